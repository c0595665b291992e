/** Up axis and unit of takes in which nobody stands: lying, crawling, sitting; of real skeletons and a made one. */
import { describe, expect, it } from 'vitest';
import { liftOntoGround } from '../../src/evaluate/space/space.ts';
import { guessSpace } from '../../src/evaluate/space/space-guess.ts';
import { firstDofs, jointDofCount, rootDofCount } from '../../src/model/skeleton/dofs.ts';
import { dofsOf } from '../../src/model/skeleton/joint-types.ts';
import type { Joint, Skeleton } from '../../src/model/skeleton/skeleton.ts';
import { SAMPLED, type Take } from '../../src/model/takes/take.ts';
import { describeShared } from '../helpers/shared.ts';
import { captured } from './retarget/captures.ts';
import { BVH_ROOT, PARTS, person, takeOfRows } from './retarget/people.ts';

const COUNT = 12;
const RIGHT = Math.PI / 2;

/** Rotations about x of the person's joints, and height of the hips; for a person of 1.64 with z up or y up. */
type Posture = Readonly<Record<string, number>> & { readonly hips: number };

/** The root rotates first: a y-up person lying on the back has its head towards −z. */
const POSTURES: Readonly<Record<string, { readonly turn: number; readonly bends: Posture }>> = {
  'lying on the back, the head to −z': { turn: -RIGHT, bends: { hips: 0.12 } },
  'lying on the belly, the head to z': { turn: RIGHT, bends: { hips: 0.12 } },
  crawling: { turn: RIGHT, bends: { hips: 0.45, thigh: -RIGHT, shin: RIGHT, arm: 0, head: -0.8 } },
  'sitting on the floor': { turn: -0.3, bends: { hips: 0.1, thigh: -1.2, shin: 0.1 } },
  'doing press-ups': { turn: 1.2, bends: { hips: 0.35 } },
};

/** The posture somewhere on the ground, slowly moving and breathing. */
function rows(skeleton: Skeleton, { turn, bends }: (typeof POSTURES)[string], zUp: boolean, size: number): number[][] {
  const first = firstDofs(skeleton);
  const root = rootDofCount(skeleton);
  return Array.from({ length: COUNT }, (_, f) => {
    const row = new Array<number>(jointDofCount(skeleton)).fill(0);
    const ground = [1 + 0.03 * f, 2 - 0.02 * f];
    const at = zUp ? [ground[0], -ground[1], bends.hips] : [ground[0], bends.hips, ground[1]];
    row.splice(0, 3, ...at.map((v) => v * size));
    skeleton.joints.forEach((joint, j) => {
      const part = PARTS[j].split(' ').at(-1) ?? '';
      const d = dofsOf(joint.motion).findIndex(({ name }) => name === 'rx');
      row[first[j] - root + d] += (j === 0 ? turn : (bends[part] ?? 0)) + 0.02 * Math.sin(f + j);
    });
    return row;
  });
}

describe.each([
  ['y', false],
  ['z', true],
] as const)('one who does not stand, %s up', (up, zUp) => {
  it.each(Object.keys(POSTURES))('%s: the up axis and the unit are those of the same person standing', (posture) => {
    for (const [size, unit] of [
      [100, 'centimetres'],
      [1, 'metres'],
      [1000, 'millimetres'],
    ] as const) {
      const skeleton = person({
        size,
        zUp,
        motion: (part) => (part === 'hips' ? BVH_ROOT : { kind: 'ball', order: 'xyz' }),
      });
      const take = takeOfRows(skeleton, rows(skeleton, POSTURES[posture], zUp, size));
      expect(guessSpace(skeleton, take)).toMatchObject({ up, unit });
    }
  });
});

/** The character below a root that lays it on its back, its lowest point on the ground. */
function laidDown(skeleton: Skeleton, take: Take): { readonly skeleton: Skeleton; readonly take: Take } {
  const { samples } = take;
  if (!samples) throw new Error('No samples.');
  const root: Joint = {
    ...skeleton.joints[0],
    name: 'Reference',
    offset: [0, 0, 0],
    motion: BVH_ROOT,
    pose: [0, 0, 0, 0, 0, 0],
  };
  const joints = [root, ...skeleton.joints.map((j) => ({ ...j, parent: j.parent + 1, limits: j.limits }))];
  const lying = { ...skeleton, joints };
  const width = samples.scales.length;
  const withRoot = (lift: number): Take => ({
    ...take,
    channels: Array.from({ length: width + 6 }, () => SAMPLED),
    samples: {
      ...samples,
      scales: Float64Array.from([1, 1, 1, 1, 1, 1, ...samples.scales]),
      values: Float64Array.from(
        Array.from({ length: samples.frameCount }, (_, f) => [
          ...[0, lift, 0, 0, -RIGHT, 0],
          ...samples.values.subarray(f * width, (f + 1) * width),
        ]).flat(),
      ),
    },
  });
  const lift = liftOntoGround(lying, withRoot(0), { up: 'y', unit: 'asIs', lift: 0 });
  return { skeleton: lying, take: withRoot(lift) };
}

describeShared('real takes', () => {
  // Two of them have a file pose that is folded flat.
  it.each(['bandai-namco-bow-normal.bvh', 'lafan1-dance-10frames.bvh', 'mixamo-names.bvh', 'xsens-armchair.bvh'])(
    '%s laid on the back is told neither upright nor of another size',
    (file) => {
      const { skeleton, takes, space } = captured(file);
      if (!skeleton) throw new Error('No skeleton.');
      const lying = laidDown(skeleton, takes[0]);
      expect(guessSpace(lying.skeleton, lying.take)).toEqual({ up: 'y', unit: space?.unit, lift: 0, known: 'guessed' });
    },
  );

  it.each(['cmu-01_01.bvh', 'mixamo-names.bvh', 'boxing-extra-line.bvh', 'no-end-sites.bvh', 'poser-sl-walk.bvh'])(
    '%s has the unit of its skeleton’s proportions, whatever part of it is played',
    (file) => {
      const { skeleton, takes, space } = captured(file);
      const [take] = takes;
      if (!skeleton) throw new Error('No skeleton.');
      const [start, end] = take.range;
      for (const part of [0, 0.4, 0.8]) {
        const range = [start + part * (end - start), start + (part + 0.1) * (end - start)] as const;
        const { up, unit } = guessSpace(skeleton, { ...take, range });
        expect([up, unit]).toEqual([space?.up, space?.unit]);
      }
    },
  );
});
