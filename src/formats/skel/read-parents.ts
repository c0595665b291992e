/**
 * `.skel`, as other courses have it: a joint on each line.
 *
 *     [COUNT]
 *     [INDEX] x y z PARENT          the offset from the parent, and its index; -1: a root
 *
 * Indices count from 0 in the order of the file, unless each line begins with its own. Numbers may be separated by commas,
 * and a line may have the name of its joint first or last. Comments begin with # or //. In the model these are ball
 * joints; the file is written in the hierarchy form.
 */
import type { Vec3 } from '../../math/vec3.ts';
import { DEFAULT_BOX, DEFAULT_MOTION, type Joint, type Limit, type Skeleton, UNLIMITED } from '../../model/skeleton.ts';
import { stemOfName } from '../grammar.ts';
import { type Place, WHOLE_FILE } from '../places.ts';
import { bytesReader, type Reader } from '../reader.ts';
import type { Report } from '../report.ts';
import { CR, LF } from '../scan.ts';
import { textOf, whyNoNumber } from '../words.ts';

/** Bytes at the start of a file that tell this form. */
export const PARENTS_HEAD_BYTES = 4096;

/** Words of a line, without its comment. */
interface Line {
  /** From 1. */
  readonly line: number;
  readonly text: string;
  readonly words: readonly Word[];
}

interface Word {
  readonly text: string;
  /** Position in the line, from 0. */
  readonly at: number;
  /** NaN for a name. */
  readonly value: number;
}

/** A joint of the file. */
interface Row {
  readonly line: Line;
  readonly name: string;
  readonly index: number;
  readonly offset: Vec3;
  readonly parent: number;
  readonly parentAt: Word;
}

const NUMBER = /^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i;

/**
 * Whether a file that begins like this has rows of a parent's index: four or five numbers on every line, the last of them
 * -1 on the first line and a whole number on the others. The axis-angle form has six numbers a joint, wherever its lines
 * end.
 *
 * @param head its first bytes; those after `PARENTS_HEAD_BYTES` are ignored
 */
export function beginsParents(head: Uint8Array): boolean {
  const isCut = head.length >= PARENTS_HEAD_BYTES;
  const lines = [...filledLines(head.subarray(0, PARENTS_HEAD_BYTES))];
  if (isCut) lines.pop();
  const rows = lines.slice(countLines(lines)).map(({ words }) => numbersOf(words));
  const [first] = rows;
  if (!first || first.at(-1) !== -1 || !(first.length === 4 || first.length === 5)) return false;
  return rows.every((numbers, i) => {
    const isIndexed = first.length === 4 || numbers[0] === first[0] + i;
    const parent = numbers.at(-1) ?? 0.5;
    return numbers.length === first.length && isIndexed && parent >= -1 && parent % 1 === 0;
  });
}

/** Lines before the first joint: a heading, a count. */
function countLines(lines: readonly Line[]): number {
  const isHeading = (line?: Line) => line !== undefined && numbersOf(line.words).length === 0;
  const isCount = (line?: Line) =>
    line?.words.length === 1 && line.words[0].value >= 1 && line.words[0].value % 1 === 0;
  const heading = isHeading(lines[0]) ? 1 : 0;
  return heading + (isCount(lines[heading]) ? 1 : 0);
}

function numbersOf(words: readonly Word[]): readonly number[] {
  return words.flatMap(({ value }) => (Number.isNaN(value) ? [] : [value]));
}

/** A reader for a file that `beginsParents`: a skeleton for each root. */
export function parentsReader(fileName: string): Reader<readonly Skeleton[]> {
  return bytesReader(fileName, (bytes, report) => {
    const message =
      'Read as a joint on each line: x y z, its offset from the parent, and the index of that, -1 for a root.';
    report.info('parent-rows', message, WHOLE_FILE, 'ball joints; saved in the hierarchy form');
    const rows = rowsOf(bytes, report);
    const parents = parentsOf(rows, report);
    return report.hasErrors ? undefined : skeletons(rows, parents, stemOfName(fileName), report);
  });
}

function rowsOf(bytes: Uint8Array, report: Report): readonly Row[] {
  const rows: Row[] = [];
  const shared = new Map<string, Vec3>();
  const start: Line[] = [];
  let isStart = true;
  let declared: Line | undefined;
  let width = 0;
  const take = (line: Line) => {
    width ||= numbersOf(line.words).length;
    const row = rowOf(line, width, rows.length, shared, report);
    if (row) rows.push(row);
  };
  const begin = () => {
    isStart = false;
    const skipped = countLines(start);
    const last = start[skipped - 1];
    if (last?.words.length === 1 && !Number.isNaN(last.words[0].value)) declared = last;
    start.slice(skipped).forEach(take);
  };
  for (const line of filledLines(bytes)) {
    if (!isStart) take(line);
    else if (start.push(line) === MOST_LINES_BEFORE) begin();
  }
  if (isStart) begin();
  const count = declared?.words[0].value;
  if (declared && count !== rows.length && !report.hasErrors) {
    const message = `Expected ${count} joints as declared, found ${rows.length}.`;
    report.warn('count-mismatch', message, placeOf(declared, declared.words[0]), `used ${rows.length}`);
  }
  return rows;
}

/** A heading, a count, and the first joint. */
const MOST_LINES_BEFORE = 3;

function rowOf(line: Line, width: number, index: number, shared: Map<string, Vec3>, report: Report): Row | undefined {
  const { words } = line;
  const isName = (word: Word | undefined) => word !== undefined && Number.isNaN(word.value) && !looksNumeric(word.text);
  const name = isName(words[0]) ? words[0] : isName(words.at(-1)) ? words[words.length - 1] : undefined;
  const numbers = words.filter((word) => word !== name);
  const wrong = numbers.find(({ value }) => !Number.isFinite(value));
  if (wrong) {
    const { code, why } = whyNoNumber(wrong.text);
    report.error(code, `Expected a number, found "${wrong.text.slice(0, 40)}"${why}.`, placeOf(line, wrong));
    return undefined;
  }
  if (numbers.length !== width) {
    const message = `Expected ${width} numbers, the last of them the index of the parent, found ${numbers.length}.`;
    const code = numbers.length < width ? 'row-incomplete' : 'row-too-long';
    report.error(code, message, placeOf(line, numbers[width] ?? words[words.length - 1]));
    return undefined;
  }
  const [own, offset] = width === 5 ? [numbers[0].value, numbers.slice(1, 4)] : [index, numbers.slice(0, 3)];
  const key = offset.map(({ text }) => text).join(' ');
  const [x, y, z] = offset.map(({ value }) => value);
  const vector: Vec3 = shared.get(key) ?? [x, y, z];
  if (shared.size < MAX_SHARED) shared.set(key, vector);
  const parentAt = numbers[width - 1];
  return { line, name: name?.text ?? '', index: own, offset: vector, parent: parentAt.value, parentAt };
}

/** Of files of short numbers, which would take many times their size. */
const MAX_SHARED = 256;

function looksNumeric(text: string): boolean {
  return /^([-+]?(\d|\.)|[-+]?(nan|inf(inity)?)$)/i.test(text);
}

/** Of each row, the row of its parent; -1 for a root. */
function parentsOf(rows: readonly Row[], report: Report): Int32Array {
  const byIndex = new Map<number, number>();
  rows.forEach(({ index, line }, row) => {
    if (byIndex.has(index)) {
      report.error('index-repeated', `Expected each index once, found ${index} again.`, placeOf(line, line.words[0]));
    }
    byIndex.set(index, row);
  });
  return Int32Array.from(rows, ({ parent, parentAt, line }, row) => {
    if (parent === -1) return -1;
    const found = byIndex.get(parent);
    if (found !== undefined && found !== row) return found;
    const [code, what] =
      parent % 1 === 0 ? ['index-out-of-range', 'the index of another joint'] : ['index-fractional', 'a whole number'];
    report.error(code, `Expected ${what} as the parent, or -1, found ${parentAt.text}.`, placeOf(line, parentAt));
    return -1;
  });
}

interface Shared {
  readonly limits: readonly Limit[];
  readonly pose: readonly number[];
}

const BALL: Shared = { limits: [UNLIMITED, UNLIMITED, UNLIMITED], pose: [0, 0, 0] };

/** A skeleton for each root, its joints in depth-first order. */
function skeletons(
  rows: readonly Row[],
  parents: Int32Array,
  stem: string,
  report: Report,
): readonly Skeleton[] | undefined {
  const children = new Map<number, number[]>();
  parents.forEach((parent, row) => {
    const own = children.get(parent);
    if (own) own.push(row);
    else children.set(parent, [row]);
  });
  const roots = children.get(-1) ?? [];
  const order: number[] = [];
  const number = new Int32Array(rows.length).fill(-1);
  const all = roots.map((root, r): Skeleton => {
    const joints: Joint[] = [];
    const open = [root];
    for (let row = open.pop(); row !== undefined; row = open.pop()) {
      number[row] = joints.length;
      order.push(row);
      const { name, offset } = rows[row];
      const parent = parents[row] < 0 ? -1 : number[parents[row]];
      joints.push({ name, parent, offset, box: DEFAULT_BOX, motion: DEFAULT_MOTION, ...BALL });
      for (const child of (children.get(row) ?? []).toReversed()) open.push(child);
    }
    return { name: r === 0 ? stem : `${stem}_${r + 1}`, joints };
  });
  const left = number.indexOf(-1);
  if (left >= 0) {
    const { line, parentAt } = rows[left];
    const message = `Expected a parent that leads to a root, found ${parentAt.text}: this joint ends up below itself.`;
    report.error('parent-cycle', message, placeOf(line, parentAt));
    return undefined;
  }
  if (roots.length > 1) {
    const { line } = rows[roots[1]];
    const message = 'Found a second root; each root becomes its own skeleton.';
    report.info('several-roots', message, placeOf(line, line.words[0]));
  }
  const moved = order.findIndex((row, i) => row !== i);
  if (moved >= 0) {
    const { line } = rows[order[moved]];
    const message = `Joints are in the order of their tree, each before its siblings with all that is below it: joint ${order[moved]} of the file is joint ${moved}.`;
    report.info('joints-reordered', message, placeOf(line, line.words[0]));
  }
  return all;
}

/** All lines that have words. Line ends are those of `places.ts`. */
function* filledLines(bytes: Uint8Array): Generator<Line, void, void> {
  let from = bytes[0] === 0xef && bytes[1] === 0xbb && bytes[2] === 0xbf ? 3 : 0;
  let line = 1;
  while (from < bytes.length) {
    let to = from;
    while (to < bytes.length && bytes[to] !== LF && bytes[to] !== CR) to++;
    const text = textOf(bytes, from, to);
    const words = wordsOf(text);
    if (words.length > 0) yield { line, text, words };
    let returns = to;
    while (bytes[returns] === CR) returns++;
    const isFed = bytes[returns] === LF;
    line += isFed ? 1 : Math.max(1, returns - to);
    from = isFed ? returns + 1 : Math.max(returns, to + 1);
  }
}

function wordsOf(text: string): readonly Word[] {
  const comment = text.search(/#|\/\//);
  const content = comment < 0 ? text : text.slice(0, comment);
  return Array.from(content.matchAll(/[^\s,;]+/g), ({ 0: word, index }) => ({
    text: word,
    at: index,
    value: NUMBER.test(word) ? Number(word) : Number.NaN,
  }));
}

function placeOf({ line, text }: Line, { at }: Word): Place {
  const before = new TextEncoder().encode(text.slice(Math.max(0, at - EXCERPT), at));
  const after = new TextEncoder().encode(text.slice(at, at + EXCERPT));
  return { line, column: [...text.slice(0, at)].length + 1, before, after };
}

/** Characters of a line before and after a problem. */
const EXCERPT = 200;
