/**
 * Unpacks deflated data (RFC 1951) into as many bytes as are wanted, and never more: data may unpack to a thousand times
 * its size, whatever it claims.
 *
 *     data      blocks: of bytes as they are, or of symbols in Huffman codes
 *     symbol    a byte, the end of the block, or a length, which a distance follows: so many bytes from so far back
 *
 * Symbols of up to `FAST` bits are looked up. Longer ones are rare by their nature, and found by their length: codes of one
 * length are consecutive numbers.
 */

/** How unpacking ended: with the data, with data left over for which there was no room, or before its end. */
export type InflateEnding = 'whole' | 'more' | 'damaged' | 'cut';

/** The result of unpacking: how it ended, and how much there is. */
export interface Inflated {
  readonly ending: InflateEnding;
  /** Bytes of the output that were written. */
  readonly length: number;
}

/** Unpacks data from its start to the end, or until the output is full. What is behind the end is ignored. */
export function inflate(packed: Uint8Array, out: Uint8Array): Inflated {
  return new Inflating(packed, out).result();
}

/** Bits that are looked up, and those of the longest code. */
const FAST = 11;
const LONGEST = 15;
/** Where the symbol begins in an entry of `Code.fast`, and its number of bits: all that shifts look at of an entry. */
const SYMBOL = 5;
const BITS = 31;
/** Entries below it are bytes. */
const OTHER = 256 << SYMBOL;
/** No symbol. */
const NONE = 511 << SYMBOL;
const END = 256;

/** A Huffman code. */
class Code {
  /** By the next `FAST` bits: the symbol, shifted, and its number of bits; `NONE` for longer ones. */
  readonly fast = new Uint16Array(1 << FAST);
  /** Number of symbols of each length. */
  private readonly counts = new Uint16Array(LONGEST + 1);
  /** In the order of their codes. */
  private readonly symbols = new Uint16Array(288);

  /** Becomes the code whose symbols have these lengths, 0 for none. Returns false if no code has. */
  become(lengths: Uint8Array): boolean {
    const { fast, counts, symbols } = this;
    counts.fill(0);
    for (let i = 0; i < lengths.length; i++) counts[lengths[i]]++;
    counts[0] = 0;
    let [index, left] = [0, 1];
    for (let length = 1; length <= LONGEST; length++) {
      left = 2 * left - counts[length];
      if (left < 0) return false;
      nextIndices[length] = index;
      index += counts[length];
    }
    for (let symbol = 0; symbol < lengths.length; symbol++) {
      const length = lengths[symbol];
      if (length > 0) symbols[nextIndices[length]++] = symbol;
    }
    // From length to length, entries are doubled for either next bit, then those that are no symbols yet become some.
    fast[0] = NONE;
    for (let length = 1, code = 0, i = 0; length <= FAST; length++, code <<= 1) {
      fast.copyWithin(1 << (length - 1), 0, 1 << (length - 1));
      for (let k = counts[length]; k > 0; k--, code++, i++) {
        fast[REVERSED[code << (FAST - length)]] = (symbols[i] << SYMBOL) | length;
      }
    }
    return true;
  }

  /** As in `fast`, for any symbol; `NONE` if no code begins with those bits. */
  find(bits: number): number {
    const { counts, symbols } = this;
    let [code, first, index] = [0, 0, 0];
    for (let length = 1; length <= LONGEST; length++) {
      code |= (bits >> (length - 1)) & 1;
      if (code - first < counts[length]) return (symbols[index + code - first] << SYMBOL) | length;
      index += counts[length];
      first = (first + counts[length]) << 1;
      code <<= 1;
    }
    return NONE;
  }
}

/** `FAST` bits from the other end, as codes are read. */
const REVERSED = Uint16Array.from({ length: 1 << FAST }, (_, bits) => {
  let out = 0;
  for (let i = 0; i < FAST; i++) out |= ((bits >> i) & 1) << (FAST - 1 - i);
  return out;
});

/** Lengths from symbol 257 on, and distances: the least, and how many bits are added to it. */
const [LENGTH_BITS, DISTANCE_BITS] = [new Uint8Array(29), new Uint8Array(30)];
const [LENGTHS, DISTANCES] = [new Uint16Array(29), new Uint16Array(30)];
for (let i = 0, length = 3; i < 28; length += 1 << LENGTH_BITS[i++]) {
  LENGTH_BITS[i] = Math.max(0, (i >> 2) - 1);
  LENGTHS[i] = length;
}
LENGTHS[28] = 258;
for (let i = 0, distance = 1; i < 30; distance += 1 << DISTANCE_BITS[i++]) {
  DISTANCE_BITS[i] = Math.max(0, (i >> 1) - 1);
  DISTANCES[i] = distance;
}

/** The order in which a block gives the lengths of the code of lengths. */
const ORDER = [16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15];

/** Bytes that are left of a view when the next one is made; most of one, so that its bits can be counted. */
const MARGIN = 16;
const VIEW_BYTES = 1 << 26;

class Inflating {
  private length = 0;
  /** The next bit. */
  private byte = 0;
  private bit = 0;

  constructor(
    private readonly packed: Uint8Array,
    private readonly out: Uint8Array,
  ) {}

  result(): Inflated {
    for (;;) {
      const isLast = this.take(1) === 1;
      const kind = this.take(2);
      const ending = kind === 0 ? this.copy() : this.readCodes(kind) ? this.unpack() : 'damaged';
      // Bits behind the end are 0, and may be anything.
      if (this.byte + (this.bit > 0 ? 1 : 0) > this.packed.length) return { ending: 'cut', length: this.length };
      if (ending !== 'whole' || isLast) return { ending, length: this.length };
    }
  }

  /** The next bits, at most 16. */
  private peek(): number {
    const { packed, byte, bit } = this;
    // Past the end there are none.
    const at = (i: number) => (byte + i < packed.length ? packed[byte + i] : 0);
    return (at(0) | (at(1) << 8) | (at(2) << 16)) >>> bit;
  }

  private skip(bits: number): void {
    this.bit += bits;
    this.byte += this.bit >> 3;
    this.bit &= 7;
  }

  private take(bits: number): number {
    const value = this.peek() & ((1 << bits) - 1);
    this.skip(bits);
    return value;
  }

  /** A block of bytes as they are. */
  private copy(): InflateEnding {
    const { packed, out } = this;
    if (this.bit > 0) this.skip(8 - this.bit);
    const length = this.take(16);
    if ((length ^ this.take(16)) !== 0xffff) return 'damaged';
    const count = Math.min(length, out.length - this.length);
    out.set(packed.subarray(this.byte, this.byte + count), this.length);
    this.byte += length;
    this.length += count;
    return count < length ? 'more' : 'whole';
  }

  /** The codes of a block of symbols: usual ones, or its own. Returns false if there are none. */
  private readCodes(kind: number): boolean {
    if (kind === 3) return false;
    if (kind === 1) {
      lengths.fill(8, 0, 144).fill(9, 144, 256).fill(7, 256, 280).fill(8, 280, 288).fill(5, 288, 318);
      return symbolCode.become(lengths.subarray(0, 288)) && distanceCode.become(lengths.subarray(288, 318));
    }
    const symbolCount = 257 + this.take(5);
    const count = symbolCount + 1 + this.take(5);
    const given = 4 + this.take(4);
    lengths.fill(0, 0, ORDER.length);
    for (let i = 0; i < given; i++) lengths[ORDER[i]] = this.take(3);
    if (symbolCount > 286 || !lengthCode.become(lengths.subarray(0, ORDER.length))) return false;
    for (let i = 0; i < count; ) {
      const entry = lengthCode.fast[this.peek() & ((1 << FAST) - 1)];
      const symbol = entry >> SYMBOL;
      this.skip(entry & BITS);
      if (entry === NONE || (symbol === 16 && i === 0)) return false;
      const value = symbol < 16 ? symbol : symbol === 16 ? lengths[i - 1] : 0;
      const times =
        symbol < 16 ? 1 : symbol === 16 ? 3 + this.take(2) : symbol === 17 ? 3 + this.take(3) : 11 + this.take(7);
      if (i + times > count) return false;
      for (const end = i + times; i < end; i++) lengths[i] = value;
    }
    return (
      symbolCode.become(lengths.subarray(0, symbolCount)) && distanceCode.become(lengths.subarray(symbolCount, count))
    );
  }

  /**
   * A block of symbols. The next bits are held in a number: at least 24 of them once it is filled, and beyond those that
   * count the right ones or 0. What it is filled with is read while symbols are looked up.
   */
  private unpack(): InflateEnding {
    const { out } = this;
    const { fast } = symbolCode;
    const room = out.length;
    const mask = (1 << FAST) - 1;
    let { length } = this;
    let view = this.viewFrom(this.byte);
    let last = view.byteLength - MARGIN;
    let hold = view.getUint32(0, true) >>> this.bit;
    let count = 24 - this.bit;
    let at = 3;
    this.bit = 0;
    for (;;) {
      // Nearly all are bytes.
      while (at <= last && length < room - 1) {
        hold |= view.getUint32(at, true) << count;
        at += (31 - count) >> 3;
        count |= 24;
        const first = fast[hold & mask];
        if (first >= OTHER) break;
        out[length++] = first >> SYMBOL;
        hold >>>= first;
        count -= first & BITS;
        const second = fast[hold & mask];
        if (second >= OTHER) break;
        out[length++] = second >> SYMBOL;
        hold >>>= second;
        count -= second & BITS;
      }
      if (at > last) {
        this.skip(8 * at - count);
        if (this.byte > this.packed.length) return this.endsAt('cut', length);
        view = this.viewFrom(this.byte);
        last = view.byteLength - MARGIN;
        hold = view.getUint32(0, true) >>> this.bit;
        count = 24 - this.bit;
        at = 3;
        this.bit = 0;
      }
      hold |= view.getUint32(at, true) << count;
      at += (31 - count) >> 3;
      count |= 24;
      let entry = fast[hold & mask];
      if (entry === NONE) {
        entry = symbolCode.find(hold);
        if (entry === NONE) return this.endsAt('damaged', length);
      }
      hold >>>= entry;
      count -= entry & BITS;
      const symbol = entry >> SYMBOL;
      if (symbol < 256) {
        if (length === room) return this.endsAt('more', length);
        out[length++] = symbol;
        continue;
      }
      if (symbol === END) break;
      if (symbol > 285) return this.endsAt('damaged', length);
      const more = LENGTH_BITS[symbol - 257];
      let until = length + LENGTHS[symbol - 257] + (hold & ((1 << more) - 1));
      hold >>>= more;
      count -= more;
      hold |= view.getUint32(at, true) << count;
      at += (31 - count) >> 3;
      count |= 24;
      let far = distanceCode.fast[hold & mask];
      if (far === NONE) far = distanceCode.find(hold);
      hold >>>= far;
      count -= far & BITS;
      if (far >> SYMBOL > 29) return this.endsAt('damaged', length);
      hold |= view.getUint32(at, true) << count;
      at += (31 - count) >> 3;
      count |= 24;
      const farBits = DISTANCE_BITS[far >> SYMBOL];
      const from = length - DISTANCES[far >> SYMBOL] - (hold & ((1 << farBits) - 1));
      hold >>>= farBits;
      count -= farBits;
      if (from < 0) return this.endsAt('damaged', length);
      const isOver = until > room;
      if (isOver) until = room;
      for (let i = from; length < until; ) out[length++] = out[i++];
      if (isOver) return this.endsAt('more', length);
    }
    this.skip(8 * at - count);
    return this.endsAt('whole', length);
  }

  private endsAt(ending: InflateEnding, length: number): InflateEnding {
    this.length = length;
    return ending;
  }

  /** The packed bytes from that one on; those near the end with zeros behind them. */
  private viewFrom(byte: number): DataView {
    const { packed } = this;
    const left = packed.length - byte;
    if (left > 4 * MARGIN) return new DataView(packed.buffer, packed.byteOffset + byte, Math.min(left, VIEW_BYTES));
    const tail = new Uint8Array(6 * MARGIN);
    tail.set(packed.subarray(Math.min(byte, packed.length)));
    return new DataView(tail.buffer);
  }
}

/** Scratch. */
const [symbolCode, distanceCode, lengthCode] = [new Code(), new Code(), new Code()];
const lengths = new Uint8Array(320);
const nextIndices = new Uint16Array(LONGEST + 1);
