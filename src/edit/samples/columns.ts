/** Columns of samples on their own, in model units, and samples with some of them replaced. */
import type { Samples } from '../../model/samples.ts';

/** One column, an entry a frame. */
export function columnValues({ values, scales, frameCount }: Samples, column: number): Float64Array {
  const width = scales.length;
  const scale = scales[column];
  const out = new Float64Array(frameCount);
  for (let f = 0, at = column; f < frameCount; f++, at += width) out[f] = values[at] * scale;
  return out;
}

/** Samples with other values in these columns, given in model units, an entry a frame. */
export function withColumns(samples: Samples, columns: ReadonlyMap<number, Float64Array>): Samples {
  if (columns.size === 0) return samples;
  const { scales, frameCount } = samples;
  const width = scales.length;
  const values = samples.values.slice();
  for (const [column, own] of columns) {
    const scale = scales[column];
    for (let f = 0, at = column; f < frameCount; f++, at += width) values[at] = own[f] / scale;
  }
  return { ...samples, values };
}
