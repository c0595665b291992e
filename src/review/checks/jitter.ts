/**
 * Jitter: a point's deviation r (see `deviations.ts`) is longer than 5 mm and turns
 * about from frame to frame, for a quarter of a second and ten frames at least. Movement, however fast, deviates to one
 * side for several frames; a spike does so for five frames only. One flag for all joints that tremble at a time, named
 * after the one that does most.
 */
import type { Flag } from '../flags.ts';
import type { TakeFrames } from '../frames.ts';
import { type Check, flagOf, largest, Span } from './check.ts';
import type { Deviations } from './deviations.ts';

/** Metres. */
const LEAST = 0.005;
const SHORTEST_SECONDS = 0.25;
const SHORTEST_FRAMES = 10;
/** Frames of a span in which r may be shorter or not turn about. */
const GAP = 1;

export class Jitter implements Check {
  private readonly spans: readonly Span[];
  private readonly flags: Flag[] = [];
  private readonly shortest: number;

  /** @param deviations of the same frames, each pushed before */
  constructor(
    private readonly frames: TakeFrames,
    private readonly deviations: Deviations,
  ) {
    this.spans = Array.from({ length: frames.pointCount }, () => new Span(GAP));
    this.shortest = Math.max(SHORTEST_FRAMES, SHORTEST_SECONDS / frames.frameSeconds);
  }

  frame(frame: number): void {
    const { deviations, spans } = this;
    if (!deviations.isFull) return;
    const { squares, squaresBefore, products } = deviations;
    for (let p = 0; p < spans.length; p++) {
      const span = spans[p];
      if (products[p] < 0 && squares[p] > LEAST * LEAST && squaresBefore[p] > LEAST * LEAST) {
        span.add(frame - 2, Math.sqrt(squares[p]));
      }
      if (span.isOver(frame - 2)) this.close(p);
    }
  }

  private close(point: number): void {
    const span = this.spans[point];
    const { frames } = this;
    if (span.length >= this.shortest) {
      const joint = point < frames.skeleton.joints.length ? point : frames.above[point];
      this.flags.push(flagOf(frames, 'jitter', span.start, span.end, span.amount, joint));
    }
    span.clear();
  }

  end(): readonly Flag[] {
    for (let p = 0; p < this.spans.length; p++) this.close(p);
    return largest(together(this.flags));
  }
}

/** Flags that overlap in time as one. */
function together(flags: readonly Flag[]): Flag[] {
  const out: Flag[] = [];
  for (const flag of [...flags].sort((a, b) => a.from - b.from)) {
    const last = out.at(-1);
    if (!last || flag.from > last.to) out.push(flag);
    else
      out[out.length - 1] = {
        ...(flag.amount > last.amount ? flag : last),
        from: last.from,
        to: Math.max(last.to, flag.to),
      };
  }
  return out;
}
