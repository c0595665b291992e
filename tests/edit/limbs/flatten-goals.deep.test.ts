/** Takes with goals of limbs as takes without, which move the same, and their files. */
import fc from 'fast-check';
import { expect, it } from 'vitest';
import { flattened } from '../../../src/edit/layers/flatten.ts';
import { solvedTake } from '../../../src/edit/limbs/flatten-goals.ts';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../../src/evaluate/pose.ts';
import { joinLayers } from '../../../src/files/open/layers.ts';
import { openFiles } from '../../../src/files/open/open-files.ts';
import { layersCopies } from '../../../src/files/save/layers.ts';
import { outputOf, savedFileOf } from '../../../src/files/save/output.ts';
import { saveCharacter } from '../../../src/files/save/saving.ts';
import { type Character, EMPTY_DOCUMENT } from '../../../src/model/document.ts';
import { byFileName } from '../../../src/model/files.ts';
import { CRAB, crabWith, goalOf, LIMBS, poses, SIZE } from '../../evaluate/limbs/crab.ts';
import { expectClose } from '../../helpers/close.ts';
import { parsed } from '../../helpers/parsed.ts';
import { channelOf } from '../keys/channels.ts';

const TOLERANCE = 1e-3;
const REACHED = channelOf([
  [0, 0.1, 'flat'],
  [1, -0.3, 'smooth'],
  [2, 0.2, 'flat'],
]);
/** The leg and the tail follow a point that moves; the others are FK. */
const GOALS = ['leg', 'tail'].map((limb) => {
  const goal = goalOf(limb, { tx: 0.3, ty: 0, tz: 0.2, rx: 0.2, ry: -0.4 });
  return { ...goal, channels: { ...goal.channels, ty: { curve: REACHED } } };
});

function worldOf(own: Character, time: number): Float64Array {
  const dofs = new Float64Array(dofCountOf(own));
  poseAt(own, time, dofs);
  const compiled = compileSkeleton(CRAB);
  const world = new Float64Array(16 * compiled.jointCount);
  worldMatrices(compiled, dofs, world);
  return world;
}

/** Other forms of a rotation are the same pose; up to five joints above are each within the tolerance. */
function expectSamePoses(a: Character, b: Character, times: readonly number[]): void {
  for (const time of times) {
    expectClose([...worldOf(a, time)], [...worldOf(b, time)], 10 * TOLERANCE * SIZE, `at ${time} s`);
  }
}

/** Of the file. */
const REST = [0, 0, 0, ...CRAB.joints.flatMap(({ pose }) => pose)];
const FRAMES = Array.from({ length: 61 }, (_, f) => f / 30);

it('keys at whole frames move the limbs as the goals do, whatever the pose beneath, and leave all else alone', () => {
  fc.assert(
    fc.property(poses, (values) => {
      const crab = crabWith(values, GOALS);
      const [take] = crab.takes;
      const plain = solvedTake(crab, take, { tolerance: TOLERANCE });
      expect(plain).not.toHaveProperty('goals');
      expectSamePoses({ ...crab, takes: [plain] }, crab, FRAMES);
      const joints = new Set(
        LIMBS.filter(({ name }) => name === 'leg' || name === 'tail').flatMap((limb) => limb.joints),
      );
      let dof = 3;
      CRAB.joints.forEach(({ pose }, joint) => {
        for (let k = 0; k < pose.length; k++, dof++) {
          const channel = plain.channels[dof];
          if (!joints.has(joint)) expect(channel).toBe(take.channels[dof]);
          else if (channel.kind === 'keys') {
            expect(Array.from(channel.times, (time) => Math.abs(30 * time - Math.round(30 * time)))).toEqual(
              Array.from(channel.times, () => expect.closeTo(0, 9)),
            );
          }
        }
      });
    }),
    { numRuns: 10 },
  );
});

it('a take without goals stays the same object, and goals of no limb leave the channels', () => {
  const [bare] = crabWith(REST, []).takes;
  expect(solvedTake(crabWith(REST, []), bare)).toBe(bare);
  const lost = crabWith(REST, [goalOf('nobody', { tx: 1 })]);
  expect(solvedTake(lost, lost.takes[0]).channels).toEqual(lost.takes[0].channels);
  expect(flattened(bare, CRAB).take).toBe(bare);
});

it('the files of a take with goals are its base, the plain file and the JSON, and are read as the same take', () => {
  const crab = crabWith(REST, GOALS);
  const files = layersCopies(crab).map((copy) => savedFileOf(outputOf(copy)));
  expect(files.map(({ name }) => name)).toEqual(['walk.base.anim', 'walk.anim', 'walk.limbs.json']);
  const skeleton = [...saveCharacter(crab, 'skel'), ...saveCharacter(crab, 'limbs')];
  const all = [...skeleton, ...files].map(({ name, text }) => parsed(name, text));
  const { files: joined, diagnostics } = joinLayers(all, 'edit', byFileName);
  expect(diagnostics).toEqual([]);
  const { document, diagnostics: more } = openFiles(EMPTY_DOCUMENT, joined);
  expect([...more].filter(({ severity }) => severity !== 'info')).toEqual([]);
  const [opened] = document.characters;
  expectSamePoses({ ...opened, shownTake: 0 }, crab, FRAMES);
  const again = layersCopies(opened).map((copy) => savedFileOf(outputOf(copy)));
  expect(again.map(({ text }) => text)).toEqual(files.map(({ text }) => text));
  // Without the JSON, the plain file moves the same in programs that know no goals.
  const { document: other } = openFiles(
    EMPTY_DOCUMENT,
    [...skeleton, files[1]].map(({ name, text }) => parsed(name, text)),
  );
  expectSamePoses({ ...other.characters[0], shownTake: 0 }, crab, FRAMES);
});
