/** Sines and cosines of half angles for a whole row of samples; used to make quaternions. */
import { writeSinesAndCosines } from '../../math/sines-cosines.ts';

/** Half angles of one row, and their sines and cosines; reused from row to row. */
export class HalfAngles {
  halves = new Float64Array(0);
  /** Sine and cosine of each. */
  turned = new Float64Array(0);

  /**
   * Reads half angles from a row of samples.
   * @param at start of the row
   * @param columns column of each angle in the row
   * @param factors for each angle, from the number in the file to half the angle in radians
   */
  read(values: Float64Array, at: number, columns: Int32Array, factors: Float64Array): void {
    const count = columns.length;
    if (this.halves.length < count) {
      this.halves = new Float64Array(count);
      this.turned = new Float64Array(2 * count);
    }
    const { halves, turned } = this;
    for (let i = 0; i < count; i++) halves[i] = values[at + columns[i]] * factors[i];
    writeSinesAndCosines(halves, count, turned);
  }
}
