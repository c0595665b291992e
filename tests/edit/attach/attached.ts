/** Characters to be attached to each other, and where their joints are in the scene. */
import fc from 'fast-check';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { provideLayers } from '../../../src/evaluate/layers.ts';
import { dofCountOf, poseAt } from '../../../src/evaluate/pose.ts';
import { NO_TRAVEL, placementMatrix } from '../../../src/evaluate/space/placements.ts';
import { determinant3, multiplyAffine } from '../../../src/math/mat4.ts';
import type { Vec3 } from '../../../src/math/vec3.ts';
import type { Character, Placement } from '../../../src/model/document.ts';
import { filePose } from '../../../src/model/skeleton/dofs.ts';
import { EULER_ORDERS, type Motion } from '../../../src/model/skeleton/skeleton.ts';
import type { Space } from '../../../src/model/space.ts';
import { type Channel, restChannel } from '../../../src/model/takes/take.ts';
import { character, joint } from '../../helpers/builders.ts';
import type { Dice } from '../dice.ts';
import { channelOf } from '../keys/channels.ts';
import { diceOf, randomSkeleton, randomValue } from '../rig/random-rig.ts';

provideLayers();

/** A joint's matrix in the scene, from the matrices of all joints. */
export function sceneOf(one: Character, index: number, time: number): Float64Array {
  if (!one.skeleton) throw new Error('no skeleton');
  const compiled = compileSkeleton(one.skeleton);
  const dofs = new Float64Array(dofCountOf(one));
  poseAt(one, time, dofs);
  const world = new Float64Array(16 * compiled.jointCount);
  worldMatrices(compiled, dofs, world);
  const placement = new Float64Array(16);
  placementMatrix(one.placements[0], one.space, NO_TRAVEL, placement);
  const scene = new Float64Array(16);
  multiplyAffine(placement, 0, world, 16 * index, scene, 0);
  return scene;
}

/** The largest difference of two matrices. */
export function differenceOf(a: Float64Array, b: Float64Array): number {
  return Math.max(...a.map((value, i) => Math.abs(value - b[i])));
}

/** Whether a joint's matrix has a rotation and an inverse: some joints scale to nothing, or by thousands. */
export function isRegular(matrix: Float64Array): boolean {
  const lengths = [0, 4, 8].map((c) => Math.hypot(matrix[c], matrix[c + 1], matrix[c + 2]));
  return lengths.every((length) => length > 0.01 && length < 100) && Math.abs(determinant3(matrix)) > 1e-3;
}

const number = (dice: Dice, size = 4) => (dice.number() - 0.5) * size;
const vector = (dice: Dice, size?: number): Vec3 => [number(dice, size), number(dice, size), number(dice, size)];

function placementOf(dice: Dice, scale: number): Placement {
  return { position: vector(dice), turn: vector(dice, 6), scale };
}

function movingChannels(dice: Dice, rests: readonly number[]): readonly Channel[] {
  return rests.map((rest) =>
    dice.is(0.3) ? restChannel(rest) : channelOf([0, 0.7, 2].map((time) => [time, randomValue(dice, rest)] as const)),
  );
}

const SPACES: readonly (Space | undefined)[] = [undefined, { up: 'z', unit: 'centimetres', lift: 0.5 }];

/** A character of any joints that moves, at any place. */
export function randomLeader(dice: Dice, id: string): Character {
  const skeleton = randomSkeleton(dice);
  const pose = filePose(skeleton, 0);
  const space = dice.pick(SPACES);
  return character({
    ...{ id, name: `leader ${id}`, skeleton, pose },
    takes: [{ name: `${id}_walk`, range: [0, 2], channels: movingChannels(dice, pose) }],
    shownTake: 0,
    placements: [placementOf(dice, 0.5 + dice.number())],
    clampsToLimits: dice.is(0.5),
    timeOffsetSeconds: dice.is(0.5) ? 0 : number(dice, 1),
    ...(space && { space }),
  });
}

/** A prop with a root that takes any rotation. */
export function randomProp(dice: Dice, id: string): Character {
  const order = dice.pick(EULER_ORDERS);
  const motion = dice.pick<Motion>([{ kind: 'ball', order }, { kind: 'quaternion' }, { kind: 'free', order }]);
  const dofs =
    motion.kind === 'quaternion' ? [0, 0, 0, 1] : Array.from({ length: motion.kind === 'free' ? 6 : 3 }, () => 0);
  const skeleton = {
    name: id,
    joints: [joint(-1, { motion, pose: dofs, limits: [], offset: vector(dice) }), joint(0)],
  };
  const pose = filePose(skeleton, 0);
  const space = dice.pick(SPACES);
  return character({
    ...{ id, name: `prop ${id}`, skeleton, pose },
    takes: [{ name: `${id}_anim`, range: [0, 2], channels: movingChannels(dice, pose) }],
    shownTake: 0,
    placements: [placementOf(dice, 0.5 + dice.number())],
    clampsToLimits: dice.is(0.5),
    timeOffsetSeconds: dice.is(0.5) ? 0 : number(dice, 1),
    ...(space && { space }),
  });
}

/** Seeds of dice. */
export const dice = fc.noBias(fc.nat(2 ** 32 - 1)).map(diceOf);
