/**
 * `.morph`: absolute replacement values for some vertices of a base skin.
 *
 *     morph = { positions K "{" { index x y z } "}" | normals K "{" { index x y z } "}" }       in any order
 *
 * Indices are checked against the skin only when the two are bound.
 */
import type { Morph, MorphRows } from '../../model/morph.ts';
import {
  braceTooMany,
  checkRows,
  countAndBrace,
  type GrammarPart,
  MAX_COUNT,
  skipStrange,
  stemOfName,
  WrongIndices,
  warnRepeated,
} from '../grammar.ts';
import { NUMBERS } from '../number-batch.ts';
import { type Place, WHOLE_FILE } from '../places.ts';
import { grammarReader, type Reader, type ReadResult, readWhole } from '../reader.ts';
import type { NumberSink, Tokens } from '../tokens.ts';

/** A reader for a `.morph`. */
export function morphReader(fileName: string): Reader<Morph> {
  return grammarReader(fileName, morphFile);
}

/** Reads a whole `.morph`. */
export function readMorph(bytes: Uint8Array | string, fileName: string): ReadResult<Morph> {
  return readWhole(morphReader(fileName), bytes);
}

const KEYWORDS = new Set(['positions', 'normals']);
const NO_ROWS: MorphRows = { indices: new Uint32Array(0), values: new Float64Array(0) };

function* morphFile(t: Tokens): GrammarPart<Morph> {
  let positions: MorphRows | undefined;
  let normals: MorphRows | undefined;
  for (;;) {
    const kind = yield* t.next();
    if (kind === 'end') break;
    const word = t.keyword();
    if (kind === '}') braceTooMany(t);
    else if (word === 'positions') {
      if (positions) warnRepeated(t, word);
      positions = yield* rowsOf(t, word);
    } else if (word === 'normals') {
      if (normals) warnRepeated(t, word);
      normals = yield* rowsOf(t, word);
    } else yield* skipStrange(t, 'a .morph file', 'positions or normals', KEYWORDS);
  }
  if (!positions?.indices.length && !normals?.indices.length) {
    t.report.error('vertex-missing', 'Expected at least one replaced vertex, found none.', WHOLE_FILE);
  }
  return { name: stemOfName(t.fileName), positions: positions ?? NO_ROWS, normals: normals ?? NO_ROWS };
}

function* rowsOf(t: Tokens, what: string): GrammarPart<MorphRows> {
  const declared = yield* countAndBrace(t, what, KEYWORDS);
  const sink = new MorphSink();
  yield* t.numbers(sink, what, KEYWORDS);
  sink.tell(t, what);
  checkRows(t, what, 4, declared, sink.found);
  return sink.rows();
}

/** Splits rows of `index x y z` into columns while reading. */
class MorphSink implements NumberSink {
  readonly values = NUMBERS;
  count = 0;
  readonly usesUp = true;
  found = 0;
  private indices = new Uint32Array(64);
  private vectors = new Float64Array(192);
  private wrong = new WrongIndices('the index of a vertex', () => ' (0 or more)');
  private repeated = 0;
  private repeatedAt: Place | undefined;
  private highest = -1;
  /** Created only if the indices are not ascending. */
  private seen: Set<number> | undefined;

  flush(t: Tokens): void {
    const { values, count } = this;
    const rows = Math.ceil((this.found + count) / 4);
    if (rows > this.indices.length) {
      const indices = new Uint32Array(2 * rows);
      indices.set(this.indices);
      this.indices = indices;
      const vectors = new Float64Array(6 * rows);
      vectors.set(this.vectors);
      this.vectors = vectors;
    }
    for (let i = 0; i < count; i++, this.found++) {
      const row = Math.floor(this.found / 4);
      const column = this.found % 4;
      if (column > 0) this.vectors[3 * row + column - 1] = values[i];
      else this.index(t, row, values[i], i);
    }
    this.count = 0;
  }

  private index(t: Tokens, row: number, index: number, slot: number): void {
    this.indices[row] = index;
    if (this.indices[row] !== index || index >= MAX_COUNT - 1) {
      this.wrong.addSlot(index, t, slot);
    } else if (index > this.highest) {
      this.highest = index;
      this.seen?.add(index);
    } else {
      this.seen ??= new Set(this.indices.subarray(0, row));
      if (this.seen.has(index)) {
        this.repeated++;
        this.repeatedAt ??= t.placeOfSlot(slot);
      }
      this.seen.add(index);
    }
  }

  tell(t: Tokens, what: string): void {
    this.wrong.tell(t);
    if (!this.repeatedAt) return;
    const message = `Found ${this.repeated === 1 ? 'a repeated vertex' : `${this.repeated} repeated vertices`} in the ${what}, the first one here.`;
    t.report.warn('index-repeated', message, this.repeatedAt, 'the last one is used');
  }

  /** Without the earlier ones of repeated rows. */
  rows(): MorphRows {
    const n = Math.floor(this.found / 4);
    if (!this.repeatedAt) return { indices: this.indices.slice(0, n), values: this.vectors.slice(0, 3 * n) };
    const last = new Map<number, number>();
    for (let row = 0; row < n; row++) last.set(this.indices[row], row);
    const indices = new Uint32Array(last.size);
    const values = new Float64Array(3 * last.size);
    let next = 0;
    for (const row of last.values()) {
      indices[next] = this.indices[row];
      for (let k = 0; k < 3; k++) values[3 * next + k] = this.vectors[3 * row + k];
      next++;
    }
    return { indices, values };
  }
}
