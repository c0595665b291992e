/** Collects the keys of a channel one by one. */
import type { Extrapolation, KeyedChannel, Tangents } from '../../model/takes/take.ts';
import { FIXED_TANGENT, FLAT, LINEAR } from '../../model/takes/tangent-kinds.ts';

/** The slope of the straight line to a key's neighbour. No slope of a key is none. */
export const LINE_SLOPE = Number.NaN;

/** The keys of one channel, in the order in which they are added. */
export class KeyList {
  private readonly times: number[] = [];
  private readonly values: number[] = [];
  private readonly slopesIn: number[] = [];
  private readonly slopesOut: number[] = [];

  private length = 0;

  /** Number of keys so far. */
  get count(): number {
    return this.length;
  }

  /** Empties it, for the keys of another channel. */
  clear(): void {
    this.length = 0;
  }

  /** Appends a key at the time of the last one or later, with slopes per second or `LINE_SLOPE`. */
  add(time: number, value: number, slopeIn: number, slopeOut: number): void {
    const at = this.length++;
    this.times[at] = time;
    this.values[at] = value;
    this.slopesIn[at] = slopeIn;
    this.slopesOut[at] = slopeOut;
  }

  /** Sets what follows the last key. */
  leave(slope: number): void {
    this.slopesOut[this.length - 1] = slope;
  }

  /** Continues with the keys of another list, whose first is this one's last, if there is one. */
  append(other: KeyList): void {
    const isSame = this.count > 0 && this.times[this.count - 1] === other.times[0];
    if (isSame) this.leave(other.slopesOut[0]);
    for (let i = isSame ? 1 : 0; i < other.count; i++) {
      this.add(other.times[i], other.values[i], other.slopesIn[i], other.slopesOut[i]);
    }
  }

  /** Whether all keys say the same value. */
  isConstant(tolerance: number): boolean {
    for (let i = 1; i < this.length; i++) {
      if (!(Math.abs(this.values[i] - this.values[0]) <= tolerance)) return false;
    }
    return true;
  }

  /** Value of the first key; there must be one. */
  get firstValue(): number {
    return this.values[0];
  }

  /** Values and slopes times a factor, and values plus an offset. There must be a key. */
  channel(factor: number, offset: number, extrapolateIn: Extrapolation, extrapolateOut: Extrapolation): KeyedChannel {
    const { count } = this;
    // One buffer for all columns, since a small one takes as long to allocate as a hundred numbers to write.
    const buffer = new ArrayBuffer(COLUMNS_BYTES * count);
    const times = new Float64Array(buffer, 0, count);
    const values = new Float64Array(buffer, 8 * count, count);
    for (let k = 0; k < count; k++) {
      times[k] = this.times[k];
      values[k] = this.values[k] * factor + offset;
    }
    return {
      kind: 'keys',
      times,
      values,
      tangentsIn: tangentsOf(this.slopesIn, factor, count, buffer, 0),
      tangentsOut: tangentsOf(this.slopesOut, factor, count, buffer, 1),
      extrapolateIn,
      extrapolateOut,
    };
  }
}

/** Of a key in all columns: four doubles and two kinds. */
const COLUMNS_BYTES = 34;

/** A slope that is too steep to be a number is that of the straight line, too. */
function tangentsOf(
  slopes: readonly number[],
  factor: number,
  count: number,
  buffer: ArrayBuffer,
  side: 0 | 1,
): Tangents {
  const own = new Float64Array(buffer, (16 + 8 * side) * count, count);
  const kinds = new Uint8Array(buffer, (32 + side) * count, count);
  for (let k = 0; k < count; k++) {
    const slope = slopes[k];
    const isNumber = Number.isFinite(slope * factor);
    kinds[k] = !isNumber ? LINEAR : slope === 0 ? FLAT : FIXED_TANGENT;
    if (isNumber) own[k] = slope * factor;
  }
  return { kinds, slopes: own };
}
