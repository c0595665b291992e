/**
 * Spikes and jumps. With points x of a joint or End Site in five frames around frame c,
 *
 *     r = x(c) − (−x(c−2) + 4x(c−1) + 4x(c+1) − x(c+2)) / 6      left out by the cubic through its neighbours
 *     l = x(c) − 2x(c−1) + x(c−2)     e = x(c) − 2x(c+1) + x(c+2)      by the lines on either side
 *
 * is a spike if r is longer than 4 cm (the more the fewer than 30 frames a second), longer than eight times the point's usual r (its 80th percentile), and both l and
 * e go along r for most of its length: at the sharp turn of a punch they don't. It is a jump if a point moves 8 cm
 * further in one frame than in those around it, and five times as far.
 *
 * What moves a joint moves all below it: one flag a frame, of the joint that moved the uppermost point.
 */
import type { Flag } from '../flags.ts';
import type { TakeFrames } from '../frames.ts';
import { type Check, flagOf, largest, RecentPoints } from './check.ts';

/** Metres. */
const LEAST = 0.04;
const FRAME_SECONDS = 1 / 30;
/** Points that were displaced at all are asked for the joint that moved them; metres. */
const DISPLACED = 0.004;
/** Of the usual deviation. */
const TIMES_USUAL = 8;
const USUAL = 0.8;
/** Part of r that both lines are off by. */
const ALONG = 0.6;
const JUMP = 0.08;
const JUMP_RATIO = 5;
/** Frames between two spikes of one joint that count as one. */
const GAP = 4;

/** Of the histogram of deviations: 2^(k/2) micrometres. */
const BINS = 48;
const BINS_PER_DOUBLING = 2;

export class Spikes implements Check {
  private readonly recent: RecentPoints;
  /** Of each point, how often r was that long. */
  private readonly histogram: Uint32Array;
  private readonly r: Float64Array;
  /** Four numbers each: frame, point, size, whether it is a jump. */
  private readonly found: number[] = [];
  private count = 0;
  private readonly least: number;

  constructor(private readonly frames: TakeFrames) {
    // What acceleration does between two frames.
    this.least = LEAST * Math.max(1, frames.frameSeconds / FRAME_SECONDS) ** 2;
    this.recent = new RecentPoints(5, 3 * frames.pointCount);
    this.histogram = new Uint32Array(BINS * frames.pointCount);
    this.r = new Float64Array(frames.pointCount);
  }

  frame(frame: number, points: Float64Array): void {
    const { recent, frames, r, histogram, least } = this;
    recent.push(points);
    if (!recent.isFull) return;
    this.count++;
    const [x2, x1, x0, w1, w2] = [recent.ago(0), recent.ago(1), recent.ago(2), recent.ago(3), recent.ago(4)];
    let spike = -1;
    let jump = -1;
    let spikeSize = 0;
    let jumpSize = 0;
    for (let p = 0; p < frames.pointCount; p++) {
      const o = 3 * p;
      let rr = 0;
      let lr = 0;
      let er = 0;
      let far = 0;
      let before = 0;
      let after = 0;
      let later = 0;
      for (let k = o; k < o + 3; k++) {
        const d = x0[k] - (4 * (w1[k] + x1[k]) - w2[k] - x2[k]) / 6;
        rr += d * d;
        lr += d * (x0[k] - 2 * w1[k] + w2[k]);
        er += d * (x0[k] - 2 * x1[k] + x2[k]);
        far += (x0[k] - w1[k]) ** 2;
        before += (w1[k] - w2[k]) ** 2;
        after += (x1[k] - x0[k]) ** 2;
        later += (x2[k] - x1[k]) ** 2;
      }
      const size = Math.sqrt(rr);
      r[p] = size;
      histogram[BINS * p + binOf(size)]++;
      if (spike < 0 && size > least && lr > ALONG * rr && er > ALONG * rr) {
        spike = p;
        spikeSize = size;
      }
      const around = Math.sqrt(Math.max(before, after, later));
      const step = Math.sqrt(far);
      if (jump < 0 && step - around > JUMP && step > JUMP_RATIO * around) {
        jump = p;
        jumpSize = step - around;
      }
    }
    if (spike >= 0) this.found.push(frame - 2, this.moved(spike), spikeSize, 0);
    else if (jump >= 0) this.found.push(frame - 2, this.moved(jump), jumpSize, 1);
  }

  /** The uppermost point above one that was displaced too. */
  private moved(point: number): number {
    const { above } = this.frames;
    let top = point;
    while (above[top] >= 0 && this.r[above[top]] > DISPLACED) top = above[top];
    return top;
  }

  end(): readonly Flag[] {
    const { found, frames } = this;
    const flags: Flag[] = [];
    let last = -Infinity;
    let lastPoint = -1;
    for (let i = 0; i < found.length; i += 4) {
      const [frame, point, size, isJump] = found.slice(i, i + 4);
      if (isJump === 0 && size < TIMES_USUAL * this.usual(point)) continue;
      const isSame = frame - last <= GAP && point === lastPoint;
      last = frame;
      lastPoint = point;
      // The root's point is moved by the root, all others by the joint above.
      if (!isSame) flags.push(flagOf(frames, 'spike', frame, frame, size, Math.max(0, frames.above[point])));
    }
    return largest(flags);
  }

  /** The 80th percentile of a point's deviations, metres; the upper end of its bin. */
  private usual(point: number): number {
    // A spike shows in five frames, which are many of a short take.
    const part = Math.min(USUAL, Math.max(0.2, 1 - 6 / this.count));
    let below = 0;
    for (let b = 0; b < BINS; b++) {
      below += this.histogram[BINS * point + b];
      if (below >= part * this.count) return 1e-6 * 2 ** (b / BINS_PER_DOUBLING);
    }
    return Infinity;
  }
}

function binOf(metres: number): number {
  const bin = Math.ceil(BINS_PER_DOUBLING * Math.log2(metres * 1e6));
  return bin >= BINS ? BINS - 1 : bin > 0 ? bin : 0;
}
