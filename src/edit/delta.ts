/**
 * What it takes to come from one plain value to another: for a history that keeps no more than what is different.
 *
 * Immutable documents share every object that did not change, so at first sight a step costs nothing to keep. But a
 * document of the past also holds on to all that changed *later*, and a channel is columns: moving one key of a
 * hundred thousand makes new ones. A thousand such steps would hold a thousand copies. So a past value is kept as its
 * difference to the one after it, which is at hand when the history is walked back step by step:
 *
 *     from      ▒▒▒▒▒▒▒▒▒▒ 1 2 ▒▒▒▒▒▒▒▒▒
 *     target    ▒▒▒▒▒▒▒▒▒▒ 7 7 7 ▒▒▒▒▒▒▒▒▒      kept: 7 7 7, and where it goes
 *
 * It is read off the two values and knows nothing of commands. (An inverse for each command would be a second truth
 * about what that command does.)
 */

/** How to make a value out of the one it is kept against. */
export type Delta =
  /** Anything, whole. */
  | { readonly kind: 'value'; readonly value: unknown }
  /** A plain object: properties that are others, and those that are not there. */
  | { readonly kind: 'object'; readonly changed: readonly Change<string>[]; readonly gone: readonly string[] }
  /** A list as long as before. */
  | { readonly kind: 'items'; readonly changed: readonly Change<number>[] }
  /** A typed array as long as before, with other numbers here and there. */
  | { readonly kind: 'runs'; readonly runs: readonly Run[] }
  /** A list or typed array of another length: so many elements from the beginning, others, so many from the end. */
  | { readonly kind: 'stretch'; readonly head: number; readonly middle: Sequence; readonly tail: number };

interface Change<Key> {
  readonly key: Key;
  readonly delta: Delta;
}

interface Run {
  readonly start: number;
  readonly numbers: Numbers;
}

/** Runs nearer to each other than this are kept as one: a run has a cost of its own. */
const NEAR_RUNS = 16;

type Numbers = Float64Array | Float32Array | Uint32Array | Int32Array | Uint8Array;
type Sequence = readonly unknown[] | Numbers;

/** undefined where both are the same value. */
export function deltaTo(target: unknown, from: unknown): Delta | undefined {
  if (Object.is(target, from)) return undefined;
  if (isNumbers(target) && isNumbers(from) && target.constructor === from.constructor) {
    // Two views of one memory, as cropping makes: to keep both costs nothing.
    if (target.buffer === from.buffer) return isSameView(target, from) ? undefined : whole(target);
    return target.length === from.length ? runs(target, from) : stretch(target, from);
  }
  if (Array.isArray(target) && Array.isArray(from)) {
    return target.length === from.length ? items(target, from) : stretch(target, from);
  }
  if (isRecord(target) && isRecord(from)) return properties(target, from);
  return { kind: 'value', value: target };
}

/** Whether both are the same plain value, to the last bit. */
export function sameValue(a: unknown, b: unknown): boolean {
  return deltaTo(a, b) === undefined;
}

/** The target again. What is equal in both is shared with `from`. */
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
      // What it was made from is a typed array of that length.
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
    // A property that is undefined is another thing than none.
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

/** How many places of long columns are looked at first. */
const PROBES = 64;
const LONG = 1 << 16;
/** Columns as long as that are kept whole: to look for what is another takes longer than a frame of the screen. */
const HUGE = 1 << 22;

/**
 * Whether so many numbers of a long column are others that runs hardly pay. Its own array is there and costs nothing to
 * make; runs would be copies of half of it at least. (The history sees to it that arrays kept whole don't pile up.)
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
  // A long one that is mostly another is there already; the middle would be a copy.
  if (target.length > LONG && head + tail < target.length / 2) return whole(target);
  return { kind: 'stretch', head, middle: target.slice(head, target.length - tail), tail };
}

function joined(from: unknown, head: number, middle: Sequence, tail: number): unknown {
  if (!isNumbers(middle)) {
    const list: readonly unknown[] = Array.isArray(from) ? from : [];
    return [...list.slice(0, head), ...middle, ...list.slice(list.length - tail)];
  }
  // All five are made from a length; TypeScript knows a constructor only as a function.
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

/** Plain data only: anything else is kept whole. */
function isRecord(value: unknown): value is Readonly<Record<string, unknown>> {
  return typeof value === 'object' && value !== null && Object.getPrototypeOf(value) === Object.prototype;
}
