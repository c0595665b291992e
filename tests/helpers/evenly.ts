import fc from 'fast-check';

/** Numbers spread evenly over a range: half of `fc.double`'s are close to 0. */
export function evenly(min: number, max: number): fc.Arbitrary<number> {
  return fc.nat(1_000_000_007).map((k) => min + (max - min) * (k / 1_000_000_007));
}
