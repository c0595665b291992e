/** Makes a plan (`plan.ts`) for each driver. */
import { backMultiply3 } from '../../math/mat3.ts';
import type { Character, Driver, Space } from '../../model/document.ts';
import { filePose } from '../../model/dofs.ts';
import type { JointPair } from '../../model/retarget.ts';
import type { Skeleton } from '../../model/skeleton.ts';
import { compileSkeleton } from '../kinematics.ts';
import { metresPerUnit } from '../metres.ts';
import { alignment, type Bodies, bodiesOf, bodyFrame, driven } from './align.ts';
import { footTracks } from './contacts.ts';
import { upRotation } from './figure.ts';
import { jointFit } from './fit.ts';
import { automaticScale } from './leg-length.ts';
import { type Limb, limbsOf } from './limbs.ts';
import type { RetargetPlan, SpaceRule } from './plan.ts';
import { referenceFigure } from './reference.ts';
import { LIMB_SIDES } from './roles.ts';
import { playedSource } from './source-pose.ts';

/** By the driver's pairs, whose identity is kept when the source changes (`edit/drivers.ts`). */
const plans = new WeakMap<
  readonly JointPair[],
  { driver: Driver; skeleton: Skeleton; space: Space | undefined; clamps: boolean; plan: RetargetPlan }
>();

/**
 * Cached per driver, and made again when its inputs change. The source's name and time offset don't matter, so dragging
 * the source along the timeline keeps the plan.
 */
export function retargetPlan(driver: Driver, character: Character, skeleton: Skeleton): RetargetPlan {
  const { space, clampsToLimits } = character;
  const known = plans.get(driver.pairs);
  if (
    known &&
    known.skeleton === skeleton &&
    known.space === space &&
    known.clamps === clampsToLimits &&
    (known.driver === driver || plansAlike(known.driver, driver))
  ) {
    return known.plan;
  }
  const plan = planRetarget(driver, skeleton, space, clampsToLimits);
  plans.set(driver.pairs, { driver, skeleton, space, clamps: clampsToLimits, plan });
  return plan;
}

/** Compares drivers with the same pairs. */
function plansAlike({ options, source: a }: Driver, { options: otherOptions, source: b }: Driver): boolean {
  return (
    options === otherOptions &&
    a.skeleton === b.skeleton &&
    a.clip === b.clip &&
    a.pose === b.pose &&
    a.clampsToLimits === b.clampsToLimits &&
    a.space === b.space
  );
}

export function planRetarget(
  driver: Driver,
  skeleton: Skeleton,
  space: Space | undefined,
  clamps: boolean,
): RetargetPlan {
  const { source, options, pairs } = driver;
  const target = compileSkeleton(skeleton);
  const played = playedSource(source);
  const bodies = bodiesOf(source.skeleton, source.space, skeleton, space, pairs);
  const { range } = source.clip;
  const reference = referenceFigure(bodies, played, range, options.reference);
  const sourceSpace = ruleOf(source.space);
  const targetSpace = ruleOf(space);
  const across = new Float64Array(9);
  backMultiply3(targetSpace.up, 0, sourceSpace.up, 0, across, 0);
  const compiledSource = compileSkeleton(source.skeleton);
  const scale = options.scale ?? automaticScale(bodies, reference);
  const restDofs = Float64Array.from(filePose(skeleton, 0));
  const limbs = limbsOf(bodies, target, restDofs, clamps);
  const plain: RetargetPlan = {
    source: compiledSource,
    target,
    played,
    range,
    sourceOf: bodies.sourceOf,
    across,
    corrections: alignment(bodies, reference),
    fits: skeleton.joints.map((joint, j) => (bodies.sourceOf[j] >= 0 ? jointFit(target, joint, j, clamps) : undefined)),
    bones: bonesOf(bodies, limbs),
    fronts: frontsOf(bodies),
    limbs,
    restDofs,
    scale,
    ground: { carried: carriedJoints(bodies), ownHeight: 0, sourceHeight: 0 },
    plantsFeet: options.plantsFeet,
    feet: [],
    sourceSpace,
    targetSpace,
    dofs: new Float64Array(played.dofCount),
    sourceWorld: new Float64Array(16 * compiledSource.jointCount),
    targetWorld: new Float64Array(16 * target.jointCount),
    wanted: new Float64Array(9 * target.jointCount),
  };
  return footTracks(plain, bodies, reference);
}

function ruleOf(space: Space | undefined): SpaceRule {
  return { up: upRotation(space), metres: space ? metresPerUnit(space) : 1, lift: space?.lift ?? 0 };
}

function carriedJoints(bodies: Bodies): number[] {
  const thighs = LIMB_SIDES.map((side) => driven(bodies, `${side} thigh`)).filter((j) => j >= 0);
  if (thighs.length === 2) return thighs;
  const hips = driven(bodies, 'hips');
  if (hips >= 0) return [hips];
  return bodies.sourceOf[0] >= 0 ? [0] : [];
}

/** In each joint's own space at the file pose; constant for joints that only rotate. */
function bonesOf({ rest, target }: Bodies, limbs: readonly Limb[]): Float64Array {
  const out = new Float64Array(3 * target.joints.length);
  for (const { upper, lower, end } of limbs) {
    for (const [j, to] of [
      [upper, lower],
      [lower, end],
    ]) {
      const way = Float64Array.from([0, 1, 2], (k) => rest.points[3 * to + k] - rest.points[3 * j + k]);
      const length = Math.hypot(...way);
      if (!(length > 0)) continue;
      for (let k = 0; k < 3; k++) {
        const o = 9 * j + 3 * k;
        const along = rest.rotations[o] * way[0] + rest.rotations[o + 1] * way[1] + rest.rotations[o + 2] * way[2];
        out[3 * j + k] = along / length;
      }
    }
  }
  return out;
}

/** z of the body's frame at rest. */
function frontsOf(bodies: Bodies): Float64Array {
  const frame = bodyFrame(bodies.rest, bodies, (t) => t);
  const { rotations: r } = bodies.rest;
  const out = new Float64Array(r.length / 3);
  // Transposed: from the scene's axes to the joint's own.
  for (let i = 0; i < out.length; i++) {
    out[i] = r[3 * i] * frame[6] + r[3 * i + 1] * frame[7] + r[3 * i + 2] * frame[8];
  }
  return out;
}
