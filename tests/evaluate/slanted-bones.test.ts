/** Acclaim bones about slanted axes, between frames and between keys: C·M·C⁻¹, with M as it is about plain axes. */

import { Matrix3 } from 'three';
import { beforeAll, describe, expect, it } from 'vitest';
import { keyedTake } from '../../src/edit/convert/keys-of-samples.ts';
import { blendPoses } from '../../src/edit/pose/blend.ts';
import { bareCharacter } from '../../src/evaluate/bare-character.ts';
import { compileSkeleton, localMatrices, worldMatrices } from '../../src/evaluate/kinematics.ts';
import { axesOf } from '../../src/evaluate/motions/acclaim.ts';
import { poseFrom, poseSource } from '../../src/evaluate/pose.ts';
import { PoseRotations } from '../../src/evaluate/rotations/pose-rotations.ts';
import type { AcclaimTake } from '../../src/model/files.ts';
import { acclaimMotionOf } from '../../src/model/skeleton/joint-types.ts';
import { INTERPOLATIONS, type Interpolation } from '../../src/model/takes/samples.ts';
import type { Take } from '../../src/model/takes/take.ts';
import { readAmcText } from '../helpers/acclaim.ts';
import { expectClose } from '../helpers/close.ts';

const ASF = (axis: string) => `:version 1.10
:root
  order TX TY TZ RZ RX RY
  axis XYZ
  orientation ${axis}
:bonedata
${['rx ry rz', 'rz ry rx l', 'tx ty tz ry rz rx', 'rx rz', 'ry']
  .map((dofs, i) => `begin\nname b${i}\ndirection 0 1 0\nlength 1\naxis ${axis} XYZ\ndof ${dofs}\nend`)
  .join('\n')}
:hierarchy
  begin
    root b0 b1 b2 b3 b4
  end
`;
/** Angles that jump by whole turns, and to another set of the same rotation. */
const FRAMES = [
  [170, 10, -20],
  [-175, 5, -10],
  [-160, -15, 30],
  [20, 195, 210],
];
const AMC = `:DEGREES\n${FRAMES.map(
  ([a, b, c], f) =>
    `${f + 1}\nroot 1 2 3 ${a} ${b} ${c}\nb0 ${a} ${b} ${c}\nb1 ${c} ${a} ${b} 0.5\nb2 0 ${f} 1 ${b} ${a} ${c}\nb3 ${a} ${b}\nb4 ${a}\n`,
).join('')}`;

let slanted: AcclaimTake;
let plain: AcclaimTake;

beforeAll(async () => {
  const read = async (axis: string) => {
    const { value } = await readAmcText(AMC, ASF(axis));
    if (!value) throw new Error('It was not read.');
    return value;
  };
  [slanted, plain] = [await read('20 -35 50'), await read('0 0 0')];
});

/** DOFs and rotations of joints in their parents, and in the character with what came with the DOFs. */
function posed({ skeleton }: AcclaimTake, take: Take, seconds: number) {
  const source = poseSource(bareCharacter(skeleton, take));
  const dofs = new Float64Array(source.count);
  const rotations = new PoseRotations(skeleton.joints.length);
  poseFrom(source, seconds, dofs, rotations);
  const [local, world] = [0, 1].map(() => new Float64Array(16 * skeleton.joints.length));
  localMatrices(compileSkeleton(skeleton), dofs, local);
  worldMatrices(compileSkeleton(skeleton), dofs, world, rotations);
  const again = new Float64Array(world.length);
  worldMatrices(compileSkeleton(skeleton), dofs, again);
  expectClose(world, again, 1e-9);
  return { dofs, local };
}

const rotationIn = (m: Float64Array, j: number) =>
  new Matrix3().fromArray([0, 1, 2, 4, 5, 6, 8, 9, 10].map((k) => m[16 * j + k]));

/** Each rotation of the slanted skeleton against that of the plain one. */
function expectConjugate(take: Take, plainTake: Take, seconds: number): void {
  const [own, other] = [posed(slanted, take, seconds), posed(plain, plainTake, seconds)];
  expectClose(own.dofs, other.dofs, 1e-9, `DOFs at ${seconds}`);
  slanted.skeleton.joints.forEach(({ motion }, j) => {
    const acclaim = acclaimMotionOf(motion);
    if (!acclaim) throw new Error('It is no bone.');
    const c = new Matrix3().fromArray([...axesOf(acclaim)]);
    const wanted = c.clone().multiply(rotationIn(other.local, j));
    if (j > 0) wanted.multiply(c.clone().transpose());
    expectClose(rotationIn(own.local, j).elements, wanted.elements, 1e-9, `joint ${j} at ${seconds}`);
  });
}

const times = [0, 0.3, 0.5, 1, 1.25, 1.9, 2.4, 3].map((frame) => frame / 120);
const interpolated = (take: Take, interpolation: Interpolation): Take =>
  take.samples ? { ...take, samples: { ...take.samples, interpolation } } : take;

describe('bones about slanted axes', () => {
  it.each(INTERPOLATIONS)('turn between frames as those about plain axes do: %s', (interpolation) => {
    for (const time of times)
      expectConjugate(interpolated(slanted.take, interpolation), interpolated(plain.take, interpolation), time);
  });

  it('turn the shortest way between frames whose angles jump', () => {
    const at = (seconds: number) => rotationIn(posed(slanted, slanted.take, seconds).local, 1);
    const turn = (a: Matrix3, b: Matrix3) => {
      const [x, , , , y, , , , z] = a.clone().transpose().multiply(b).elements;
      return Math.acos(Math.min(1, (x + y + z - 1) / 2));
    };
    const [from, half, to] = [0, 0.5, 1].map((frame) => at(frame / 120));
    expect(turn(from, half)).toBeCloseTo(turn(from, to) / 2, 6);
    expect(turn(half, to)).toBeCloseTo(turn(from, to) / 2, 6);
  });

  it('turn between keys as those about plain axes do, without jumps', () => {
    const keyed = [slanted, plain].map(({ take, skeleton }) => keyedTake(take, skeleton));
    for (const time of times) expectConjugate(keyed[0], keyed[1], time);
    for (const channel of keyed[0].channels) {
      if (channel.kind !== 'keys') continue;
      const { values } = channel;
      for (let k = 1; k < values.length; k++) expect(Math.abs(values[k] - values[k - 1])).toBeLessThan(Math.PI + 1e-9);
    }
  });

  it('turn between poses as those about plain axes do', () => {
    const [from, to] = [0, 1].map((frame) => posed(slanted, slanted.take, frame / 120).dofs);
    expectClose(blendPoses(slanted.skeleton, from, to, 0.4), blendPoses(plain.skeleton, from, to, 0.4), 1e-12);
  });
});
