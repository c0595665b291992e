import { describe, expect, it } from 'vitest';
import { CommandError } from '../../src/edit/command-error.ts';
import { setCouple } from '../../src/edit/commands/couples.ts';
import { Store } from '../../src/edit/store.ts';
import { dofCountOf, poseAt } from '../../src/evaluate/pose.ts';
import { readSkel } from '../../src/formats/skel/read.ts';
import { writeSkel } from '../../src/formats/skel/write.ts';
import type { Document } from '../../src/model/document.ts';
import { character, documentOf, skeleton } from '../helpers/builders.ts';

// Ball joints 0, 1, 2 in a chain; DOFs 0 1 2 are the root's translation, 3 4 5 its rotation.
const document = documentOf(character({ skeleton: skeleton(3), pose: [0, 0, 0, 0.5, 0, 0, 0, 0, 0, 0, 0, 0] }));
const couple = (on: Document, joint: number, dof: string, follows: { joint: number; dof: string } | null) =>
  setCouple.run(on, { characterId: 'c1', joint, dof, follows: follows && { ...follows, gain: 2, offset: 0.25 } });
const jointsOf = (d: Document) => d.characters[0].skeleton?.joints ?? [];

describe('rig.setCouple', () => {
  it('lets a DOF follow another from then on', () => {
    const [hero] = couple(document, 1, 'ry', { joint: 0, dof: 'rx' }).characters;
    const shown = new Float64Array(dofCountOf(hero));
    poseAt(hero, 0, shown);
    expect(shown[7]).toBe(1.25);
  });

  it('rig.setCouple is in the .skel that is saved', () => {
    const { skeleton: coupled } = couple(document, 1, 'ry', { joint: 0, dof: 'rx' }).characters[0];
    if (!coupled) throw new Error('no skeleton');
    const { value } = readSkel(writeSkel([coupled], 'hero.skel').text, 'hero.skel');
    expect(value?.[0].joints[1].couples).toEqual([{ dof: 'ry', joint: 0, follows: 'rx', gain: 2, offset: 0.25 }]);
  });

  it('rig.setCouple keeps links in the order of the DOFs, and other joints unchanged', () => {
    const both = couple(couple(document, 1, 'rz', { joint: 0, dof: 'rx' }), 1, 'rx', { joint: 0, dof: 'rz' });
    expect(jointsOf(both)[1].couples?.map(({ dof }) => dof)).toEqual(['rx', 'rz']);
    expect(jointsOf(both)[0]).toBe(jointsOf(document)[0]);
  });

  it('rig.setCouple can be taken off, and leaves nothing behind', () => {
    const off = couple(couple(document, 1, 'ry', { joint: 0, dof: 'rx' }), 1, 'ry', null);
    expect(jointsOf(off)[1]).toEqual(jointsOf(document)[1]);
    expect('couples' in jointsOf(off)[1]).toBe(false);
  });

  it('returns the same document if nothing changes', () => {
    const once = couple(document, 1, 'ry', { joint: 0, dof: 'rx' });
    expect(couple(once, 1, 'ry', { joint: 0, dof: 'rx' })).toBe(once);
    expect(couple(document, 1, 'ry', null)).toBe(document);
  });

  it('refuses a DOF that would follow itself, directly or through others', () => {
    expect(() => couple(document, 1, 'ry', { joint: 1, dof: 'ry' })).toThrow('would follow itself');
    const chain = couple(couple(document, 1, 'rx', { joint: 0, dof: 'rx' }), 2, 'rx', { joint: 1, dof: 'rx' });
    expect(() => couple(chain, 0, 'rx', { joint: 2, dof: 'rx' })).toThrow(CommandError);
    expect(() => couple(chain, 0, 'ry', { joint: 2, dof: 'rx' })).not.toThrow();
  });

  it('refuses DOFs and joints that are not there, and numbers that are none', () => {
    expect(() => couple(document, 1, 'tx', { joint: 0, dof: 'rx' })).toThrow('has no DOF tx');
    expect(() => couple(document, 1, 'rx', { joint: 0, dof: 'qw' })).toThrow('it has rx, ry, rz');
    expect(() => couple(document, 9, 'rx', { joint: 0, dof: 'rx' })).toThrow('no joint number 9');
    const follows = { joint: 0, dof: 'rx', gain: Number.NaN, offset: 0 };
    expect(() => setCouple.run(document, { characterId: 'c1', joint: 1, dof: 'rx', follows })).toThrow(
      '"follows.gain" must be a finite number',
    );
  });

  it('rig.setCouple is undone to the same document', () => {
    const store = new Store(document);
    const follows = { joint: 0, dof: 'rx', gain: 1, offset: 0 };
    store.apply(setCouple, { characterId: 'c1', joint: 2, dof: 'rz', follows });
    expect(store.undoLabel).toMatch(/^Link rz of /);
    store.undo();
    expect(store.document).toEqual(document);
  });
});
