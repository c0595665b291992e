/** Takes with layers, goals of limbs and attachments: what counts as changed, and what other files have of them. */
import { describe, expect, it } from 'vitest';
import { withEditedTakes } from '../../../src/dataset/edited-take.ts';
import { addLayer } from '../../../src/edit/commands/beside/layers.ts';
import { keyLimb } from '../../../src/edit/commands/beside/limbs.ts';
import { Store } from '../../../src/edit/store.ts';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../../src/evaluate/pose.ts';
import { joinLayers } from '../../../src/files/open/layers.ts';
import { openFiles } from '../../../src/files/open/open-files.ts';
import { outputsOf } from '../../../src/files/save/conversion.ts';
import { changedFiles } from '../../../src/files/save/jobs.ts';
import { savedFileOf } from '../../../src/files/save/output.ts';
import { ownFiles } from '../../../src/files/save/own-files.ts';
import { SavedParts } from '../../../src/files/save/saved-parts.ts';
import { jointPose } from '../../../src/files/save/saved-poses.ts';
import { saveCharacter } from '../../../src/files/save/saving.ts';
import { partsOf } from '../../../src/model/character-parts.ts';
import { type Character, EMPTY_DOCUMENT, shownTake } from '../../../src/model/document.ts';
import { byFileName, type ParsedFile } from '../../../src/model/files.ts';
import { parsed } from '../../helpers/parsed.ts';

const LIMBS = {
  limbs: [{ name: 'leg', joints: ['thigh', 'shin', 'foot'], bend: { dof: 'rx', sign: 1 } }],
  goals: [{ limb: 'leg', space: 'world', channels: { blend: 1, tx: 0.2, ty: 0.5, tz: 0.3 } }],
};
const BVH = `HIERARCHY
ROOT hips {
  OFFSET 0 2 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT thigh { OFFSET 0.1 0 0 CHANNELS 3 Zrotation Xrotation Yrotation
  JOINT shin { OFFSET 0 -1 0 CHANNELS 3 Zrotation Xrotation Yrotation
  JOINT foot { OFFSET 0 -1 0 CHANNELS 3 Zrotation Xrotation Yrotation End Site { OFFSET 0 0 0.3 } } } }
}
MOTION
Frames: 4
Frame Time: 0.1
0 2 0 0 0 0 0 -20 0 0 30 0 0 0 0
0 2 0 0 0 0 0 -10 0 0 20 0 0 5 0
0.1 2 0 0 0 0 0 0 0 0 30 0 0 5 0
0.2 2 0 0 0 0 0 10 0 0 30 0 0 0 0
`;
const SKEL = `balljoint hips {
 offset 0 2 0
 balljoint thigh {
  offset .1 0 0
  balljoint shin {
   offset 0 -1 0
   balljoint foot {
    offset 0 -1 0
   }
  }
 }
}
`;
const channel = (keys: string) => `channel {\n extrapolate constant constant\n keys ${keys}\n}\n`;
const anim = (hips: string) =>
  `animation {\n range 0 1\n numchannels 15\n${[hips, ...Array(14).fill('1 {\n  0 0 flat flat\n }')].map(channel).join('')}}\n`;

function opened(texts: Readonly<Record<string, string>>): Character {
  const files = Object.entries(texts).map(([name, text]) => parsed(name, text));
  return openFiles(EMPTY_DOCUMENT, joinLayers(files, 'edit', byFileName).files).document.characters[0];
}

const capture = () => opened({ 'walk.bvh': BVH, 'walk.limbs.json': JSON.stringify({ base: 'walk.bvh', ...LIMBS }) });
const keyed = () =>
  opened({
    'crab.skel': SKEL,
    'walk.base.anim': anim('2 {\n  0 0 linear linear\n  1 0.3 linear linear\n }'),
    'walk.limbs.json': JSON.stringify({ base: 'walk.base.anim', ...LIMBS }),
  });

/** Where the foot is. */
function footAt(own: Character, seconds: number): readonly number[] {
  if (!own.skeleton) throw new Error('no skeleton');
  const compiled = compileSkeleton(own.skeleton);
  const dofs = new Float64Array(dofCountOf(own));
  poseAt(own, seconds, dofs);
  const world = new Float64Array(16 * compiled.jointCount);
  worldMatrices(compiled, dofs, world);
  return [...world.subarray(16 * 3 + 12, 16 * 3 + 15)];
}

/** Its foot is held where the goal is, at these seconds. */
function expectHeld(own: Character, digits: number, times = [0, 0.1, 0.3]): void {
  for (const seconds of times) {
    footAt(own, seconds).forEach((value, k) => {
      expect(value).toBeCloseTo([0.2, 0.5, 0.3][k], digits);
    });
  }
}

const read = (files: readonly { readonly name: string; readonly text: string }[]): ParsedFile[] =>
  files.map(({ name, text }) => parsed(name, text));

describe.each([
  ['motion capture', capture],
  ['keys', keyed],
])('a take of %s with a goal', (_, make) => {
  it('holds the foot', () => expectHeld(make(), 9));

  it.each(['anim', 'skel', 'rig', 'bvh'] as const)('holds it in the files of a conversion to .%s', (target) => {
    const files = read(
      outputsOf([make()], target)
        .map(savedFileOf)
        .filter(({ name }) => !/\.rig$/.test(name)),
    );
    const skel = target === 'anim' ? read(outputsOf([make()], 'skel').map(savedFileOf)) : [];
    const all = [...skel.filter(({ kind }) => kind === 'skel'), ...files];
    const [own] = openFiles(EMPTY_DOCUMENT, all).document.characters;
    expect(shownTake(own)?.goals).toBeUndefined();
    expectHeld(own, 2);
  });

  it('holds it when cropped and mirrored there and back', () => {
    const cropped = withEditedTakes(make(), { crop: { from: 0.1, to: 0.3 } });
    expect(shownTake(cropped)?.goals).toBeUndefined();
    expectHeld(cropped, 2, [shownTake(cropped)?.range[0] ?? 0]);
  });

  it('counts as changed when its goal is', () => {
    const own = make();
    const store = new Store({ ...EMPTY_DOCUMENT, characters: [own], charactersMade: 1 });
    const saved = new SavedParts();
    for (const part of partsOf(own)) saved.mark(part, jointPose(own));
    expect(saved.unsavedIn(store.document)).toEqual([]);
    store.apply(keyLimb, { characterId: own.id, limb: 0, timeSeconds: 0.2 });
    expect(saved.unsavedIn(store.document).map(({ kind }) => kind)).toContain(make === capture ? 'bvh' : 'anim');
  });
});

it('the own file of a capture with goals keeps its frames, and its copies are solved', () => {
  const [own] = saveCharacter(capture(), 'bvh');
  const [taken] = openFiles(EMPTY_DOCUMENT, read([own])).document.characters;
  expect(footAt(taken, 0.1)).toEqual(footAt({ ...taken, takes: [{ ...capture().takes[0], goals: undefined }] }, 0.1));
  const files = read(saveCharacter(capture(), 'anim'));
  expect(files.length).toBe(1);
});

it('all files of a take with layers and goals open as the same take', () => {
  const own = keyed();
  const store = new Store({ ...EMPTY_DOCUMENT, characters: [own], charactersMade: 1 });
  store.apply(addLayer, { characterId: own.id });
  const [layered] = store.document.characters;
  const files = ownFiles(layered, 'all').map(({ name, content }) => parsed(name, content));
  const again = openFiles(EMPTY_DOCUMENT, joinLayers(files, 'edit', byFileName).files).document.characters[0];
  expect(shownTake(again)?.goals?.list.length).toBe(1);
  expect(shownTake(again)?.layers?.list.length).toBe(1);
  expectHeld(again, 6);
});

it('the JSON files are written after the plain one', () => {
  const own = keyed();
  const store = new Store({ ...EMPTY_DOCUMENT, characters: [own], charactersMade: 1 });
  store.apply(addLayer, { characterId: own.id });
  const names = changedFiles(store.document, new SavedParts().unsavedIn(store.document), jointPose).map(
    ({ name }) => name,
  );
  const plain = names.indexOf('walk.anim');
  expect(plain).toBeGreaterThan(names.indexOf('walk.base.anim'));
  for (const json of names.filter((name) => /^walk\..*json$/.test(name)))
    expect(names.indexOf(json)).toBeGreaterThan(plain);
});
