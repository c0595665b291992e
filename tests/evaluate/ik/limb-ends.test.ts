import { describe, expect, it } from 'vitest';
import { limbEnds } from '../../../src/evaluate/ik/limb-ends.ts';
import type { Skeleton } from '../../../src/model/skeleton/skeleton.ts';
import { skeleton } from '../../ui/builders.ts';

const endsOf = (of: Skeleton) =>
  [...limbEnds(of)].map((end, j) => [of.joints[j].name, end < 0 ? undefined : of.joints[end].name]);

describe('the ends of limbs', () => {
  it('are hands with their fingers, heads with their ears, and feet with their toes', () => {
    const body = skeleton(
      ['hips', -1],
      ['spine', 0],
      ['head', 1],
      ['ear_l', 2],
      ['ear_r', 2],
      ['arm_l', 1],
      ['forearm_l', 5],
      ['hand_l', 6],
      ['finger1_l', 7],
      ['finger2_l', 8],
      ['arm_r', 1],
      ['forearm_r', 10],
      ['hand_r', 11],
      ['thigh_l', 0],
      ['shin_l', 13],
      ['foot_l', 14],
      ['toe_l', 15],
      ['thigh_r', 0],
      ['shin_r', 17],
      ['foot_r', 18],
    );
    const ends = new Map(endsOf(body).map(([name, end]) => [name, end]));
    expect(['head', 'ear_l', 'ear_r'].map((name) => ends.get(name))).toEqual(['head', 'head', 'head']);
    expect(['hand_l', 'finger1_l', 'finger2_l'].map((name) => ends.get(name))).toEqual(['hand_l', 'hand_l', 'hand_l']);
    expect(['foot_l', 'toe_l', 'foot_r'].map((name) => ends.get(name))).toEqual(['foot_l', 'foot_l', 'foot_r']);
    for (const name of ['hips', 'spine', 'arm_l', 'forearm_l', 'thigh_r', 'shin_r'])
      expect(ends.get(name)).toBeUndefined();
  });

  it('are the tips of limbs that have no part of a body', () => {
    const insect = skeleton(['a', -1], ['b', 0], ['c', 1], ['d', 0], ['e', 3], ['f', 0], ['g', 5]);
    expect(endsOf(insect)).toEqual([
      ['a', undefined],
      ['b', undefined],
      ['c', 'c'],
      ['d', undefined],
      ['e', 'e'],
      ['f', undefined],
      ['g', 'g'],
    ]);
  });

  it('are none where the root alone is the body', () => {
    expect([...limbEnds(skeleton(['root', -1]))]).toEqual([-1]);
  });
});
