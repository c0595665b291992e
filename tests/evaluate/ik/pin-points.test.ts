import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { defaultPinPoint, pinPoints, skinPinPoint } from '../../../src/evaluate/ik/pin-points.ts';
import { pointAt } from '../../../src/evaluate/ik/set-up.ts';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import type { Vec3 } from '../../../src/math/vec3.ts';
import type { Joint, Skeleton } from '../../../src/model/skeleton/skeleton.ts';
import { character, joint, skeleton, skin } from '../../helpers/builders.ts';
import { characterOf } from '../../teaching/lesson-files.ts';

const alone = (more: Partial<Joint>): Skeleton => ({ name: 'one', joints: [joint(-1, more)] });
const LEG = { min: [-0.05, -0.5, -0.05], max: [0.05, 0, 0.05] } as const;
const BVH = { motion: { kind: 'bvh', channels: ['rz', 'rx', 'ry'], positions: 'replace' } } as const;

describe('the points of a joint that a pin may hold', () => {
  it('a pin may hold the origin of a joint and the middles of its box, none of them twice', () => {
    const points = pinPoints(alone({ box: LEG }), 0);
    expect(points.map(({ name }) => name)).toEqual([
      'origin',
      'box end −x',
      'box end +x',
      'box end −y',
      'box end −z',
      'box end +z',
    ]);
    expect(points[3].point).toEqual([0, -0.5, 0]);
  });

  it('points of a joint with a length include its tip, and no box that nobody set', () => {
    expect(pinPoints(alone({ length: 2 }), 0)).toEqual([
      { kind: 'origin', point: [0, 0, 0], name: 'origin' },
      { kind: 'tip', point: [0, 2, 0], name: 'tip' },
    ]);
    expect(pinPoints(alone({ length: 0 }), 0).map(({ kind }) => kind)).toEqual(['origin']);
  });

  it('a pin may hold End Sites, numbered where there are several', () => {
    const sites = [
      [0, 1, 0],
      [0, 0, 0],
      [1, 0, 0],
    ] as const;
    const points = pinPoints(alone({ ...BVH, endSites: sites }), 0);
    expect(points.map(({ name }) => name)).toEqual(['origin', 'End Site 1', 'End Site 3']);
  });

  it('the points of a joint that a pin may hold are never in one place, whatever the box', () => {
    const length = fc.double({ min: -5, max: 5, noNaN: true });
    const corner = fc.tuple(length, length, length);
    fc.assert(
      fc.property(corner, corner, (min, max) => {
        const points = pinPoints(alone({ box: { min, max } }), 0);
        points.forEach((a, i) => {
          for (const b of points.slice(0, i))
            expect(Math.hypot(...a.point.map((x, k) => x - b.point[k]))).toBeGreaterThan(0);
        });
      }),
    );
  });
});

describe('the point that is pinned where only a joint was picked', () => {
  const withChild = (more: Partial<Joint>): Skeleton => ({ name: 'two', joints: [joint(-1, more), joint(0)] });

  it('the point that is pinned where only a joint was picked is the tip of a joint with a length, as on the command line', () => {
    expect(defaultPinPoint(withChild({ length: 2 }), 0).point).toEqual([0, 2, 0]);
    expect(defaultPinPoint(alone({ length: 0, endSites: [[1, 0, 0]] }), 0).kind).toBe('origin');
  });

  it('a pin on a joint with children is at its origin', () => {
    expect(defaultPinPoint(withChild({ box: LEG, endSites: [[1, 0, 0]] }), 0).kind).toBe('origin');
  });

  it('the point that is pinned where only a joint was picked is where a last joint ends: its furthest End Site, else the end of its box', () => {
    const sites = [
      [0, 1, 0],
      [0, 0, 3],
    ] as const;
    expect(defaultPinPoint(alone({ ...BVH, endSites: sites }), 0).name).toBe('End Site 2');
    expect(defaultPinPoint(alone({ box: LEG }), 0).name).toBe('box end −y');
  });

  it('the point that is pinned where only a joint was picked is the origin of a last joint whose box is about it, for that has no end', () => {
    expect(defaultPinPoint(alone({}), 0).kind).toBe('origin');
    expect(defaultPinPoint(alone({ box: { min: [-2, -1, -1], max: [2, 1, 1] } }), 0).kind).toBe('origin');
  });

  it('the point that is pinned where only a joint was picked is the end of the skin that hangs on a last joint: a foot that no joint ends', () => {
    const own = skeleton(2);
    const point = defaultPinPoint(own, 1, skin('hero', 1, { positions: Float64Array.of(0, 0, 0, 1, 0, 0, 0, -3, 0) }));
    expect(point).toEqual({ kind: 'skinEnd', point: [0, -3, 0], name: 'end of the skin' });
    expect(defaultPinPoint(own, 0, skin('hero', 1)).kind).toBe('origin');
  });
});

describe('a picked point of the skin', () => {
  const own = skeleton(3);
  const dofs = Float64Array.of(1, 2, 3, 0.4, 0.1, -0.7, 0.2, 0, 0.5, 0.9, 0.3, 0);
  const world = new Float64Array(16 * 3);
  worldMatrices(compileSkeleton(own), dofs, world);
  const shared = skin('hero', 2, {
    attachments: {
      start: Uint32Array.of(0, 2, 2, 3),
      joints: Uint32Array.of(1, 2, 9),
      weights: Float64Array.of(0.7, 0.3, 1),
    },
  });
  const hero = character({ skeleton: own, skins: [shared] });

  it('belongs to the joint that moves it most, and is where it was picked', () => {
    const picked = skinPinPoint(hero, 0, world, [0.3, 0.2, 0.1]);
    expect(picked?.joint).toBe(1);
    const at = picked && pointAt(world, picked.joint, picked.point);
    at?.forEach((x, k) => {
      expect(x).toBeCloseTo([0.3, 0.2, 0.1][k], 12);
    });
  });

  it('a picked point of the skin does not exist if no joint moves it, or the joint is flat', () => {
    expect(skinPinPoint(hero, 1, world, [0, 0, 0])).toBeUndefined();
    expect(skinPinPoint(hero, 2, world, [0, 0, 0])).toBeUndefined();
    expect(skinPinPoint(hero, 0, new Float64Array(48), [0, 0, 0])).toBeUndefined();
  });

  it("a picked point of the skin is the root's where the whole skin hangs on it", () => {
    const { attachments: _none, ...loose } = skin('hero', 0);
    expect(skinPinPoint(character({ skeleton: own, skins: [loose] }), 2, world, [0, 0, 0])?.joint).toBe(0);
  });
});

describe('a picked point of the skin of the walker', () => {
  const { skeleton: own, skins } = characterOf('walker.skel', 'walker.skin');
  const [body] = skins;
  if (!own || !body?.attachments) throw new Error('The walker has a skin.');
  const { start, joints, weights } = body.attachments;
  const walking = character({ skeleton: own, skins: [body] });
  const world = Float64Array.from(body.bindings);
  const placeOf = (v: number) => [0, 1, 2].map((k) => body.positions[3 * v + k]) as unknown as Vec3;

  it.each([
    ['the left knee', 'shin_l', 'thigh_l'],
    ['the right knee', 'shin_r', 'thigh_r'],
  ])('where two joints move %s alike, it is of the lower one, which bends there', (_, below, above) => {
    const indexOf = (name: string) => own.joints.findIndex((each) => each.name === name);
    const [low, high] = [indexOf(below), indexOf(above)];
    const weightOf = (v: number, joint: number) => {
      for (let a = start[v]; a < start[v + 1]; a++) if (joints[a] === joint) return weights[a];
      return 0;
    };
    const shared = Array.from({ length: start.length - 1 }, (__, v) => v).filter(
      (v) => weightOf(v, low) > 0.34 && weightOf(v, low) <= weightOf(v, high),
    );
    expect(shared.length).toBeGreaterThan(0);
    for (const v of shared) expect(skinPinPoint(walking, v, world, placeOf(v))?.joint).toBe(low);
    const alone = Array.from({ length: start.length - 1 }, (__, v) => v).filter((v) => weightOf(v, high) > 0.7);
    expect(alone.length).toBeGreaterThan(0);
    for (const v of alone) expect(skinPinPoint(walking, v, world, placeOf(v))?.joint).toBe(high);
  });
});
