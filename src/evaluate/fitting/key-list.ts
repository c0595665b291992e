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

  /** Number of keys so far. */
  get count(): number {
    return this.times.length;
  }

  /** Appends a key at the time of the last one or later, with slopes per second or `LINE_SLOPE`. */
  add(time: number, value: number, slopeIn: number, slopeOut: number): void {
    this.times.push(time);
    this.values.push(value);
    this.slopesIn.push(slopeIn);
    this.slopesOut.push(slopeOut);
  }

  /** Sets what follows the last key. */
  leave(slope: number): void {
    this.slopesOut[this.slopesOut.length - 1] = slope;
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
    return this.values.every((value) => Math.abs(value - this.values[0]) <= tolerance);
  }

  /** Value of the first key; there must be one. */
  get firstValue(): number {
    return this.values[0];
  }

  /** Values and slopes times a factor, and values plus an offset. There must be a key. */
  channel(factor: number, offset: number, extrapolateIn: Extrapolation, extrapolateOut: Extrapolation): KeyedChannel {
    const values = new Float64Array(this.values);
    for (let k = 0; k < values.length; k++) values[k] = values[k] * factor + offset;
    return {
      kind: 'keys',
      times: new Float64Array(this.times),
      values,
      tangentsIn: tangentsOf(this.slopesIn, factor),
      tangentsOut: tangentsOf(this.slopesOut, factor),
      extrapolateIn,
      extrapolateOut,
    };
  }
}

/** A slope that is too steep to be a number is that of the straight line, too. */
function tangentsOf(slopes: readonly number[], factor: number): Tangents {
  const kinds = new Uint8Array(slopes.length).fill(LINEAR);
  const own = new Float64Array(slopes.length);
  for (let k = 0; k < own.length; k++) {
    const slope = slopes[k];
    if (!Number.isFinite(slope * factor)) continue;
    kinds[k] = slope === 0 ? FLAT : FIXED_TANGENT;
    own[k] = slope * factor;
  }
  return { kinds, slopes: own };
}
