/** Forward kinematics of the joints involved, and the errors of the pins. */
import { multiplyAffine } from '../../math/mat4.ts';
import { length3 } from '../../math/vec3.ts';
import { writeMatrices } from './chain.ts';
import { FRAME_SIZE, writeFrame, writeOrientationError } from './orientation.ts';
import type { IkProblem } from './state.ts';
import { settleFollowers } from './variables.ts';

/**
 * Evaluates a pose: matrices, positions, errors. Linked DOFs are written into `dofs`.
 * @returns the sum of the squared errors
 */
export function evaluatePose(problem: IkProblem, dofs: Float64Array): number {
  if (problem.variables.followers.count > 0) settleFollowers(problem.variables.followers, dofs);
  const { seen } = problem.scratch;
  for (let d = 0; d < seen.length; d++) seen[d] = dofs[d];
  writeMatrices(problem, dofs, writeByRule);
  writePins(problem);
  return writeErrors(problem);
}

/** Whether this pose was the last one evaluated: in a drag, the result of the step before. */
export function isEvaluatedAt({ scratch }: IkProblem, dofs: Float64Array): boolean {
  const { seen } = scratch;
  for (let d = 0; d < seen.length; d++) if (seen[d] !== dofs[d]) return false;
  return true;
}

/** The matrix of a slot by its joint's own rule. */
function writeByRule({ skeleton, slots }: IkProblem, dofs: Float64Array, s: number): void {
  const { motions, offsets, firstDof, hasRootTranslation } = skeleton;
  const { locals, worlds } = slots;
  const j = slots.joint[s];
  const above = slots.parent[s];
  const o = 16 * s;
  motions[j].write(dofs, firstDof[j], locals, o);
  for (let k = 0; k < 3; k++) locals[o + 12 + k] += offsets[3 * j + k];
  if (above >= 0) multiplyAffine(worlds, 16 * above, locals, o, worlds, o);
  else {
    if (hasRootTranslation) for (let k = 0; k < 3; k++) locals[o + 12 + k] += dofs[k];
    for (let k = 0; k < 16; k++) worlds[o + k] = locals[o + k];
  }
}

function writePins({ pins, slots }: IkProblem): void {
  const { count, slot, points, positions, holdsOrientation, frames } = pins;
  const { worlds } = slots;
  for (let p = 0; p < count; p++) {
    const o = 16 * slot[p];
    const x = points[3 * p];
    const y = points[3 * p + 1];
    const z = points[3 * p + 2];
    for (let k = 0; k < 3; k++) {
      positions[3 * p + k] = worlds[o + k] * x + worlds[o + 4 + k] * y + worlds[o + 8 + k] * z + worlds[o + 12 + k];
    }
    if (holdsOrientation[p]) writeFrame(worlds, o, frames, FRAME_SIZE * p);
  }
}

/** Errors of the pose last evaluated, relative to the pins' current targets. @returns the sum of the squared errors */
export function writeErrors({ pins, errors }: IkProblem): number {
  const { count, positions, aims, weights, row, holdsOrientation, frames, targetFrames, turns, turnWeights } = pins;
  let sum = 0;
  for (let p = 0; p < count; p++) {
    const r = row[p];
    for (let k = 0; k < 3; k++) {
      const e = weights[p] * (positions[3 * p + k] - aims[3 * p + k]);
      errors[r + k] = e;
      sum += e * e;
    }
    if (!holdsOrientation[p]) continue;
    writeOrientationError(frames, FRAME_SIZE * p, targetFrames, 9 * p, turns, 3 * p);
    for (let k = 0; k < 3; k++) {
      const e = turnWeights[p] * turns[3 * p + k];
      errors[r + 3 + k] = e;
      sum += e * e;
    }
  }
  return sum;
}

/** Distance of a pin from its aim, in the character's unit. */
export function aimDistance({ positions, aims }: IkProblem['pins'], p: number): number {
  return distance(positions, aims, 3 * p);
}

/** Distance of a pin from its target, reachable or not. */
export function residual({ positions, targets }: IkProblem['pins'], p: number): number {
  return distance(positions, targets, 3 * p);
}

/** Between the points at `a[o]` and `b[o]`. */
function distance(a: Float64Array, b: Float64Array, o: number): number {
  return length3(a[o] - b[o], a[o + 1] - b[o + 1], a[o + 2] - b[o + 2]);
}

/** The remaining rotation of a pin's joint in radians; 0 if the pin holds no orientation. */
export function orientationError({ turns }: IkProblem['pins'], p: number): number {
  const [x, y, z] = [turns[3 * p], turns[3 * p + 1], turns[3 * p + 2]];
  return Math.sqrt(x * x + y * y + z * z);
}

/** Whether all pins are at their aims, within a fraction of the reach (and as many radians). */
export function isThere({ pins, reach }: IkProblem, within: number): boolean {
  for (let p = 0; p < pins.count; p++) {
    if (!(aimDistance(pins, p) <= within * reach)) return false;
    if (pins.holdsOrientation[p] && !(orientationError(pins, p) <= within)) return false;
  }
  return true;
}
