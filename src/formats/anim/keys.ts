/**
 * Splits the keys of a channel, rows of `time value tan_in tan_out`, into the model's columns while reading.
 *
 * The number loop returns the words flat, linear and smooth as values that no number has (see `scan.ts`), so that a
 * hundred thousand keys are one loop over bytes like any other block.
 */
import { type Keys, NO_KEYS, type Tangents } from '../../model/takes/take.ts';
import { FIXED_TANGENT, FLAT, LINEAR, SMOOTH, TANGENT_KINDS } from '../../model/takes/tangent-kinds.ts';
import { NUMBERS } from '../number-batch.ts';
import type { Place } from '../places.ts';
import type { BlockWords } from '../scan.ts';
import type { NumberSink, Tokens } from '../tokens.ts';

const ascii = (word: string) => Uint8Array.from(word, (c) => c.charCodeAt(0));
const TANGENT_WORDS: BlockWords = [ascii('flat'), ascii('linear'), ascii('smooth')];
const COLUMNS = ['a time', 'a value', 'a tangent', 'a tangent'] as const;

/** One for a whole file; `begin` starts the next channel. */
export class KeySink implements NumberSink {
  readonly values = NUMBERS;
  count = 0;
  readonly words = TANGENT_WORDS;
  readonly usesUp = true;
  /** Numbers and words so far. */
  found = 0;
  private times = new Float64Array(64);
  private channelValues = new Float64Array(64);
  private readonly kinds = [new Uint8Array(64), new Uint8Array(64)];
  private readonly slopes = [new Float64Array(64), new Float64Array(64)];
  private unsorted: { count: number; place: Place } | undefined;
  private doubled: { count: number; time: number; place: Place } | undefined;

  /** Empties the sink for the keys of the next channel. */
  begin(): void {
    this.count = this.found = 0;
    this.unsorted = this.doubled = undefined;
  }

  /**
   * Moves the numbers read so far into columns: times, values, tangents. Reports words among times and values, and keys
   * out of order.
   */
  flush(t: Tokens): void {
    const { values, count, found } = this;
    this.grow(Math.ceil((found + count) / 4));
    const { times, channelValues, kinds, slopes } = this;
    let row = Math.floor(found / 4);
    let column = found % 4;
    for (let i = 0; i < count; i++) {
      const value = values[i];
      if (column >= 2) {
        const isWord = value - value !== 0;
        kinds[column - 2][row] = isWord ? kindOf(value) : FIXED_TANGENT;
        slopes[column - 2][row] = isWord ? 0 : value;
        if (++column === 4) {
          column = 0;
          row++;
        }
        continue;
      }
      if (value - value !== 0) {
        this.misplaced(t, i, column);
        values[i] = 0;
      }
      if (column === 1) channelValues[row] = values[i];
      else {
        times[row] = values[i];
        // Not later than the previous key?
        if (row > 0 && !(values[i] > times[row - 1])) this.notLater(t, i, times[row - 1]);
      }
      column++;
    }
    this.found += count;
    this.count = 0;
  }

  /** A tangent's word in place of a time or value. */
  private misplaced(t: Tokens, slot: number, column: number): void {
    if (!t.report.hasRoom('error')) return;
    const word = TANGENT_KINDS[kindOf(this.values[slot])];
    t.report.error('number-expected', `Expected ${COLUMNS[column]}, found "${word}".`, t.placeOfSlot(slot));
  }

  private notLater(t: Tokens, slot: number, before: number): void {
    const time = this.values[slot];
    if (time < before) {
      if (this.unsorted) this.unsorted.count++;
      else this.unsorted = { count: 1, place: t.placeOfSlot(slot) };
    } else if (this.doubled) this.doubled.count++;
    else this.doubled = { count: 1, time, place: t.placeOfSlot(slot) };
  }

  /** Reports a token that is neither a number nor a known word, by the column that it stands in. */
  strange(t: Tokens): void {
    const column = this.found % 4;
    if (column >= 2 && /^[a-z_]/i.test(t.text().slice(0, 4)) && !/^(nan|inf)/i.test(t.text().slice(0, 4))) {
      t.error('tangent-unknown', `Expected flat, linear, smooth or a slope, found ${t.found()}.`);
    } else t.notANumber(COLUMNS[column]);
  }

  /** After the block: warns about the order of the keys, and returns them sorted. */
  columns(t: Tokens): Keys {
    const n = Math.floor(this.found / 4);
    if (n === 0) return NO_KEYS;
    let order: Uint32Array | undefined;
    if (this.unsorted) {
      const { count, place } = this.unsorted;
      const times = this.times;
      order = Uint32Array.from({ length: n }, (_, i) => i).sort((a, b) => times[a] - times[b] || a - b);
      const steps = count === 1 ? '1 key is' : `${count} keys are`;
      t.report.warn('keys-unsorted', `${steps} out of order in time.`, place, 'sorted');
    }
    const take = <A extends Float64Array | Uint8Array>(column: A, empty: A): A => {
      if (order) for (let i = 0; i < n; i++) empty[i] = column[order[i]];
      else empty.set(column.subarray(0, n));
      return empty;
    };
    const times = take(this.times, new Float64Array(n));
    this.tellDoubled(t, times);
    const side = (s: 0 | 1): Tangents => ({
      kinds: take(this.kinds[s], new Uint8Array(n)),
      slopes: take(this.slopes[s], new Float64Array(n)),
    });
    return { times, values: take(this.channelValues, new Float64Array(n)), tangentsIn: side(0), tangentsOut: side(1) };
  }

  private tellDoubled(t: Tokens, times: Float64Array): void {
    let { doubled } = this;
    // Unsorted keys may share a time without being neighbours in the file.
    if (!doubled && this.unsorted) {
      for (let i = 1; i < times.length; i++) {
        if (times[i] !== times[i - 1]) continue;
        doubled ??= { count: 0, time: times[i], place: this.unsorted.place };
        doubled.count++;
      }
    }
    if (!doubled) return;
    const more = doubled.count > 1 ? ` (and ${doubled.count - 1} more such pairs)` : '';
    const message = `Found two keys at time ${doubled.time}${more}.`;
    t.report.warn(
      'keys-at-one-time',
      message,
      doubled.place,
      'read as a step: the later key applies from that time on',
    );
  }

  private grow(rows: number): void {
    if (rows <= this.times.length) return;
    const length = Math.max(rows, 2 * this.times.length);
    const doubles = (old: Float64Array) => {
      const grown = new Float64Array(length);
      grown.set(old);
      return grown;
    };
    this.times = doubles(this.times);
    this.channelValues = doubles(this.channelValues);
    for (const s of [0, 1]) {
      const kinds = new Uint8Array(length);
      kinds.set(this.kinds[s]);
      this.kinds[s] = kinds;
      this.slopes[s] = doubles(this.slopes[s]);
    }
  }
}

/** See `WORD_VALUES`. */
function kindOf(value: number): number {
  return Number.isNaN(value) ? FLAT : value > 0 ? LINEAR : SMOOTH;
}
