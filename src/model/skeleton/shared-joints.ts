/**
 * Joints of files that are read one after the other: equal ones become the same array, so that thousands of takes of
 * one session share what is computed from their skeleton (`per-skeleton.ts`).
 */
import type { Joint } from './skeleton.ts';

/** Sessions have one skeleton, or one per actor. */
const REMEMBERED = 8;

/** The latest come first. */
const latest: (readonly Joint[])[] = [];

/** An equal array that was given before, else the same one. The last eight are remembered. */
export function sharedJoints(joints: readonly Joint[]): readonly Joint[] {
  const found = latest.findIndex((known) => isEqual(known, joints));
  const [known = joints] = found < 0 ? [] : latest.splice(found, 1);
  latest.unshift(known);
  latest.length = Math.min(latest.length, REMEMBERED);
  return known;
}

/** Equality of plain values: numbers exactly, NaN equal to NaN and 0 not to −0. */
function isEqual(a: unknown, b: unknown): boolean {
  if (Object.is(a, b)) return true;
  if (typeof a !== 'object' || typeof b !== 'object' || a === null || b === null) return false;
  if (Array.isArray(a) && Array.isArray(b)) {
    if (a.length !== b.length) return false;
    for (let i = 0; i < a.length; i++) if (!isEqual(a[i], b[i])) return false;
    return true;
  }
  // Of other prototypes, such as typed arrays, only the same object is equal.
  if (Object.getPrototypeOf(a) !== Object.prototype || Object.getPrototypeOf(b) !== Object.prototype) return false;
  const entries = Object.entries(b);
  if (Object.keys(a).length !== entries.length) return false;
  // Checked to be an object of named values.
  const own = a as Readonly<Record<string, unknown>>;
  for (const [key, value] of entries) if (!(key in own) || !isEqual(own[key], value)) return false;
  return true;
}
