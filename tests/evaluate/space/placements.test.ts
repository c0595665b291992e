import fc from 'fast-check';
import { Euler, Matrix4, Quaternion, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { NO_TRAVEL, placementMatrix } from '../../../src/evaluate/space/placements.ts';
import { applySpace } from '../../../src/evaluate/space/space.ts';

const number = fc.double({ min: -10, max: 10, noNaN: true });

describe('the matrix of a placement', () => {
  it('scales, turns about x, then y, then z, and moves', () => {
    fc.assert(
      fc.property(fc.tuple(number, number, number), fc.tuple(number, number, number), (position, turn) => {
        const out = new Float64Array(16);
        placementMatrix({ position, turn, scale: 1.5 }, undefined, NO_TRAVEL, out);
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
    placementMatrix({ position: [1, 0, 0], turn: [0, 1, 0], scale: 2 }, undefined, Float64Array.of(5, 0, -3), out);
    const root = new Vector3(5, 4, -3).applyMatrix4(new Matrix4().fromArray(out));
    expect(root.x).toBeCloseTo(1, 12);
    expect(root.y).toBeCloseTo(8, 12);
    expect(root.z).toBeCloseTo(0, 12);
  });
});

describe('the space of a character, in its placement', () => {
  const anywhere = fc.tuple(number, number, number);

  it('the space of a character, in its placement comes first: z becomes up, units become metres, and the ground is where it is lifted to', () => {
    fc.assert(
      fc.property(anywhere, anywhere, anywhere, fc.constantFrom('y', 'z', '-y'), (position, turn, point, up) => {
        const placement = { position, turn, scale: 2 };
        const plain = new Float64Array(16);
        const out = new Float64Array(16);
        const space = { up, unit: 'centimetres', lift: 0.75 } as const;
        placementMatrix(placement, undefined, NO_TRAVEL, plain);
        placementMatrix(placement, space, NO_TRAVEL, out);
        const [x, y, z] = point;
        const found = new Vector3(x, y, z).applyMatrix4(new Matrix4().fromArray(out));
        const turned = { y: [y, z], z: [z, -y], '-y': [-y, -z] }[up];
        const own = new Vector3(x / 100, turned[0] / 100 + 0.75, turned[1] / 100);
        const applied = new Float64Array(3);
        applySpace(space, x, y, z, applied);
        expect(new Vector3(...applied).distanceTo(own)).toBeLessThan(1e-9);
        const expected = own.applyMatrix4(new Matrix4().fromArray(plain));
        expect(found.distanceTo(expected)).toBeLessThan(1e-9);
      }),
    );
  });

  it('leaves the root on the spot in place, at its height over the ground', () => {
    const out = new Float64Array(16);
    const placement = { position: [1, 0, 2] as const, turn: [0, 0, 0] as const, scale: 1 };
    placementMatrix(placement, { up: 'z', unit: 'inches', lift: 0 }, Float64Array.of(50, 70, 0), out);
    const root = new Vector3(50, 70, 40).applyMatrix4(new Matrix4().fromArray(out));
    expect(root.x).toBeCloseTo(1, 9);
    expect(root.y).toBeCloseTo(40 * 0.0254, 9);
    expect(root.z).toBeCloseTo(2, 9);
  });
});
