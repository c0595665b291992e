/** Bones that a DOF lengthens: what follows them, and their ends, are where `pose` has them, wherever they are seen. */
import { beforeAll, expect, it } from 'vitest';
import { FloatPool } from '../../src/dataset/float-pool.ts';
import { takeOf } from '../../src/dataset/take.ts';
import { takeArrays } from '../../src/dataset/take-arrays.ts';
import { eachFrame } from '../../src/evaluate/bake.ts';
import { bareCharacter } from '../../src/evaluate/bare-character.ts';
import { toBvhCapture } from '../../src/evaluate/bvh-capture.ts';
import { endSitePositions } from '../../src/evaluate/end-sites.ts';
import { compileSkeleton, worldMatrices } from '../../src/evaluate/kinematics.ts';
import { setIdentity } from '../../src/math/mat4.ts';
import type { Character } from '../../src/model/document.ts';
import { displayedFrames } from '../../src/review/frames.ts';
import { Bones } from '../../src/view/skeleton/bones.ts';
import { nodesFor, posedNodes } from '../../src/view/skeleton/drawn-skeletons.ts';
import { placePositions } from '../../src/view/skeleton/node-matrices.ts';
import { readAmcText } from '../helpers/acclaim.ts';
import { character as built } from '../helpers/builders.ts';
import { expectClose } from '../helpers/close.ts';

/** A bone with a child, and two leaves, all of which lengthen; the last one in no frame. */
const ASF = `:version 1.10
:root
  order TX TY TZ RX RY RZ
:bonedata
  begin
    name rod
    direction 0 1 0
    length 2
    axis 0.3 0.2 0.1 XYZ
    dof rx l
  end
  begin
    name leaf
    direction 0.6 0.8 0
    length 1
    axis 10 20 30 ZYX
    dof l rz ry
  end
  begin
    name still
    direction 0 0 1
    length 1.5
    dof rx l
  end
:hierarchy
  begin
    root rod still
    rod leaf
  end
`;
const FRAMES = 20;
const AMC = `:FULLY-SPECIFIED
:DEGREES
${Array.from({ length: FRAMES }, (_, f) => `${f + 1}\nroot ${f} 0 1 ${10 * f} 5 0\nrod ${7 * f} ${0.25 * f}\nleaf ${-0.125 * f} 20 ${3 * f}\nstill ${2 * f} 0.5\n`).join('')}`;

let character: Character;
/** Positions of joints, then of ends, frame after frame. */
const joints: number[][] = [];
const ends: number[][] = [];

beforeAll(async () => {
  const { value } = await readAmcText(AMC, ASF);
  if (!value) throw new Error('It was not read.');
  const { skeleton, take } = value;
  const world = new Float64Array(16 * skeleton.joints.length);
  character = built({ skeleton, takes: [take], shownTake: 0, clampsToLimits: false });
  eachFrame(character, framesOf(character), (dofs) => {
    worldMatrices(compileSkeleton(skeleton), dofs, world);
    joints.push(skeleton.joints.flatMap((_, j) => [...world.subarray(16 * j + 12, 16 * j + 15)]));
    ends.push(endSitePositions(skeleton, world, dofs).flatMap(({ position }) => position));
  });
});

function framesOf({ takes: [{ samples }] }: Character) {
  if (!samples) throw new Error('It has no samples.');
  return samples;
}

it('the child of a longer bone is at its tip, and an end is as far from its joint as the bone is long', () => {
  for (let f = 0; f < FRAMES; f++) {
    const [rod, leaf] = [joints[f].slice(3, 6), joints[f].slice(6, 9)];
    expect(Math.hypot(...leaf.map((v, k) => v - rod[k]))).toBeCloseTo(2 + 0.25 * f, 12);
    expect(Math.hypot(...leaf.map((v, k) => v - ends[f][k]))).toBeCloseTo(Math.abs(1 - 0.125 * f), 12);
  }
});

it('arrays have joints and ends there, and so has a review', () => {
  const arrays = takeArrays(takeOf(character, { isRaw: true }), new FloatPool('float64'));
  expectClose(arrays.positions, joints.flat(), 1e-12);
  expectClose(arrays.endPositions, ends.flat(), 1e-12);
  const frames = displayedFrames(character);
  if (!frames) throw new Error('It has no frames.');
  const dofs = new Float64Array(frames.dofCount);
  const points = new Float64Array(3 * frames.pointCount);
  const way = (p: ArrayLike<number>, a: number, b: number) =>
    Math.hypot(p[3 * a] - p[3 * b], p[3 * a + 1] - p[3 * b + 1], p[3 * a + 2] - p[3 * b + 2]);
  frames.write(0, dofs, points);
  const [first] = [way(points, 2, 4)];
  frames.write(4, dofs, points);
  expect(way(points, 2, 4) / first).toBeCloseTo(0.5, 12);
});

it('they are drawn there, and are inside the bounds', () => {
  const { skeleton } = character;
  if (!skeleton) throw new Error('It has no skeleton.');
  const bones = new Bones(skeleton);
  const nodes = nodesFor(skeleton);
  const placement = new Float64Array(16);
  setIdentity(placement, 0);
  const out = new Float64Array(3 * nodes.count);
  const bounds = new Float64Array(6);
  eachFrame(character, framesOf(character), (dofs, f) => {
    bones.pose(dofs);
    placePositions(posedNodes(nodes, skeleton, dofs), placement, 0, bones.world, out, 0);
    expectClose(out, [...joints[f], ...ends[f]], 1e-12);
    bones.bounds(bounds);
    const all = [...joints[f], ...ends[f]];
    for (let k = 0; k < 3; k++) {
      const along = all.filter((_, i) => i % 3 === k);
      expect(bounds[k]).toBeCloseTo(Math.min(...along), 12);
      expect(bounds[k + 3]).toBeCloseTo(Math.max(...along), 12);
    }
  });
});

it('a .bvh has them there: an end that moves is a joint, and one that doesn’t an End Site', () => {
  const { capture } = toBvhCapture(character, framesOf(character));
  const { skeleton, take } = capture;
  expect(skeleton.joints.map(({ name }) => name)).toEqual(['root', 'rod', 'leaf', 'leaf_end', 'still']);
  expect(skeleton.joints[4].endSites).toEqual([[0, 0, 2]]);
  const world = new Float64Array(16 * 5);
  eachFrame(bareCharacter(skeleton, take), framesOf(character), (dofs, f) => {
    worldMatrices(compileSkeleton(skeleton), dofs, world);
    const at = (j: number) => [...world.subarray(16 * j + 12, 16 * j + 15)];
    expectClose([...at(0), ...at(1), ...at(2), ...at(4)], joints[f], 1e-9);
    expectClose([...at(3), ...endSitePositions(skeleton, world)[1].position], ends[f], 1e-9);
  });
});
