/**
 * Differences between plain values, for a history that stores only what differs.
 *
 * Immutable documents share every unchanged object, so at first sight undo steps cost nothing. But a past document also
 * retains everything that changed *later*, and channels are columns: moving one key of a hundred thousand makes new
 * ones. A thousand such steps would retain a thousand copies. So a past value is stored as its difference from the next
 * one, which is available when the history is walked back step by step:
 *
 *     from      ▒▒▒▒▒▒▒▒▒▒ 1 2 ▒▒▒▒▒▒▒▒▒
 *     target    ▒▒▒▒▒▒▒▒▒▒ 7 7 7 ▒▒▒▒▒▒▒▒▒      stored: 7 7 7, and its position
 *
 * The difference is computed from the two values and independent of commands. (An inverse for each command would
 * duplicate what the command does.)
 */

/** How to make a value from the one it is stored relative to. */
export type Delta =
  /** Anything, whole. */
  | { readonly kind: 'value'; readonly value: unknown }
  /** A plain object: changed properties, and removed ones. */
  | { readonly kind: 'object'; readonly changed: readonly Change<string>[]; readonly gone: readonly string[] }
  /** A list of unchanged length. */
  | { readonly kind: 'items'; readonly changed: readonly Change<number>[] }
  /** A typed array of unchanged length, with some different numbers. */
  | { readonly kind: 'runs'; readonly runs: readonly Run[] }
  /** A list or typed array of different length: elements from the start, new ones, elements from the end. */
  | { readonly kind: 'stretch'; readonly head: number; readonly middle: Sequence; readonly tail: number };

interface Change<Key> {
  readonly key: Key;
  readonly delta: Delta;
}

interface Run {
  readonly start: number;
  readonly numbers: Numbers;
}

/** Runs closer than this are merged, since each has overhead. */
const NEAR_RUNS = 16;

type Numbers = Float64Array | Float32Array | Uint32Array | Int32Array | Uint8Array;
type Sequence = readonly unknown[] | Numbers;

/** Undefined if both are the same value. */
export function deltaTo(target: unknown, from: unknown): Delta | undefined {
  if (Object.is(target, from)) return undefined;
  if (isNumbers(target) && isNumbers(from) && target.constructor === from.constructor) {
    // Two views of the same memory, as from cropping: keeping both costs nothing.
    if (target.buffer === from.buffer) return isSameView(target, from) ? undefined : whole(target);
    return target.length === from.length ? runs(target, from) : stretch(target, from);
  }
  if (Array.isArray(target) && Array.isArray(from)) {
    return target.length === from.length ? items(target, from) : stretch(target, from);
  }
  if (isRecord(target) && isRecord(from)) return properties(target, from);
  return { kind: 'value', value: target };
}

/** Whether both are the same plain value, exactly. */
export function sameValue(a: unknown, b: unknown): boolean {
  return deltaTo(a, b) === undefined;
}

/** Reconstructs the target. Equal parts are shared with `from`. */
export function applyDelta(from: unknown, delta: Delta | undefined): unknown {
  switch (delta?.kind) {
    case undefined:
      return from;
    case 'value':
      return delta.value;
    case 'object': {
      const made: Record<string, unknown> = isRecord(from) ? { ...from } : {};
      for (const { key, delta: change } of delta.changed) made[key] = applyDelta(made[key], change);
      for (const key of delta.gone) delete made[key];
      return made;
    }
    case 'items': {
      const made: unknown[] = Array.isArray(from) ? [...from] : [];
      for (const { key, delta: change } of delta.changed) made[key] = applyDelta(made[key], change);
      return made;
    }
    case 'runs': {
      // It was made from a typed array of that length.
      const made = (from as Numbers).slice();
      for (const { start, numbers } of delta.runs) made.set(numbers, start);
      return made;
    }
    case 'stretch':
      return joined(from, delta.head, delta.middle, delta.tail);
  }
}

function properties(target: Readonly<Record<string, unknown>>, from: Readonly<Record<string, unknown>>) {
  const changed: Change<string>[] = [];
  for (const key of Object.keys(target)) {
    // An undefined property differs from a missing one.
    const delta = key in from ? deltaTo(target[key], from[key]) : whole(target[key]);
    if (delta) changed.push({ key, delta });
  }
  const gone = Object.keys(from).filter((key) => !(key in target));
  return changed.length || gone.length ? { kind: 'object' as const, changed, gone } : undefined;
}

function items(target: readonly unknown[], from: readonly unknown[]): Delta | undefined {
  const changed: Change<number>[] = [];
  for (let key = 0; key < target.length; key++) {
    const delta = deltaTo(target[key], from[key]);
    if (delta) changed.push({ key, delta });
  }
  return changed.length ? { kind: 'items', changed } : undefined;
}

/** Number of elements of long columns that are probed first. */
const PROBES = 64;
const LONG = 1 << 16;
/** Columns this long are stored whole: finding the difference would take longer than a frame. */
const HUGE = 1 << 22;

/**
 * Whether a long column differs so much that runs hardly pay. The array itself exists and costs nothing; runs would
 * copy at least half of it. (The history keeps whole arrays from accumulating.)
 */
function isAnother(target: Numbers, from: Numbers): boolean {
  const { length } = target;
  if (length < LONG) return false;
  if (length >= HUGE) return true;
  let others = 0;
  for (let i = 0; i < PROBES; i++) {
    const at = Math.floor(((i + 0.5) * length) / PROBES);
    if (!Object.is(target[at], from[at])) others++;
  }
  return others > 0.5 * PROBES;
}

/** Many small runs cost more than the whole. */
function runs(target: Numbers, from: Numbers): Delta | undefined {
  if (isAnother(target, from)) return whole(target);
  const found: Run[] = [];
  const { length } = target;
  for (let start = 0; start < length; start++) {
    if (Object.is(target[start], from[start])) continue;
    let end = start + 1;
    for (let i = end; i < length && i < end + NEAR_RUNS; i++) if (!Object.is(target[i], from[i])) end = i + 1;
    found.push({ start, numbers: target.slice(start, end) });
    start = end;
  }
  if (found.length === 0) return undefined;
  const kept = found.reduce((sum, { numbers }) => sum + NEAR_RUNS + numbers.length, 0);
  return kept < length ? { kind: 'runs', runs: found } : whole(target);
}

function stretch(target: Sequence, from: Sequence): Delta | undefined {
  if (target.length >= HUGE) return whole(target);
  const most = Math.min(target.length, from.length);
  let head = 0;
  while (head < most && Object.is(target[head], from[head])) head++;
  if (head === target.length && head === from.length) return undefined;
  let tail = 0;
  while (tail < most - head && Object.is(target[target.length - 1 - tail], from[from.length - 1 - tail])) tail++;
  if (head + tail === 0) return whole(target);
  // A long one that is mostly different exists already; the middle would be a copy.
  if (target.length > LONG && head + tail < target.length / 2) return whole(target);
  return { kind: 'stretch', head, middle: target.slice(head, target.length - tail), tail };
}

function joined(from: unknown, head: number, middle: Sequence, tail: number): unknown {
  if (!isNumbers(middle)) {
    const list: readonly unknown[] = Array.isArray(from) ? from : [];
    return [...list.slice(0, head), ...middle, ...list.slice(list.length - tail)];
  }
  // All five have a constructor that takes a length; to TypeScript a constructor is only a function.
  const Made = middle.constructor as new (length: number) => Numbers;
  const made = new Made(head + middle.length + tail);
  made.set(middle, head);
  if (isNumbers(from)) {
    made.set(from.subarray(0, head));
    made.set(from.subarray(from.length - tail), head + middle.length);
  }
  return made;
}

function whole(value: unknown): Delta {
  return { kind: 'value', value };
}

function isSameView(a: Numbers, b: Numbers): boolean {
  return a.byteOffset === b.byteOffset && a.length === b.length;
}

function isNumbers(value: unknown): value is Numbers {
  return (
    value instanceof Float64Array ||
    value instanceof Float32Array ||
    value instanceof Uint32Array ||
    value instanceof Int32Array ||
    value instanceof Uint8Array
  );
}

/** Plain data only; anything else is stored whole. */
function isRecord(value: unknown): value is Readonly<Record<string, unknown>> {
  return typeof value === 'object' && value !== null && Object.getPrototypeOf(value) === Object.prototype;
}
