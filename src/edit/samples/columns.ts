/**
 * Extracts columns of samples in model units, and replaces some of them. Both process a few rows at a time with all of
 * their columns: column by column would pass through the memory of all rows for each.
 */

import { STEP_VALUES, type Steps } from '../../evaluate/steps.ts';
import type { Samples } from '../../model/takes/samples.ts';

/** Columns by index, an entry per frame. */
export function* takingColumns(samples: Samples, columns: readonly number[]): Steps<Map<number, Float64Array>> {
  const { scales, frameCount } = samples;
  const out = new Map(columns.map((column) => [column, new Float64Array(frameCount)]));
  const rows = Math.max(1, Math.floor(STEP_VALUES / Math.max(1, scales.length)));
  for (let from = 0; from < frameCount; from += rows) {
    const to = Math.min(frameCount, from + rows);
    for (const [column, own] of out) takeColumn(samples, column, own, from, to);
    yield to / frameCount;
  }
  return out;
}

function takeColumn({ values, scales }: Samples, column: number, own: Float64Array, from: number, to: number): void {
  const width = scales.length;
  const scale = scales[column];
  for (let f = from, at = from * width + column; f < to; f++, at += width) own[f] = values[at] * scale;
}

/**
 * Samples with other values in these columns, given in model units, an entry per frame. Unchanged values keep their
 * exact number in file units.
 * @param first the frame of the first entries; frames before it, and after the last entries, are kept
 */
export function* replacingColumns(
  samples: Samples,
  columns: ReadonlyMap<number, Float64Array>,
  first = 0,
): Steps<Samples> {
  if (columns.size === 0) return samples;
  const { scales, frameCount } = samples;
  const width = scales.length;
  const values = new Float64Array(samples.values.length);
  const rows = Math.max(1, Math.floor(STEP_VALUES / Math.max(1, width)));
  for (let from = 0; from < frameCount; from += rows) {
    const to = Math.min(frameCount, from + rows);
    values.set(samples.values.subarray(from * width, to * width), from * width);
    for (const [column, own] of columns) putColumn(values, width, column, scales[column], own, first, from, to);
    yield to / frameCount;
  }
  return { ...samples, values };
}

function putColumn(
  values: Float64Array,
  width: number,
  column: number,
  scale: number,
  own: Float64Array,
  first: number,
  from: number,
  to: number,
): void {
  const end = Math.min(to, first + own.length);
  for (let f = Math.max(from, first); f < end; f++) {
    const at = f * width + column;
    const value = own[f - first];
    if (value !== values[at] * scale) values[at] = value / scale;
  }
}
