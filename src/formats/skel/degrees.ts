/**
 * Degrees and radians in the axis-angle form.
 *
 *     radians = degrees · (π / 180)        a single product of doubles, so that writing can predict what reading gives
 *
 * Not every double is such a product: where degrees are spaced more coarsely than radians, about one in ten angles that
 * were not read from degrees (such as dragged ones) lies between two of them, and is written as the nearer one: off by
 * half a unit in the last place, and stable from then on.
 */
import { RADIANS_PER_DEGREE } from '../../math/degrees.ts';

/** Radians of an angle in degrees, rounded once. */
export function radiansOf(degrees: number): number {
  return degrees * RADIANS_PER_DEGREE;
}

/** The number with the shortest decimal that `radiansOf` maps to these radians, or if there is none, the nearest. */
export function degreesOf(radians: number): number {
  const about = radians / RADIANS_PER_DEGREE;
  if (about === 0 || !Number.isFinite(about)) return about;
  const near = neighbours(about);
  const off = (degrees: number) => Math.abs(radiansOf(degrees) - radians);
  const nearest = near.reduce((best, degrees) => (off(degrees) < off(best) ? degrees : best));
  const alike = near.filter((degrees) => radiansOf(degrees) === radiansOf(nearest));
  return alike.reduce((best, degrees) => (`${degrees}`.length < `${best}`.length ? degrees : best));
}

const double = new Float64Array(1);
const bits = new BigInt64Array(double.buffer);

/** The double itself and two on either side, since quotient and product may each round by one. */
function neighbours(value: number): readonly number[] {
  return [0n, 1n, -1n, 2n, -2n].map((step) => {
    double[0] = value;
    bits[0] += step;
    return double[0];
  });
}
