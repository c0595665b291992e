import fc from 'fast-check';
import { Euler, Matrix4, Quaternion, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { placementMatrix } from '../../src/view/placements.ts';

const number = fc.double({ min: -10, max: 10, noNaN: true });

describe('the matrix of a placement', () => {
  it('scales, turns about x, then y, then z, and moves', () => {
    fc.assert(
      fc.property(fc.tuple(number, number, number), fc.tuple(number, number, number), (position, turn) => {
        const out = new Float64Array(16);
        placementMatrix({ position, turn, scale: 1.5 }, 0, 0, out);
        const turned = new Quaternion().setFromEuler(new Euler(...turn, 'ZYX'));
        const expected = new Matrix4().compose(new Vector3(...position), turned, new Vector3(1.5, 1.5, 1.5));
        expected.elements.forEach((e, i) => {
          expect(out[i]).toBeCloseTo(e, 9);
        });
      }),
    );
  });

  it('takes the root’s travel over the ground out, in place, and leaves its height', () => {
    const out = new Float64Array(16);
    placementMatrix({ position: [1, 0, 0], turn: [0, 1, 0], scale: 2 }, 5, -3, out);
    const root = new Vector3(5, 4, -3).applyMatrix4(new Matrix4().fromArray(out));
    expect(root.x).toBeCloseTo(1, 12);
    expect(root.y).toBeCloseTo(8, 12);
    expect(root.z).toBeCloseTo(0, 12);
  });
});
