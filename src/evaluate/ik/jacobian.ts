/**
 * The Jacobian: the derivative of each error with respect to each variable. A DOF that rotates or slides about an axis
 * `a` through o, with nothing above it that stretches, moves all its descendants as a rigid body (Buss, Introduction to
 * Inverse Kinematics, 2004):
 *
 *     ṗ = a × (p − o) + slide · a        the frame turns with a
 *
 * A quaternion's DOFs give a twist about its pivot, ṗ = v + ω × (p − o). Joints that stretch are propagated up the
 * path:
 *
 *     ṗ = W_parent · ∂L/∂φ · x        with x the point in the space of the joint, of its children's results
 *
 * Linked DOFs add to the column of the DOF they follow, times their rate.
 */
import { FRAME_SIZE, orientationErrorSpeed, writeFrameSpeed } from './orientation.ts';
import type { IkProblem } from './state.ts';
import { writeTwists } from './twists.ts';

/** For the pose last evaluated, which is in `dofs`. */
export function writeJacobian(problem: IkProblem, dofs: Float64Array): void {
  // Hinges overwrite their columns, and the others always stay 0.
  if (!problem.screwColumns.areAll) problem.jacobian.fill(0);
  writeHingeColumns(problem);
  if (problem.screwColumns.areAll) return;
  writeRootColumns(problem);
  writeOtherScrewColumns(problem);
  if (problem.slots.allScrews) return;
  writeTwistColumns(problem, dofs);
  for (let p = 0; p < problem.pins.count; p++) writeStretchingColumns(problem, dofs, p);
}

function writeRootColumns({ pins, variables, rootVariables, jacobian }: IkProblem): void {
  const { count, scale } = variables;
  for (let k = 0; k < 3; k++) {
    const v = rootVariables[k];
    if (v < 0) continue;
    for (let p = 0; p < pins.count; p++) jacobian[(pins.row[p] + k) * count + v] += scale[v] * pins.weights[p];
  }
}

/** Nearly all of the work for nearly all skeletons. */
function writeHingeColumns({ pins, links, screwColumns, variables, jacobian }: IkProblem): void {
  const { positions, weights } = pins;
  const { lines } = links;
  const { firstHinge, hinges, hingeScales } = screwColumns;
  const n = variables.count;
  for (let p = 0; p < pins.count; p++) {
    const w = weights[p];
    const px = positions[3 * p];
    const py = positions[3 * p + 1];
    const pz = positions[3 * p + 2];
    for (let h = firstHinge[p]; h < firstHinge[p + 1]; h++) {
      const line = hinges[2 * h];
      const at = hinges[2 * h + 1];
      const f = w * hingeScales[h];
      const ax = f * lines[line];
      const ay = f * lines[line + 1];
      const az = f * lines[line + 2];
      const x = px - lines[line + 3];
      const y = py - lines[line + 4];
      const z = pz - lines[line + 5];
      // Only its own linked DOFs add to this, later.
      jacobian[at] = ay * z - az * y;
      jacobian[at + n] = az * x - ax * z;
      jacobian[at + 2 * n] = ax * y - ay * x;
    }
  }
}

function writeOtherScrewColumns(problem: IkProblem): void {
  const { links, screwColumns, pins, variables, jacobian } = problem;
  const { variable, follower, turns, slides, lines } = links;
  const { others } = screwColumns;
  const { count: n, scale } = variables;
  const { slope } = variables.followers;
  const { positions, weights, row, holdsOrientation } = pins;
  for (let k = 0; k < others.length; k += 2) {
    const i = others[k];
    const p = others[k + 1];
    const v = variable[i];
    const f = follower[i] < 0 ? scale[v] : scale[v] * slope[follower[i]];
    const line = 6 * i;
    const ax = f * lines[line];
    const ay = f * lines[line + 1];
    const az = f * lines[line + 2];
    const slide = slides[i];
    const w = weights[p];
    const at = row[p] * n + v;
    if (turns[i] === 1) {
      const x = positions[3 * p] - lines[line + 3];
      const y = positions[3 * p + 1] - lines[line + 4];
      const z = positions[3 * p + 2] - lines[line + 5];
      jacobian[at] += w * (ay * z - az * y);
      jacobian[at + n] += w * (az * x - ax * z);
      jacobian[at + 2 * n] += w * (ax * y - ay * x);
      if (holdsOrientation[p] === 1) addTurn(problem, p, v, ax, ay, az);
    }
    if (slide !== 0) {
      jacobian[at] += w * slide * ax;
      jacobian[at + n] += w * slide * ay;
      jacobian[at + 2 * n] += w * slide * az;
    }
  }
}

/** Joints that neither stretch nor are products of screws. */
function writeTwistColumns(problem: IkProblem, dofs: Float64Array): void {
  const { skeleton, slots, pins, variables, jacobian } = problem;
  const { motions, firstDof } = skeleton;
  const { worlds } = slots;
  const { count: n, scale, followers } = variables;
  const { twists } = problem.scratch;
  for (let s = 0; s < slots.count; s++) {
    const part0 = slots.firstPart[s];
    const partEnd = slots.firstPart[s + 1];
    if (part0 === partEnd || slots.isRigid[s] === 0 || slots.takesScrews[s] === 1) continue;
    const j = slots.joint[s];
    writeTwists(motions[j], dofs, firstDof[j], firstDof[j + 1] - firstDof[j], slots.locals, 16 * s, twists);
    const above = 16 * slots.parent[s];
    for (let part = part0; part < partEnd; part++) {
      const v = slots.partVariable[part];
      const follower = slots.partFollower[part];
      const f = follower < 0 ? scale[v] : scale[v] * followers.slope[follower];
      for (let k = 0; k < 3; k++) {
        turning[k] = f * twists[6 * slots.partDof[part] + k];
        moved[k] = f * twists[6 * slots.partDof[part] + 3 + k];
      }
      if (above >= 0) {
        applyTo(worlds, above, turning, 0, turning);
        applyTo(worlds, above, moved, 0, moved);
      }
      const [ax, ay, az] = [turning[0], turning[1], turning[2]];
      for (let b = slots.firstPin[s]; b < slots.firstPin[s + 1]; b++) {
        const p = slots.pinsBelow[b];
        const w = pins.weights[p];
        const x = pins.positions[3 * p] - worlds[16 * s + 12];
        const y = pins.positions[3 * p + 1] - worlds[16 * s + 13];
        const z = pins.positions[3 * p + 2] - worlds[16 * s + 14];
        const at = pins.row[p] * n + v;
        jacobian[at] += w * (moved[0] + ay * z - az * y);
        jacobian[at + n] += w * (moved[1] + az * x - ax * z);
        jacobian[at + 2 * n] += w * (moved[2] + ax * y - ay * x);
        if (pins.holdsOrientation[p]) addTurn(problem, p, v, ax, ay, az);
      }
    }
  }
}

/** Adds the rotation of a pin's frame with a variable. */
function addTurn(
  { pins, variables, jacobian }: IkProblem,
  p: number,
  v: number,
  wx: number,
  wy: number,
  wz: number,
): void {
  const { count } = variables;
  speed[0] = wx;
  speed[1] = wy;
  speed[2] = wz;
  orientationErrorSpeed(pins.turns, 3 * p, speed);
  const at = (pins.row[p] + 3) * count + v;
  for (let k = 0; k < 3; k++) jacobian[at + k * count] += pins.turnWeights[p] * speed[k];
}

/** All joints from a pin up to the root that stretch, or are below one that does. */
function writeStretchingColumns(problem: IkProblem, dofs: Float64Array, p: number): void {
  const { skeleton, slots, pins, variables, jacobian } = problem;
  const { motions, firstDof } = skeleton;
  const { count: n, scale, followers } = variables;
  const { matrix } = problem.scratch;
  for (let k = 0; k < 3; k++) {
    point[k] = pins.points[3 * p + k];
    axisX[k] = k === 0 ? 1 : 0;
    axisY[k] = k === 1 ? 1 : 0;
  }
  for (let s = pins.slot[p]; s >= 0 && !slots.isRigid[s]; s = slots.parent[s]) {
    const j = slots.joint[s];
    const above = 16 * slots.parent[s];
    for (let part = slots.firstPart[s]; part < slots.firstPart[s + 1]; part++) {
      const v = slots.partVariable[part];
      const follower = slots.partFollower[part];
      const f = follower < 0 ? scale[v] : scale[v] * followers.slope[follower];
      motions[j].writeDerivative(dofs, firstDof[j], slots.partDof[part], matrix, 0);
      applyTo(matrix, 0, point, 1, moved);
      if (above >= 0) applyTo(slots.worlds, above, moved, 0, moved);
      const at = pins.row[p] * n + v;
      for (let k = 0; k < 3; k++) jacobian[at + k * n] += f * pins.weights[p] * moved[k];
      if (!pins.holdsOrientation[p]) continue;
      applyTo(matrix, 0, axisX, 0, movedX);
      applyTo(matrix, 0, axisY, 0, movedY);
      if (above >= 0) {
        applyTo(slots.worlds, above, movedX, 0, movedX);
        applyTo(slots.worlds, above, movedY, 0, movedY);
      }
      writeFrameSpeed(pins.frames, FRAME_SIZE * p, movedX, movedY, moved);
      addTurn(problem, p, v, f * moved[0], f * moved[1], f * moved[2]);
    }
    applyTo(slots.locals, 16 * s, point, 1, point);
    applyTo(slots.locals, 16 * s, axisX, 0, axisX);
    applyTo(slots.locals, 16 * s, axisY, 0, axisY);
  }
}

/** First three components of M · (a, w). `out` may be `a`. */
function applyTo(m: Float64Array, o: number, a: Float64Array, w: number, out: Float64Array): void {
  const [x, y, z] = [a[0], a[1], a[2]];
  for (let k = 0; k < 3; k++) out[k] = m[o + k] * x + m[o + 4 + k] * y + m[o + 8 + k] * z + m[o + 12 + k] * w;
}

/** Scratch; never escapes. */
const turning = new Float64Array(3);
const speed = new Float64Array(3);
const point = new Float64Array(3);
const axisX = new Float64Array(3);
const axisY = new Float64Array(3);
const moved = new Float64Array(3);
const movedX = new Float64Array(3);
const movedY = new Float64Array(3);
