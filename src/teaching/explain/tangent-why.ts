/** Why a key has its slopes: the rule of each tangent, with the numbers that it takes. */
import { keySlope } from '../../evaluate/slopes.ts';
import { crossesSeam } from '../../model/takes/auto-slope.ts';
import type { KeyedCurve, Keys } from '../../model/takes/take.ts';
import {
  AUTO_TANGENT,
  FIXED_TANGENT,
  FLAT,
  LINEAR,
  TANGENT_KINDS,
  type TangentKind,
} from '../../model/takes/tangent-kinds.ts';

/** A slope between two keys. */
export interface Secant {
  readonly from: number;
  readonly to: number;
}

/** What decides an `auto` slope, if it isn’t that between both neighbours: `model/takes/auto-slope.ts`. */
type AutoRule = 'end' | 'level' | 'limited' | 'seam';

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
  readonly because?: 'lone key' | 'first key' | 'last key' | 'one time' | 'overflow' | AutoRule;
}

/** The rule that gives a key's tangent its slope, with the keys that it depends on; the key must exist. */
export function whyTangent(keys: KeyedCurve, key: number, side: 'in' | 'out'): TangentWhy {
  const tangents = side === 'in' ? keys.tangentsIn : keys.tangentsOut;
  const code = tangents.kinds[key];
  const own = { key, side, kind: TANGENT_KINDS[code], slope: keySlope(keys, key, side) };
  if (code === FLAT || code === FIXED_TANGENT) return own;
  const last = keys.times.length - 1;
  if (last === 0) return { ...own, because: 'lone key' };
  if (code === AUTO_TANGENT) return whyAuto(keys, own);
  const isBetween = key > 0 && key < last;
  const isToNext = key === 0 || (isBetween && (code !== LINEAR || side === 'out'));
  const isFromBefore = key === last || (isBetween && (code !== LINEAR || side === 'in'));
  const secant = { from: isFromBefore ? key - 1 : key, to: isToNext ? key + 1 : key };
  if (keys.times[secant.from] === keys.times[secant.to]) return { ...own, secant, because: 'one time' };
  if (!Number.isFinite(quotient(keys, secant))) return { ...own, secant, because: 'overflow' };
  if (key === 0) return { ...own, secant, because: 'first key' };
  return key === last ? { ...own, secant, because: 'last key' } : { ...own, secant };
}

function whyAuto(keys: KeyedCurve, own: TangentWhy): TangentWhy {
  const { key, slope } = own;
  if (key === 0 || key === keys.times.length - 1) return { ...own, because: crossesSeam(keys) ? 'seam' : 'end' };
  if (slope === 0) return { ...own, because: 'level' };
  const secant = { from: key - 1, to: key + 1 };
  return quotient(keys, secant) === slope ? { ...own, secant } : { ...own, because: 'limited' };
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
  end: 'level at the end',
  level: 'level, the curve turns or holds here',
  limited: 'at most three times the lesser slope beside it',
  seam: 'as across the seam of the loop',
};

/** `linear in: (0.25 − (−0.3)) / (0.75 − 0.5) = 2.2`. @param number formats numbers */
export function tangentText(keys: Keys, why: TangentWhy, number: (value: number) => string): string {
  const { side, kind, slope, secant, because } = why;
  const head = `${kind} ${side}`;
  if (because === 'lone key' || because === 'one time' || because === 'overflow') return `${head}: ${BECAUSE[because]}`;
  if (kind === 'auto' && because) return `${head}: ${number(slope)}, ${BECAUSE[because]}`;
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
