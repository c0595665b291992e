/**
 * Ticks of the time ruler. Labels are at 1, 2 or 5 times a power of ten, as dense as there is room; minor ticks divide
 * that by five or two. In frames, nothing is finer than a frame.
 */
import { roundStep } from '../../math/round-steps.ts';
import { shown } from './number-text.ts';

export interface Tick {
  readonly timeSeconds: number;
  /** Absent on minor ticks. */
  readonly label?: string;
}

export interface RulerScale {
  readonly fromSeconds: number;
  readonly toSeconds: number;
  /** Width in pixels. */
  readonly width: number;
  /** Minimum distance of labels in pixels. */
  readonly spacing: number;
  /** Frames per second to count in frames; absent for seconds. */
  readonly framesPerSecond?: number;
}

/** Safety limit: an empty time window must not hang the page. */
const MAX_TICKS = 2000;

export function rulerTicks(scale: RulerScale): Tick[] {
  const { fromSeconds, toSeconds, width, spacing, framesPerSecond } = scale;
  const unit = framesPerSecond ? 1 / framesPerSecond : 1;
  const from = fromSeconds / unit;
  const to = toSeconds / unit;
  if (!(to > from) || !(width > 0) || !Number.isFinite(to - from)) return [];
  const least = ((to - from) / width) * spacing;
  const step = roundStep(framesPerSecond ? Math.max(1, least) : least);
  const leading = Math.round(step / 10 ** Math.floor(Math.log10(step) + 1e-9));
  const wanted = leading === 2 ? 2 : 5;
  const parts = framesPerSecond && step / wanted < 1 ? Math.max(1, Math.round(step)) : wanted;
  const small = step / parts;
  const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const first = Math.ceil(from / small - 1e-9);
  const last = Math.min(Math.floor(to / small + 1e-9), first + MAX_TICKS);
  const ticks: Tick[] = [];
  for (let i = first; i <= last; i++) {
    const timeSeconds = i * small * unit;
    if (i % parts === 0) ticks.push({ timeSeconds, label: shown((i / parts) * step, decimals) });
    else ticks.push({ timeSeconds });
  }
  return ticks;
}
