/**
 * Inverse kinematics as a least-squares problem, with all its typed arrays allocated once:
 *
 *     minimise Σ over pins  |w·(p(φ) − target)/reach|²  +  |w·ORIENTATION_WEIGHT·turn left|²        within the limits
 *
 * Errors are divided by the reach, so that a character in centimetres is solved like one in metres.
 */
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { applyConstraints, type CompiledSkeleton, compileSkeleton, worldMatrices } from '../kinematics.ts';
import { evaluatePose } from './forward.ts';
import { systemSize } from './normal.ts';
import { FRAME_SIZE, writeTurnFrame } from './orientation.ts';
import { checkPins, HOLDING_WEIGHT, type IkOptions, type IkPin, ikStiffness } from './pins.ts';
import { ballsOf, pathReach } from './reach.ts';
import { linksOf, screwColumnsOf } from './screws.ts';
import type { IkProblem, JacobianShape, PinArrays, Scratch, Slots } from './state.ts';
import { type IkVariables, ikVariables } from './variables.ts';

/** A radian of orientation error weighs as much as this fraction of the reach. */
const ORIENTATION_WEIGHT = 0.3;

/**
 * Makes the IK problem of some pins, with all arrays that solving needs.
 * @param pose the character's current DOFs: lengths are measured there, and locked DOFs keep these values
 * @throws IkError for an invalid pin
 */
export function ikProblem(
  skeleton: Skeleton,
  pins: readonly IkPin[],
  pose: ArrayLike<number>,
  options: IkOptions = {},
): IkProblem {
  const compiled = compileSkeleton(skeleton);
  checkPins(compiled, pins);
  const { clamps = true, stiffness = ikStiffness(skeleton, false) } = options;
  const dofs = Float64Array.from(pose);
  applyConstraints(compiled, dofs, clamps);
  const world = new Float64Array(16 * compiled.jointCount);
  worldMatrices(compiled, dofs, world);
  const reach = pathReach(skeleton, compiled, pins, world);
  const onPath = Array.from({ length: compiled.jointCount }, () => false);
  for (const { joint } of pins) for (let j = joint; j >= 0; j = compiled.parent[j]) onPath[j] = true;
  const variables = ikVariables(skeleton, compiled, onPath, stiffness, reach, clamps);
  const slots = slotsOf(compiled, pins, onPath, variables);
  const arrays = pinArrays(pins, slots, reach);
  const rootVariables = compiled.hasRootTranslation ? variables.ofDof.slice(0, 3) : Int32Array.of(-1, -1, -1);
  const rootMoves = rootVariables.some((v) => v >= 0);
  const balls = ballsOf(compiled, slots, arrays, dofs, world, rootMoves);
  // `linksOf` depends on which slots are kept.
  for (const s of balls.centre) if (s >= 0) slots.isKept[s] = 1;
  const links = linksOf(compiled, slots, variables);
  const rows = pins.reduce((sum, { orientation }) => sum + (orientation ? 6 : 3), 0);
  const problem: IkProblem = {
    skeleton: compiled,
    clamps,
    reach,
    pins: arrays,
    slots,
    links,
    screwColumns: screwColumnsOf(links, slots, arrays, variables, rootMoves),
    balls,
    variables,
    rootVariables,
    rows,
    errors: new Float64Array(rows),
    shape: shapeOf(slots, arrays, rootVariables),
    jacobian: new Float64Array(rows * variables.count),
    foresight: {
      isMet: false,
      last: new Float64Array(rows),
      bend: new Float64Array(rows),
      foreseen: new Float64Array(rows),
    },
    scratch: scratchOf(compiled, rows, variables.count, dofs.length),
    result: {
      iterations: 0,
      isSolved: false,
      residuals: new Float64Array(pins.length),
      turns: new Float64Array(pins.length),
      binding: new Int32Array(variables.count),
      bindingCount: 0,
    },
  };
  // Most problems are solved from this pose first, which is then already evaluated.
  evaluatePose(problem, dofs);
  return problem;
}

/** Sets another target without allocating. Returns false and ignores it if it is not finite. */
export function movePin({ pins }: IkProblem, pin: number, x: number, y: number, z: number): boolean {
  if (!Number.isFinite(x + y + z)) return false;
  pins.targets[3 * pin] = x;
  pins.targets[3 * pin + 1] = y;
  pins.targets[3 * pin + 2] = z;
  return true;
}

/** Sets another orientation for a pin that holds one: x y z w. Ignored if not finite, or of length 0. */
export function turnPin({ pins }: IkProblem, pin: number, turn: ArrayLike<number>): boolean {
  const length = Math.hypot(turn[0], turn[1], turn[2], turn[3]);
  if (!(length > 0 && length < Infinity)) return false;
  writeTurnFrame(turn, 0, pins.targetFrames, 9 * pin);
  return true;
}

function slotsOf(
  compiled: CompiledSkeleton,
  pins: readonly IkPin[],
  onPath: readonly boolean[],
  { ofDof, followers }: IkVariables,
): Slots {
  const joints = onPath.flatMap((is, j) => (is ? [j] : []));
  const slotOf = new Int32Array(compiled.jointCount).fill(-1);
  joints.forEach((j, s) => {
    slotOf[j] = s;
  });
  const parent = Int32Array.from(joints, (j) => (compiled.parent[j] < 0 ? -1 : slotOf[compiled.parent[j]]));
  const isRigid = new Uint8Array(joints.length);
  joints.forEach((j, s) => {
    isRigid[s] = compiled.motions[j].stretches || (parent[s] >= 0 && !isRigid[parent[s]]) ? 0 : 1;
  });
  const takesScrews = isRigid.map((is, s) => (is && compiled.motions[joints[s]].screws ? 1 : 0));
  const isKept = Uint8Array.from(joints, (j) => (pins.some(({ joint }) => joint === j) ? 1 : 0));
  parent.forEach((above, s) => {
    if (above >= 0 && (s !== above + 1 || takesScrews[s] === 0)) isKept[above] = 1;
  });
  const below = joints.map((j) =>
    pins.flatMap((pin, p) => (pin.joint >= j && pin.joint < compiled.subtreeEnd[j] ? [p] : [])),
  );
  const parts = joints.map((j) => {
    const dofs = Array.from({ length: compiled.firstDof[j + 1] - compiled.firstDof[j] }, (_, k) => k);
    return dofs.filter((k) => ofDof[compiled.firstDof[j] + k] >= 0);
  });
  const ofPart = (list: Int32Array) =>
    Int32Array.from(parts.flatMap((dofs, s) => dofs.map((k) => list[compiled.firstDof[joints[s]] + k])));
  return {
    count: joints.length,
    joint: Int32Array.from(joints),
    parent,
    locals: new Float64Array(16 * joints.length),
    worlds: Float64Array.from({ length: 16 * joints.length }, (_, k) => (k % 16 === 15 ? 1 : 0)),
    isKept,
    isRigid,
    allScrews: takesScrews.every((does) => does === 1),
    firstPin: starts(below),
    pinsBelow: Int32Array.from(below.flat()),
    firstPart: starts(parts),
    partDof: Int32Array.from(parts.flat()),
    partVariable: ofPart(ofDof),
    partFollower: ofPart(followers.ofDof),
    takesScrews,
  };
}

/** Start of each list if they were concatenated, and the end of the last. */
function starts(lists: readonly (readonly unknown[])[]): Int32Array {
  const out = new Int32Array(lists.length + 1);
  lists.forEach((list, i) => {
    out[i + 1] = out[i] + list.length;
  });
  return out;
}

function pinArrays(pins: readonly IkPin[], slots: Slots, reach: number): PinArrays {
  const count = pins.length;
  const row = new Int32Array(count);
  const targetFrames = new Float64Array(9 * count);
  let next = 0;
  pins.forEach(({ orientation }, p) => {
    row[p] = next;
    next += orientation ? 6 : 3;
    if (orientation) writeTurnFrame(orientation, 0, targetFrames, 9 * p);
  });
  // Relative to the heaviest, so that a weight of 1e300 is not squared.
  const heaviest = pins.reduce((most, { weight = 1 }) => Math.max(most, weight), 0);
  const counts = pins.map(({ weight = 1, holds }) => Math.sqrt(weight / heaviest) * (holds ? HOLDING_WEIGHT : 1));
  return {
    count,
    slot: Int32Array.from(pins, ({ joint }) => slots.joint.indexOf(joint)),
    points: Float64Array.from(pins.flatMap(({ point }) => point)),
    targets: Float64Array.from(pins.flatMap(({ target }) => target)),
    aims: new Float64Array(3 * count),
    holdsOrientation: Uint8Array.from(pins, ({ orientation }) => (orientation ? 1 : 0)),
    targetFrames,
    weights: Float64Array.from(counts, (w) => w / reach),
    turnWeights: Float64Array.from(counts, (w) => w * ORIENTATION_WEIGHT),
    row,
    positions: new Float64Array(3 * count),
    frames: new Float64Array(FRAME_SIZE * count),
    turns: new Float64Array(3 * count),
  };
}

function shapeOf(
  { parent, firstPart, partVariable }: Slots,
  { count, slot, holdsOrientation }: PinArrays,
  rootVariables: Int32Array,
): JacobianShape {
  const blocks = Array.from({ length: count }, (_, p) => {
    const moving = new Set(rootVariables.filter((v) => v >= 0));
    for (let s = slot[p]; s >= 0; s = parent[s]) {
      for (let part = firstPart[s]; part < firstPart[s + 1]; part++) moving.add(partVariable[part]);
    }
    const columns = [...moving].sort((a, b) => a - b);
    return holdsOrientation[p] ? [columns, columns] : [columns];
  }).flat();
  return {
    first: starts(blocks),
    column: Int32Array.from(blocks.flat()),
    shared: Int32Array.from(
      blocks.flatMap((a) => blocks.map((b) => 1 + Math.max(-1, ...a.filter((v) => b.includes(v))))),
    ),
  };
}

function scratchOf(compiled: CompiledSkeleton, rows: number, unknowns: number, dofs: number): Scratch {
  const { firstDof, jointCount } = compiled;
  let most = 0;
  for (let j = 0; j < jointCount; j++) most = Math.max(most, firstDof[j + 1] - firstDof[j]);
  const size = systemSize(rows, unknowns);
  return {
    twists: new Float64Array(6 * most),
    matrix: new Float64Array(16),
    step: new Float64Array(unknowns),
    held: new Uint8Array(unknowns),
    fixed: new Uint8Array(unknowns),
    fixedStep: new Float64Array(unknowns),
    before: new Float64Array(unknowns),
    seen: new Float64Array(dofs),
    bestPose: new Float64Array(dofs),
    startPose: new Float64Array(dofs),
    freeColumns: new Float64Array(rows * unknowns),
    rest: new Float64Array(rows),
    errorsBefore: new Float64Array(rows),
    expected: new Float64Array(rows),
    normal: new Float64Array(size * size),
    factor: new Float64Array(size * size),
    solution: new Float64Array(size),
  };
}
