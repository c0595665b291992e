/** Transformations that make our points theirs: moved, swapped axes, scaled, or one axis alone. */
import { shortNumber } from '../compare/short-number.ts';

/** Points of one time: x y z each. */
export interface PointPair {
  readonly theirs: Float64Array;
  readonly ours: Float64Array;
  /** In the unit of the points. */
  readonly tolerance: number;
}

const AXES = ['x', 'y', 'z'];

/** In words; undefined if no place differs. @param wrong indices of the points that differ at any of the times */
export function pointPattern(pairs: readonly PointPair[], wrong: readonly number[]): string | undefined {
  const every = (test: (pair: PointPair, o: number) => boolean, points?: readonly number[]) =>
    pairs.every((pair) => (points ?? allOf(pair)).every((p) => test(pair, 3 * p)));
  const isNear = ({ theirs, tolerance }: PointPair, i: number, value: number) =>
    Math.abs(theirs[i] - value) <= tolerance;
  const differing = [0, 1, 2].filter((k) => !every((pair, o) => isNear(pair, o + k, pair.ours[o + k]), wrong));
  if (differing.length === 0) return undefined;
  if (!every(({ theirs }, o) => [0, 1, 2].every((k) => Number.isFinite(theirs[o + k])), wrong))
    return 'of which some are not finite numbers';
  const [pair] = pairs;
  const offset = [0, 1, 2].map((k) => pair.theirs[3 * wrong[0] + k] - pair.ours[3 * wrong[0] + k]);
  if (every((each, o) => offset.every((d, k) => isNear(each, o + k, each.ours[o + k] + d)), wrong)) {
    return `by a constant offset (${offset.map((d) => shortNumber(Math.abs(d) <= pair.tolerance ? 0 : d)).join(', ')})`;
  }
  for (const { words, from, sign } of AXIS_MAPS) {
    if (every((each, o) => from.every((axis, k) => isNear(each, o + k, sign[k] * each.ours[o + axis])))) return words;
  }
  const scale = scaleOf(pairs);
  if (
    Number.isFinite(scale) &&
    every((each, o) => [0, 1, 2].every((k) => isNear(each, o + k, scale * each.ours[o + k])))
  ) {
    return `scaled by ${shortNumber(scale)}`;
  }
  let largest = 0;
  for (const each of pairs) for (const p of wrong) largest = Math.max(largest, distance(each, 3 * p));
  const only = differing.length < 3 ? `only in ${differing.map((k) => AXES[k]).join(' and ')}, ` : '';
  return `${only}by up to ${shortNumber(largest)}`;
}

function allOf({ theirs }: PointPair): readonly number[] {
  return Array.from({ length: theirs.length / 3 }, (_, p) => p);
}

function distance({ theirs, ours }: PointPair, o: number): number {
  return Math.hypot(theirs[o] - ours[o], theirs[o + 1] - ours[o + 1], theirs[o + 2] - ours[o + 2]);
}

/** Least squares. */
function scaleOf(pairs: readonly PointPair[]): number {
  let [product, square] = [0, 0];
  for (const { theirs, ours } of pairs) {
    for (let i = 0; i < theirs.length; i++) {
      product += theirs[i] * ours[i];
      square += ours[i] * ours[i];
    }
  }
  return product / square;
}

interface AxisMap {
  readonly words: string;
  /** Which of our axes each of theirs is, and with which sign. */
  readonly from: readonly number[];
  readonly sign: readonly number[];
}

/** All ways to exchange and to negate axes, but for none. */
const AXIS_MAPS: readonly AxisMap[] = [
  [0, 1, 2],
  [0, 2, 1],
  [2, 1, 0],
  [1, 0, 2],
  [1, 2, 0],
  [2, 0, 1],
].flatMap((from) =>
  [0, 1, 2, 4, 3, 5, 6, 7].flatMap((bits) => {
    const sign = [0, 1, 2].map((k) => ((bits >> k) & 1 ? -1 : 1));
    return from.every((axis, k) => axis === k) && bits === 0 ? [] : [{ words: mapWords(from, sign), from, sign }];
  }),
);

function mapWords(from: readonly number[], sign: readonly number[]): string {
  const negative = AXES.filter((_, k) => sign[k] < 0);
  if (from.every((axis, k) => axis === k))
    return negative.length === 1 ? `mirrored in ${negative[0]}` : `with ${negative.join(', ')} negated`;
  const moved = AXES.filter((_, k) => from[k] !== k);
  if (negative.length === 0 && moved.length === 2) return `with ${moved.join(' and ')} swapped`;
  return `with ${from.map((axis, k) => `${sign[k] < 0 ? '-' : ''}${AXES[axis]}`).join(', ')} for x, y, z`;
}
