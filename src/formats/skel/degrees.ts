/**
 * Degrees and radians of the axis-angle form.
 *
 *     radians = degrees · (π / 180)        one product of doubles, so that writing can tell what reading will give
 *
 * Not every double is such a product: where the degrees' spacing maps to more than the radians' own, about one angle in
 * ten that nobody read from degrees (one that was dragged) lies between two of them, and is written as the nearer one:
 * half a unit of its last place off, and the same from then on.
 */
import { RADIANS_PER_DEGREE } from '../../model/samples.ts';

export function radiansOf(degrees: number): number {
  return degrees * RADIANS_PER_DEGREE;
}

/** The number with the shortest decimal that `radiansOf` makes these radians of, or, where none does, the nearest to them. */
export function degreesOf(radians: number): number {
  const about = radians / RADIANS_PER_DEGREE;
  if (about === 0 || about - about !== 0) return about;
  const near = neighbours(about);
  const off = (degrees: number) => Math.abs(radiansOf(degrees) - radians);
  const nearest = near.reduce((best, degrees) => (off(degrees) < off(best) ? degrees : best));
  const alike = near.filter((degrees) => radiansOf(degrees) === radiansOf(nearest));
  return alike.reduce((best, degrees) => (`${degrees}`.length < `${best}`.length ? degrees : best));
}

const double = new Float64Array(1);
const bits = new BigInt64Array(double.buffer);

/** The double itself and two on either side, for quotient and product each may round by one. */
function neighbours(value: number): readonly number[] {
  return [0n, 1n, -1n, 2n, -2n].map((step) => {
    double[0] = value;
    bits[0] += step;
    return double[0];
  });
}
