import { describe, expect, it } from 'vitest';
import { documentIn } from '../../../src/edit/change.ts';
import { keysLostBy, setMotion } from '../../../src/edit/commands/rig-joint.ts';
import { sameDof } from '../../../src/edit/rig/same-dof.ts';
import { Store } from '../../../src/edit/store.ts';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../../src/evaluate/pose.ts';
import type { Vec3 } from '../../../src/math/vec3.ts';
import type { Character } from '../../../src/model/document.ts';
import type { Motion, Skeleton } from '../../../src/model/skeleton/skeleton.ts';
import { type Channel, followingSamples, keysOf, restChannel } from '../../../src/model/takes/take.ts';
import { FIXED_TANGENT } from '../../../src/model/takes/tangent-kinds.ts';
import { character, documentOf, joint } from '../../helpers/builders.ts';
import { channelOf } from '../keys/channels.ts';

const BALL: Motion = { kind: 'ball', order: 'xyz' };
const FREE_LIMITS = Array.from({ length: 3 }, () => ({ min: -100000, max: 100000 }));
const hingeAbout = (axis: Vec3): Motion => ({ kind: 'hinge', axis });

/** Two keys that come in and leave at slopes of their own. */
const sloped = (): Channel => {
  const tangents = { kinds: new Uint8Array([FIXED_TANGENT, FIXED_TANGENT]), slopes: new Float64Array([1, -2]) };
  return {
    ...channelOf([
      [0, 0.25],
      [1, -0.5],
    ]),
    tangentsIn: tangents,
    tangentsOut: { ...tangents, slopes: new Float64Array([0, 3]) },
  };
};

/** hip – thigh, a hinge with keys; foot, whose x follows it. */
function hinged(axis: Vec3): Character {
  const skeleton: Skeleton = {
    name: 'hero',
    joints: [
      joint(-1, { name: 'hip', motion: { kind: 'fixed' }, limits: [], pose: [] }),
      joint(0, { name: 'thigh', motion: hingeAbout(axis), limits: [{ min: -1, max: 0.5 }], pose: [0.25] }),
      joint(1, { name: 'foot', couples: [{ dof: 'rx', joint: 1, follows: 'r', gain: 0.5, offset: 0.1 }] }),
    ],
  };
  const resting: readonly Channel[] = [0, 1, 2].map(() => restChannel());
  const channels = [...resting, sloped()];
  const take = { name: 'walk', range: [0, 1] as const, channels };
  return character({
    skeleton,
    pose: [0, 0, 0, 0.125, 0, 0, 0],
    poses: [{ name: 'bent', values: [0, 0, 0, 0.5, 0, 0, 0] }],
    takes: [
      take,
      { ...take, name: 'capture', channels: followingSamples([...resting, restChannel()], SAMPLES), samples: SAMPLES },
    ],
    shownTake: 0,
  });
}

const SAMPLES = {
  frameCount: 2,
  frameSeconds: 1,
  startSeconds: 0,
  firstChannel: 3,
  values: new Float64Array([10, 0]),
  scales: new Float64Array([0.02]),
  interpolation: 'linear' as const,
};

const turned = (before: Character, motion: Motion) =>
  documentIn(setMotion.run(documentOf(before), { characterId: 'c1', joint: 1, motion })).characters[0];

function worldsAt(c: Character, seconds: number): number[] {
  if (!c.skeleton) throw new Error('no skeleton');
  const dofs = new Float64Array(dofCountOf(c));
  poseAt(c, seconds, dofs);
  const world = new Float64Array(16 * c.skeleton.joints.length);
  worldMatrices(compileSkeleton(c.skeleton), dofs, world);
  return [...world];
}

describe('a hinge along an axis that becomes a ball', () => {
  it.each([[[1, 0, 0]], [[0, -1, 0]], [[0, 0, -2]]] as [Vec3][])('moves as before, about %j', (axis) => {
    const before = hinged(axis);
    const after = turned(before, BALL);
    for (const shownTake of [0, 1]) {
      for (const seconds of [0, 0.3, 0.7, 1]) {
        worldsAt({ ...after, shownTake }, seconds).forEach((value, k) => {
          expect(value).toBeCloseTo(worldsAt({ ...before, shownTake }, seconds)[k], 12);
        });
      }
    }
  });

  it('mirrors values, keys with their slopes, samples, limits, poses and links if the axis is reversed', () => {
    const after = turned(hinged([-1, 0, 0]), BALL);
    const [, thigh, foot] = after.skeleton?.joints ?? [];
    expect(thigh.limits).toEqual([{ min: -0.5, max: 1 }, ...FREE_LIMITS.slice(1)]);
    expect(thigh.pose).toEqual([-0.25, 0, 0]);
    expect(after.pose.slice(3, 6)).toEqual([-0.125, 0, 0]);
    expect(after.poses?.[0].values.slice(3, 6)).toEqual([-0.5, 0, 0]);
    const { values, tangentsIn, tangentsOut } = keysOf(after.takes[0].channels[3]);
    expect([values, tangentsIn.slopes, tangentsOut.slopes].map((column) => [...column])).toEqual([
      [-0.25, 0.5],
      [-1, 2],
      // No −0, which would be written with its sign.
      [0, -3],
    ]);
    expect([...(after.takes[1].samples?.values ?? [])]).toEqual([-10, 0]);
    expect(foot.couples).toEqual([{ dof: 'rx', joint: 1, follows: 'rx', gain: -0.5, offset: 0.1 }]);
  });

  it('a hinge along an axis that becomes a ball can be converted back', () => {
    for (const axis of [
      [1, 0, 0],
      [0, 0, -1],
    ] as Vec3[]) {
      const before = hinged(axis);
      const back = turned(turned(before, BALL), hingeAbout(axis));
      expect(back.skeleton).toEqual(before.skeleton);
      expect(back.pose).toEqual(before.pose);
      expect(back.poses).toEqual(before.poses);
      expect(back.takes[0].channels).toEqual(before.takes[0].channels);
    }
  });
});

describe('which DOF is which', () => {
  it('works both ways, and only along an axis', () => {
    const z = hingeAbout([0, 0, -3]);
    expect(sameDof(z, BALL, 'rz')).toEqual({ name: 'r', sign: -1 });
    expect(sameDof(BALL, z, 'r')).toEqual({ name: 'rz', sign: -1 });
    expect(sameDof(z, BALL, 'rx')).toBeUndefined();
    expect(sameDof(hingeAbout([0, 1, 1]), BALL, 'ry')).toBeUndefined();
    expect(sameDof({ kind: 'prismatic', axis: [1, 0, 0] }, BALL, 'rx')).toBeUndefined();
    expect(sameDof({ kind: 'screw', axis: [1, 0, 0], pitch: 1 }, z, 'r')).toEqual({ name: 'r', sign: 1 });
  });
});

describe('keys that have no DOF to go to', () => {
  it('keys that have no DOF to go to are named in the label of the step', () => {
    const store = new Store(documentOf(hinged([0, 1, 1])));
    store.apply(setMotion, { characterId: 'c1', joint: 1, motion: BALL });
    expect(store.undoLabel).toBe('Set type of thigh, losing 2 keys and samples of r');
    expect(store.document.characters[0].takes[0].channels.every(({ kind }) => kind === 'rest')).toBe(true);
  });

  it('keys without a DOF are counted over all takes, and are none if all are kept', () => {
    const lost = (axis: Vec3, motion: Motion) =>
      keysLostBy(documentOf(hinged(axis)), { characterId: 'c1', joint: 1, motion });
    expect(lost([0, 0, 1], BALL)).toBeUndefined();
    expect(lost([0, 0, 1], { kind: 'universal', order: 'xy' })).toBe('2 keys and samples of r');
    const bare = hinged([0, 0, 1]);
    const twice = { ...bare, takes: [bare.takes[0], { ...bare.takes[0], name: 'run' }] };
    expect(keysLostBy(documentOf(twice), { characterId: 'c1', joint: 1, motion: { kind: 'fixed' } })).toBe(
      '4 keys of r',
    );
    const store = new Store(documentOf(turned(twice, BALL)));
    store.apply(setMotion, { characterId: 'c1', joint: 1, motion: { kind: 'ball', order: 'zxy' } });
    expect(store.undoLabel).toBe('Set type of thigh');
  });
});
