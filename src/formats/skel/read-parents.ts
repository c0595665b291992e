/**
 * `.skel`, as other courses have it: a joint on each line.
 *
 *     [COUNT]
 *     [INDEX] x y z PARENT          the offset from the parent, and its index; -1: a root
 *
 * Indices count from 0 in the order of the file, unless each line begins with its own. Numbers may be separated by
 * commas, and a line may have the name of its joint first or last. Comments begin with # or //. In the model these are
 * ball joints; the file is written in the hierarchy form.
 */
import type { Vec3 } from '../../math/vec3.ts';
import {
  DEFAULT_BOX,
  DEFAULT_MOTION,
  type Joint,
  type Limit,
  type Skeleton,
  UNLIMITED,
} from '../../model/skeleton/skeleton.ts';
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
  /** Offset of its first byte. */
  readonly from: number;
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

/** A joint of the file, without its words: there may be millions. */
interface Row {
  readonly name: string;
  readonly index: number;
  readonly offset: Vec3;
  readonly parent: number;
  readonly line: number;
  readonly from: number;
}

const NUMBER = /^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i;

/**
 * Whether a file that begins like this has rows of a parent's index: four or five numbers on every line, the last of
 * them a whole number, and -1 for a root, which may come last. The axis-angle form has six numbers a joint, wherever
 * its lines end.
 *
 * @param head its first bytes; those after `PARENTS_HEAD_BYTES` are ignored
 */
export function beginsParents(head: Uint8Array): boolean {
  const isCut = head.length >= PARENTS_HEAD_BYTES;
  const lines = [...filledLines(head.subarray(0, PARENTS_HEAD_BYTES))];
  if (isCut) lines.pop();
  const rows = lines.slice(countLines(lines)).map(({ words }) => numbersOf(words));
  const [first] = rows;
  if (!first || !(first.length === 4 || first.length === 5)) return false;
  const areRows = rows.every((numbers, i) => {
    const isIndexed = first.length === 4 || numbers[0] === first[0] + i;
    const parent = numbers.at(-1) ?? 0.5;
    return numbers.length === first.length && isIndexed && parent >= -1 && parent % 1 === 0;
  });
  if (!areRows || first.at(-1) === -1) return areRows;
  const hasRoot = isCut || rows.some((numbers) => numbers.at(-1) === -1);
  return hasRoot && !mayBeAxisAngle(rows.flat(), isCut);
}

/** Whether numbers are joints of six, the last the count of children, that are one tree; of a cut file, the first ones. */
function mayBeAxisAngle(numbers: readonly number[], isCut: boolean): boolean {
  const counts = numbers.filter((_, i) => i % 6 === 5);
  if (!counts.every((children) => children >= 0 && children % 1 === 0)) return false;
  const children = counts.reduce((sum, count) => sum + count, 0);
  return isCut || (numbers.length % 6 === 0 && children === counts.length - 1);
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
      "Read as one joint per line: x y z, the offset from the parent, and the parent's index, -1 for a root.";
    report.info('parent-rows', message, WHOLE_FILE, 'ball joints; saved in the hierarchy form');
    const rows = rowsOf(bytes, report);
    const told = { report, bytes };
    const parents = parentsOf(rows, told);
    return report.hasErrors ? undefined : skeletons(rows, parents, stemOfName(fileName), told);
  });
}

/** Problems of rows are told at a word of theirs. */
interface Told {
  readonly report: Report;
  readonly bytes: Uint8Array;
}

/** The place of a row's parent, or of its first word. */
function placeIn({ bytes }: Told, { from, line }: Row, what: 'parent' | 'start'): Place {
  const [found] = filledLines(bytes, from, line);
  const { words } = found;
  const numbers = words.filter(({ value }) => !Number.isNaN(value));
  return placeOf(found, what === 'start' ? words[0] : numbers[numbers.length - 1]);
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
    else if (start.push(line) === MAX_LINES_BEFORE) begin();
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
const MAX_LINES_BEFORE = 3;

function rowOf(line: Line, width: number, index: number, shared: Map<string, Vec3>, report: Report): Row | undefined {
  const { words } = line;
  const isName = (word: Word | undefined) => word !== undefined && Number.isNaN(word.value) && !isNoName(word.text);
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
  const parent = numbers[width - 1].value;
  return { name: name?.text ?? '', index: own, offset: vector, parent, line: line.line, from: line.from };
}

/** Number of values that are shared: for files of short numbers, which would take many times their size. */
const MAX_SHARED = 256;

/** Whether a word is meant as a number, or can't be a name. */
function isNoName(text: string): boolean {
  return /^([-+]?(\d|\.)|[-+]?(nan|inf(inity)?)$)|[{}]/i.test(text);
}

/** Row of each row's parent; -1 for a root. */
function parentsOf(rows: readonly Row[], told: Told): Int32Array {
  const { report } = told;
  const rowWith = byIndex(rows, told);
  return Int32Array.from(rows, (each, row) => {
    const { parent } = each;
    if (parent === -1) return -1;
    const found = rowWith(parent);
    if (found !== undefined && found !== row) return found;
    const [code, what] =
      parent % 1 === 0 ? ['index-out-of-range', 'the index of another joint'] : ['index-fractional', 'a whole number'];
    report.error(code, `Expected ${what} as the parent, or -1, found ${parent}.`, placeIn(told, each, 'parent'));
    return -1;
  });
}

/** Finds rows by their indices, which are mostly their numbers. */
function byIndex(rows: readonly Row[], told: Told): (index: number) => number | undefined {
  const first = rows[0]?.index ?? 0;
  if (rows.every(({ index }, row) => index === first + row)) {
    return (index) => (index >= first && index < first + rows.length && index % 1 === 0 ? index - first : undefined);
  }
  const found = new Map<number, number>();
  rows.forEach((each, row) => {
    const { index } = each;
    if (found.has(index)) {
      const message = `Expected each index once, found ${index} again.`;
      told.report.error('index-repeated', message, placeIn(told, each, 'start'));
    }
    found.set(index, row);
  });
  return (index) => found.get(index);
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
  told: Told,
): readonly Skeleton[] | undefined {
  const { report } = told;
  // Lists of children: of each row the first one, and the next one of its parent.
  const first = new Int32Array(rows.length).fill(-1);
  const next = new Int32Array(rows.length).fill(-1);
  for (let row = rows.length - 1; row >= 0; row--) {
    const parent = parents[row];
    if (parent < 0) continue;
    next[row] = first[parent];
    first[parent] = row;
  }
  const roots = Array.from(parents.keys()).filter((row) => parents[row] < 0);
  /** Joint of each row. */
  const number = new Int32Array(rows.length).fill(-1);
  let [count, moved] = [0, -1];
  const all = roots.map((root, r): Skeleton => {
    const joints: Joint[] = [];
    let row = root;
    while (row >= 0) {
      if (row !== count++ && moved < 0) moved = row;
      number[row] = joints.length;
      const { name, offset } = rows[row];
      const parent = parents[row] < 0 ? -1 : number[parents[row]];
      joints.push({ name, parent, offset, box: DEFAULT_BOX, motion: DEFAULT_MOTION, ...BALL });
      if (first[row] >= 0) row = first[row];
      else {
        while (row >= 0 && next[row] < 0) row = parents[row];
        if (row >= 0) row = next[row];
      }
    }
    return { name: r === 0 ? stem : `${stem}_${r + 1}`, joints };
  });
  const left = number.indexOf(-1);
  if (left >= 0) {
    const message = `Expected a parent that leads to a root, found ${rows[left].parent}: this joint ends up below itself.`;
    report.error('parent-cycle', message, placeIn(told, rows[left], 'parent'));
    return undefined;
  }
  if (roots.length > 1) {
    const message = 'Found a second root; each root becomes its own skeleton.';
    report.info('several-roots', message, placeIn(told, rows[roots[1]], 'start'));
  }
  if (moved >= 0) {
    const message = `Joints are reordered depth-first, each followed by its descendants: joint ${rows[moved].index} of the file is joint ${number[moved]}.`;
    report.info('joints-reordered', message, placeIn(told, rows[moved], 'start'));
  }
  return all;
}

/** All lines that have words, from the start of one on. Line ends are those of `places.ts`. */
function* filledLines(bytes: Uint8Array, start = 0, first = 1): Generator<Line, void, void> {
  const hasMark = start === 0 && bytes[0] === 0xef && bytes[1] === 0xbb && bytes[2] === 0xbf;
  let from = hasMark ? 3 : start;
  let line = first;
  while (from < bytes.length) {
    let to = from;
    while (to < bytes.length && bytes[to] !== LF && bytes[to] !== CR) to++;
    const text = textOf(bytes, from, to);
    const words = wordsOf(text);
    if (words.length > 0) yield { line, from, text, words };
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
