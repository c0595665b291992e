import { describe, expect, it } from 'vitest';
import { addSet, changeSet, removeSet, setLocked } from '../../src/edit/commands/beside/sets.ts';
import { renameJoint } from '../../src/edit/commands/rig-joint.ts';
import { lockedDofs } from '../../src/model/sets.ts';
import { character, documentOf, morph, skeleton } from '../helpers/builders.ts';
import { expectEdit } from '../helpers/expect-edit.ts';

const c1 = { characterId: 'c1' };
const HERO = documentOf(character({ skeleton: skeleton(3), morphs: [morph('smile')] }));

describe('selection sets and locked DOFs', () => {
  it('sets are added at the end, changed and removed; the last one leaves nothing', () => {
    const one = expectEdit(HERO, addSet, { ...c1, name: 'legs', color: '#ff0000', joints: [2, 0, 2] });
    const two = expectEdit(one, addSet, { ...c1, name: 'spine', joints: [1] });
    expect(two.characters[0].sets?.sets).toEqual([
      { name: 'legs', color: '#ff0000', joints: [0, 2] },
      { name: 'spine', joints: [1] },
    ]);
    const plain = expectEdit(two, changeSet, { ...c1, set: 0, name: 'hips', color: '' });
    expect(plain.characters[0].sets?.sets[0]).toEqual({ name: 'hips', joints: [0, 2] });
    const left = expectEdit(expectEdit(plain, removeSet, { ...c1, set: 1 }), removeSet, { ...c1, set: 0 });
    expect('sets' in left.characters[0]).toBe(false);
  });

  it('DOFs are locked by joint and name, the root’s translation too, and no morph', () => {
    const locked = expectEdit(HERO, setLocked, { ...c1, dofs: [1, 3, 11], locked: true });
    expect(locked.characters[0].sets?.locked).toEqual([
      { joint: 0, dofs: ['ty', 'rx'] },
      { joint: 2, dofs: ['rz'] },
    ]);
    expect([...lockedDofs(locked.characters[0])]).toEqual([1, 3, 11]);
    const some = expectEdit(locked, setLocked, { ...c1, dofs: [1, 11], locked: false });
    expect([...lockedDofs(some.characters[0])]).toEqual([3]);
    expect(() => setLocked.run(HERO, { ...c1, dofs: [12], locked: true })).toThrow('smile is a morph');
  });

  it('they follow their joints when these are renamed', () => {
    const set = addSet.run(HERO, { ...c1, name: 'end', joints: [2] });
    const renamed = expectEdit(set, renameJoint, { ...c1, joint: 2, name: 'tip' });
    expect(renamed.characters[0].sets).toBe(set.characters[0].sets);
  });
});
