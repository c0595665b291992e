/** A pose of the target from rotations alone: steps 1 to 4 of `retarget-pose.ts`. */
import { backMultiply3, multiply3, turnVector, writeRotationPart } from '../../math/mat3.ts';
import { multiplyAffine } from '../../math/mat4.ts';
import { worldMatrices } from '../kinematics.ts';
import { fitJoint } from './fit.ts';
import { rollLimb } from './limbs.ts';
import type { RetargetPlan, Slide } from './plan.ts';
import { levelFeet } from './slopes.ts';
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
 * @param takeSeconds of the source's take
 */
export function solveFreely(plan: RetargetPlan, takeSeconds: number, out: Float64Array): void {
  sourcePose(plan.played, takeSeconds, plan.dofs);
  worldMatrices(plan.source, plan.dofs, plan.sourceWorld);
  const { wanted, limbs, bones, target, copied, carrier, restDofs } = plan;
  wantRotations(plan);
  levelFeet(plan.slopes, plan.wanted, plan.targetSpace.up);
  for (let i = 0; i < limbs.length; i++) rollLimb(limbs[i], bones, wanted);
  if (plan.carried.length > 0) {
    for (let k = 0; k < 3; k++) if (carrier.dofs[k] >= 0) out[carrier.dofs[k]] = restDofs[carrier.dofs[k]];
  }
  for (let i = 0; i < copied.length; i++) out[copied[i].target] = copied[i].factor * plan.dofs[copied[i].source];
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
  const { target, fits, slides, wanted, bones, targetWorld } = plan;
  const { parent, motions, firstDof, offsets } = target;
  for (let j = from; j < to; j++) {
    const above = parent[j];
    const fit = fits[j];
    const slide = slides[j];
    if (slide && above >= 0) slideBelow(plan, slide, above, out);
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
      if (slide) slideRoot(plan, slide, out);
      for (let k = 0; k < 16; k++) targetWorld[16 * j + k] = local[k];
    }
  }
}

/** The joint's distance from its rest position in its parent's space, as large as the source's in proportion. */
function slideBelow(plan: RetargetPlan, slide: Slide, above: number, out: Float64Array): void {
  const { sourceWorld, sourceSpace, targetSpace } = plan;
  const { sourceRest, dofs, rest } = slide;
  const p = 16 * slide.parent;
  for (let k = 0; k < 3; k++) {
    point[k] = sourceWorld[16 * slide.source + 12 + k] - sourceWorld[p + 12 + k];
    for (let c = 0; c < 3; c++) point[k] -= sourceWorld[p + 4 * c + k] * sourceRest[c];
  }
  turnVector(plan.across, 0, point, 0, point, 0);
  const factor = (plan.scale * sourceSpace.metres) / targetSpace.metres;
  writeRotationPart(plan.targetWorld, 16 * above, parentTurn, 0, 3);
  for (let k = 0; k < 3; k++) {
    if (dofs[k] < 0) continue;
    const c = 3 * k;
    const way = parentTurn[c] * point[0] + parentTurn[c + 1] * point[1] + parentTurn[c + 2] * point[2];
    out[dofs[k]] = rest[k] + factor * way;
  }
}

/** A root above the carrier: where the source's is, in proportion. Changes `local` too. */
function slideRoot(plan: RetargetPlan, { source, dofs }: Slide, out: Float64Array): void {
  for (let k = 0; k < 3; k++) point[k] = plan.sourceWorld[16 * source + 12 + k];
  toScene(plan.sourceSpace, point);
  inProportion(plan, point);
  fromScene(plan.targetSpace, point);
  for (let k = 0; k < 3; k++) {
    if (dofs[k] < 0) continue;
    out[dofs[k]] += point[k] - local[12 + k];
    local[12 + k] = point[k];
  }
}

/** Moves the target so that the centre of `carried` is where it belongs. */
function carry(plan: RetargetPlan, out: Float64Array): void {
  const { carried, sourceOf, targetWorld } = plan;
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
  inProportion(plan, middle);
  middle[1] += plan.shift;
  fromScene(plan.targetSpace, middle);
  moveBy(plan, middle[0] - point[0], middle[1] - point[1], middle[2] - point[2], out);
}
