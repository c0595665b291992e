import fc from 'fast-check';
import { Matrix4, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import {
  axesMatrix,
  boneMatrix,
  boxMatrix,
  jointSizes,
  sphereMatrix,
} from '../../../src/evaluate/shapes/joint-shapes.ts';
import type { Box } from '../../../src/model/skeleton/skeleton.ts';
import { joint } from '../../helpers/builders.ts';

const IDENTITY = Float64Array.from(new Matrix4().elements);

/** Where a unit shape's point comes to lie. */
function at(matrix: Float32Array, x: number, y: number, z: number): number[] {
  return new Vector3(x, y, z)
    .applyMatrix4(new Matrix4().fromArray(matrix))
    .toArray()
    .map((v) => Math.round(v * 1e4) / 1e4 + 0);
}

function boxOf(box: Box, world: Float64Array = IDENTITY): Float32Array {
  const out = new Float32Array(16);
  boxMatrix(world, 0, box, 0.001, out, 0);
  return out;
}

describe('the box of a joint', () => {
  it('reaches from min to max, in the joint’s space', () => {
    const world = Float64Array.from(new Matrix4().makeRotationZ(Math.PI / 2).setPosition(10, 0, 0).elements);
    const out = boxOf({ min: [0, -1, -1], max: [4, 1, 3] }, world);
    expect(at(out, -0.5, -0.5, -0.5)).toEqual([11, 0, -1]);
    expect(at(out, 0.5, 0.5, 0.5)).toEqual([9, 4, 3]);
  });

  it('the box of a joint is drawn all the same where min > max', () => {
    const out = boxOf({ min: [1, 2, 3], max: [-1, -2, -3] });
    expect(at(out, 0.5, 0.5, 0.5)).toEqual([1, 2, 3]);
    expect(new Matrix4().fromArray(out).determinant()).toBeGreaterThan(0);
  });

  it('the box of a joint has a thickness, hardly any, where it is flat', () => {
    const out = boxOf({ min: [-1, 0.5, -1], max: [1, 0.5, 1] });
    expect(new Matrix4().fromArray(out).determinant()).toBeGreaterThan(0);
    expect(at(out, 0, 0.5, 0)).toEqual([0, 0.5005, 0]);
  });
});

describe('the bone between two joints', () => {
  it('starts at the parent, ends at the child, and is as thick as asked, in every direction', () => {
    const coordinate = fc.double({ min: -5, max: 5, noNaN: true });
    fc.assert(
      fc.property(coordinate, coordinate, coordinate, (x, y, z) => {
        fc.pre(Math.hypot(x, y, z) > 0.1);
        const world = new Float64Array(32);
        world.set(new Matrix4().setPosition(1, 2, 3).elements);
        world.set(new Matrix4().setPosition(1 + x, 2 + y, 3 + z).elements, 16);
        const out = new Float32Array(16);
        boneMatrix(world, 0, 16, 0.25, out, 0);
        const m = new Matrix4().fromArray(out);
        const base = new Vector3().applyMatrix4(m);
        expect(base.toArray()).toEqual([1, 2, 3]);
        expect(new Vector3(0, 1, 0).applyMatrix4(m).distanceTo(new Vector3(1 + x, 2 + y, 3 + z))).toBeLessThan(1e-5);
        const along = new Vector3(x, y, z).normalize();
        for (const side of [new Vector3(1, 0, 0), new Vector3(0, 0, 1)]) {
          const across = side.applyMatrix4(m).sub(base);
          expect(across.length()).toBeCloseTo(0.25, 5);
          expect(Math.abs(across.dot(along))).toBeLessThan(1e-5);
        }
        // Not turned inside out.
        expect(m.determinant()).toBeGreaterThan(0);
      }),
    );
  });

  it('the bone between two joints is nothing between joints at one place', () => {
    const out = new Float32Array(16).fill(9);
    boneMatrix(Float64Array.from([...IDENTITY, ...IDENTITY]), 0, 16, 1, out, 0);
    expect(at(out, 1, 1, 1)).toEqual([0, 0, 0]);
  });
});

describe('the axes of a joint', () => {
  it('the axes of a joint are of one length, whatever the joint’s scale, and keep its mirroring', () => {
    const world = Float64Array.from(new Matrix4().makeScale(-3, 0.1, 2).setPosition(1, 1, 1).elements);
    const out = new Float32Array(16);
    axesMatrix(world, 0, 0.5, out, 0);
    expect([at(out, 1, 0, 0), at(out, 0, 1, 0), at(out, 0, 0, 1)]).toEqual([
      [0.5, 1, 1],
      [1, 1.5, 1],
      [1, 1, 1.5],
    ]);
  });

  it('leave out one that the joint flattens away', () => {
    const out = new Float32Array(16);
    axesMatrix(Float64Array.from(new Matrix4().makeScale(1, 0, 1).elements), 0, 2, out, 0);
    expect(at(out, 0, 1, 0)).toEqual([0, 0, 0]);
  });
});

describe('sizes of joints', () => {
  const chain = (scale: number) => ({
    name: '',
    joints: [joint(-1), joint(0, { offset: [0, scale, 0] }), joint(1, { offset: [0, 0.1 * scale, 0] })],
  });

  it('sizes of joints grow with the skeleton', () => {
    const small = jointSizes(chain(0.01));
    const large = jointSizes(chain(100));
    expect(large.radii[0] / small.radii[0]).toBeCloseTo(1e4, -1);
    expect(large.axis / small.axis).toBeCloseTo(1e4, 3);
  });

  it('sizes of joints are small at the end of a short bone', () => {
    const { radii } = jointSizes(chain(1));
    expect(radii[2]).toBeLessThanOrEqual(0.1 * 0.22 + 1e-6);
  });

  it('suit the shortest bone that a joint has, an End Site too', () => {
    const limb = (end: number) =>
      jointSizes({
        name: '',
        joints: [
          joint(-1),
          joint(0, { offset: [0, 40, 0] }),
          joint(1, { offset: [0, 40, 0], endSites: [[0, end, 0]] }),
        ],
      }).radii;
    expect(limb(6)[2]).toBeLessThanOrEqual(0.22 * 6 + 1e-6);
    expect(limb(6)[2]).toBeLessThan(limb(30)[2]);
  });

  it('make no club of a bone: hardly larger at one end than at the other', () => {
    const length = fc.double({ min: 1, max: 50, noNaN: true });
    fc.assert(
      fc.property(fc.array(length, { minLength: 3, maxLength: 12 }), (lengths) => {
        const joints = [joint(-1), ...lengths.map((y, j) => joint(j, { offset: [0, y, 0] }))];
        const { radii, extent } = jointSizes({ name: '', joints });
        // What is a speck anyway may be what it likes.
        const speck = 0.007 * extent;
        for (let j = 1; j < joints.length; j++) {
          const [less, more] = [radii[j - 1], radii[j]].sort((a, b) => a - b);
          expect(more).toBeLessThanOrEqual(Math.max(1.4 * less, speck) + 1e-4);
        }
      }),
    );
  });

  it('thousands of long bones, side by side, cover their place a few times, and bones of any character are as thick as ever', () => {
    const star = (rays: number) => {
      const ray = (r: number) => joint(0, { offset: [Math.sin(r), 0, Math.cos(r)] });
      return jointSizes({ name: '', joints: [joint(-1), ...Array.from({ length: rays }, (_, r) => ray(r))] });
    };
    const few = star(100).radii;
    expect(few[0]).toBeCloseTo(star(50).radii[0], 6);
    const { radii, extent } = star(20_000);
    const covered = radii.subarray(1).reduce((sum) => sum + 2 * radii[0], 0);
    expect(covered).toBeLessThan(21 * extent ** 2);
    expect(radii[0]).toBeGreaterThan(0);
    expect(radii[0]).toBeLessThan(few[0] / 5);
  });

  it('offsets as large and as small as numbers go have sizes', () => {
    for (const length of [1e308, 1e154, 1e-154, 5e-324]) {
      const { radii } = jointSizes({ name: '', joints: [joint(-1), joint(0, { offset: [0, length, 0] })] });
      expect([...radii].some(Number.isNaN)).toBe(false);
    }
  });

  it('sizes of joints come from the box where there is a single joint', () => {
    const sizes = jointSizes({ name: '', joints: [joint(-1, { box: { min: [-2, -2, -2], max: [2, 2, 2] } })] });
    expect(sizes.extent).toBeCloseTo(Math.hypot(4, 4, 4), 9);
    expect(sizes.radii[0]).toBeGreaterThan(0);
  });

  it('sizes of joints are above 0 where everything is at one point', () => {
    const point = joint(-1, { box: { min: [0, 0, 0], max: [0, 0, 0] } });
    expect(jointSizes({ name: '', joints: [point] }).radii[0]).toBeGreaterThan(0);
  });
});

it('a ball is at the joint', () => {
  const out = new Float32Array(16);
  sphereMatrix(1, 2, 3, 0.5, out, 0);
  expect(at(out, 0, 1, 0)).toEqual([1, 2.5, 3]);
});
