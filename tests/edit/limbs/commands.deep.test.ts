/** Making limbs, and keying, switching and moving their goals. */
import { describe, expect, it } from 'vitest';
import { addAttachment } from '../../../src/edit/commands/beside/attach.ts';
import {
  addLimb,
  changeLimb,
  flattenLimbs,
  keyLimb,
  removeLimb,
  setLimbSpace,
  switchLimb,
} from '../../../src/edit/commands/beside/limbs.ts';
import { moveKeys, removeKeys } from '../../../src/edit/commands/keys.ts';
import { keyForMoment } from '../../../src/edit/commands/moment.ts';
import { setDofs } from '../../../src/edit/commands/pose.ts';
import { reverseSamples } from '../../../src/edit/commands/samples.ts';
import { lockFeet, mirrorTakes, setTakeSpeed } from '../../../src/edit/commands/take-edits.ts';
import { limbInfos } from '../../../src/evaluate/limbs/infos.ts';
import { dofCountOf } from '../../../src/evaluate/pose.ts';
import type { Document } from '../../../src/model/document.ts';
import { firstGoalChannel, withGoalChannels } from '../../../src/model/takes/goals.ts';
import { character, documentOf } from '../../helpers/builders.ts';
import { expectClose } from '../../helpers/close.ts';
import { HERO, heroOf, jointCalled, LEG, run, WALKER, walking, withLegs, worldAt } from './walker.ts';

const at = (timeSeconds: number) => ({ ...HERO, timeSeconds });
const SIZE = 2;
const TIMES = Array.from({ length: 31 }, (_, k) => k / 15);

function expectSame(a: Document, b: Document, times: readonly number[], within = 1e-9): void {
  for (const time of times) expectClose([...worldAt(a, time)], [...worldAt(b, time)], within * SIZE, `at ${time} s`);
}

const goalsIn = (document: Document) => heroOf(document).takes[0].goals?.list ?? [];

describe('limbs.add', () => {
  it('proposes how the middle joint bends, and makes the limb of the other side', () => {
    const [left, right] = heroOf(withLegs()).limbs?.list ?? [];
    expect(left).toEqual({ name: 'leg_l', joints: LEG, tip: [0, 0, 0], orient: true, bend: { dof: 'rx', sign: 1 } });
    expect(right.name).toBe('leg_r');
    expect(right.bend).toEqual(left.bend);
    const arm = ['upper_arm_l', 'forearm_l', 'hand_l'].map(jointCalled);
    const arms = run(walking(), addLimb, { ...HERO, joints: arm, mirrored: true, tip: [0.1, 0.02, 0.03] });
    const [leftArm, rightArm] = heroOf(arms).limbs?.list ?? [];
    expect(leftArm).toMatchObject({ name: 'hand_l', orient: false, bend: { dof: 'ry', sign: -1 } });
    expect(rightArm).toMatchObject({ name: 'hand_r', bend: { dof: 'ry', sign: 1 } });
    expectClose([...rightArm.tip], [-0.1, 0.02, 0.03], 1e-9);
    const label = (mirrored: boolean) => addLimb.label(walking(), { ...HERO, joints: arm, mirrored });
    expect([true, false].map(label)).toEqual(['Add limbs hand_l and hand_r', 'Add limb hand_l']);
  });

  it('refuses what is no chain, shares a joint or a name, or has no other side, in words', () => {
    const legs = withLegs();
    const joints = ['thigh_l', 'foot_l'].map(jointCalled);
    expect(() => addLimb.run(walking(), { ...HERO, joints })).toThrow(
      /^foot_l of foot_l should be attached to thigh_l/,
    );
    expect(() => addLimb.run(legs, { ...HERO, joints: LEG })).toThrow(
      /^leg_l is a limb already, as is its mirror, leg_r\.$/,
    );
    expect(() => addLimb.run(legs, { ...HERO, joints: LEG.slice(1) })).toThrow(
      /^shin_l already belongs to the limb leg_l\.$/,
    );
    const tail = ['tail_1', 'tail_2', 'tail_3'].map(jointCalled);
    expect(() => addLimb.run(legs, { ...HERO, joints: tail, name: 'leg_l' })).toThrow('Another limb is called');
    expect(() => addLimb.run(legs, { ...HERO, joints: tail, mirrored: true })).toThrow('has no counterpart');
    expect(() => addLimb.run(legs, { ...HERO, joints: [99] })).toThrow('There is no joint number 99');
  });
});

it('a renamed limb keeps its goals, and a removed one takes them away', () => {
  const keyed = run(withLegs(), keyLimb, { ...at(0), limb: 0 });
  const renamed = run(keyed, changeLimb, { ...HERO, limb: 0, name: 'left leg', orient: false });
  expect(goalsIn(renamed).map(({ limb }) => limb)).toEqual(['left leg']);
  expect(heroOf(renamed).limbs?.list[0]).toMatchObject({ name: 'left leg', orient: false, joints: LEG });
  const without = run(renamed, removeLimb, { ...HERO, limb: 0 });
  expect(heroOf(without).takes[0]).not.toHaveProperty('goals');
  expect(heroOf(run(without, removeLimb, { ...HERO, limb: 0 }))).not.toHaveProperty('limbs');
});

describe('limbs.switch', () => {
  it('to IK nothing moves up to that time, and the foot stays where it is from then on', () => {
    const legs = withLegs();
    const held = run(legs, switchLimb, { ...at(0.4), limb: 0, to: 'ik' });
    expectSame(held, legs, [0, 0.1, 0.25, 0.399, 0.4]);
    const foot = 16 * LEG[2];
    const there = [...worldAt(held, 0.4).slice(foot, foot + 16)];
    for (const time of [0.45, 0.5, 0.6]) {
      const [info] = limbInfos(heroOf(held), time);
      if (info.gap < 1e-6) expectClose([...worldAt(held, time).slice(foot, foot + 16)], there, 1e-6);
    }
  });

  it('there and back at one time gives the same pose at all times, and back later leaves what was before', () => {
    const legs = withLegs();
    const held = run(legs, switchLimb, { ...at(0.4), limb: 0, to: 'ik' });
    expectSame(run(held, switchLimb, { ...at(0.4), limb: 0, to: 'fk' }), legs, TIMES);
    const back = run(held, switchLimb, { ...at(0.7), limb: 0, to: 'fk' });
    expectSame(back, held, [0, 0.2, 0.39, 0.4, 0.5, 0.6, 0.699999, 0.7]);
    expect(limbInfos(heroOf(back), 0.8)[0].blend).toBe(0);
    const again = run(back, switchLimb, { ...at(0.9), limb: 0, to: 'ik' });
    expectSame(again, back, [0, 0.2, 0.4, 0.5, 0.6, 0.699999, 0.75, 0.899, 0.9]);
  });

  it('within IK a switch ends where the next one begins', () => {
    const held = run(withLegs(), switchLimb, { ...at(0.2), limb: 0, to: 'ik' });
    const back = run(held, switchLimb, { ...at(0.8), limb: 0, to: 'fk' });
    const middle = run(back, switchLimb, { ...at(0.5), limb: 0, to: 'fk' });
    const blends = [0.1, 0.2, 0.49, 0.5, 0.7, 0.79, 0.8, 0.9].map((time) => limbInfos(heroOf(middle), time)[0].blend);
    expect(blends).toEqual([0, 1, 1, 0, 0, 0, 0, 0]);
  });

  it('changes nothing where the limb is there already', () => {
    const legs = withLegs();
    expect(switchLimb.run(legs, { ...at(0), limb: 0, to: 'fk' })).toBe(legs);
    const held = run(legs, switchLimb, { ...at(0), limb: 0, to: 'ik' });
    expect(switchLimb.run(held, { ...at(0.5), limb: 0, to: 'ik' })).toBe(held);
    expect(() => switchLimb.run(held, { ...at(0), limb: 2, to: 'ik' })).toThrow(
      'There is no limb number 2; there are 2.',
    );
  });
});

describe('limbs.key', () => {
  it('keys what is given, and the limb goes there', () => {
    const bare = run(withLegs(), keyLimb, { ...at(0.5), limb: 0 });
    const [x, y, z, ...turn] = limbInfos(heroOf(bare), 0.5)[0].goal;
    const goal = [x, y + 0.03, z + 0.02, turn[0], turn[1], turn[2]] as const;
    const keyed = run(bare, keyLimb, { ...at(0.5), limb: 0, goal, pole: [x, y + 0.5, z + 3], blend: 1 });
    const [info] = limbInfos(heroOf(keyed), 0.5);
    expect(info).toMatchObject({ name: 'leg_l', blend: 1, space: 'world' });
    expectClose([...info.goal], [...goal], 1e-12);
    expect(info.gap).toBeLessThan(1e-6 * SIZE);
    const moved = run(keyed, keyLimb, { ...at(1), limb: 0, goal: [x, y + 0.05, z, 0, 0, 0] });
    expect(limbInfos(heroOf(moved), 0.75)[0].goal[1]).toBeCloseTo(y + 0.04, 9);
    const half = run(moved, keyLimb, { ...at(0.5), limb: 0, blend: 0.5 });
    expect(limbInfos(heroOf(half), 0.5)[0]).toMatchObject({ blend: 0.5, goal: info.goal });
  });

  it('a planted foot holds while the body moves', () => {
    const {
      characters: [hero],
      ...rest
    } = withLegs();
    const still: Document = { ...rest, characters: [{ ...hero, takes: [], shownTake: -1 }] };
    const first = run(still, keyLimb, { ...at(0), limb: 0 });
    const both = run(first, keyLimb, { ...at(1), limb: 0 });
    expectClose([...worldAt(both, 0.5)], [...worldAt(still, 0)], 1e-9);
  });

  it('to another space the limb doesn’t jump, and follows that from then on', () => {
    const first = run(withLegs(), switchLimb, { ...at(0), limb: 0, to: 'ik' });
    const keyed = run(first, keyLimb, { ...at(0.5), limb: 0, space: 'hips' });
    expectSame(keyed, first, [0, 0.2, 0.4, 0.5], 1e-7);
    expect(limbInfos(heroOf(keyed), 0.6)[0].space).toBe('hips');
    const back = run(keyed, keyLimb, { ...at(0.8), limb: 0, space: 'world' });
    expectSame(back, keyed, [0, 0.3, 0.5, 0.7, 0.8], 1e-7);
    expect(goalsIn(back)[0].space).toEqual([
      [-0.5, 'world'],
      [0.5, 'hips'],
      [0.8, 'world'],
    ]);
    expect(() => keyLimb.run(first, { ...at(1), limb: 0, space: 'foot_l' })).toThrow('in a space that leg_l moves');
    expect(() => keyLimb.run(first, { ...at(1), limb: 0, space: 'wing' })).toThrow('has no joint "wing"');
  });
});

it('limbs.setSpace keeps every key where it is', () => {
  const first = run(withLegs(), switchLimb, { ...at(0), limb: 0, to: 'ik' });
  const keyed = run(first, keyLimb, { ...at(1), limb: 0, goal: [0.15, 0.2, 0.1, 0, 0.3, 0] });
  const moved = run(keyed, setLimbSpace, { ...at(0.3), limb: 0, space: 'hips' });
  expectSame(moved, keyed, [0, 1], 1e-7);
  expectSame(run(moved, setLimbSpace, { ...at(0.3), limb: 0, space: 'world' }), keyed, [0, 1], 1e-7);
});

it('keys of goals are moved, deleted and selected as those of any channel', () => {
  const first = run(withLegs(), keyLimb, { ...at(0), limb: 0 });
  const keyed = run(first, keyLimb, { ...at(1), limb: 0, goal: [0.1, 0.3, 0.2, 0, 0, 0] });
  const hero = heroOf(keyed);
  const count = dofCountOf(hero);
  const ty = firstGoalChannel(count, 0) + 2;
  const moved = run(keyed, moveKeys, { ...HERO, keys: [{ channel: ty, indices: [1] }], seconds: 0.5, values: [0.1] });
  const { channels } = withGoalChannels(heroOf(moved).takes[0], count);
  expect(channels[ty]).toMatchObject({ times: Float64Array.of(0, 1.5) });
  expect(heroOf(moved).takes[0].channels).toBe(hero.takes[0].channels);
  const gone = run(moved, removeKeys, { ...at(0), keys: [{ channel: ty, indices: [0, 1] }] });
  expect(typeof goalsIn(gone)[0].channels.ty?.curve).toBe('number');
});

it('limbs.flatten leaves a take without goals that moves the same at whole frames', () => {
  const held = run(withLegs(), switchLimb, { ...at(0.4), limb: 0, to: 'ik' });
  const plain = run(held, flattenLimbs, HERO);
  expect(heroOf(plain).takes[0]).not.toHaveProperty('goals');
  expectSame(plain, held, [0, 0.1, 0.3, 0.4, 0.5, 0.8], 2e-3);
  expect(() => flattenLimbs.run(plain, HERO)).toThrow('has no goals of limbs.');
});

describe('a take with goals', () => {
  const held = run(withLegs(), switchLimb, { ...at(0.4), limb: 0, to: 'ik' });
  const takes = [{ ...HERO, take: 0 }];

  it('is refused by what edits takes as a whole, which says what to do first', () => {
    const flattenFirst = 'walk has limbs with goals, and this changes takes as a whole. Flatten limbs first';
    expect(() => setTakeSpeed.run(held, { takes, factor: 2 })).toThrow(flattenFirst);
    expect(() => mirrorTakes.run(held, { takes })).toThrow(flattenFirst);
    expect(() => lockFeet.run(held, { takes })).toThrow(flattenFirst);
    expect(() => reverseSamples.run(held, HERO)).toThrow(flattenFirst);
    const plain = run(held, flattenLimbs, HERO);
    expect(setTakeSpeed.run(plain, { takes, factor: 2 })).not.toBe(plain);
  });

  it('keeps its attachments when limbs are flattened', () => {
    const leader = character({ id: 'c2', skeleton: WALKER, pose: heroOf(held).pose });
    const both = documentOf(heroOf(held), leader);
    const span = [0, 1] as const;
    const attached = run(both, addAttachment, { ...HERO, leaderId: 'c2', joint: 0, span });
    const plain = run(attached, flattenLimbs, HERO);
    const [take] = heroOf(plain).takes;
    expect(take).not.toHaveProperty('goals');
    expect(take.attached).toBe(heroOf(attached).takes[0].attached);
    // The root has its own keys, which show once it is detached.
    const [root] = [heroOf(held).takes[0].channels];
    expect(take.channels.slice(0, 6)).toEqual(root.slice(0, 6));
    expectSame(plain, attached, [0, 0.1, 0.3, 0.4, 0.5, 0.8], 2e-3);
  });
});

it('values of goals stay unkeyed when DOFs are keyed for a moment', () => {
  const [{ takes, ...hero }] = walking().characters;
  // Without channels beyond the DOFs.
  const [take] = takes.map((one) => ({ ...one, channels: one.channels.slice(0, dofCountOf({ takes, ...hero })) }));
  const walk = documentOf({ ...hero, takes: [take] });
  const held = run(withLegs(walk), switchLimb, { ...at(0.4), limb: 0, to: 'ik' });
  const goal = { index: firstGoalChannel(dofCountOf(heroOf(held)), 0) + 1, value: 0.3 };
  const posed = run(held, setDofs, { ...at(0.4), dofs: [{ index: 1, value: 2 }, goal] });
  const keyed = run(posed, keyForMoment, { ...at(0.4), easeIn: 0.1, easeOut: 0.1 });
  expect(heroOf(keyed).unkeyed).toMatchObject({ dofs: [goal.index], values: [goal.value] });
});
