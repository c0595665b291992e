/**
 * Feet and hands that point for half a second where those of people can't, as after a retarget whose reference poses
 * don't match:
 *
 *     toes against the shin      the foot at an angle of less than 40° to it; squatting feet come to 60°
 *     toes to the back           more than 30° behind the shin, by the bend of the knee or the hips; pointed toes are 0°
 *     toes up from the floor     more than 35° above the ankle of a foot that stands; heels strike for a moment
 *     a hand against the forearm more than 120° from being in line with it; wrists bend by 90°
 *
 * The amount is the angle beyond that.
 */
import type { Flag } from '../flags.ts';
import type { TakeFrames } from '../frames.ts';
import type { Foot, Hand, Survey } from '../survey.ts';
import { type Check, flagOf, largest, Span } from './check.ts';

const DEGREE = Math.PI / 180;
const UP_THE_SHIN = 40 * DEGREE;
const BACK = 30 * DEGREE;
const OFF_THE_FLOOR = 35 * DEGREE;
const WRIST = 120 * DEGREE;
const SHORTEST = 0.5;
/** Seconds within which it may be less. */
const GAP = 0.05;
/** A foot that stands: its ankle is at most this much above where it usually is then, of a leg's length. */
const LOW = 0.05;
/** And the shin within 45° of upright. */
const STEEP = Math.SQRT1_2;
/** Sine of the angle from which on the bend of a knee tells where its front is, rather than the hips. */
const BENT = 0.4;
/** Sine: a straight leg out to the side doesn't tell where its front is. */
const ASIDE = 0.5;

interface Watched {
  readonly joint: number;
  readonly span: Span;
  /** Radians beyond what is possible; at most 0 if it isn't. */
  beyond(points: Float64Array): number;
}

export class Turned implements Check {
  private readonly watched: readonly Watched[];
  private readonly flags: Flag[] = [];

  constructor(
    private readonly frames: TakeFrames,
    survey: Survey,
  ) {
    const gap = Math.max(1, Math.round(GAP / frames.frameSeconds));
    const { feet, hands } = survey;
    this.watched = [
      ...feet.flatMap((foot): Watched[] => {
        if (foot.tip < 0) return [];
        return [{ joint: foot.ankle, span: new Span(gap), beyond: (points) => footBeyond(points, foot, survey) }];
      }),
      ...hands.map((hand) => ({
        joint: hand.wrist,
        span: new Span(gap),
        beyond: (points: Float64Array) => handBeyond(points, hand),
      })),
    ];
  }

  frame(frame: number, points: Float64Array): void {
    for (const each of this.watched) {
      const beyond = each.beyond(points);
      if (beyond > 0) each.span.add(frame, beyond);
      else if (each.span.isOver(frame)) this.close(each);
    }
  }

  private close({ joint, span }: Watched): void {
    const { frames } = this;
    // A take of a frame or two is turned as a whole.
    const least = Math.min(SHORTEST, (frames.count - 1) * frames.frameSeconds);
    if (span.isOpen && (span.length - 1) * frames.frameSeconds >= least - 1e-9) {
      this.flags.push(flagOf(frames, 'turned', span.start, span.end, span.amount, joint));
    }
    span.clear();
  }

  end(): readonly Flag[] {
    for (const each of this.watched) this.close(each);
    return largest(this.flags);
  }
}

/** Scratch; never escapes: unit vectors. */
const shin = new Float64Array(3);
const way = new Float64Array(3);
const across = new Float64Array(3);
const upper = new Float64Array(3);
const lower = new Float64Array(3);

function footBeyond(points: Float64Array, foot: Foot, { feet, leg }: Survey): number {
  towards(points, foot.ankle, foot.shin, shin);
  towards(points, foot.ankle, foot.tip, way);
  let most = UP_THE_SHIN - Math.acos(Math.min(1, Math.max(-1, dot(shin, way))));
  const stands = shin[1] > STEEP && points[3 * foot.ankle + 1] < foot.ankleLevel + LOW * leg;
  if (stands) most = Math.max(most, Math.asin(Math.min(1, way[1])) - OFF_THE_FLOOR);
  if (!axisOf(points, foot, feet)) return most;
  // To the front of the leg: perpendicular to the axis and to the shin.
  const x = across[1] * shin[2] - across[2] * shin[1];
  const y = across[2] * shin[0] - across[0] * shin[2];
  const z = across[0] * shin[1] - across[1] * shin[0];
  const length = Math.sqrt(x * x + y * y + z * z);
  if (length < ASIDE) return most;
  const back = -(x * way[0] + y * way[1] + z * way[2]) / length;
  return Math.max(most, Math.asin(Math.min(1, Math.max(-1, back))) - BACK);
}

/** To `across`: the axis of a bent knee, else the line of the hip joints, from right to left. False without either. */
function axisOf(points: Float64Array, { thigh, shin: knee, ankle }: Foot, feet: Survey['feet']): boolean {
  towards(points, thigh, knee, upper);
  towards(points, knee, ankle, lower);
  across[0] = upper[1] * lower[2] - upper[2] * lower[1];
  across[1] = upper[2] * lower[0] - upper[0] * lower[2];
  across[2] = upper[0] * lower[1] - upper[1] * lower[0];
  const sine = Math.sqrt(dot(across, across));
  if (sine > BENT) for (let k = 0; k < 3; k++) across[k] /= sine;
  else if (feet.length === 2) towards(points, feet[1].thigh, feet[0].thigh, across);
  else return false;
  return true;
}

function handBeyond(points: Float64Array, { elbow, wrist, tip }: Hand): number {
  towards(points, elbow, wrist, shin);
  towards(points, wrist, tip, way);
  return Math.acos(Math.min(1, Math.max(-1, dot(shin, way)))) - WRIST;
}

function towards(points: Float64Array, from: number, to: number, out: Float64Array): void {
  for (let k = 0; k < 3; k++) out[k] = points[3 * to + k] - points[3 * from + k];
  const length = Math.sqrt(dot(out, out)) || 1;
  for (let k = 0; k < 3; k++) out[k] /= length;
}

function dot(a: Float64Array, b: Float64Array): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
