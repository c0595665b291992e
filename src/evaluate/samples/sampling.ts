/**
 * Sampled motion at any time, column by column. Finding the frame is one division, since frames are evenly spaced.
 *
 *     frame f = (time − start) / frameSeconds        row ⌊f⌋, and the fraction of the way to the next
 *
 * Before the first frame and after the last one their values hold. NaN and −∞ give the first frame's value, +∞ the last
 * one's.
 *
 * These are the curves of the curve editor, independent of what they drive: between two samples an angle is
 * interpolated numerically, even from 179° to −179°. What a character does in between depends on its joints
 * (`sampled-pose.ts`). At frames, both equal the file's values.
 */
import type { Samples } from '../../model/takes/samples.ts';

/** Fraction of a frame below which a time counts as that frame: 10 · 0.0333333 is meant to be frame 10. */
const SAME_FRAME = 1e-6;

/** The frame at a time, from 0 to the last, with the fraction of the way to the next. */
export function frameAt({ frameCount, frameSeconds, startSeconds }: Samples, timeSeconds: number): number {
  const frame = (timeSeconds - startSeconds) / frameSeconds;
  if (!(frame > 0)) return 0;
  if (frame >= frameCount - 1) return frameCount - 1;
  const nearest = Math.round(frame);
  return Math.abs(frame - nearest) < SAME_FRAME ? nearest : frame;
}

/** The frame that is at a time; undefined between frames, and outside of them. */
export function wholeFrameAt(samples: Samples, timeSeconds: number): number | undefined {
  const frame = Math.round(frameAt(samples, timeSeconds));
  const exact = (timeSeconds - samples.startSeconds) / samples.frameSeconds;
  return Math.abs(exact - frame) < SAME_FRAME ? frame : undefined;
}

/** The value of a single column: angles between frames follow the curve, not the joint's rotation. */
export function sampleColumn(samples: Samples, column: number, timeSeconds: number): number {
  const { values, scales, frameCount, interpolation } = samples;
  const frame = frameAt(samples, timeSeconds);
  const row = Math.floor(frame);
  const part = frame - row;
  const width = scales.length;
  const at = row * width + column;
  const scale = scales[column];
  const here = values[at];
  if (part === 0) return here * scale;
  const next = values[at + width];
  if (interpolation === 'nearest') return (part < 0.5 ? here : next) * scale;
  if (interpolation === 'linear') return (here + (next - here) * part) * scale;
  const before = row > 0 ? values[at - width] : 2 * here - next;
  const after = row + 2 < frameCount ? values[at + 2 * width] : 2 * next - here;
  return catmullRom(before, here, next, after, part) * scale;
}

/** Slope of a column at a time, per second; `side` selects one side of a corner. */
export function columnSlope(samples: Samples, column: number, timeSeconds: number, side: 'in' | 'out'): number {
  const { values, scales, frameCount, frameSeconds, startSeconds, interpolation } = samples;
  const frame = frameAt(samples, timeSeconds);
  const isBeyond = !(Math.abs((timeSeconds - startSeconds) / frameSeconds - frame) <= SAME_FRAME);
  if (isBeyond || interpolation === 'nearest') return 0;
  const row = side === 'in' ? Math.ceil(frame) - 1 : Math.floor(frame);
  if (row < 0 || row >= frameCount - 1) return 0;
  const width = scales.length;
  const at = row * width + column;
  const here = values[at];
  const next = values[at + width];
  const perSecond = scales[column] / frameSeconds;
  if (interpolation === 'linear') return (next - here) * perSecond;
  const before = row > 0 ? values[at - width] : 2 * here - next;
  const after = row + 2 < frameCount ? values[at + 2 * width] : 2 * next - here;
  return catmullRomSlope(before, here, next, after, frame - row) * perSecond;
}

/**
 * Writes to `out[c]` the value that channel c follows in a row, for the first `count` channels; those with column -1
 * are left alone.
 */
export function sampleRow(
  { values, scales }: Samples,
  columns: Int32Array,
  row: number,
  out: Float64Array,
  count: number,
): void {
  const at = row * scales.length;
  for (let c = 0; c < count; c++) {
    const column = columns[c];
    if (column >= 0) out[c] = values[at + column] * scales[column];
  }
}

/**
 * Catmull and Rom's cubic (1974) from `here` (t = 0) to `next` (t = 1): its slope at a frame is that from the previous
 * to the next frame, so that it has no corners. At the ends of the samples the slope is extrapolated.
 */
export function catmullRom(before: number, here: number, next: number, after: number, t: number): number {
  const m0 = (next - before) / 2;
  const m1 = (after - here) / 2;
  const c2 = 3 * (next - here) - 2 * m0 - m1;
  const c3 = m0 + m1 - 2 * (next - here);
  return ((c3 * t + c2) * t + m0) * t + here;
}

/** Its derivative with respect to t. */
function catmullRomSlope(before: number, here: number, next: number, after: number, t: number): number {
  const m0 = (next - before) / 2;
  const m1 = (after - here) / 2;
  const c2 = 3 * (next - here) - 2 * m0 - m1;
  const c3 = m0 + m1 - 2 * (next - here);
  return (3 * c3 * t + 2 * c2) * t + m0;
}
