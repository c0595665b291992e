import { describe, expect, it } from 'vitest';
import { loopTakes } from '../../../src/edit/commands/take-edits.ts';
import { Carrier } from '../../../src/edit/samples/carry.ts';
import { framesBetween } from '../../../src/edit/samples/frames.ts';
import { readFrame, takeOfFrames } from '../../../src/edit/samples/take-frames.ts';
import { shownTake } from '../../../src/model/document.ts';
import type { Skeleton } from '../../../src/model/skeleton/skeleton.ts';
import type { Samples } from '../../../src/model/takes/samples.ts';
import type { Take } from '../../../src/model/takes/take.ts';
import { documentOf } from '../../helpers/builders.ts';
import { ALL_BVH, sharedCaptures } from '../../helpers/bvh-files.ts';
import { expectEdit } from '../../helpers/expect-edit.ts';
import { captured, personSkeleton, takeOfRoots } from '../../helpers/mocap.ts';

const takes = [{ characterId: 'c1', take: 0 }];

function looped(skeleton: Skeleton, take: Take, blendSeconds: number): Samples {
  const after = expectEdit(documentOf(captured(skeleton, take)), loopTakes, { takes, blendSeconds });
  const samples = shownTake(after.characters[0])?.samples;
  if (!samples) throw new Error('no samples');
  return samples;
}

/** Joints relative to the one that carries the body, turned to face alike: the same for one pose anywhere. */
function poseOf(carrier: Carrier, samples: Samples, frame: number, facing = 0): number[] {
  const dofs = new Float64Array(samples.scales.length);
  readFrame(samples, frame, dofs);
  const { place } = carrier.stanceOf(dofs);
  const world = carrier.worldOf(dofs);
  const carry = carrier.over(facing, place, [0, 0, 0]);
  const points: number[] = [];
  for (let o = 12; o < world.length; o += 16) points.push(...carrier.point(carry, world.subarray(o, o + 3)));
  return points;
}

function facingOf(carrier: Carrier, samples: Samples, frame: number, like: number): number {
  const dofs = new Float64Array(samples.scales.length);
  readFrame(samples, like, dofs);
  const first = carrier.stanceOf(dofs);
  readFrame(samples, frame, dofs);
  return carrier.turnBetween(first, carrier.stanceOf(dofs));
}

const apart = (a: readonly number[], b: readonly number[]) => Math.max(...a.map((v, i) => Math.abs(v - b[i])));

describe('making a take loop', () => {
  const WALKER = personSkeleton();

  it('a take with frames for some DOFs only is refused, not filled with numbers that are none', () => {
    const { samples, ...walk } = takeOfRoots(WALKER, [[0, 90, 0] as const, [0, 91, 12] as const, [0, 90, 24] as const]);
    if (!samples) throw new Error('no samples');
    const narrow = { ...samples, scales: samples.scales.slice(0, 1), values: Float64Array.of(0, 1, 2) };
    const take = { ...walk, channels: walk.channels.slice(0, 1), samples: narrow };
    expect(() => looped(WALKER, take, 0.1)).toThrow(/frames for 1 of \d+ DOFs/);
  });

  it('a walk at an even pace goes on at that pace, round after round', () => {
    const walk = takeOfRoots(
      WALKER,
      Array.from({ length: 30 }, (_, f) => [0, 90 + (f % 10), 12 * f] as const),
    );
    const { values, frameCount } = looped(WALKER, walk, 1);
    expect(frameCount).toBe(21);
    for (let f = 0; f < frameCount; f++) {
      expect(values[21 * f + 2]).toBeCloseTo(12 * f, 9);
      expect(values[21 * f + 1]).toBeCloseTo(90 + (f % 10), 9);
    }
  });

  it('a take that returns is blended where it is, and one that loops is left as it is', () => {
    const sway = takeOfRoots(
      WALKER,
      Array.from({ length: 30 }, (_, f) => [20 * Math.sin(f / 4), 90, 0] as const),
    );
    const document = documentOf(captured(WALKER, sway));
    const once = loopTakes.run(document, { takes, blendSeconds: 0.5 });
    const samples = shownTake(once.characters[0])?.samples;
    expect(samples?.values[0]).toBeCloseTo(samples?.values[21 * ((samples?.frameCount ?? 0) - 1)] ?? 0, 9);
    expect(loopTakes.run(once, { takes, blendSeconds: 0.5 })).toBe(once);
  });
});

describe('loops of real takes', () => {
  for (const name of ALL_BVH) {
    it(`${name} made a loop ends in the pose it begins with, at the speed it begins with`, () => {
      for (const { skeleton, take: whole } of sharedCaptures(name)) {
        if (!whole?.samples || whole.samples.frameCount < 20) continue;
        const take = takeOfFrames(whole, framesBetween(whole.samples, 0, Math.min(80, whole.samples.frameCount)));
        const { frameSeconds } = whole.samples;
        const made = looped(skeleton, take, 8 * frameSeconds);
        const carrier = new Carrier(skeleton, take, 'y');
        const last = made.frameCount - 1;
        const facing = facingOf(carrier, made, last, 0);
        const first = poseOf(carrier, made, 0);
        const size = Math.max(...first.map(Math.abs));
        expect(apart(first, poseOf(carrier, made, last, facing))).toBeLessThan(1e-6 * size);
        // The step out of the seam is that of the frame after it in the take, but for the little that is blended in.
        const own = take.samples ?? made;
        const [into, outOf] = [poseOf(carrier, made, 1), poseOf(carrier, own, last + 1, facing)];
        const most = apart(poseOf(carrier, own, 1), outOf);
        expect(apart(into, outOf)).toBeLessThan(0.1 * most + 1e-6 * size);
      }
    });
  }
});
