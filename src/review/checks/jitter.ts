/**
 * Jitter: a point's deviation r from the cubic through its neighbours (see `spikes.ts`) is longer than 5 mm and turns
 * about from frame to frame, for a quarter of a second and ten frames at least. Movement, however fast, deviates to one
 * side for several frames; a spike does so for five frames only. One flag for all joints that tremble at a time, named
 * after the one that does most.
 */
import type { Flag } from '../flags.ts';
import type { TakeFrames } from '../frames.ts';
import { type Check, flagOf, largest, RecentPoints, Span } from './check.ts';

/** Metres. */
const LEAST = 0.005;
const SHORTEST_SECONDS = 0.25;
const SHORTEST_FRAMES = 10;
/** Frames of a span in which r may be shorter or not turn about. */
const GAP = 1;

export class Jitter implements Check {
  private readonly recent: RecentPoints;
  private readonly r: Float64Array;
  private readonly spans: readonly Span[];
  private readonly flags: Flag[] = [];
  private readonly shortest: number;

  constructor(private readonly frames: TakeFrames) {
    this.recent = new RecentPoints(5, 3 * frames.pointCount);
    this.r = new Float64Array(3 * frames.pointCount);
    this.spans = Array.from({ length: frames.pointCount }, () => new Span(GAP));
    this.shortest = Math.max(SHORTEST_FRAMES, SHORTEST_SECONDS / frames.frameSeconds);
  }

  frame(frame: number, points: Float64Array): void {
    const { recent, r, spans } = this;
    recent.push(points);
    if (!recent.isFull) return;
    const [x2, x1, x0, w1, w2] = [recent.ago(0), recent.ago(1), recent.ago(2), recent.ago(3), recent.ago(4)];
    for (let p = 0; p < spans.length; p++) {
      let rr = 0;
      let turned = 0;
      let was = 0;
      for (let k = 3 * p; k < 3 * p + 3; k++) {
        const d = x0[k] - (4 * (w1[k] + x1[k]) - w2[k] - x2[k]) / 6;
        rr += d * d;
        turned += d * r[k];
        was += r[k] * r[k];
        r[k] = d;
      }
      const span = spans[p];
      if (turned < 0 && rr > LEAST * LEAST && was > LEAST * LEAST) span.add(frame - 2, Math.sqrt(rr));
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
