/** Floor penetration: a joint or an End Site is more than 5 cm below the ground for a tenth of a second. */
import type { Flag } from '../flags.ts';
import type { TakeFrames } from '../frames.ts';
import { type Check, flagOf, largest, Span } from './check.ts';

/** Metres. */
const DEPTH = 0.05;
const SHORTEST = 0.1;

export class Floor implements Check {
  private readonly span = new Span(2);
  private deepest = 0;
  private point = 0;
  private readonly flags: Flag[] = [];

  constructor(private readonly frames: TakeFrames) {}

  frame(frame: number, points: Float64Array): void {
    let low = -DEPTH;
    let point = -1;
    for (let p = 0; p < this.frames.pointCount; p++) {
      if (points[3 * p + 1] >= low) continue;
      low = points[3 * p + 1];
      point = p;
    }
    if (point >= 0) {
      if (!this.span.isOpen) this.deepest = 0;
      if (-low > this.deepest) {
        this.deepest = -low;
        this.point = point;
      }
      this.span.add(frame, -low);
    } else if (this.span.isOver(frame)) this.close();
  }

  private close(): void {
    const { frames, span, point } = this;
    if (span.length * frames.frameSeconds >= SHORTEST) {
      const joint = point < frames.skeleton.joints.length ? point : frames.above[point];
      this.flags.push(flagOf(frames, 'floor', span.start, span.end, span.amount, joint));
    }
    span.clear();
  }

  end(): readonly Flag[] {
    this.close();
    return largest(this.flags);
  }
}
