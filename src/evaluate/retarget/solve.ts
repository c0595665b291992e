/** A pose of the target from rotations alone: steps 1 to 4 of `retarget-pose.ts`. */
import { backMultiply3, multiply3, writeRotationPart } from '../../math/mat3.ts';
import { multiplyAffine } from '../../math/mat4.ts';
import { worldMatrices } from '../kinematics.ts';
import { fitJoint } from './fit.ts';
import { rollLimb } from './limbs.ts';
import type { RetargetPlan } from './plan.ts';
import { sourcePose } from './source-pose.ts';
import { fromScene, inProportion, moveBy, toScene } from './travel.ts';

/** Scratch; never escapes. */
const own = new Float64Array(9);
const turned = new Float64Array(9);
const parentTurn = new Float64Array(9);
const local = new Float64Array(16);
const point = new Float64Array(3);
const middle = new Float64Array(3);

/**
 * Writes the target's paired DOFs from rotations alone. Allocates nothing.
 * @param clipSeconds of the source's clip
 */
export function solveFreely(plan: RetargetPlan, clipSeconds: number, out: Float64Array): void {
  sourcePose(plan.played, clipSeconds, plan.dofs);
  worldMatrices(plan.source, plan.dofs, plan.sourceWorld);
  const { wanted, limbs, bones, target } = plan;
  wantRotations(plan);
  for (let i = 0; i < limbs.length; i++) rollLimb(limbs[i], bones, wanted);
  const { travel } = target;
  if (plan.ground.carried.length > 0) for (let k = 0; k < 3; k++) if (travel[k] >= 0) out[travel[k]] = 0;
  fitRange(plan, 0, target.jointCount, out);
  carry(plan, out);
}

function wantRotations(plan: RetargetPlan): void {
  const { sourceOf, across, corrections, sourceWorld, wanted } = plan;
  for (let j = 0; j < sourceOf.length; j++) {
    const s = sourceOf[j];
    if (s < 0) continue;
    writeRotationPart(sourceWorld, 16 * s, own, 0, 3);
    multiply3(across, 0, own, 0, turned, 0);
    multiply3(turned, 0, corrections, 9 * j, wanted, 9 * j);
  }
}

/** Fits joints `from` up to (excluding) `to`; those above must be final. */
export function fitRange(plan: RetargetPlan, from: number, to: number, out: Float64Array): void {
  const { target, fits, wanted, bones, targetWorld } = plan;
  const { parent, motions, firstDof, offsets } = target;
  for (let j = from; j < to; j++) {
    const above = parent[j];
    const fit = fits[j];
    if (fit) {
      if (above >= 0) {
        writeRotationPart(targetWorld, 16 * above, parentTurn, 0, 3);
        backMultiply3(parentTurn, 0, wanted, 9 * j, own, 0);
      } else for (let k = 0; k < 9; k++) own[k] = wanted[9 * j + k];
      fitJoint(target, j, fit, own, bones, 3 * j, out);
    }
    motions[j].write(out, firstDof[j], local, 0);
    for (let k = 0; k < 3; k++) local[12 + k] += offsets[3 * j + k];
    if (above >= 0) multiplyAffine(targetWorld, 16 * above, local, 0, targetWorld, 16 * j);
    else {
      if (target.hasRootTranslation) for (let k = 0; k < 3; k++) local[12 + k] += out[k];
      for (let k = 0; k < 16; k++) targetWorld[16 * j + k] = local[k];
    }
  }
}

/** Moves the target so that the centre of `carried` is where it belongs. */
function carry(plan: RetargetPlan, out: Float64Array): void {
  const { ground, sourceOf, targetWorld } = plan;
  const { carried } = ground;
  if (carried.length === 0) return;
  middle.fill(0);
  point.fill(0);
  for (let i = 0; i < carried.length; i++) {
    const o = 16 * sourceOf[carried[i]] + 12;
    for (let k = 0; k < 3; k++) {
      middle[k] += plan.sourceWorld[o + k] / carried.length;
      point[k] += targetWorld[16 * carried[i] + 12 + k] / carried.length;
    }
  }
  toScene(plan.sourceSpace, middle);
  inProportion(plan, middle, ground.ownHeight, ground.sourceHeight);
  fromScene(plan.targetSpace, middle);
  moveBy(plan, middle[0] - point[0], middle[1] - point[1], middle[2] - point[2], out);
}
