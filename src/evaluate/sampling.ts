/**
 * Sampled motion at any time. Finding the frame is one division: the rows are at uniform times.
 *
 *     frame f = (time − start) / frameSeconds        row ⌊f⌋, and the part of the way to the next one
 *
 * Before the first frame and after the last one their values hold. A time that is no finite number gives the first
 * frame's, but +∞ the last one's.
 */
import type { Samples } from '../model/samples.ts';

/** Nearer to a frame than this part of one is that frame: 10 · 0.0333333 is meant to be frame 10. */
const SAME_FRAME = 1e-6;

/** Where a time lies: `row`, and `part` of the way from it to the next. Scratch of `locate`. */
const place = { row: 0, part: 0 };

function locate({ frameCount, frameSeconds, startSeconds }: Samples, timeSeconds: number): void {
  const last = frameCount - 1;
  const frame = (timeSeconds - startSeconds) / frameSeconds;
  if (!(frame > 0)) place.row = place.part = 0;
  else if (frame >= last) {
    place.row = last;
    place.part = 0;
  } else {
    place.row = Math.floor(frame);
    place.part = frame - place.row;
    if (place.part < SAME_FRAME) place.part = 0;
    else if (place.part > 1 - SAME_FRAME) {
      place.row++;
      place.part = 0;
    }
  }
}

/** One column at a time, by itself: angles between frames are those of the curve, not of the joint's rotation. */
export function sampleColumn(samples: Samples, column: number, timeSeconds: number): number {
  locate(samples, timeSeconds);
  return valueAt(samples, column);
}

/**
 * Writes to `out[c]` what channel c follows, of the first `count` channels; those that follow nothing stay as they are.
 * @param columns one a channel; -1 for none
 */
export function sampleColumns(
  samples: Samples,
  columns: Int32Array,
  timeSeconds: number,
  out: Float64Array,
  count: number,
): void {
  locate(samples, timeSeconds);
  for (let c = 0; c < count; c++) if (columns[c] >= 0) out[c] = valueAt(samples, columns[c]);
}

/** How fast a column changes at a time, a second; on one side of it where there is a corner. */
export function columnSlope(samples: Samples, column: number, timeSeconds: number, side: 'in' | 'out'): number {
  const step = samples.frameSeconds / 256;
  const [from, to] = side === 'in' ? [timeSeconds - step, timeSeconds] : [timeSeconds, timeSeconds + step];
  return (sampleColumn(samples, column, to) - sampleColumn(samples, column, from)) / step;
}

function valueAt({ values, scales, frameCount, interpolation }: Samples, column: number): number {
  const width = scales.length;
  const { row, part } = place;
  const at = row * width + column;
  const scale = scales[column];
  const here = values[at];
  if (part === 0) return here * scale;
  const next = values[at + width];
  if (interpolation === 'nearest') return (part < 0.5 ? here : next) * scale;
  if (interpolation === 'linear') return (here + (next - here) * part) * scale;
  // Catmull-Rom; at the ends the way goes on as it came.
  const before = row > 0 ? values[at - width] : 2 * here - next;
  const after = row + 2 < frameCount ? values[at + 2 * width] : 2 * next - here;
  const m0 = (next - before) / 2;
  const m1 = (after - here) / 2;
  const c2 = 3 * (next - here) - 2 * m0 - m1;
  const c3 = m0 + m1 - 2 * (next - here);
  return (((c3 * part + c2) * part + m0) * part + here) * scale;
}
