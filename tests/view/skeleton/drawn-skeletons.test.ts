import { describe, expect, it } from 'vitest';
import {
  assignInstances,
  boneOwner,
  haveSameJoints,
  instanceOf,
  instancesOf,
  jointAt,
  nodesFor,
  type PosedSkeleton,
} from '../../../src/view/skeleton/drawn-skeletons.ts';
import { skeleton } from '../../helpers/builders.ts';
import { personSkeleton } from '../../helpers/mocap.ts';

function posed(characterId: string, of = personSkeleton(), placements = 1): PosedSkeleton {
  return {
    characterId,
    skeleton: of,
    world: new Float64Array(16 * of.joints.length),
    dofs: new Float64Array(0),
    placements: new Float64Array(16 * placements),
    hasSkin: false,
  };
}

describe('the nodes of a skeleton', () => {
  it('the nodes of a skeleton are its joints, and after them its End Sites', () => {
    const { count, jointCount, owners, ends } = nodesFor(personSkeleton({ height: 100 }));
    expect([jointCount, count]).toEqual([6, 9]);
    expect([...owners]).toEqual([1, 3, 5]);
    expect([...ends.subarray(0, 3)]).toEqual([0, 15, 0]);
  });

  it('the nodes of a skeleton are no End Sites where their joint is already', () => {
    const [root] = personSkeleton().joints;
    expect(nodesFor({ name: 'none', joints: [{ ...root, endSites: [[0, 0, 0]] }] }).count).toBe(1);
  });
});

describe('instances of skeletons', () => {
  const drawn = assignInstances([posed('a', personSkeleton(), 2), posed('b', skeleton(3))]);

  it('instances of skeletons are one for each node of each placement', () => {
    expect(instancesOf(drawn)).toBe(2 * 9 + 3);
    expect(instancesOf([])).toBe(0);
  });

  it('instances of skeletons are found by joint, and give it back', () => {
    for (const [characterId, placement, joint] of [
      ['a', 0, 5],
      ['a', 1, 0],
      ['b', 0, 2],
    ] as const) {
      const instance = instanceOf(drawn, characterId, placement, joint);
      expect(jointAt(drawn, instance)).toEqual({ characterId, placement, joint });
    }
    expect(instanceOf(drawn, 'b', 1, 0)).toBe(-1);
    expect(instanceOf(drawn, 'a', 0, 6)).toBe(-1);
    expect(jointAt(drawn, 21)).toBeUndefined();
  });

  it('instances of End Sites and of the bones to them belong to the joint that they end', () => {
    expect(jointAt(drawn, 6)).toEqual({ characterId: 'a', placement: 0, joint: 1 });
    expect(boneOwner(drawn, 6)).toEqual({ characterId: 'a', placement: 0, joint: 1 });
    expect(jointAt(drawn, 9 + 8)).toEqual({ characterId: 'a', placement: 1, joint: 5 });
  });

  it('instances of bones belong to the joint where they start', () => {
    expect(boneOwner(drawn, 3)).toEqual({ characterId: 'a', placement: 0, joint: 2 });
    expect(boneOwner(drawn, 0)).toEqual({ characterId: 'a', placement: 0, joint: 0 });
  });
});

describe('the joints of two skeletons', () => {
  const [root, ...others] = skeleton(3).joints.map((joint, j) => ({ ...joint, name: `j${j}` }));
  const whole = { name: 'whole', joints: [root, ...others] };

  it('the joints of two skeletons are the same wherever they stand and however they move', () => {
    const moved = others.map((joint) => ({ ...joint, offset: [9, 9, 9] as const }));
    expect(haveSameJoints(whole, { name: 'moved', joints: [root, ...moved] })).toBe(true);
    expect(haveSameJoints(undefined, undefined)).toBe(true);
  });

  it('two skeletons have different joints when number, names or parents differ', () => {
    const [second, third] = others;
    for (const joints of [
      [root, second],
      [root, second, { ...third, name: 'other' }],
      [root, second, { ...third, parent: 0 }],
    ]) {
      expect(haveSameJoints(whole, { name: 'changed', joints })).toBe(false);
    }
    expect(haveSameJoints(whole, undefined)).toBe(false);
  });
});
