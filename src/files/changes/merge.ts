/**
 * Carries what changed between two writings of a model over to the text that the model was read from, so that only what
 * changed differs from that text: its layout, order, defaults and comments stay.
 *
 *     original   ~   before   →   after        before and after are by one writer, so their difference is exact
 *
 * Lines of the original and of `before` correspond if they mean the same. Lines with fields in another order correspond
 * within their block; where a writing has other line breaks, blocks of lines with the same tokens do.
 */
import type { LineHunk } from '../../model/text-changes.ts';
import { commonLines } from './line-diff.ts';
import { headOf, joinLines, LineIds, lineMeaning, meaningOf, splitLines, TOKEN, tokensOf } from './text-lines.ts';

/** The merged text, and where it differs from the original. */
export interface MergedText {
  readonly text: string;
  readonly hunks: readonly LineHunk[];
}

/** Lines [from, to) of `before` that became lines [newFrom, newTo) of `after`; from 0. */
interface Change {
  from: number;
  to: number;
  newFrom: number;
  newTo: number;
}

/** Lines [from, to) of `before` that are lines [own, ownTo) of the original, with other line breaks. */
interface Gap {
  readonly from: number;
  readonly to: number;
  readonly own: number;
  readonly ownTo: number;
}

/** How far around an insertion an example of its indentation is looked for. */
const REACH = 64;

/**
 * The original with the changes. It is right if it reads as `after`, which the caller checks: a text with another order
 * of lines in other blocks is more than this follows.
 *
 * @param keepsDefaults whether a block whose first line changed keeps what only the original has in it; default true
 */
export function mergeChanges(original: string, before: string, after: string, keepsDefaults = true): MergedText {
  return new Merge(original, before, after, keepsDefaults).result();
}

class Merge {
  private readonly original;
  private readonly before: readonly string[];
  private readonly after: readonly string[];
  private readonly meanings: readonly string[];
  /** Line of `before` for each line of `after`; -1: new. */
  private readonly was: Int32Array;
  /** Line of the original for each line of `before`; -1: in a gap. */
  private readonly own: Int32Array;
  private readonly gapOf = new Map<number, Gap>();
  /** Lines of the original that correspond to none, by block and by what they set: defaults that writers omit. */
  private readonly defaults = new Map<string, number>();
  private readonly isOwn: Uint8Array;
  private readonly blocks: Int32Array;
  private readonly newBlocks: Int32Array;
  // What becomes of the lines of the original.
  private readonly gone: Uint8Array;
  private readonly replaced = new Map<number, string>();
  /** Before a line; behind the last one, its count. */
  private readonly inserted = new Map<number, string[]>();

  constructor(
    original: string,
    before: string,
    after: string,
    private readonly keepsDefaults: boolean,
  ) {
    this.original = splitLines(original);
    this.before = writtenLines(before);
    this.after = writtenLines(after);
    this.meanings = this.original.lines.map(lineMeaning);
    this.gone = new Uint8Array(this.meanings.length);
    this.isOwn = new Uint8Array(this.meanings.length);
    this.blocks = blocksOf(this.meanings);
    this.newBlocks = blocksOf(this.after);
    this.own = this.correspond();
    this.was = new Int32Array(this.after.length).fill(-1);
  }

  result(): MergedText {
    for (const change of this.changes()) {
      if (this.isInGap(change)) this.replaceAll(change);
      else this.replaceLines(change);
    }
    return this.build();
  }

  private correspond(): Int32Array {
    const { meanings, isOwn, blocks } = this;
    const ids = new LineIds();
    const written = this.before.map(lineMeaning);
    const filled = Int32Array.from(meanings.keys()).filter((i) => meanings[i] !== '');
    const common = commonLines(ids.of(written), ids.of(Array.from(filled, (i) => meanings[i])));
    const own = common.map((at) => (at < 0 ? -1 : filled[at]));
    for (const at of own) if (at >= 0) isOwn[at] = 1;
    // The same line elsewhere in its block.
    const writtenBlocks = blocksOf(written);
    const left = new Map<string, number[]>();
    for (const at of filled) {
      if (isOwn[at]) continue;
      const key = `${blocks[at]} ${meanings[at]}`;
      left.set(key, [...(left.get(key) ?? []), at]);
    }
    const gaps: Gap[] = [];
    for (let from = 0; from < own.length; from++) {
      if (common[from] >= 0) continue;
      let to = from + 1;
      while (to < own.length && common[to] < 0) to++;
      for (let i = from; i < to; i++) {
        const block = writtenBlocks[i] < 0 ? -1 : own[writtenBlocks[i]];
        const at = left.get(`${block} ${written[i]}`)?.shift();
        if (at === undefined) continue;
        own[i] = at;
        isOwn[at] = 1;
      }
      const start = from > 0 ? filled[common[from - 1]] + 1 : 0;
      const end = to < own.length ? filled[common[to]] : meanings.length;
      if (own.subarray(from, to).includes(-1)) gaps.push(...this.split({ from, to, own: start, ownTo: end }, written));
      from = to;
    }
    for (const gap of gaps) for (let i = gap.from; i < gap.to; i++) if (own[i] < 0) this.gapOf.set(i, gap);
    for (const at of filled) {
      const head = headOf(meanings[at]);
      const key = `${blocks[at]} ${head}`;
      if (!isOwn[at] && head !== '' && !this.defaults.has(key)) this.defaults.set(key, at);
    }
    return own;
  }

  /** Parts between line breaks that both have, if the tokens are the same. */
  private split(gap: Gap, written: readonly string[]): readonly Gap[] {
    const { meanings } = this;
    const tokens = (lines: readonly string[]) => lines.filter((line) => line !== '').join(' ');
    if (tokens(meanings.slice(gap.own, gap.ownTo)) !== tokens(written.slice(gap.from, gap.to))) return [gap];
    const parts: Gap[] = [];
    let [from, own, at, length, ownLength] = [gap.from, gap.own, gap.own, 0, 0];
    for (let i = gap.from; i < gap.to; i++) {
      length += written[i].length + 1;
      while (ownLength < length && at < gap.ownTo) {
        if (meanings[at] !== '') ownLength += meanings[at].length + 1;
        at++;
      }
      if (length !== ownLength) continue;
      parts.push({ from, to: i + 1, own, ownTo: at });
      [from, own] = [i + 1, at];
    }
    return parts;
  }

  /** Differences between the writings; what reaches into a gap has all of it. */
  private changes(): readonly Change[] {
    const { before, after, was } = this;
    const ids = new LineIds();
    const common = commonLines(ids.of(before), ids.of(after));
    common.forEach((line, i) => {
      if (line >= 0) was[line] = i;
    });
    const found: Change[] = [];
    let newFrom = 0;
    for (let from = 0; from <= before.length; from++) {
      let to = from;
      while (to < before.length && common[to] < 0) to++;
      const newTo = to < before.length ? common[to] : after.length;
      if (to > from || newTo > newFrom) {
        const change = this.widened({ from, to, newFrom, newTo });
        const last = found.at(-1);
        if (last && change.from <= last.to && this.isInGap(last)) {
          last.to = Math.max(last.to, change.to);
          last.newTo = Math.max(last.newTo, change.newTo);
        } else found.push(change);
      }
      from = to;
      newFrom = newTo + 1;
    }
    return found;
  }

  private widened({ from, to, newFrom, newTo }: Change): Change {
    const { gapOf } = this;
    const isInside = from === to && from > 0 && gapOf.has(from) && gapOf.get(from) === gapOf.get(from - 1);
    const first = from < to || isInside ? gapOf.get(from) : undefined;
    const last = from < to || isInside ? gapOf.get(Math.max(from, to - 1)) : undefined;
    const start = first ? Math.min(from, first.from) : from;
    const end = last ? Math.max(to, last.to) : to;
    // Lines that didn't change are as many in both.
    return { from: start, to: end, newFrom: newFrom - (from - start), newTo: newTo + (end - to) };
  }

  private isInGap({ from, to }: Change): boolean {
    for (let i = from; i < to; i++) if (this.gapOf.has(i)) return true;
    return false;
  }

  /** Where the line breaks differ. */
  private replaceAll({ from, to, newFrom, newTo }: Change): void {
    const { own, gapOf, gone, after } = this;
    const start = gapOf.get(from)?.own ?? own[from];
    const end = gapOf.get(to - 1)?.ownTo ?? own[to - 1] + 1;
    for (let at = start; at < end; at++) gone[at] = 1;
    this.insert(start, after.slice(newFrom, newTo), from);
  }

  /** Lines that set the same are replaced in their places, others removed and inserted. */
  private replaceLines({ from, to, newFrom, newTo }: Change): void {
    const { before, after, own, gone, original } = this;
    const ids = new LineIds();
    // A block may have got another name or type.
    const heads = (lines: readonly string[]) =>
      ids.of(lines.map((line) => (line.endsWith('{') ? '{' : headOf(lineMeaning(line)))));
    const pairs = commonLines(heads(before.slice(from, to)), heads(after.slice(newFrom, newTo)));
    let place = this.placeAfter(from - 1);
    let done = newFrom;
    for (let i = from; i < to; i++) {
      const at = own[i];
      const pair = pairs[i - from] < 0 ? -1 : newFrom + pairs[i - from];
      if (pair >= 0) {
        this.insertLines(place, done, pair, from);
        done = pair + 1;
        this.replaced.set(at, inPlace(original.lines[at], after[pair], before[i]));
        if (!this.keepsDefaults && before[i].endsWith('{')) this.dropDefaults(at);
      } else {
        gone[at] = 1;
        const next = i + 1 < to && pairs[i + 1 - from] < 0 ? own[i + 1] : at;
        for (let between = at + 1; between < next && !this.isOwn[between]; between++) gone[between] = 1;
      }
      place = at + 1;
    }
    this.insertLines(place, done, newTo, to > from ? to - 1 : from);
  }

  /** @param block of the original */
  private dropDefaults(block: number): void {
    for (const at of this.defaults.values()) if (this.blocks[at] === block && !this.replaced.has(at)) this.gone[at] = 1;
  }

  /** Behind a line, and behind what the original alone has there in its block. */
  private placeAfter(i: number): number {
    const { own, gapOf, blocks, isOwn, meanings } = this;
    if (i < 0) return own.length > 0 ? (gapOf.get(0)?.own ?? own[0]) : meanings.length;
    const at = own[i];
    if (at < 0) return gapOf.get(i)?.ownTo ?? meanings.length;
    let place = at + 1;
    if (meanings[at].endsWith('{') || meanings[at].endsWith('}')) return place;
    while (place < meanings.length && meanings[place] !== '' && !isOwn[place] && blocks[place] === blocks[at]) place++;
    return place;
  }

  /** Inserts lines [from, to) of `after`; one that sets what the original sets to its default replaces that. */
  private insertLines(place: number, from: number, to: number, near: number): void {
    const { after, newBlocks, was, own, defaults, original } = this;
    const rest: string[] = [];
    for (let k = from; k < to; k++) {
      const block = newBlocks[k] < 0 ? -1 : was[newBlocks[k]];
      const key = `${block < 0 ? block : own[block]} ${headOf(lineMeaning(after[k]))}`;
      const at = newBlocks[k] >= 0 && block < 0 ? undefined : defaults.get(key);
      if (at === undefined || this.gone[at]) rest.push(after[k]);
      else this.replaced.set(at, inPlace(original.lines[at], after[k]));
    }
    if (rest.length > 0) this.insert(place, rest, near);
  }

  private insert(place: number, lines: readonly string[], near: number): void {
    const known = this.inserted.get(place) ?? [];
    this.inserted.set(place, [...known, ...lines.map((line) => this.indented(line, near))]);
  }

  /** With the indentation that the original has at this depth nearby. */
  private indented(line: string, near: number): string {
    const { before, own, original } = this;
    const depth = indentOf(line);
    for (let reach = 0; reach < REACH; reach++) {
      for (const i of [near - reach, near + reach]) {
        if (!(i >= 0 && i < before.length) || own[i] < 0 || indentOf(before[i]) !== depth) continue;
        return indentOf(original.lines[own[i]]) + line.slice(depth.length);
      }
    }
    return line;
  }

  private build(): MergedText {
    const { original, gone, replaced, inserted } = this;
    const count = original.lines.length;
    const lineEnd = original.ends[0] || '\n';
    const lines: string[] = [];
    const ends: string[] = [];
    const hunks: LineHunk[] = [];
    let open: { oldFrom: number; newFrom: number } | undefined;
    for (let at = 0; at <= count; at++) {
      const added = inserted.get(at) ?? [];
      const line = replaced.get(at);
      const isChanged = at < count && (gone[at] === 1 || (line !== undefined && line !== original.lines[at]));
      if (added.length > 0 || isChanged) open ??= { oldFrom: at + 1, newFrom: lines.length + 1 };
      if (added.length > 0) {
        if (lines.length > 0 && ends[lines.length - 1] === '') ends[lines.length - 1] = lineEnd;
        for (const each of added) {
          lines.push(each);
          ends.push(lineEnd);
        }
        if (at === count) ends[ends.length - 1] = '';
      }
      if (!isChanged && open) {
        hunks.push({ ...open, oldTo: Math.min(at, count) + 1, newTo: lines.length + 1 });
        open = undefined;
      }
      if (at === count || gone[at]) continue;
      lines.push(line ?? original.lines[at]);
      ends.push(original.ends[at]);
    }
    return { text: joinLines({ lines, ends }), hunks };
  }
}

/** Writers end the last line too. */
function writtenLines(text: string): readonly string[] {
  return splitLines(text).lines.filter((line) => line !== '');
}

/** The line of the brace that is open before each line; -1: none. A line that closes one belongs to its block. */
function blocksOf(lines: readonly string[]): Int32Array {
  const open: number[] = [];
  return Int32Array.from(lines, (line, i) => {
    const block = open.at(-1) ?? -1;
    for (const brace of line.match(/[{}]/g) ?? []) {
      if (brace === '{') open.push(i);
      else open.pop();
    }
    return block;
  });
}

function indentOf(line: string): string {
  return /^\uFEFF?[ \t]*/.exec(line)?.[0] ?? '';
}

/**
 * A line of the original with the tokens that changed.
 *
 * @param before as it was written; absent if it wasn't
 */
function inPlace(own: string, after: string, before?: string): string {
  const [is, was] = [tokensOf(after), before === undefined ? undefined : tokensOf(before)];
  if (tokensOf(own).length !== is.length || (was && was.length !== is.length)) return indentOf(own) + after.trim();
  let at = -1;
  return own.replace(TOKEN, (token) => {
    at++;
    const isSame = was ? was[at] === is[at] : meaningOf(token) === meaningOf(is[at]);
    return isSame ? token : is[at];
  });
}
