/** Commands that add, remove and reparent joints: `edit/commands/rig.ts`. */
import { describe, expect, it } from 'vitest';
import { documentIn } from '../../../src/edit/change.ts';
import { addJoint, createRig, removeJoint, reparentJoint } from '../../../src/edit/commands/rig.ts';
import { setMotion, setOffset } from '../../../src/edit/commands/rig-joint.ts';
import { provideSources } from '../../../src/edit/follow/sources.ts';
import { Store } from '../../../src/edit/store.ts';
import { poseAt } from '../../../src/evaluate/pose.ts';
import { saveCharacter } from '../../../src/files/save/saving.ts';
import { readSkel } from '../../../src/formats/skel/read.ts';
import { readSkin } from '../../../src/formats/skin/read.ts';
import { RADIANS_PER_DEGREE } from '../../../src/math/degrees.ts';
import { type Character, isBvh } from '../../../src/model/document.ts';
import { DEFAULT_BOX, type Motion, NO_BOX, type Skeleton, UNLIMITED } from '../../../src/model/skeleton/skeleton.ts';
import { followingSamples, keysOf, restChannel, SAMPLED } from '../../../src/model/takes/take.ts';
import { character, documentOf, skeleton, skin, takeOfValues } from '../../helpers/builders.ts';
import { describeShared, sharedBytes } from '../../helpers/shared.ts';
import { BODY, body, done, jointsOf, NEAR, named, namesIn, of, worldOf } from './body.ts';

describe('rig.create', () => {
  it('rig.create makes a character of one joint, which is selected', () => {
    const store = new Store(documentOf());
    store.apply(createRig, { name: 'crab' });
    expect(store.document.characters.map(({ id, name }) => [id, name])).toEqual([['c1', 'crab']]);
    expect(store.document.charactersMade).toBe(1);
    expect(store.selection).toEqual({ characterId: 'c1', joint: 0 });
    expect(namesIn(store.document.characters[0])).toEqual(['root']);
    expect(saveCharacter(store.document.characters[0], 'skel')[0].text).toContain('balljoint root');
  });

  it('numbers unnamed ones', () => {
    const store = new Store();
    for (let i = 0; i < 3; i++) store.apply(createRig, {});
    const made = store.document.characters;
    expect(made.map(({ name }) => name)).toEqual(['character', 'character2', 'character3']);
    expect(made.map(({ skeleton }) => skeleton?.name)).toEqual(['character', 'character2', 'character3']);
  });

  it('replaces the opening example, as files do, and is placed beside others', () => {
    const sample = { ...body(), isOpeningSample: true, charactersMade: 1 };
    expect(documentIn(createRig.run(sample, {})).characters.map(({ id }) => id)).toEqual(['c2']);
    const beside = documentIn(createRig.run({ ...sample, isOpeningSample: false }, {}));
    expect(beside.characters[1].placements[0].position[0]).toBeGreaterThan(0);
  });

  it('begins the skeleton of a skin that waits for one', () => {
    const waiting = { ...character({ skins: [skin()] }), skeleton: undefined, pose: [0, 0, 0] };
    const { skeleton: _none, ...alone } = waiting;
    const made = done(createRig, documentOf(alone), { characterId: 'c1' });
    expect(namesIn(made)).toEqual(['root']);
    expect(made.pose.length).toBe(6);
    expect(() => createRig.run(body(), { characterId: 'c1' })).toThrow('already has a skeleton');
  });
});

describe('rig.addJoint', () => {
  it('a child of a joint without a box has none, of one with a box it has the default one', () => {
    const boxes = [NO_BOX, DEFAULT_BOX, { min: [0, 0, 0], max: [1, 2, 3] } as const].map((box) => {
      const alone = documentOf(character({ skeleton: { name: 'hero', joints: [{ ...named(-1, 'hip'), box }] } }));
      return jointsOf(done(addJoint, alone, { characterId: 'c1', parent: 0 }))[1].box;
    });
    expect(boxes).toEqual([NO_BOX, DEFAULT_BOX, DEFAULT_BOX]);
  });

  it('adds a child behind the others, continuing the bone, selected', () => {
    const store = new Store(body());
    store.apply(addJoint, { characterId: 'c1', parent: 1 });
    const [made] = store.document.characters;
    expect(namesIn(made)).toEqual(['hip', 'thigh', 'knee', 'joint4', 'tail']);
    expect(jointsOf(made)[3]).toMatchObject({ parent: 1, offset: [0, 1, 0], motion: { kind: 'ball', order: 'xyz' } });
    expect(store.selection).toEqual({ characterId: 'c1', joint: 3 });
    expect(store.undoLabel).toBe('Add joint under thigh');
  });

  it('continues the numbering of its parent', () => {
    const spine = documentOf(character({ skeleton: { name: 'x', joints: [named(-1, 'spine09')] } }));
    expect(namesIn(done(addJoint, spine, { characterId: 'c1', parent: 0 }))).toEqual(['spine09', 'spine10']);
  });

  it('takes pose, takes, samples, couples, pins and weights behind it along', () => {
    const coupled = { ...BODY, joints: [...BODY.joints] };
    coupled.joints[3] = { ...BODY.joints[3], couples: [{ dof: 'rx', joint: 2, follows: 'ry', gain: 1, offset: 0 }] };
    coupled.joints[0] = { ...BODY.joints[0], couples: [{ dof: 'rz', joint: 3, follows: 'rz', gain: 1, offset: 0 }] };
    const pose = Array.from({ length: 15 }, (_, d) => d);
    const samples = {
      frameCount: 2,
      frameSeconds: 1,
      startSeconds: 0,
      firstChannel: 9,
      values: Float64Array.from({ length: 12 }, (_, i) => i),
      scales: new Float64Array(6).fill(RADIANS_PER_DEGREE),
      interpolation: 'linear' as const,
    };
    const sampled = {
      ...takeOfValues('walk', []),
      channels: followingSamples(pose.map(restChannel), samples),
      samples,
    };
    const made = done(
      addJoint,
      documentOf(
        character({
          skeleton: coupled,
          pose,
          takes: [takeOfValues('hero_anim', pose), sampled],
          shownTake: 0,
          skins: [skin('hero', 3)],
          unkeyed: { timeSeconds: 0, dofs: [2, 12], values: [7, 8] },
          poses: [{ name: 'wave', values: pose }],
          ik: {
            pins: [{ id: 1, joint: 3, point: [0, 0, 0], weight: 1, holdsOrientation: false }],
            stiff: [{ joint: 2 }, { joint: 3, stiffness: 4 }],
            rootIsFree: true,
          },
        }),
      ),
      { characterId: 'c1', parent: 2, offset: [0, -1, 0] },
    );
    const grown = [...pose.slice(0, 12), 0, 0, 0, ...pose.slice(12)];
    expect(made.pose).toEqual(grown);
    expect(made.poses?.[0].values).toEqual(grown);
    expect(made.takes[0].channels.map((c) => (c.kind === 'rest' ? c.value : keysOf(c).values[0]))).toEqual(grown);
    expect(made.takes[1].samples?.firstChannel).toBe(9);
    expect([...(made.takes[1].samples?.values ?? [])]).toEqual([
      0, 1, 2, 0, 0, 0, 3, 4, 5, 6, 7, 8, 0, 0, 0, 9, 10, 11,
    ]);
    expect(made.unkeyed).toEqual({ timeSeconds: 0, dofs: [2, 15], values: [7, 8] });
    expect(made.ik?.pins[0].joint).toBe(4);
    expect(made.ik?.stiff).toEqual([{ joint: 2 }, { joint: 4, stiffness: 4 }]);
    expect(jointsOf(made).map(({ couples }) => couples?.[0].joint)).toEqual([4, undefined, undefined, undefined, 2]);
    expect([...(made.skins[0].attachments?.joints ?? [])]).toEqual([4, 4, 4]);
    expect(made.skins[0].bindings.length).toBe(16 * 5);
  });

  it('binds the joint so that vertices assigned to it stay where its parent has them', () => {
    const made = done(addJoint, body({ skins: [skin('hero', 3)] }), {
      characterId: 'c1',
      parent: 1,
      offset: [2, 3, 4],
    });
    // The parent's is the identity.
    expect([...made.skins[0].bindings.slice(48, 64)]).toEqual([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 2, 3, 4, 1]);
  });
});

const ZXY: Motion = { kind: 'bvh', channels: ['rz', 'rx', 'ry'], positions: 'replace' };
const ROOT: Motion = { kind: 'bvh', channels: ['tx', 'ty', 'tz', 'rx', 'ry', 'rz'], positions: 'replace' };
const LEG: Skeleton = {
  name: 'leg',
  joints: [
    named(-1, 'hips', { offset: [0, 0, 0], motion: ROOT, limits: Array(6).fill(UNLIMITED), pose: [0, 0, 0, 0, 0, 0] }),
    named(0, 'thigh', { motion: ZXY, offset: [1, 0, 0] }),
    named(1, 'shin', { motion: ZXY, offset: [0, -4, 0], endSites: [[0, -3, 0]] }),
  ],
};
const leg = () => documentOf(character({ skeleton: LEG, pose: [1, 2, 3, 0, 0, 0, 0.1, 0.2, 0.3, 0, 0, 0] }));

describe('joints of BVH', () => {
  it('joints of BVH are added in the order of their parents, in place of the End Site, and can still be saved as .bvh', () => {
    const made = done(addJoint, leg(), { characterId: 'c1', parent: 2, name: 'foot' });
    expect(isBvh(made)).toBe(true);
    expect(jointsOf(made)[2].endSites).toBeUndefined();
    expect(jointsOf(made)[3]).toMatchObject({ motion: ZXY, offset: [0, -3, 0], endSites: [[0, -3, 0]] });
    expect(saveCharacter(made, 'bvh')[0].text).toContain('JOINT foot');
  });

  it('leave an End Site where the last child was', () => {
    const made = done(removeJoint, leg(), { ...of(2), children: 'too' });
    expect(jointsOf(made)[1].endSites).toEqual([[0, -4, 0]]);
  });

  it('move by their position channels if those replace the offset', () => {
    const made = done(setOffset, leg(), { ...of(0), offset: [0, 10, 0], children: 'follow' });
    expect(made.pose.slice(0, 3)).toEqual([1, 12, 3]);
    expect(jointsOf(made)[0].pose.slice(0, 3)).toEqual([0, 10, 0]);
    expect([...worldOf(made, 0).slice(12, 15)]).toEqual([1, 12, 3]);
  });
});

describe('a root of BVH', () => {
  it('a root of BVH with some position channels beside the root translation moves once, not twice', () => {
    const root = named(-1, 'hips', {
      offset: [0, 0, 2],
      motion: { kind: 'bvh', channels: ['tz'], positions: 'replace' },
    });
    const hips = { name: 'x', joints: [{ ...root, limits: [UNLIMITED], pose: [2] }] };
    const made = done(setOffset, documentOf(character({ skeleton: hips, pose: [0, 0, 1, 5] })), {
      ...of(0),
      offset: [0, 0, 3],
      children: 'follow',
    });
    expect(made.pose).toEqual([0, 0, 1, 6]);
  });

  it('a root of BVH stays in place when it becomes another joint, and gives its channels to the root translation', () => {
    const before = leg();
    const made = done(setMotion, before, { ...of(0), motion: { kind: 'ball', order: 'xyz' } });
    expect(made.pose.slice(0, 6)).toEqual([1, 2, 3, 0, 0, 0]);
    expect([...worldOf(made, 2)]).toEqual([...worldOf(before.characters[0], 2)]);
  });
});

describe('rig.remove', () => {
  it('gives vertices of a joint to its parent, and merges what they have of both', () => {
    const attachments = {
      start: Uint32Array.of(0, 3, 4, 5),
      joints: Uint32Array.of(2, 3, 1, 2, 3),
      weights: Float64Array.of(0.5, 0.25, 0.25, 1, 1),
    };
    const made = done(removeJoint, body({ skins: [skin('hero', 3, { attachments })] }), { ...of(2), children: 'stay' });
    expect(made.skins[0].attachments).toEqual({
      start: Uint32Array.of(0, 2, 3, 4),
      joints: Uint32Array.of(1, 2, 1, 2),
      weights: Float64Array.of(0.75, 0.25, 1, 1),
    });
    expect(made.skins[0].bindings.length).toBe(16 * 3);
  });

  it('rig.remove keeps children in place, with their own channels', () => {
    const pose = [0, 0, 0, 0, 0, 0.5, 0.25, 0, 0, 0, 0.75, 0, 0, 0, 0];
    const before = body({ pose });
    const made = done(removeJoint, before, { ...of(1), children: 'stay' });
    expect(namesIn(made)).toEqual(['hip', 'knee', 'tail']);
    const [was, is] = [worldOf(before.characters[0], 2), worldOf(made, 1)];
    is.forEach((value, k) => {
      expect(value).toBeCloseTo(was[k], 9);
    });
  });

  it('lets couples, pins and pairs of others go with the joint', () => {
    const followed = { ...BODY, joints: [...BODY.joints] };
    followed.joints[3] = { ...BODY.joints[3], couples: [{ dof: 'rx', joint: 2, follows: 'ry', gain: 1, offset: 0 }] };
    const hero = character({
      skeleton: followed,
      takes: [takeOfValues('hero_anim', Array(15).fill(0))],
      shownTake: 0,
      ik: {
        pins: [{ id: 1, joint: 2, point: [0, 0, 0], weight: 1, holdsOrientation: false }],
        stiff: [],
        rootIsFree: true,
      },
    });
    const { name, takes, pose, clampsToLimits, timeOffsetSeconds } = hero;
    const bee: Character = {
      ...character({ id: 'c2' }),
      driver: {
        sourceId: 'c1',
        source: { name, skeleton: followed, take: takes[0], pose, clampsToLimits, timeOffsetSeconds },
        pairs: [
          { target: 0, source: 2 },
          { target: 1, source: 3 },
        ],
        options: { reference: 'rest', plantsFeet: false },
      },
    };
    // Here no command makes the driver.
    provideSources();
    const store = new Store(documentOf(hero, bee));
    store.apply(removeJoint, { ...of(2), children: 'too' });
    const [made, follower] = store.document.characters;
    expect(jointsOf(made)[2].couples).toBeUndefined();
    expect(made.ik).toBeUndefined();
    expect(follower.driver?.pairs).toEqual([{ target: 1, source: 2 }]);
    expect(follower.driver?.source.skeleton).toBe(made.skeleton);
    expect(store.selection).toEqual({ characterId: 'c1', joint: 1 });
  });

  it('refuses to leave nothing, and lets an only child be the root', () => {
    expect(() => removeJoint.run(body(), { ...of(0), children: 'too' })).toThrow('Remove the character');
    expect(() => removeJoint.run(body(), { ...of(0), children: 'stay' })).toThrow('has 2 children');
    const chain = documentOf(character({ skeleton: skeleton(3) }));
    const made = done(removeJoint, chain, { ...of(0), children: 'stay' });
    expect(jointsOf(made).map(({ parent }) => parent)).toEqual([-1, 0]);
    expect([...worldOf(made, 0).slice(12, 15)]).toEqual([0, 2, 0]);
  });
});

describe('rig.reparent', () => {
  it('rig.reparent keeps the pivot and, where the rule allows it, how the joint is turned', () => {
    const pose = [0, 0, 0, 0.2, 0, 0, 0, 0.3, 0, 0.1, 0.2, 0.3, 0, 0, 1];
    const before = body({ pose });
    const made = done(reparentJoint, before, { ...of(2), parent: 3 });
    expect(namesIn(made)).toEqual(['hip', 'thigh', 'tail', 'knee']);
    const [was, is] = [worldOf(before.characters[0], 2), worldOf(made, 3)];
    was.forEach((value, k) => {
      expect(Math.abs(value - is[k])).toBeLessThan(NEAR);
    });
  });

  it('rig.reparent keeps the pivot only where keys drive how it is turned', () => {
    const turned = takeOfValues('hero_anim', [0, 0, 0, 0.2, 0, 0, 0, 0.3, 0, 0.1, 0.2, 0.3, 0, 0, 1]);
    const before = body({ takes: [turned], shownTake: 0 });
    const made = done(reparentJoint, before, { ...of(2), parent: 3 });
    expect(made.takes[0].channels.slice(12)).toEqual(turned.channels.slice(9, 12));
    const [was, is] = [worldOf(before.characters[0], 2), worldOf(made, 3)];
    for (let k = 12; k < 15; k++) expect(Math.abs(was[k] - is[k])).toBeLessThan(NEAR);
    expect(Math.abs(was[0] - is[0])).toBeGreaterThan(0.01);
  });

  it('rig.reparent keeps a constant channel constant when it ends up between sampled ones', () => {
    const pose = Array.from({ length: 15 }, (_, d) => (d < 12 ? 0 : 0.5));
    const walk = {
      ...takeOfValues('walk', []),
      channels: pose.map((rest, c) => (c >= 6 && c < 12 ? SAMPLED : restChannel(rest))),
      samples: {
        frameCount: 2,
        frameSeconds: 1,
        startSeconds: 0,
        firstChannel: 6,
        values: new Float64Array(12).fill(10),
        scales: new Float64Array(6).fill(RADIANS_PER_DEGREE),
        interpolation: 'linear' as const,
      },
    };
    const made = done(reparentJoint, body({ pose, takes: [walk], shownTake: 0 }), { ...of(2), parent: 3 });
    const shown = new Float64Array(15);
    poseAt(made, 0, shown);
    const ten = 10 * RADIANS_PER_DEGREE;
    [0, 0, 0, 0, 0, 0, ten, ten, ten, 0.5, 0.5, 0.5, ten, ten, ten].forEach((value, dof) => {
      expect(shown[dof]).toBeCloseTo(value, 12);
    });
  });

  it('sorts siblings, and changes nothing if the joint is there already', () => {
    const document = body();
    expect(namesIn(done(reparentJoint, document, { ...of(3), parent: 0, before: 1 }))).toEqual([
      ...['hip', 'tail', 'thigh', 'knee'],
    ]);
    expect(reparentJoint.run(document, { ...of(3), parent: 0 })).toBe(document);
    expect(reparentJoint.run(document, { ...of(1), parent: 0, before: 3 })).toBe(document);
  });

  it('refuses to reparent a joint to its descendant', () => {
    expect(() => reparentJoint.run(body(), { ...of(1), parent: 2 })).toThrow(
      'can’t be parented to its descendant knee',
    );
    expect(() => reparentJoint.run(body(), { ...of(0), parent: 2 })).toThrow('is the root');
    expect(() => reparentJoint.run(body(), { ...of(2), parent: 0, before: 2 })).toThrow('not a child of hip');
  });
});

describeShared('the wasp', () => {
  const read = () => {
    const [own] = readSkel(sharedBytes('data/cse169/wasp.skel'), 'wasp.skel').value ?? [];
    const skinned = readSkin(sharedBytes('data/cse169/wasp.skin'), 'wasp.skin').value;
    if (!own || !skinned) throw new Error('the wasp can not be read');
    return documentOf(character({ skeleton: own, skins: [skinned] }));
  };

  it('the wasp is saved byte for byte after a joint was added and removed again', () => {
    const document = read();
    const before = [...saveCharacter(document.characters[0], 'skel'), ...saveCharacter(document.characters[0], 'skin')];
    const store = new Store(document);
    store.apply(addJoint, { characterId: 'c1', parent: 4, skin: 'stays' });
    const [added] = store.document.characters;
    expect(saveCharacter(added, 'skin')[0].text).not.toBe(before[1].text);
    store.apply(removeJoint, { ...of(store.selection.joint ?? -1), children: 'too', skin: 'stays' });
    const [again] = store.document.characters;
    const after = [...saveCharacter(again, 'skel'), ...saveCharacter(again, 'skin')];
    expect(after.map(({ text }) => text)).toEqual(before.map(({ text }) => text));
  });
});
