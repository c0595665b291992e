/** Rows of a dump as numbers of one joint, vertex or time each, and what is told from their lengths. */

import type { DumpBlock, DumpLabel } from '../../model/dump.ts';
import { UserError } from '../../model/user-error.ts';

/** Numbers of one joint, vertex or time. */
export interface Entry {
  readonly numbers: Float64Array;
  readonly line: number;
  readonly label: DumpLabel | null;
}

/** Share of rows: if they have the same length, another length is a mistake. */
const NEARLY_ALL = 0.75;

/** Thrown when a block fits nothing; caught for each block. */
export class Misfit extends UserError {
  constructor(
    readonly code: string,
    message: string,
    readonly line: number,
  ) {
    super(message);
  }
}

/** With labels, all numbers up to the next one; else the rows. */
export function entriesOf({ values, starts, lines, labels }: DumpBlock): Entry[] {
  const entries: Entry[] = [];
  for (let r = 0; r < lines.length; r++) {
    const label = labels?.[r] ?? null;
    const last = entries.at(-1);
    if (labels && label === null && last) {
      const from = last.numbers.byteOffset / 8 - values.byteOffset / 8;
      entries[entries.length - 1] = { ...last, numbers: values.subarray(from, starts[r + 1]) };
    } else entries.push({ numbers: values.subarray(starts[r], starts[r + 1]), line: lines[r], label });
  }
  return entries;
}

/**
 * Entries of the same number of values: as they are, or all numbers cut again.
 * @throws Misfit if labelled entries have another number of values
 */
export function evenly(
  { values, lines, starts }: DumpBlock,
  entries: readonly Entry[],
  each: number,
): readonly Entry[] {
  if (entries.every(({ numbers }) => numbers.length === each)) return entries;
  const isLabelled = entries.length > 1 && entries.every(({ label }) => label !== null);
  if (isLabelled) {
    const wrong = entries.find(({ numbers }) => numbers.length !== each) ?? entries[0];
    throw new Misfit(
      'dump-length',
      `Expected ${each} numbers, as in the other entries, found ${wrong.numbers.length}.`,
      wrong.line,
    );
  }
  let row = 0;
  return Array.from({ length: values.length / each }, (_, i): Entry => {
    while (starts[row + 1] <= i * each) row++;
    return { numbers: values.subarray(i * each, (i + 1) * each), line: lines[row], label: null };
  });
}

/** The number of values of every row; 0 if they differ. */
export function widthOf({ starts }: DumpBlock): number {
  const width = starts[1] - starts[0];
  for (let r = 1; r + 1 < starts.length; r++) if (starts[r + 1] - starts[r] !== width) return 0;
  return width;
}

/** Whether all values are rows of a number of values, each of which begins with a row of the block. */
export function isInRows({ starts, values }: DumpBlock, width: number): boolean {
  if (values.length % width !== 0) return false;
  let row = 0;
  for (let at = 0; at < values.length; at += width) {
    while (starts[row] < at) row++;
    if (starts[row] !== at) return false;
  }
  return true;
}

/** The first row of another length than nearly all; undefined if there is none. */
export function oddRow({ starts, lines }: DumpBlock): { line: number; found: number; others: number } | undefined {
  const counts = new Map<number, number>();
  const widthAt = (r: number) => starts[r + 1] - starts[r];
  for (let r = 0; r < lines.length; r++) counts.set(widthAt(r), (counts.get(widthAt(r)) ?? 0) + 1);
  for (const [others, count] of counts) {
    if (count === lines.length || count < NEARLY_ALL * lines.length) continue;
    const row = lines.findIndex((_, r) => widthAt(r) !== others);
    return { line: lines[row], found: widthAt(row), others };
  }
  return undefined;
}

/** Whether they are 0 … n − 1 or 1 … n, each once, in any order. */
export function isCount(numbers: readonly number[]): boolean {
  const from = numbers.includes(0) ? 0 : 1;
  const seen = new Set(numbers);
  return (
    seen.size === numbers.length && numbers.every((n) => Number.isInteger(n) && n >= from && n < numbers.length + from)
  );
}

/** Whether all points have length 1. */
export function isUnit(values: Float64Array, width: number): boolean {
  const from = width === 4 ? 1 : 0;
  for (let i = from; i < values.length; i += 3 + from) {
    if (Math.abs(Math.hypot(values[i], values[i + 1], values[i + 2]) - 1) > 1e-3) return false;
  }
  return true;
}
