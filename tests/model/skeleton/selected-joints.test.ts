/** The rules of selecting several joints. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { NOTHING_SELECTED, type Selection } from '../../../src/model/session.ts';
import {
  withCharacterToggled,
  withJointActive,
  withJoints,
  withJointToggled,
} from '../../../src/model/skeleton/joint-selection.ts';
import { jointsIn, othersKept, partsOf, selectionOf } from '../../../src/model/skeleton/selected-joints.ts';
import { skeleton } from '../../ui/builders.ts';

const joints = fc.uniqueArray(fc.nat(30), { maxLength: 12 });
const of = (...list: readonly number[]) => withJoints({ characterId: 'c1' }, list);
const pick = (joint: number) => ({ characterId: 'c1', joint });

describe('selected joints', () => {
  it('selected joints keep the order of selection, and the last one is active', () => {
    expect(of(3, 1, 2)).toEqual({ characterId: 'c1', joint: 2, others: [3, 1] });
    expect(jointsIn(of(3, 1, 2))).toEqual([3, 1, 2]);
    expect(of(4)).toEqual({ characterId: 'c1', joint: 4 });
    expect(of()).toEqual({ characterId: 'c1' });
    expect(jointsIn(NOTHING_SELECTED)).toEqual([]);
  });

  it('selected joints are a set: one named twice counts where it comes last', () => {
    expect(jointsIn(of(1, 2, 1, 3, 2))).toEqual([1, 3, 2]);
  });

  it('toggling a joint that isn’t selected twice is the identity', () => {
    fc.assert(
      fc.property(joints, fc.nat(30), (list, joint) => {
        fc.pre(!list.includes(joint));
        const once = withJointToggled(of(...list), pick(joint));
        expect(once.joint).toBe(joint);
        expect(withJointToggled(once, pick(joint))).toEqual(of(...list));
      }),
    );
  });

  it('toggling a selected joint twice leaves the same joints selected, with that one active', () => {
    fc.assert(
      fc.property(joints, fc.nat(), (list, n) => {
        fc.pre(list.length > 0);
        const joint = list[n % list.length];
        const once = withJointToggled(of(...list), pick(joint));
        expect(jointsIn(once)).toEqual(list.filter((j) => j !== joint));
        const twice = withJointToggled(once, pick(joint));
        expect([...jointsIn(twice)].sort()).toEqual([...list].sort());
        expect(twice.joint).toBe(joint);
      }),
    );
  });

  it('a joint of another character is added as one of the same is, and dragged alone', () => {
    const other = { characterId: 'c2', placement: 1, joint: 5 };
    const both = withJointToggled(of(1, 2), other);
    expect(both).toEqual({ ...other, beside: [of(1, 2)] });
    expect(withJointActive(of(1, 2), other)).toEqual(other);
    expect(withJointToggled(both, other)).toEqual(of(1, 2));
    expect(withJointActive(both, pick(1))).toEqual({ ...of(2, 1), beside: [other] });
    expect(withJointToggled(both, pick(1))).toEqual({ ...other, beside: [of(2)] });
    expect(withJointToggled({ characterId: 'c1' }, other)).toEqual(other);
  });

  it('joints of several characters are a set of each, whatever is toggled; the last added one is active', () => {
    const picks = fc.array(fc.record({ characterId: fc.constantFrom('a', 'b', 'c'), joint: fc.nat(4) }));
    fc.assert(
      fc.property(picks, (each) => {
        let selection: Selection = NOTHING_SELECTED;
        const expected = new Set<string>();
        for (const one of each) {
          selection = withJointToggled(selection, one);
          const name = `${one.characterId} ${one.joint}`;
          if (!expected.delete(name)) {
            expected.add(name);
            expect(selection).toMatchObject(one);
          }
        }
        const parts = partsOf(selection);
        const found = parts.flatMap((part) => jointsIn(part).map((joint) => `${part.characterId} ${joint}`));
        expect(found.sort()).toEqual([...expected].sort());
        expect(new Set(parts.map(({ characterId }) => characterId)).size).toBe(parts.length);
        expect(selectionOf(parts)).toEqual(selection);
      }),
    );
  });

  it('a character is added to the selection, and removed with its joints', () => {
    const both = withCharacterToggled(of(1), 'c2');
    expect(both).toEqual({ characterId: 'c2', beside: [of(1)] });
    expect(withCharacterToggled(both, 'c1')).toEqual({ characterId: 'c2' });
    expect(withCharacterToggled(of(1), 'c1')).toEqual(NOTHING_SELECTED);
  });

  it('dragging a selected joint makes it active and keeps the others; any other joint is selected alone', () => {
    expect(jointsIn(withJointActive(of(1, 2, 3), pick(1)))).toEqual([2, 3, 1]);
    expect(jointsIn(withJointActive(of(1, 2, 3), pick(4)))).toEqual([4]);
  });
});

describe('selected joints after a change of the skeleton', () => {
  const bones = skeleton(['hips', -1], ['leg_l', 0], ['foot_l', 1], ['leg_r', 0]);
  const renamed = { ...bones, joints: bones.joints.map((j, i) => (i === 1 ? { ...j, name: 'thigh' } : j)) };

  it('selected joints stay through other limits and names', () => {
    const others = [1, 3];
    expect(othersKept(others, bones, bones)).toBe(others);
    expect(othersKept(others, bones, renamed)).toBe(others);
  });

  it('selected joints are dropped when joints are removed or change places, which renumbers them', () => {
    expect(othersKept([1, 3], bones, { ...bones, joints: bones.joints.slice(0, 3) })).toEqual([]);
    const moved = skeleton(['hips', -1], ['leg_r', 0], ['leg_l', 0], ['foot_l', 2]);
    expect(othersKept([1, 3], bones, moved)).toEqual([]);
  });
});
