/** Commands that change one joint: `edit/commands/rig-joint.ts`. */
import { describe, expect, it } from 'vitest';
import { documentIn } from '../../../src/edit/change.ts';
import { addJoint } from '../../../src/edit/commands/rig.ts';
import {
  renameJoint,
  setBox,
  setFilePose,
  setLength,
  setMotion,
  setOffset,
} from '../../../src/edit/commands/rig-joint.ts';
import type { Character } from '../../../src/model/document.ts';
import { type Joint, type Motion, type Skeleton, UNLIMITED } from '../../../src/model/skeleton/skeleton.ts';
import { keysOf } from '../../../src/model/takes/take.ts';
import { character, documentOf, takeOfValues } from '../../helpers/builders.ts';
import { BODY, body, done, jointsOf, NEAR, named, namesIn, of, worldOf } from './body.ts';

describe('rig.rename', () => {
  it('changes one joint, and nothing if it has that name', () => {
    const document = body();
    const made = done(renameJoint, document, { ...of(0), name: 'pelvis {1}' });
    expect(namesIn(made)[0]).toBe('pelvis {1}');
    expect(jointsOf(made)[1]).toBe(BODY.joints[1]);
    expect(renameJoint.label(document, { ...of(0), name: 'pelvis' })).toBe('Rename hip to pelvis');
    expect(renameJoint.run(document, { ...of(0), name: 'hip' })).toBe(document);
    expect(() => renameJoint.run(document, { ...of(9), name: 'a' })).toThrow('no joint number 9');
    expect(() => renameJoint.run(documentOf(), { ...of(0), name: 'a' })).toThrow('no character');
  });
});

describe('rig.setMotion', () => {
  const pose = [1, 2, 3, 0.1, 0.2, 0.3, ...Array(9).fill(0)];

  it('rig.setMotion turns the root translation into the DOFs of a root that moves by itself, and back', () => {
    const free: Motion = { kind: 'free', order: 'xyz' };
    const before = body({ pose, takes: [takeOfValues('hero_anim', pose)], shownTake: 0 });
    const made = done(setMotion, before, { ...of(0), motion: free });
    expect(made.pose).toEqual(pose);
    expect(made.takes[0].channels).toEqual(before.characters[0].takes[0].channels);
    expect([...worldOf(made, 3)]).toEqual([...worldOf(before.characters[0], 3)]);
    const back = done(setMotion, documentOf(made), { ...of(0), motion: { kind: 'ball', order: 'xyz' } });
    expect(back.pose).toEqual(pose);
    expect(back.skeleton?.joints[0].limits.length).toBe(3);
  });

  it('rig.setMotion keeps pose, limits and channels of the DOFs that both have', () => {
    const limited = { ...BODY, joints: [...BODY.joints] };
    limited.joints[1] = { ...BODY.joints[1], limits: [UNLIMITED, { min: -1, max: 1 }, UNLIMITED] };
    const values = pose.map((_, d) => d);
    const made = done(
      setMotion,
      body({ skeleton: limited, pose: values, takes: [takeOfValues('a', values)], shownTake: 0 }),
      {
        ...of(1),
        motion: { kind: 'universal', order: 'yz' },
      },
    );
    expect(made.pose).toEqual([0, 1, 2, 3, 4, 5, 7, 8, 9, 10, 11, 12, 13, 14]);
    expect(made.takes[0].channels.map((c) => keysOf(c).values[0])).toEqual(made.pose);
    expect(jointsOf(made)[1].limits).toEqual([{ min: -1, max: 1 }, UNLIMITED]);
  });

  it('rig.setMotion turns a hinge into a ball with the same rotation', () => {
    const hinged = { ...BODY, joints: [...BODY.joints] };
    hinged.joints[1] = named(0, 'thigh', {
      motion: { kind: 'hinge', axis: [0, 0, -2] },
      limits: [UNLIMITED],
      pose: [0.5],
    });
    const before = documentOf(character({ skeleton: hinged }));
    const made = done(setMotion, before, { ...of(1), motion: { kind: 'ball', order: 'xyz' } });
    expect(made.pose.slice(6, 9).map((v) => Number(v.toFixed(9)) + 0)).toEqual([0, 0, -0.5]);
    const [was, is] = [worldOf(before.characters[0], 2), worldOf(made, 2)];
    was.forEach((value, k) => {
      expect(Math.abs(value - is[k])).toBeLessThan(NEAR);
    });
  });

  it('changes nothing if the motion is the same, and refuses invalid ones', () => {
    const document = body();
    expect(setMotion.run(document, { ...of(1), motion: { kind: 'ball', order: 'xyz' } })).toBe(document);
    const set = (motion: object) => () => setMotion.run(document, { ...of(1), motion: motion as Motion });
    expect(set({ kind: 'hinge', axis: [0, 0, 0] })).toThrow('0 0 0 has none');
    expect(set({ kind: 'ball', order: 'xxy' })).toThrow('"motion.order" must be one of');
    expect(set({ kind: 'wheel' })).toThrow('"motion.kind" must be one of');
    expect(set({ kind: 'compound', dofs: ['tx', 'tx'] })).toThrow('lists tx twice');
  });
});

describe('the axis-angle form', () => {
  const hinge = (parent: number, offset: Joint['offset'], length: number) =>
    named(parent, '', { motion: { kind: 'hinge', axis: [0, 0, 1] }, limits: [UNLIMITED], pose: [0], offset, length });
  const arm: Skeleton = {
    name: 'arm',
    form: 'axis-angle',
    joints: [hinge(-1, [0, 0, 0], 2), hinge(0, [0, 2, 0], 1)],
  };
  const document = documentOf(character({ skeleton: arm }));

  it('the axis-angle form is kept by a child at the tip, and by a bone whose children move along', () => {
    const grown = done(addJoint, document, { characterId: 'c1', parent: 1 });
    expect(jointsOf(grown)[2]).toMatchObject({ name: '', offset: [0, 1, 0], length: 1, motion: { axis: [0, 0, 1] } });
    expect(grown.skeleton?.form).toBe('axis-angle');
    const longer = done(setLength, document, { ...of(0), length: 3 });
    expect(jointsOf(longer)[1].offset).toEqual([0, 3, 0]);
    expect(longer.skeleton?.form).toBe('axis-angle');
  });

  it('the axis-angle form is lost by what it can not store', () => {
    expect(
      done(setOffset, document, { ...of(1), offset: [1, 2, 0], children: 'follow' }).skeleton?.form,
    ).toBeUndefined();
    expect(done(setLength, document, { ...of(0), length: null }).skeleton?.form).toBeUndefined();
    expect(done(setMotion, document, { ...of(1), motion: { kind: 'fixed' } }).skeleton?.form).toBeUndefined();
  });

  it('leaves its root in place when it is given up, unless it was said to travel', () => {
    const move = { ...of(1), offset: [1, 2, 0], children: 'follow' } as const;
    const said = (ik: Character['ik']) =>
      done(setOffset, documentOf(character({ skeleton: arm, ...(ik && { ik }) })), move).ik;
    expect(said(undefined)).toEqual({ pins: [], stiff: [], rootIsFree: false });
    expect(said({ pins: [], stiff: [{ joint: 1 }], rootIsFree: false })).toEqual({
      pins: [],
      stiff: [{ joint: 1 }],
      rootIsFree: false,
    });
    // What every skeleton of the other form does is nothing to be written down.
    expect(said({ pins: [], stiff: [], rootIsFree: true })).toBeUndefined();
    // The form is kept, and so is what it means.
    expect(done(setLength, document, { ...of(0), length: 3 }).ik).toBeUndefined();
  });
});

describe('rig.setLength', () => {
  const bone = { ...BODY, joints: BODY.joints.map((one, j) => (j === 1 ? { ...one, length: 2 } : one)) };
  const pin = (id: number, joint: number, y: number) =>
    ({ id, joint, point: [0, y, 0], weight: 1, holdsOrientation: false }) as const;
  const pinsAfter = (length: number | null, ...pins: readonly ReturnType<typeof pin>[]) =>
    done(setLength, documentOf(character({ skeleton: bone, ik: { pins, stiff: [], rootIsFree: true } })), {
      ...of(1),
      length,
    }).ik?.pins;

  it('takes pins at the tip along, and no others', () => {
    expect(pinsAfter(3, pin(1, 1, 2), pin(2, 1, 1), pin(3, 2, 2))).toEqual([pin(1, 1, 3), pin(2, 1, 1), pin(3, 2, 2)]);
    expect(pinsAfter(null, pin(1, 1, 2))).toEqual([pin(1, 1, 2)]);
  });

  it('leaves one pin where two would hold one point', () => {
    expect(pinsAfter(3, pin(1, 1, 2), pin(2, 1, 3))).toEqual([pin(2, 1, 3)]);
  });
});

describe('rig.setBox, rig.setLength and rig.setFilePose', () => {
  it('change only their joint, and nothing if it is so already', () => {
    const document = body({ pose: [0, 0, 0, ...Array(12).fill(0.5)] });
    const box = { min: [0, 0, 0], max: [1, 1, 1] } as const;
    expect(jointsOf(done(setBox, document, { ...of(2), box }))[2].box).toEqual(box);
    expect(setBox.run(document, { ...of(2), box: BODY.joints[2].box })).toBe(document);
    expect(setLength.run(document, { ...of(2), length: null })).toBe(document);
    expect(() => setLength.run(document, { ...of(2), length: -1 })).toThrow('0 or more');
    const one = done(setFilePose, document, { ...of(2), from: 'shown' });
    expect(jointsOf(one).map(({ pose }) => pose[0])).toEqual([0, 0, 0.5, 0]);
    const all = documentIn(setFilePose.run(document, { characterId: 'c1', from: 'shown' }));
    expect(jointsOf(all.characters[0]).map(({ pose }) => pose[0])).toEqual([0.5, 0.5, 0.5, 0.5]);
    expect(all.characters[0].pose).toBe(document.characters[0].pose);
    const back = done(setFilePose, all, { characterId: 'c1', from: 'rest' });
    expect(jointsOf(back).map(({ pose }) => pose[0])).toEqual([0, 0, 0, 0]);
    expect(setFilePose.run(document, { characterId: 'c1', from: 'rest' })).toBe(document);
  });
});
