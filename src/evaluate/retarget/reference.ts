/**
 * Chooses the poses in which the two skeletons are compared.
 *
 * A standing file pose (T, A, arms down) tells best how joints are meant to be rotated. Some files have none: in LAFAN1
 * all bones are along x. Then a frame of the character's own take is used. For the target it is the most upright one,
 * if the target has a take; for the source, the one that looks most like the target: the one with the smallest sum of
 * angles between their bones. Such a frame may be one of a step, so its feet are turned flat (`feet.ts`).
 *
 * Skeletons with the same bones are compared in their file poses, whatever these are and whatever was chosen: they
 * match joint by joint.
 */
import { turnVector } from '../../math/mat3.ts';
import type { RetargetOptions } from '../../model/takes/retarget.ts';
import { aims, type Bodies, bodyFrame, bodyTurn, driven, type Reference, sourceBody } from './align.ts';
import { type RetargetBody, retargetBody } from './body.ts';
import { type Foot, looksFlat, withFlatFeet } from './feet.ts';
import { LIMB_SIDES, type Role } from './roles.ts';
import { type PlayedSource, sourcePose } from './source-pose.ts';

/** Number of times examined, evenly over the take. */
const MAX_MOMENTS = 64;
/** Within 45° of upright. */
const STANDS = Math.SQRT1_2;

/** A take with its range in seconds. */
export interface PlayedTake {
  readonly played: PlayedSource;
  readonly range: readonly [number, number];
}

/**
 * The target's pose to compare: its file pose if it is a standing one, else the most upright frame of its take.
 * @param take its own
 */
export function ownReference(bodies: Bodies, take: PlayedTake | undefined): Reference {
  const { target, targetSpace, rest } = bodies;
  const at = (t: number) => t;
  const isStanding = stands(bodies, rest, at);
  const sampled = new SampledBodies(take, (dofs) => retargetBody(target, targetSpace, dofs));
  const body = isStanding ? rest : sampled.closest(rest, (each) => slant(bodies, each, at));
  const feet = bodies.feet.map(({ own }) => own);
  return onSoles(body, isStanding, feet, sampled);
}

/** The source's pose that matches the one of `bodies.rest`. */
export function sourceReference(bodies: Bodies, take: PlayedTake, reference: RetargetOptions['reference']): Reference {
  if (typeof reference === 'number') {
    const dofs = new Float64Array(take.played.dofCount);
    sourcePose(take.played, reference, dofs);
    return { ...sourceBody(bodies, dofs), soles: true };
  }
  const rest = sourceBody(bodies);
  if (reference === 'rest') return { ...rest, soles: true };
  const isStanding = stands(bodies, rest, (t) => bodies.sourceOf[t]);
  const sampled = new SampledBodies(take, (dofs) => sourceBody(bodies, dofs));
  const body = isStanding ? rest : sampled.closest(rest, (each) => unlikeness(bodies, each));
  const feet = bodies.feet.map(({ source }) => source);
  return onSoles(body, isStanding, feet, sampled);
}

/** Whether the target's own take is asked how it stands. */
export function asksTake(bodies: Bodies): boolean {
  const { rest, feet } = bodies;
  return !stands(bodies, rest, (t) => t) || !feet.every(({ own }) => looksFlat(rest, own));
}

/**
 * A pose with flat soles. Those of a standing file pose are, unless its feet are level with their ankles, as in files
 * whose bones are along axes, or hang; then the take is asked, as for poses of a take.
 */
function onSoles(body: RetargetBody, isStanding: boolean, feet: readonly Foot[], sampled: SampledBodies): Reference {
  if (isStanding && feet.every((foot) => looksFlat(body, foot))) return { ...body, soles: true };
  const flat = withFlatFeet(body, sampled.all, feet);
  return flat ? { ...flat, soles: true } : { ...body, soles: isStanding };
}

/** A skeleton at times of a take, evenly over it. */
class SampledBodies {
  private made: readonly RetargetBody[] | undefined;

  constructor(
    private readonly take: PlayedTake | undefined,
    private readonly bodyAt: (dofs: Float64Array) => RetargetBody,
  ) {}

  /** None without a take. */
  get all(): readonly RetargetBody[] {
    this.made ??= this.take ? this.make(this.take) : [];
    return this.made;
  }

  private make({ played, range: [start, end] }: PlayedTake): readonly RetargetBody[] {
    const dofs = new Float64Array(played.dofCount);
    return Array.from({ length: end > start ? MAX_MOMENTS : 1 }, (_, i) => {
      sourcePose(played, start + ((end - start) * i) / (MAX_MOMENTS - 1), dofs);
      return this.bodyAt(dofs);
    });
  }

  /** The one with the least of something; `otherwise` without a take, or if none has any. */
  closest(otherwise: RetargetBody, measure: (body: RetargetBody) => number): RetargetBody {
    let best = otherwise;
    let least = Infinity;
    for (const body of this.all) {
      const off = measure(body);
      if (off >= least) continue;
      least = off;
      best = body;
    }
    return best;
  }
}

/** Whether legs point down and the trunk up, with distinct left and right. Bodies without legs are accepted. */
export function stands(bodies: Bodies, { points }: RetargetBody, jointAt: (target: number) => number): boolean {
  const at = (role: Role) => {
    const joint = driven(bodies, role);
    return joint < 0 ? undefined : jointAt(joint);
  };
  const isSteep = (low: number, high: number) => {
    const d = [0, 1, 2].map((k) => points[3 * high + k] - points[3 * low + k]);
    return d[1] > STANDS * Math.hypot(...d);
  };
  const legs = LIMB_SIDES.map((side) => [at(`${side} foot`), at(`${side} thigh`)] as const);
  for (const [foot, thigh] of legs) {
    if (foot !== undefined && thigh !== undefined && !isSteep(foot, thigh)) return false;
  }
  const [left, right] = legs.map(([, thigh]) => thigh);
  if (
    left !== undefined &&
    right !== undefined &&
    !(
      Math.abs(points[3 * left + 1] - points[3 * right + 1]) <
      0.5 * Math.hypot(points[3 * left] - points[3 * right], points[3 * left + 2] - points[3 * right + 2])
    )
  )
    return false;
  const hips = at('hips');
  const head = at('head');
  return hips === undefined || head === undefined || isSteep(hips, head);
}

/** Sum of the angles of thighs, shins and trunk to the vertical. */
function slant(bodies: Bodies, body: RetargetBody, at: (target: number) => number): number {
  const { points } = body;
  let sum = 0;
  for (const { joint, to, role } of aims(bodies)) {
    if (!/thigh|shin/.test(role)) continue;
    const d = [0, 1, 2].map((k) => points[3 * at(joint) + k] - points[3 * at(to) + k]);
    sum += Math.acos(Math.min(1, Math.max(-1, d[1] / (Math.hypot(...d) || 1))));
  }
  return sum + 4 * Math.acos(Math.min(1, Math.max(-1, bodyFrame(body, bodies, at)[4])));
}

/** Sum of the angles between the target's bones at rest, turned to face like the character, and the character's. */
function unlikeness(bodies: Bodies, body: RetargetBody): number {
  const turn = bodyTurn(bodies, body);
  const own = new Float64Array(3);
  let sum = 0;
  for (const { joint, to } of aims(bodies)) {
    const [s, e] = [bodies.sourceOf[joint], bodies.sourceOf[to]];
    for (let k = 0; k < 3; k++) own[k] = bodies.rest.points[3 * to + k] - bodies.rest.points[3 * joint + k];
    turnVector(turn, 0, own, 0, own, 0);
    let dot = 0;
    let square = 0;
    for (let k = 0; k < 3; k++) {
      const other = body.points[3 * e + k] - body.points[3 * s + k];
      dot += own[k] * other;
      square += other * other;
    }
    const length = Math.hypot(...own) * Math.sqrt(square);
    if (length > 0) sum += Math.acos(Math.min(1, Math.max(-1, dot / length)));
  }
  // A character that lies or bows is not at rest, however its limbs are.
  const tilt = Math.acos(Math.min(1, Math.max(-1, turn[4])));
  return sum + 4 * tilt;
}
