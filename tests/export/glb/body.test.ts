/** Characters without a skin: what their body of boxes and bones shows. */
import { describe, expect, it } from 'vitest';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../../src/evaluate/pose.ts';
import { DEFAULT_GLB } from '../../../src/export/glb/options.ts';
import { filePoseOf } from '../../../src/export/shared/file-pose.ts';
import { cross, dot, type Vec3 } from '../../../src/math/vec3.ts';
import { type Joint, NO_BOX, type Skeleton } from '../../../src/model/skeleton/skeleton.ts';
import type { Skin } from '../../../src/model/skin.ts';
import { character, joint, skeleton, takeOfValues } from '../../helpers/builders.ts';
import { glbOf, inThree } from '../../helpers/glb.ts';

const HAND = 16;

const skeletonOf = (joints: readonly Joint[]): Skeleton => ({ name: 'sword', joints });

/** The volume within the triangles, negative if they face inwards, the box around them, and their vertices. */
function solid({ positions, triangles }: Skin) {
  const at = (i: number) => [...positions.subarray(3 * triangles[i], 3 * triangles[i] + 3)] as unknown as Vec3;
  let volume = 0;
  for (let i = 0; i < triangles.length; i += 3) volume += dot(at(i), cross(at(i + 1), at(i + 2))) / 6;
  const extent = [0, 1, 2].map((k) => {
    const all = positions.filter((_, i) => i % 3 === k);
    return [Math.min(...all), Math.max(...all)];
  });
  return { volume, extent, count: positions.length / 3 };
}

describe('the body of a character without a skin', () => {
  it('is its boxes, faces outwards, where all joints have one of their own', () => {
    // One of them turned inside out, which is drawn all the same.
    const boxes = [
      { min: [-1, 0, -1], max: [1, 9, 1] },
      { min: [1, 0, 1], max: [0, 2, 0] },
    ] as const;
    const sword = skeletonOf(boxes.map((box, j) => joint(j - 1, { box, offset: [0, 9 * j, 0] })));
    const { skin } = filePoseOf(character({ skeleton: sword }), DEFAULT_GLB);
    expect(skin && solid(skin)).toEqual({
      volume: expect.closeTo(36 + 2, 9),
      extent: [
        [-1, 1],
        [0, 11],
        [-1, 1],
      ],
      count: 48,
    });
    expect([...(skin?.attachments?.joints ?? [])]).toEqual(Array.from({ length: 48 }, (_, v) => (v < 24 ? 0 : 1)));
  });

  it('has a bone for a box that is far larger than the character, and a single joint is as large as its box', () => {
    const [far, fine] = [1.6e81, 9].map((y) => ({ min: [-1, 0, -1], max: [1, y, 1] }) as const);
    const file = (joints: readonly Joint[]) => filePoseOf(character({ skeleton: skeletonOf(joints) }), DEFAULT_GLB);
    const two = file([joint(-1, { box: far }), joint(0, { box: fine })]);
    expect(two.skin?.positions.every((x) => Math.abs(x) <= 11)).toBe(true);
    expect(two.skin?.attachments?.joints).toContain(0);
    const sword = file([joint(-1, { box: fine })]);
    expect(sword.size).toBeCloseTo(Math.hypot(2, 9, 2), 12);
    expect(sword.skin?.positions).toContain(10);
    // Floats of a GLB file have no such number.
    expect(file([joint(-1, { box: far })])).toMatchObject({ size: 1, skin: { positions: { length: 8 * 3 * 3 } } });
  });

  it('has bones where boxes are missing, and instead of default ones that most joints have', () => {
    const seen = (joints: readonly Joint[]) =>
      filePoseOf(character({ skeleton: skeletonOf(joints) }), DEFAULT_GLB).skin?.attachments?.joints.length;
    const chain = [-1, 0, 1].map((parent) => joint(parent, { offset: [0, 1, 0] }));
    const [own, bone] = [{ min: [-1, 0, 0], max: [1, 1, 1] } as const, 8 * 3];
    // Two bones between the joints, and one for the last.
    expect(seen(chain)).toBe(3 * bone);
    expect(seen(chain.map((each) => ({ ...each, box: NO_BOX })))).toBe(3 * bone);
    expect(seen([...chain.slice(0, 2), { ...chain[2], box: own }])).toBe(2 * bone + 24);
    expect(seen([{ ...chain[0], box: NO_BOX }, ...chain.slice(1).map((each) => ({ ...each, box: own }))])).toBe(
      2 * bone + 2 * 24,
    );
  });

  it.each(['linear', 'cubic'] as const)('a last joint turns with %s keys as it does here', async (keys) => {
    const own = skeleton(2);
    const rest = takeOfValues(
      'wave',
      Array.from({ length: 9 }, () => 0),
      [0, 3],
    );
    const [turn, swing] = [0.8, 2.4].map((value) => ({
      ...rest.channels[0],
      times: Float64Array.of(0, 0.5, 1.2, 2, 3),
      values: Float64Array.of(0, value, -value, value / 2, 0),
      tangentsIn: { kinds: new Uint8Array(5).fill(2), slopes: new Float64Array(5) },
      tangentsOut: { kinds: new Uint8Array(5).fill(2), slopes: new Float64Array(5) },
    }));
    const channels = rest.channels.map((each, i) => (i === 6 ? turn : i === 7 ? swing : each));
    const hero = character({ skeleton: own, takes: [{ ...rest, channels }], shownTake: 0 });
    const glb = glbOf(hero, { keys });
    const play = await inThree(glb);
    const dofs = new Float64Array(dofCountOf(hero));
    const world = new Float64Array(32);
    for (let i = 0; i < 50; i++) {
      const time = (i + 0.37) * 0.06;
      poseAt(hero, time, dofs);
      worldMatrices(compileSkeleton(own), dofs, world);
      const { matrices } = play(0, time);
      for (const o of [0, 4, 8].map((column) => HAND + column)) {
        const off = Math.hypot(...[0, 1, 2].map((k) => matrices[o + k] - world[o + k]));
        // The bone of the hand is 0.3 long: a corner of it is within the tolerance of 1/2000.
        expect(off, `at ${time}`).toBeLessThan(0.02);
      }
    }
  });
});
