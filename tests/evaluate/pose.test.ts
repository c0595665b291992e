import { describe, expect, it } from 'vitest';
import { compileSkeleton, worldMatrices } from '../../src/evaluate/kinematics.ts';
import { dofCountOf, isDriven, poseAt } from '../../src/evaluate/pose.ts';
import type { Character } from '../../src/model/document.ts';
import { character, joint, morph, skeleton, skin, takeOfValues } from '../helpers/builders.ts';
import { expectClose } from '../helpers/close.ts';
import { referenceSkeleton, referenceTake } from '../helpers/reference.ts';
import { conformance, describeShared } from '../helpers/shared.ts';

interface AnimFile {
  readonly tolerance: { readonly float64: number };
  readonly cases: readonly {
    readonly skel: string;
    readonly anim: string;
    readonly frames: readonly {
      readonly time: number;
      readonly root_translation: readonly number[];
      readonly clamped_dofs: number;
      readonly clamped: readonly (readonly number[])[];
      readonly world: readonly (readonly number[])[];
    }[];
  }[];
}

function poseOf(c: Character, time: number): number[] {
  const out = new Float64Array(dofCountOf(c));
  poseAt(c, time, out);
  return [...out];
}

describeShared('poses of an animation against the reference', () => {
  const { tolerance, cases } = conformance<AnimFile>('anim-pose.json');

  it.each(cases)('poses of $anim are those of the reference', ({ skel, anim, frames }) => {
    const model = referenceSkeleton(skel);
    const compiled = compileSkeleton(model);
    const played = character({ skeleton: model, takes: [referenceTake(anim)], shownTake: 0 });
    for (const frame of frames) {
      const got = poseOf(played, frame.time);
      const what = `at ${frame.time}`;
      expectClose(got, [...frame.root_translation, ...frame.clamped.flat()], tolerance.float64, `DOFs ${what}`);
      const free = poseOf({ ...played, clampsToLimits: false }, frame.time);
      expect(free.filter((value, d) => value !== got[d])).toHaveLength(frame.clamped_dofs);
      const world = new Float64Array(16 * compiled.jointCount);
      worldMatrices(compiled, Float64Array.from(got), world);
      expectClose(world, frame.world.flat(), tolerance.float64, `world matrices ${what}`);
    }
  });
});

describe('a pose', () => {
  const set = [1, 2, 3, 0.1, 0.2, 0.3, 0.7];
  const still = character({ skeleton: skeleton(1), skins: [skin()], morphs: [morph('smile')], pose: set });
  const played = (values: number[], more: Partial<Character> = {}) => ({
    ...still,
    takes: [takeOfValues('walk', values)],
    shownTake: 0,
    ...more,
  });

  it('a pose is the one set, without a take', () => {
    expect(poseOf(still, 5)).toEqual(set);
  });

  it('a pose is the take’s where a channel drives it, morph weights included', () => {
    expect(poseOf(played([9, 8, 7, -1, -2, -3, 0.5]), 0)).toEqual([9, 8, 7, -1, -2, -3, 0.5]);
  });

  it('takes what matches of fewer or more channels than DOFs', () => {
    expect(poseOf(played([9, 8, 7, -1]), 0)).toEqual([9, 8, 7, -1, 0.2, 0.3, 0.7]);
    expect(poseOf(played([9, 8, 7, -1, -2, -3, 0.5, 44, 55]), 0)).toEqual([9, 8, 7, -1, -2, -3, 0.5]);
  });

  it('a pose is not driven by a take that waits for a skeleton', () => {
    const { skeleton: _none, ...bodyless } = played([9, 8, 7, -1, -2]);
    const face = { ...bodyless, pose: [0, 0, 0, 0.7] };
    expect(poseOf(face, 0)).toEqual([0, 0, 0, 0.7]);
    expect(isDriven(face, 0)).toBe(false);
  });

  it('shows unkeyed changes at their own time only', () => {
    const byHand = played([9, 8, 7, -1, -2, -3], { unkeyed: { timeSeconds: 0.5, dofs: [0, 4], values: [1, 0.2] } });
    expect(poseOf(byHand, 0.5)).toEqual([1, 8, 7, -1, 0.2, -3, 0.7]);
    expect(poseOf(byHand, 0.5 + 1e-10)).toEqual([1, 8, 7, -1, 0.2, -3, 0.7]);
    expect(poseOf(byHand, 0.501)).toEqual([9, 8, 7, -1, -2, -3, 0.7]);
    // The moment is the transport's: the character's own offset has no part in it.
    expect(poseOf({ ...byHand, timeOffsetSeconds: 3 }, 0.5)[0]).toBe(1);
  });

  it('adds the character’s own offset to the time', () => {
    const ramp = takeOfValues('walk', [0]);
    const channels = [
      {
        ...ramp.channels[0],
        times: Float64Array.of(0),
        extrapolateOut: 'linear' as const,
        tangentsOut: { kinds: Uint8Array.of(3), slopes: Float64Array.of(1) },
      },
    ];
    const late = played([], { takes: [{ ...ramp, channels }], timeOffsetSeconds: 2 });
    expect(poseOf(late, 1)[0]).toBe(3);
  });

  it('holds the joints’ limits, neither the root translation nor morph weights, unless switched off', () => {
    const tight = { min: -0.5, max: 0.5 };
    const limited = played([900, 8, 7, -1, 0.2, 3, 5], {
      skeleton: { name: 's', joints: [joint(-1, { limits: [tight, tight, tight] })] },
    });
    expect(poseOf(limited, 0)).toEqual([900, 8, 7, -0.5, 0.2, 0.5, 5]);
    expect(poseOf({ ...limited, clampsToLimits: false }, 0)).toEqual([900, 8, 7, -1, 0.2, 3, 5]);
  });

  it('fills in 0 where too few values were set', () => {
    expect(poseOf({ ...still, pose: [1] }, 0)).toEqual([1, 0, 0, 0, 0, 0, 0]);
  });

  it('tells which DOFs a channel drives', () => {
    const c = played([9, 8, 7, -1]);
    expect([0, 3, 4, 6].map((d) => isDriven(c, d))).toEqual([true, true, false, false]);
    expect(isDriven(still, 0)).toBe(false);
  });
});
