/** Several roots of one file as one Acclaim skeleton. */
import { expect, it } from 'vitest';
import { eachFrame } from '../../../src/evaluate/bake.ts';
import { bareCharacter } from '../../../src/evaluate/bare-character.ts';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { openFiles } from '../../../src/files/open/open-files.ts';
import { outputsOf } from '../../../src/files/save/conversion.ts';
import { acclaimRootsCopies } from '../../../src/files/save/copies.ts';
import { type Character, EMPTY_DOCUMENT } from '../../../src/model/document.ts';
import { DEFAULT_SPACE } from '../../../src/model/space.ts';
import { read } from '../../formats/read-in-pieces.ts';
import { readAmcText, writtenText } from '../../helpers/acclaim.ts';
import { expectClose } from '../../helpers/close.ts';

const ROOT = (name: string, x: number) => `ROOT ${name}
{
OFFSET ${x} 1 0
CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
JOINT arm
{
OFFSET 0 2 1
CHANNELS 3 Zrotation Xrotation Yrotation
End Site
{
OFFSET 0 0 3
}
}
}
`;
const ROW = (f: number) => [f, 1 + f, 0.5, 10 * f, 5, -f, 20, f, 3 * f];
const BVH = `HIERARCHY
${ROOT('a', 0)}${ROOT('b', 5)}MOTION
Frames: 4
Frame Time: 0.025
${[0, 1, 2, 3].map((f) => [...ROW(f), ...ROW(7 - f)].join(' ')).join('\n')}
`;

function roots(): readonly Character[] {
  const { value } = read('two.bvh', BVH);
  if (!value) throw new Error('It was not read.');
  const { document } = openFiles(EMPTY_DOCUMENT, [
    { ...value, source: { name: 'two.bvh', path: 'two.bvh', bytes: 1 } },
  ]);
  // These are no persons: nothing of the file tells which axis is up.
  return document.characters.map((character) => ({ ...character, space: DEFAULT_SPACE }));
}

/** Positions of joints in each frame. */
function positionsOf(character: Character): number[][] {
  const { skeleton, takes } = character;
  const samples = takes[0]?.samples;
  if (!skeleton || !samples) throw new Error('It has no samples.');
  const world = new Float64Array(16 * skeleton.joints.length);
  const all: number[][] = [];
  eachFrame(character, samples, (dofs) => {
    worldMatrices(compileSkeleton(skeleton), dofs, world);
    all.push(skeleton.joints.flatMap((_, j) => [...world.subarray(16 * j + 12, 16 * j + 15)]));
  });
  return all;
}

it('they are bones with six DOFs below a root that stays at 0, and move as before', async () => {
  const characters = roots();
  const copies = acclaimRootsCopies(characters, {}, 'two') ?? [];
  expect(copies.map(({ name }) => name)).toEqual(['two.asf', 'two.amc']);
  const [asf, amc] = copies.map(({ name, content }) => writtenText(content(), name));
  expect(amc.match(/^root .*$/gm)).toEqual(Array(4).fill('root 0 0 0 0 0 0'));
  expect(asf).toContain('dof tx ty tz rx ry rz');
  const { value } = await readAmcText(amc, asf, ['two.amc', 'two.asf']);
  if (!value) throw new Error('It was not read.');
  expect(value.skeleton.joints.map(({ name, parent }) => [name, parent])).toEqual([
    ['root', -1],
    ['a', 0],
    ['arm', 1],
    ['b', 0],
    ['arm_2', 3],
  ]);
  const [a, b] = characters.map(positionsOf);
  positionsOf(bareCharacter(value.skeleton, value.take)).forEach((frame, f) => {
    expectClose(frame, [0, 0, 0, ...a[f], ...b[f]], 1e-6);
  });
  expect(outputsOf(characters, 'asf').map(({ name }) => name)).toEqual(['two.asf', 'two.amc']);
});

it('those of other frames, and skeletons of Acclaim, are not joined', () => {
  const [a, b] = roots();
  const [take] = b.takes;
  const { samples } = take;
  const shorter = samples && { ...take, samples: { ...samples, frameCount: 3 } };
  expect(acclaimRootsCopies([a, shorter ? { ...b, takes: [shorter] } : b], {}, 'two')).toBeUndefined();
});
