/**
 * Spikes and jumps. With r of `deviations.ts`, and around frame c
 *
 *     l = x(c) − 2x(c−1) + x(c−2)     e = x(c) − 2x(c+1) + x(c+2)      by the lines on either side
 *
 * a point is a spike if r is longer than 4 cm (the more the fewer than 30 frames a second), longer than eight times the
 * point's usual r (its 80th percentile), and both l and e go along r for most of its length: at the sharp turn of a
 * punch they don't. It is a jump if a point moves 8 cm further in one frame than in those around it, and five times as
 * far.
 *
 * What moves a joint moves all below it: one flag a frame, of the joint that moved the uppermost point.
 */
import type { Flag } from '../flags.ts';
import type { TakeFrames } from '../frames.ts';
import { type Check, flagOf, largest } from './check.ts';
import type { Deviations } from './deviations.ts';

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
/** Digits are counted 32 at a time. */
const WORD = 2 ** 32;
const MOST = 2 ** (BINS - 1);

export class Spikes implements Check {
  /** Of each point, how often r was that long. */
  private readonly histogram: Uint32Array;
  /** Four numbers each: frame, point, size, whether it is a jump. */
  private readonly found: number[] = [];
  private count = 0;
  private readonly least: number;

  /** @param deviations of the same frames, each pushed before */
  constructor(
    private readonly frames: TakeFrames,
    private readonly deviations: Deviations,
  ) {
    // What acceleration does between two frames.
    this.least = LEAST * Math.max(1, frames.frameSeconds / FRAME_SECONDS) ** 2;
    this.histogram = new Uint32Array(BINS * frames.pointCount);
  }

  frame(frame: number): void {
    const { deviations, histogram, least } = this;
    if (!deviations.isFull) return;
    this.count++;
    const { squares } = deviations;
    const later = deviations.waysAgo(0);
    const after = deviations.waysAgo(1);
    const far = deviations.waysAgo(2);
    const before = deviations.waysAgo(3);
    let spike = -1;
    let jump = -1;
    let jumpSize = 0;
    for (let p = 0; p < squares.length; p++) {
      const square = squares[p];
      histogram[BINS * p + binOf(square)]++;
      if (spike < 0 && square > least * least && this.goesAlong(p)) spike = p;
      if (jump >= 0 || !(far[p] > JUMP * JUMP)) continue;
      const around = Math.sqrt(Math.max(before[p], after[p], later[p]));
      const step = Math.sqrt(far[p]);
      if (step - around > JUMP && step > JUMP_RATIO * around) {
        jump = p;
        jumpSize = step - around;
      }
    }
    if (spike >= 0) this.found.push(frame - 2, this.moved(spike), Math.sqrt(squares[spike]), 0);
    else if (jump >= 0) this.found.push(frame - 2, this.moved(jump), jumpSize, 1);
  }

  private goesAlong(point: number): boolean {
    const { deviations } = this;
    const most = ALONG * deviations.squares[point];
    return deviations.alongLine(point, -1) > most && deviations.alongLine(point, 1) > most;
  }

  /** The uppermost point above one that was displaced too. */
  private moved(point: number): number {
    const { above } = this.frames;
    const { squares } = this.deviations;
    let top = point;
    while (above[top] >= 0 && squares[above[top]] > DISPLACED * DISPLACED) top = above[top];
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

/** The bin of a deviation: ⌈2 log₂⌉ of its micrometres, which is ⌈log₂⌉ of their square, counted in binary digits. */
function binOf(square: number): number {
  const micrometres = square * 1e12;
  if (!(micrometres > 1)) return 0;
  if (micrometres <= WORD) return 32 - Math.clz32(Math.ceil(micrometres) - 1);
  return micrometres > MOST ? BINS - 1 : 64 - Math.clz32(Math.ceil(micrometres / WORD) - 1);
}
