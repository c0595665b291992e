/** The frame rate that the settings of an FBX file state. */
import { statedRate } from '../../evaluate/samples/frame-rate.ts';
import type { Properties } from './document.ts';

const FILM = 24 / 1.001;
const NTSC = 30 / 1.001;

/** By `TimeMode`, in its order; that of 0 is anyone's default, and 14 is `CUSTOM`. */
const RATES = [
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
const CUSTOM = 14;
/** Frames per second that a custom rate can mean. */
const MOST = 10_000;

/** Frames per second; undefined if the file states none. */
export function timeModeRate(settings: Properties): number | undefined {
  const mode = settings.number('TimeMode') ?? 0;
  if (mode !== CUSTOM) return RATES[mode];
  const rate = settings.number('CustomFrameRate') ?? 0;
  return rate >= 1 && rate <= MOST ? statedRate(rate) : undefined;
}
