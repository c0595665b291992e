/**
 * Foot sliding. A foot is flat on the ground while its tip (the ball, or the end of the toes) and its ankle are at most
 * 3 % of a leg's length above where they usually are on it, with the hips above it by half a leg's length; it swings
 * with its heel higher, and comes down with its toes higher. It slides if tip and ankle both move 15 cm over the ground
 * meanwhile: turning on its heel or its ball, a foot moves one of them. Creeping by 10 cm a second is no slide. A foot
 * of which only the ankle is known is not judged: that moves as far when it turns on its ball.
 */
import type { Flag } from '../flags.ts';
import type { TakeFrames } from '../frames.ts';
import type { Foot, Survey } from '../survey.ts';
import { type Check, flagOf, largest, Span } from './check.ts';

/** Of a leg's length. */
const FLAT = 0.03;
const UPRIGHT = 0.5;
/** Metres over the ground; metres a second. */
const WAY = 0.15;
const CREEPING = 0.1;

interface FlatFoot {
  readonly foot: Foot;
  readonly span: Span;
  /** Where it was, as far as creeping doesn't explain the way since: x z of tip and ankle. */
  readonly from: Float64Array;
  /** The last frame at which it wasn't moving yet. */
  since: number;
  amount: number;
}

/** Metres; less is noise of a foot at rest. */
const NOISE = 0.01;

export class FootSliding implements Check {
  private readonly feet: readonly FlatFoot[];
  private readonly flags: Flag[] = [];
  private readonly creep: number;

  constructor(
    private readonly frames: TakeFrames,
    private readonly survey: Survey,
  ) {
    const judged = survey.feet.filter(({ tip }) => tip >= 0);
    this.feet = judged.map((foot) => ({ foot, span: new Span(1), from: new Float64Array(4), since: 0, amount: 0 }));
    this.creep = CREEPING * frames.frameSeconds;
  }

  frame(frame: number, points: Float64Array): void {
    const { survey } = this;
    const low = FLAT * survey.leg;
    for (const flat of this.feet) {
      const { foot, span, from } = flat;
      const tip = 3 * foot.tip;
      const ankle = 3 * foot.ankle;
      const isFlat =
        points[tip + 1] < foot.tipLevel + low &&
        points[ankle + 1] < foot.ankleLevel + low &&
        points[3 * survey.hips + 1] - points[ankle + 1] > UPRIGHT * survey.leg;
      if (!isFlat) {
        if (span.isOver(frame)) this.close(flat);
        continue;
      }
      if (!span.isOpen) {
        from[0] = points[tip];
        from[1] = points[tip + 2];
        from[2] = points[ankle];
        from[3] = points[ankle + 2];
        flat.since = frame;
        flat.amount = 0;
      }
      span.add(frame, 0);
      const way = Math.min(
        follow(from, 0, points[tip], points[tip + 2], this.creep),
        follow(from, 2, points[ankle], points[ankle + 2], this.creep),
      );
      if (way < NOISE && flat.amount < WAY) flat.since = frame;
      flat.amount = Math.max(flat.amount, way);
    }
  }

  private close({ foot, span, since, amount }: FlatFoot): void {
    const joint = foot.tip < this.frames.skeleton.joints.length ? foot.tip : foot.ankle;
    if (span.isOpen && amount > WAY) this.flags.push(flagOf(this.frames, 'slide', since, span.end, amount, joint));
    span.clear();
  }

  end(): readonly Flag[] {
    for (const flat of this.feet) this.close(flat);
    return largest(this.flags);
  }
}

/** Moves a point on the ground, x z at `o`, towards another by up to a length; how far it still was before. */
function follow(from: Float64Array, o: number, x: number, z: number, most: number): number {
  const dx = x - from[o];
  const dz = z - from[o + 1];
  const way = Math.hypot(dx, dz);
  const part = way > most ? most / way : 1;
  from[o] += part * dx;
  from[o + 1] += part * dz;
  return way;
}
