import { describe, expect, it } from 'vitest';
import { compileSkeleton, worldMatrices } from '../../src/evaluate/kinematics.ts';
import { carrierOf, groundTravel } from '../../src/evaluate/travel.ts';
import type { Skeleton } from '../../src/model/skeleton/skeleton.ts';
import { character, skeleton, takeOfValues } from '../helpers/builders.ts';
import { bvhJoint, captureOf } from '../helpers/bvh.ts';
import { sharedCaptures } from '../helpers/bvh-files.ts';
import { captured, personSkeleton } from '../helpers/mocap.ts';
import { describeShared } from '../helpers/shared.ts';

const POSITIONS = ['tx', 'ty', 'tz'] as const;
/** A root, hips below it, and two legs; all may translate. */
const STUDIO: Skeleton = {
  name: 'studio',
  joints: [-1, 0, 1, 1].map((parent) => bvhJoint(parent, POSITIONS)),
};

/** @param rows x of the root, of the hips and of the first leg, a frame */
const carrierIn = (rows: readonly (readonly [number, number, number])[]) => {
  const capture = captureOf(
    STUDIO,
    rows.map(([root, hips, leg]) => [root, 0, 0, hips, 0, 0, leg, 0, 0, 0, 0, 0]),
  );
  const { skeleton, take } = capture;
  if (!take) throw new Error('No take was made.');
  return carrierOf(captured(skeleton, take));
};

const travelOf = (space: 'y' | 'z', carrier: number, dofs: readonly number[]) => {
  const compiled = compileSkeleton(personSkeleton());
  const all = new Float64Array(compiled.dofCount);
  all.set(dofs);
  const world = new Float64Array(16 * compiled.jointCount);
  worldMatrices(compiled, all, world);
  const out = new Float64Array(3);
  groundTravel(compiled, { up: space, unit: 'metres', lift: 0 }, carrier, all, world, out);
  return [...out];
};

describeShared('captures of studios', () => {
  it('captures of studios are carried by the joint that travels', () => {
    const carriers = ['bandai-namco-bow-normal.bvh', 'rokoko-dance.bvh', 'cmu-01_01.bvh'].map((name) => {
      const [{ skeleton, take }] = sharedCaptures(name);
      return take && skeleton.joints[carrierOf(captured(skeleton, take))].name;
    });
    expect(carriers).toEqual(['Hips', 'Hips', 'Hips']);
    expect(sharedCaptures('bandai-namco-bow-normal.bvh')[0].skeleton.joints[1].name).toBe('Hips');
  });
});

describe('the joint that carries a character', () => {
  it('the joint that carries a character is the root if it travels, though others do too', () => {
    expect(
      carrierIn([
        [0, 0, 0],
        [10, 90, 500],
      ]),
    ).toBe(0);
  });

  it('the joint that carries a character is the one below if the root is static, or only trembles', () => {
    expect(
      carrierIn([
        [0, 0, 0],
        [0, 90, 0],
      ]),
    ).toBe(1);
    expect(
      carrierIn([
        [0, 0, 0],
        [0.5, 90, 0],
      ]),
    ).toBe(1);
  });

  it('the joint that carries a character is looked for no further than where the skeleton branches', () => {
    expect(
      carrierIn([
        [0, 0, 0],
        [0, 0, 90],
      ]),
    ).toBe(0);
  });

  it('the joint that carries a character is the root if nothing moves, and if there is no take', () => {
    expect(carrierIn([[3, 4, 5]])).toBe(0);
    expect(carrierOf(character({ skeleton: skeleton(3) }))).toBe(0);
    expect(
      carrierOf(character({ skeleton: skeleton(3), takes: [takeOfValues('walk', [0, 1, 2])], shownTake: 0 })),
    ).toBe(0);
    expect(carrierOf(character())).toBe(0);
  });
});

describe('the travel over the ground', () => {
  it('leaves the height alone, whichever axis it is', () => {
    expect(travelOf('y', 0, [7, 8, 9, 1, 2, 3])).toEqual([7, 0, 9]);
    expect(travelOf('z', 0, [7, 8, 9, 1, 2, 3])).toEqual([7, 8, 0]);
  });

  it('the travel over the ground is where the joint is that carries, however it got there', () => {
    // The left foot, below the root's own travel.
    const [x, y, z] = travelOf('y', 3, [7, 8, 9]);
    expect(x).toBeCloseTo(7 + 0.06 * 170, 9);
    expect([y, z]).toEqual([0, 9]);
  });
});
