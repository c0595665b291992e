/**
 * Which lines of a text file hold which part of the model, and which part a line holds. Made by `formats/source/`, in
 * one pass over the bytes; plain data, so that the worker can make it. Lines count from 1.
 */

/** A part of the model that a file's text can hold. All numbers are indices of the model, from 0. */
export type SourceTarget =
  /** `root`: which of the file's skeletons; `dof`: one of the joint's own, by name. */
  | { readonly kind: 'joint'; readonly root: number; readonly joint: number; readonly dof?: string }
  /** A joint's matrix in a skin. */
  | { readonly kind: 'binding'; readonly joint: number }
  | { readonly kind: 'vertex'; readonly vertex: number }
  | { readonly kind: 'triangle'; readonly triangle: number }
  | { readonly kind: 'channel'; readonly channel: number }
  | { readonly kind: 'key'; readonly channel: number; readonly key: number }
  | { readonly kind: 'frame'; readonly frame: number }
  /** The values of a joint in a frame, or in all; `name` as `boneKey` has it. */
  | { readonly kind: 'bone'; readonly name: string; readonly frame?: number };

/** Both included. */
export interface LineRange {
  readonly from: number;
  readonly to: number;
}

/** Offsets of the first bytes of some lines: enough that any other is near one. */
export interface LineIndex {
  /** Ascending; the first is line 1. */
  readonly lines: Float64Array;
  /** Offset of each one's first byte. */
  readonly offsets: Float64Array;
  /** Number of lines, at least 1. */
  readonly count: number;
  /** Size of the file. */
  readonly bytes: number;
}

/**
 * The line of each row of a block, in runs of equal distance: run r starts at row `rows[r]` on line `lines[r]`, and
 * each further row of it begins `steps[r]` lines below.
 */
export interface RowLines {
  readonly rows: Uint32Array;
  readonly lines: Uint32Array;
  readonly steps: Uint32Array;
  /** Number of rows. */
  readonly count: number;
  /** The line where the last row ends. */
  readonly end: number;
}

/** A block of rows, one for each part. */
export interface SourceRows {
  readonly of: 'joint' | 'vertex' | 'triangle' | 'key' | 'frame';
  /** Channel of the keys. */
  readonly channel?: number;
  readonly lines: RowLines;
  /** The index of each row's part; absent: row i is part `first` + i. */
  readonly indices?: Uint32Array;
  /** Default 0. */
  readonly first?: number;
  /** The bone of each line of a row after its first one, as `boneKey` has it; the same in all rows. */
  readonly bones?: readonly string[];
}

/** Longer names are cut. */
const KEY_BYTES = 64;

/** A name as it is compared with those of lines: bytes of UTF-8, in lower case, cut. */
export function boneKey(name: string): string {
  const bytes = new TextEncoder().encode(name).subarray(0, KEY_BYTES);
  return String.fromCharCode(...bytes).replace(/[A-Z]/g, (letter) => letter.toLowerCase());
}

/** Lines that hold a part, by themselves or beside others. */
export interface SourceMark extends LineRange {
  readonly target: SourceTarget;
  /** They hold a value of each of the joint's DOFs. */
  readonly isPose?: true;
}

/** The lines of one text file, and the parts of the model that they hold. */
export interface SourceMap {
  readonly index: LineIndex;
  /** In the order of the file. */
  readonly marks: readonly SourceMark[];
  readonly rows: readonly SourceRows[];
}

/** The lines that hold a part, ascending; none if the file doesn't hold it. A DOF without lines has its joint's. */
export function linesOf(map: SourceMap, target: SourceTarget): readonly LineRange[] {
  const { marks, rows } = map;
  const found: LineRange[] = [];
  for (const block of rows) {
    if (target.kind === 'bone') found.push(...linesOfBone(block, target.name, target.frame));
    const index = indexIn(block, target);
    if (index === undefined) continue;
    const row = block.indices ? block.indices.indexOf(index) : index - (block.first ?? 0);
    if (row >= 0 && row < block.lines.count) found.push(linesOfRow(block.lines, row));
  }
  for (const { target: own, from, to, isPose } of marks) {
    if (isSamePart(own, target, isPose === true)) found.push({ from, to });
  }
  if (found.length === 0 && target.kind === 'joint' && target.dof !== undefined) {
    const { dof: _dof, ...joint } = target;
    return linesOf(map, joint);
  }
  return joined(found);
}

/** The part that a line holds: the smallest if there are several. Undefined for a line of none. */
export function targetAt({ marks, rows }: SourceMap, line: number): SourceTarget | undefined {
  for (const block of rows) {
    const { lines, indices, first = 0, bones } = block;
    if (lines.count === 0 || line < lines.lines[0] || line > lines.end) continue;
    const row = rowAt(lines, line);
    const name = bones?.[line - lineOfRow(lines, row) - 1];
    if (name) return { kind: 'bone', name, frame: first + row };
    return targetOf(block, indices ? indices[row] : first + row);
  }
  let best: SourceMark | undefined;
  for (const mark of marks) {
    if (line < mark.from || line > mark.to) continue;
    if (!best || mark.to - mark.from <= best.to - best.from) best = mark;
  }
  return best?.target;
}

/** The lines of a bone in a block of frames, or in one frame. */
function linesOfBone({ lines, bones = [], first = 0 }: SourceRows, name: string, frame?: number): readonly LineRange[] {
  const found: LineRange[] = [];
  const [from, to] = frame === undefined ? [0, lines.count] : [frame - first, frame - first + 1];
  for (let b = bones.indexOf(name); b >= 0; b = bones.indexOf(name, b + 1)) {
    for (let row = Math.max(0, from); row < Math.min(lines.count, to); row++) {
      const line = lineOfRow(lines, row) + b + 1;
      found.push({ from: line, to: line });
    }
  }
  return found;
}

/** The lines of a row, the last one up to where the next row begins. */
function linesOfRow(rows: RowLines, row: number): LineRange {
  const from = lineOfRow(rows, row);
  const next = row + 1 < rows.count ? lineOfRow(rows, row + 1) - 1 : rows.end;
  return { from, to: Math.max(from, next) };
}

function lineOfRow({ rows, lines, steps }: RowLines, row: number): number {
  const run = lastUpTo(rows, row);
  return lines[run] + steps[run] * (row - rows[run]);
}

/** The first row that begins on a line, or else the one that continues there. The line must not be before the first. */
function rowAt({ rows, lines, steps, count }: RowLines, line: number): number {
  let run = lastUpTo(lines, line);
  // Several runs may begin on a line.
  while (run > 0 && lines[run] === line && lines[run - 1] === line) run--;
  const end = run + 1 < rows.length ? rows[run + 1] : count;
  const step = steps[run];
  const row =
    step === 0 ? (line === lines[run] ? rows[run] : end - 1) : rows[run] + Math.floor((line - lines[run]) / step);
  return Math.min(row, end - 1);
}

/** The index of the last entry that is not above a value; the entries ascend, and the first is not above it. */
export function lastUpTo(entries: ArrayLike<number>, value: number): number {
  let low = 0;
  let high = entries.length;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (entries[middle] <= value) low = middle;
    else high = middle;
  }
  return low;
}

function indexIn({ of, channel }: SourceRows, target: SourceTarget): number | undefined {
  if (target.kind !== of) return undefined;
  switch (target.kind) {
    case 'joint':
      return target.root === 0 ? target.joint : undefined;
    case 'vertex':
      return target.vertex;
    case 'triangle':
      return target.triangle;
    case 'frame':
      return target.frame;
    case 'key':
      return target.channel === channel ? target.key : undefined;
    default:
      return undefined;
  }
}

function targetOf({ of, channel = 0 }: SourceRows, index: number): SourceTarget {
  switch (of) {
    case 'joint':
      return { kind: 'joint', root: 0, joint: index };
    case 'vertex':
      return { kind: 'vertex', vertex: index };
    case 'triangle':
      return { kind: 'triangle', triangle: index };
    case 'frame':
      return { kind: 'frame', frame: index };
    case 'key':
      return { kind: 'key', channel, key: index };
  }
}

function isSamePart(own: SourceTarget, asked: SourceTarget, isPose: boolean): boolean {
  if (own.kind === 'joint' && asked.kind === 'joint') {
    if (own.root !== asked.root || own.joint !== asked.joint) return false;
    return asked.dof === undefined || own.dof === asked.dof || isPose;
  }
  if (own.kind === 'binding' && asked.kind === 'binding') return own.joint === asked.joint;
  return own.kind === 'channel' && asked.kind === 'channel' && own.channel === asked.channel;
}

/** Ascending, without overlaps; those next to each other are one. */
function joined(ranges: readonly LineRange[]): readonly LineRange[] {
  const all: { from: number; to: number }[] = [];
  for (const { from, to } of [...ranges].sort((a, b) => a.from - b.from)) {
    const last = all.at(-1);
    if (last && from <= last.to + 1) last.to = Math.max(last.to, to);
    else all.push({ from, to });
  }
  return all;
}
