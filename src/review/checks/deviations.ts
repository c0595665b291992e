/**
 * How far points are from where the frames around them let them be expected, for the checks of spikes and of jitter.
 * With points x of a joint or End Site in five frames around frame c,
 *
 *     r = x(c) − (−x(c−2) + 4x(c−1) + 4x(c+1) − x(c+2)) / 6      left out by the cubic through its neighbours
 */
import { RecentPoints } from './check.ts';

const HELD = 5;

export class Deviations {
  readonly recent: RecentPoints;
  /** Of each point: |r|² at c and at c − 1, and r(c) · r(c−1). */
  squares: Float64Array;
  squaresBefore: Float64Array;
  readonly products: Float64Array;
  private readonly r: Float64Array;
  /** Squares of the ways from frame to frame, the newest of which is the last one pushed. */
  private readonly ways: RecentPoints;
  private readonly way: Float64Array;
  private readonly last: Float64Array;

  constructor(pointCount: number) {
    this.recent = new RecentPoints(HELD, 3 * pointCount);
    this.ways = new RecentPoints(HELD - 1, pointCount);
    this.squares = new Float64Array(pointCount);
    this.squaresBefore = new Float64Array(pointCount);
    this.products = new Float64Array(pointCount);
    this.r = new Float64Array(3 * pointCount);
    this.way = new Float64Array(pointCount);
    this.last = new Float64Array(3 * pointCount);
  }

  /** Whether there are five frames: c is two before the newest one. */
  get isFull(): boolean {
    return this.recent.isFull;
  }

  /** |x − x before|² of each point, of so many frames ago. */
  waysAgo(frames: number): Float64Array {
    return this.ways.ago(frames);
  }

  /** Frames come in order. */
  push(points: Float64Array): void {
    const { recent, ways, way, last } = this;
    for (let p = 0, o = 0; p < way.length; p++, o += 3) {
      const x = points[o] - last[o];
      const y = points[o + 1] - last[o + 1];
      const z = points[o + 2] - last[o + 2];
      way[p] = x * x + y * y + z * z;
    }
    last.set(points);
    recent.push(points);
    ways.push(way);
    if (recent.isFull) this.deviate();
  }

  private deviate(): void {
    const { recent, r, products } = this;
    const squares = this.squaresBefore;
    this.squaresBefore = this.squares;
    this.squares = squares;
    const x2 = recent.ago(0);
    const x1 = recent.ago(1);
    const x0 = recent.ago(2);
    const w1 = recent.ago(3);
    const w2 = recent.ago(4);
    for (let p = 0, o = 0; p < squares.length; p++, o += 3) {
      const x = x0[o] - (4 * (w1[o] + x1[o]) - w2[o] - x2[o]) / 6;
      const y = x0[o + 1] - (4 * (w1[o + 1] + x1[o + 1]) - w2[o + 1] - x2[o + 1]) / 6;
      const z = x0[o + 2] - (4 * (w1[o + 2] + x1[o + 2]) - w2[o + 2] - x2[o + 2]) / 6;
      products[p] = x * r[o] + y * r[o + 1] + z * r[o + 2];
      squares[p] = x * x + y * y + z * z;
      r[o] = x;
      r[o + 1] = y;
      r[o + 2] = z;
    }
  }

  /**
   * r · l and r · e of a point at c, with the deviations from the lines on either side.
   * @param side −1: l = x(c) − 2x(c−1) + x(c−2); 1: e = x(c) − 2x(c+1) + x(c+2)
   */
  alongLine(point: number, side: -1 | 1): number {
    const { recent, r } = this;
    const x = recent.ago(2);
    const next = recent.ago(2 - side);
    const beyond = recent.ago(2 - 2 * side);
    let sum = 0;
    for (let k = 3 * point; k < 3 * point + 3; k++) sum += r[k] * (x[k] - 2 * next[k] + beyond[k]);
    return sum;
  }
}
