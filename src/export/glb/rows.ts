/**
 * A stretch of a take as rows: the numbers of all nodes and the morph weights at times close enough that a straight
 * line between two of them is as good as the motion itself.
 */
import { keepNear } from '../shared/joint-nodes.ts';

/** The rows of one stretch; grows, and is reused. */
export class Rows {
  readonly width: number;
  private readonly nodeCount: number;
  count = 0;
  /** Seconds since the start of the take, as the file has them: rounded to floats. */
  seconds = new Float64Array(64);
  /** 1 where the values jump from the row before: a step. */
  jumps = new Uint8Array(64);
  values: Float64Array;

  constructor(width: number, nodeCount: number) {
    this.width = width;
    this.nodeCount = nodeCount;
    this.values = new Float64Array(64 * width);
  }

  /** Adds a row, unless its time is that of the row before when rounded; says whether it did. */
  add(seconds: number, row: Float64Array, jumps: boolean): boolean {
    const rounded = Math.fround(seconds);
    if (this.count > 0 && !(rounded > this.seconds[this.count - 1])) return false;
    if (this.count === this.seconds.length) this.grow();
    const o = this.count * this.width;
    this.seconds[this.count] = rounded;
    this.jumps[this.count] = jumps ? 1 : 0;
    this.values.set(row, o);
    if (this.count > 0) keepNear(this.values, o - this.width, o, this.nodeCount);
    this.count++;
    return true;
  }

  private grow(): void {
    const { seconds, jumps, values } = this;
    this.seconds = new Float64Array(2 * seconds.length);
    this.seconds.set(seconds);
    this.jumps = new Uint8Array(2 * jumps.length);
    this.jumps.set(jumps);
    this.values = new Float64Array(2 * values.length);
    this.values.set(values);
  }

  /** Leaves the last row only, as the first of the next stretch. */
  continueFromLast(): void {
    const last = this.count - 1;
    this.values.copyWithin(0, last * this.width, this.count * this.width);
    this.seconds[0] = this.seconds[last];
    this.jumps[0] = 0;
    this.count = 1;
  }
}
