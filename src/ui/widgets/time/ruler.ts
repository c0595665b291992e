/**
 * Ticks of the time ruler. Labels are at 1, 2 or 5 times a power of ten, as dense as there is room; minor ticks divide
 * that by five or two. In frames, nothing is finer than a frame.
 */
import { roundStep, wholeNumbers } from '../../../math/round-steps.ts';
import { shown } from '../numbers/number-text.ts';
import type { TimeStrip } from './time-window.ts';

export interface Tick {
  readonly timeSeconds: number;
  /** Absent on minor ticks. */
  readonly label?: string;
}

/** Minimum distance of labels, in pixels: with that of the ruler, the grids of all plots are the same. */
const SPACING = 64;

export interface RulerScale extends TimeStrip {
  /** Frames per second to count in frames; absent for seconds. */
  readonly framesPerSecond?: number;
}

/** Safety limit: an empty time window must not hang the page. */
const MAX_TICKS = 2000;
/** More can't be told apart in a label. */
const MAX_DECIMALS = 12;

/** From left to right, in pixels. */
export type Extent = readonly [left: number, right: number];

/** A number closer to the playhead's flag would be read as one with it. */
const CLEAR_OF_FLAG = 12;

/** Whether a number on the ruler is far enough from the playhead's flag to be drawn. */
export function isClearOf([left, right]: Extent, flag: Extent | undefined): boolean {
  return !flag || right <= flag[0] - CLEAR_OF_FLAG || left >= flag[1] + CLEAR_OF_FLAG;
}

export function rulerTicks(scale: RulerScale): Tick[] {
  const { window, width, framesPerSecond } = scale;
  const unit = framesPerSecond ? 1 / framesPerSecond : 1;
  const from = window.from / unit;
  const to = window.to / unit;
  if (!(to > from) || !(width > 0) || !Number.isFinite(to - from)) return [];
  const least = ((to - from) / width) * SPACING;
  const step = roundStep(framesPerSecond ? Math.max(1, least) : least);
  const leading = Math.round(step / 10 ** Math.floor(Math.log10(step) + 1e-9));
  const wanted = leading === 2 ? 2 : 5;
  const parts = framesPerSecond && step / wanted < 1 ? Math.max(1, Math.round(step)) : wanted;
  const small = step / parts;
  const decimals = Math.min(MAX_DECIMALS, Math.max(0, -Math.floor(Math.log10(step) + 1e-9)));
  return wholeNumbers(from / small - 1e-9, to / small + 1e-9, MAX_TICKS).map((i) => {
    const timeSeconds = i * small * unit;
    return i % parts === 0 ? { timeSeconds, label: shown((i / parts) * step, decimals) } : { timeSeconds };
  });
}
