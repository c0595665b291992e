/** Why a key has its slopes: the rule of each tangent, with the numbers that it takes. */
import { keySlope } from '../../evaluate/slopes.ts';
import { FIXED_TANGENT, FLAT, type Keys, LINEAR, TANGENT_KINDS, type TangentKind } from '../../model/takes/take.ts';

/** A slope between two keys. */
export interface Secant {
  readonly from: number;
  readonly to: number;
}

/** Why one tangent of a key has its slope. */
export interface TangentWhy {
  readonly key: number;
  readonly side: 'in' | 'out';
  readonly kind: TangentKind;
  /** Value per second. */
  readonly slope: number;
  /** Slope of the keys that give the slope; undefined if none do. */
  readonly secant?: Secant;
  /** Why it isn't what the kind says: `the first key has one segment`. */
  readonly because?: 'lone key' | 'first key' | 'last key' | 'one time' | 'overflow';
}

/** The rule that gives a key's tangent its slope, with the keys that it depends on; the key must exist. */
export function whyTangent(keys: Keys, key: number, side: 'in' | 'out'): TangentWhy {
  const tangents = side === 'in' ? keys.tangentsIn : keys.tangentsOut;
  const code = tangents.kinds[key];
  const own = { key, side, kind: TANGENT_KINDS[code], slope: keySlope(keys, key, side) };
  if (code === FLAT || code === FIXED_TANGENT) return own;
  const last = keys.times.length - 1;
  if (last === 0) return { ...own, because: 'lone key' };
  const isBetween = key > 0 && key < last;
  const isToNext = key === 0 || (isBetween && (code !== LINEAR || side === 'out'));
  const isFromBefore = key === last || (isBetween && (code !== LINEAR || side === 'in'));
  const secant = { from: isFromBefore ? key - 1 : key, to: isToNext ? key + 1 : key };
  if (keys.times[secant.from] === keys.times[secant.to]) return { ...own, secant, because: 'one time' };
  if (!Number.isFinite(quotient(keys, secant))) return { ...own, secant, because: 'overflow' };
  if (key === 0) return { ...own, secant, because: 'first key' };
  return key === last ? { ...own, secant, because: 'last key' } : { ...own, secant };
}

function quotient({ times, values }: Keys, { from, to }: Secant): number {
  return (values[to] - values[from]) / (times[to] - times[from]);
}

const BECAUSE: Readonly<Record<NonNullable<TangentWhy['because']>, string>> = {
  'lone key': 'a lone key has slope 0',
  'first key': 'of the first segment',
  'last key': 'of the last segment',
  'one time': 'two keys at one time: slope 0',
  overflow: 'too steep for a number: slope 0',
};

/** `linear in: (0.25 − (−0.3)) / (0.75 − 0.5) = 2.2`. @param number formats numbers */
export function tangentText(keys: Keys, why: TangentWhy, number: (value: number) => string): string {
  const { side, kind, slope, secant, because } = why;
  const head = `${kind} ${side}`;
  if (because === 'lone key' || because === 'one time' || because === 'overflow') return `${head}: ${BECAUSE[because]}`;
  if (!secant) return kind === 'fixed' ? `${head}: ${number(slope)}, as written` : `${head}: ${number(slope)}`;
  const { times, values } = keys;
  const difference = (column: Float64Array) =>
    `(${number(column[secant.to])} − ${bracketed(column[secant.from], number)})`;
  const of = because ? `, ${BECAUSE[because]}` : '';
  return `${head}${of}: ${difference(values)} / ${difference(times)} = ${number(slope)}`;
}

function bracketed(value: number, number: (value: number) => string): string {
  return value < 0 ? `(${number(value)})` : number(value);
}
