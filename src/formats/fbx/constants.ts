/** Numbers of the FBX format that both reading and writing need. */
import type { EulerOrder } from '../../model/skeleton/skeleton.ts';

/** Units of time in a second, unless a file states another number. */
export const TICKS_PER_SECOND = 46186158000;

const FILM = 24 / 1.001;
const NTSC = 30 / 1.001;

/** Frames per second by `TimeMode`, in its order; that of 0 is anyone's default, and 14 is `CUSTOM_RATE`. */
export const RATES: readonly (number | undefined)[] = [
  undefined,
  120,
  100,
  60,
  50,
  48,
  30,
  30,
  NTSC,
  NTSC,
  25,
  24,
  1000,
  FILM,
  undefined,
  96,
  72,
  2 * NTSC,
  4 * NTSC,
];
/** The `TimeMode` of a rate that `CustomFrameRate` states. */
export const CUSTOM_RATE = 14;

/** By `RotationOrder`. Spheric angles, which no exporter is known to write, are read as the first. */
export const ROTATION_ORDERS: readonly EulerOrder[] = ['xyz', 'xzy', 'yzx', 'yxz', 'zxy', 'zyx', 'xyz'];
