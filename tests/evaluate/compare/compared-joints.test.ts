import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { type ComparedJoints, comparedJoints, whyLeftOut } from '../../../src/evaluate/compare/compared-joints.ts';
import { rootTurn } from '../../../src/evaluate/compare/compared-roots.ts';
import { commonFrames, measureDistances } from '../../../src/evaluate/compare/distance.ts';
import { automaticPairs } from '../../../src/evaluate/retarget/match.ts';
import { readBvh } from '../../../src/formats/bvh/read.ts';
import type { Character } from '../../../src/model/document.ts';
import { filePose, jointDofCount } from '../../../src/model/skeleton/dofs.ts';
import type { Skeleton } from '../../../src/model/skeleton/skeleton.ts';
import type { Space } from '../../../src/model/space.ts';
import { character } from '../../helpers/builders.ts';
import { describeShared, sharedBytes } from '../../helpers/shared.ts';
import { skeleton } from '../../ui/builders.ts';
import { driverOf, person, takeOfRows } from '../retarget/people.ts';

const of = (from: Skeleton, more: Partial<Character> = {}) =>
  character({ id: from.name, name: from.name, skeleton: from, pose: filePose(from, 0), ...more });
const named = (name: string, from: Skeleton) => of({ ...from, name });

/** `LeftElbow = LeftForeArm` for each pair. */
function texts(a: Character, b: Character, { first, second }: ComparedJoints): string[] {
  return first.map((i, k) => `${a.skeleton?.joints[i].name} = ${b.skeleton?.joints[second[k]].name}`);
}

describe('the compared joints of two characters', () => {
  const trunk = (...names: string[]) => {
    const limbs = ['Thigh', 'Shin', 'Foot', 'Arm', 'ForeArm', 'Hand'];
    const chain = names.map((name, i): [string, number] => [name, i - 1]);
    const sides = ['Left', 'Right'].flatMap((side, s) =>
      limbs.map((limb, i): [string, number] => {
        const at = chain.length + s * limbs.length + i;
        return [`${side}${limb}`, i === 0 ? 0 : i === 3 ? chain.length - 2 : at - 1];
      }),
    );
    return skeleton(...chain, ...sides);
  };

  it('the compared joints of two rigs with other names are the same parts of the body', () => {
    const a = named('a', person());
    const b = named('b', person({ names: (part) => `mixamorig:${part.replace('forearm', 'lower arm')}` }));
    const joints = comparedJoints(a, b);
    expect(joints).toMatchObject({ isSame: false, onlyFirst: [], onlySecond: [] });
    expect(joints.second).toEqual(joints.first);
    expect(joints.reasons[joints.first.findIndex((j) => a.skeleton?.joints[j].name === 'left forearm')]).toBe(
      'left forearm, by name',
    );
  });

  it('the compared joints of one skeleton are all, because of their names', () => {
    const joints = comparedJoints(named('a', person()), named('b', person()));
    expect(joints).toMatchObject({ isSame: true, onlyFirst: [], onlySecond: [] });
    expect(new Set(joints.reasons)).toEqual(new Set(['same name']));
  });

  it('each joint has one partner at most, and the order of the characters doesn’t matter', () => {
    const spine = (count: number) => Array.from({ length: count }, (_, i) => `Spine${i}`);
    fc.assert(
      fc.property(fc.integer({ min: 1, max: 6 }), fc.integer({ min: 1, max: 6 }), (n, m) => {
        const a = named('a', trunk('Hips', ...spine(n), 'Head'));
        const b = named('b', trunk('Pelvis', ...spine(m).map((s) => `b${s}`), 'Skull'));
        const there = comparedJoints(a, b);
        const back = comparedJoints(b, a);
        expect(new Set(there.second).size).toBe(there.first.length);
        const pairs = there.first.map((i, k) => `${i} ${there.second[k]}`).sort();
        expect(back.first.map((j, k) => `${back.second[k]} ${j}`).sort()).toEqual(pairs);
        expect(there.onlyFirst.length + there.first.length).toBe(a.skeleton?.joints.length);
      }),
    );
  });

  it('the compared joints of a retargeted character are those of its retargeting', () => {
    const source = of({ ...person(), name: 'source' }, { id: 'source' });
    const pairs = [
      { target: 0, source: 0 },
      { target: 4, source: 3 },
    ];
    const take = takeOfRows(person(), [[0]]);
    const driver = driverOf(source.skeleton ?? person(), take, pairs);
    const target = of({ ...person({ names: (_, i) => `j${i}` }), name: 'target' }, { driver });
    expect(comparedJoints(target, source)).toMatchObject({ first: [0, 4], second: [0, 3] });
    expect(comparedJoints(source, target)).toMatchObject({
      first: [0, 3],
      second: [0, 4],
      reasons: ['retargeted', 'retargeted'],
    });
    const { driver: _gone, ...alone } = target;
    expect(comparedJoints(alone, source).reasons).not.toContain('retargeted');
  });

  it('a joint that is left out says why', () => {
    const a = named('a', trunk('Hips', 'Spine', 'Neck', 'Head'));
    const b = named('b', trunk('Pelvis', 'Chest', 'Neck', 'Neck1', 'Head'));
    const joints = comparedJoints(a, b);
    expect(texts(a, b, joints)).toContain('Neck = Neck1');
    expect(joints.onlySecond).toEqual([2]);
    expect(whyLeftOut(b, a, 2, joints, false)).toBe('The Neck of a is compared with Neck1');
    const tail = named('tail', skeleton(['Pelvis', -1], ['Tail', 0]));
    expect(whyLeftOut(tail, a, 1, comparedJoints(tail, a), true)).toBe('a has no matching joint');
  });
});

describe('a comparison of two rigs relative to their roots', () => {
  const SPACE: Space = { up: 'z', unit: 'centimetres', lift: 0 };

  function largest(a: Character, b: Character, turn: Float64Array | undefined): number {
    const joints = comparedJoints(a, b);
    const times = commonFrames(a, b, 10, joints.first.length);
    if (!times) throw new Error('no time in common');
    const work = measureDistances(a, b, joints, times, 'turned', turn);
    for (;;) {
      const step = work.next();
      if (step.done) return Math.max(...step.value.jointMost);
    }
  }

  it('a comparison of two rigs relative to their roots ignores how their axes differ at rest', () => {
    const source = person();
    const angles = Array.from({ length: jointDofCount(source) - 3 }, (_, i) => (i < 3 ? 0.4 : 0) + 0.1 * Math.sin(i));
    const take = takeOfRows(source, [[0.3, 0.9, -0.2, ...angles]]);
    const metres: Space = { up: 'y', unit: 'metres', lift: 0 };
    const a = of({ ...source, name: 'a' }, { takes: [take], shownTake: 0, space: metres });
    const target = { ...person({ zUp: true, size: 100, names: (part) => part.toUpperCase() }), name: 'b' };
    const pairs = automaticPairs(source, target, metres, SPACE);
    const b = of(target, { driver: driverOf(source, take, pairs, { plantsFeet: false }, metres), space: SPACE });
    const joints = comparedJoints(a, b);
    expect(joints.first).toHaveLength(source.joints.length);
    expect(largest(a, b, rootTurn(a, b, joints))).toBeLessThan(0.01);
    expect(largest(b, a, rootTurn(b, a, comparedJoints(b, a)))).toBeLessThan(0.01);
    expect(largest(a, b, undefined)).toBeGreaterThan(0.3);
    // One skeleton has one set of axes.
    expect(rootTurn(a, a, comparedJoints(a, a))).toBeUndefined();
  });
});

describeShared('captures of different programs', () => {
  const read = (name: string) => {
    const { value } = readBvh(sharedBytes(`data/bvh/${name}.bvh`), `${name}.bvh`);
    const capture = value?.[0];
    if (!capture) throw new Error(`${name} was not read`);
    return named(name, capture.skeleton);
  };

  it('captures of different programs are compared by the parts of the body', () => {
    const a = read('boxing-extra-line');
    const b = read('cmu-01_01');
    const joints = comparedJoints(a, b);
    expect(joints.first).toHaveLength(21);
    expect(texts(a, b, joints)).toContain('LeftElbow = LeftForeArm');
    expect(texts(a, b, joints)).toContain('Neck = Neck1');
    expect(joints.onlyFirst).toEqual([]);
  });
});
