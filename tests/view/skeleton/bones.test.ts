import fc from 'fast-check';
import { Matrix4, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import type { Vec3 } from '../../../src/math/vec3.ts';
import type { Box } from '../../../src/model/skeleton/skeleton.ts';
import { Bones } from '../../../src/view/skeleton/bones.ts';
import { joint } from '../../helpers/builders.ts';

const length = fc.double({ min: -4, max: 4, noNaN: true });
const point: fc.Arbitrary<Vec3> = fc.tuple(length, length, length);

describe('the box around bones', () => {
  it('the box around bones is around every corner of every box, every End Site and every tip, and no larger than that', () => {
    const angles = fc.array(fc.double({ min: -3, max: 3, noNaN: true }), { minLength: 9, maxLength: 9 });
    fc.assert(
      fc.property(angles, point, point, point, point, fc.option(length), (turns, offset, a, b, end, tip) => {
        const box: Box = { min: a, max: b };
        const root = joint(-1, { box });
        const arm = joint(0, { offset, box, ...(tip !== null && { length: tip }) });
        const captured = joint(1, {
          offset,
          motion: { kind: 'bvh', channels: ['rz', 'rx', 'ry'], positions: 'replace' },
          endSites: [end],
        });
        const bones = new Bones({ name: 'made', joints: [root, arm, captured] });
        bones.pose(Float64Array.from([1, 2, 3, ...turns]));
        const out = new Float64Array(6);
        bones.bounds(out);

        const matrix = (j: number) => new Matrix4().fromArray(bones.world, 16 * j);
        const points = [0, 1, 2].map((j) => new Vector3().applyMatrix4(matrix(j)));
        points.push(new Vector3(...end).applyMatrix4(matrix(2)));
        if (tip !== null) points.push(new Vector3(0, tip, 0).applyMatrix4(matrix(1)));
        for (let corner = 0; corner < 8; corner++) {
          const from = (k: number) => ((corner >> k) & 1 ? a : b)[k];
          const at: Vec3 = [from(0), from(1), from(2)];
          points.push(new Vector3(...at).applyMatrix4(matrix(0)));
          points.push(new Vector3(...at).applyMatrix4(matrix(1)));
        }
        for (let k = 0; k < 3; k++) {
          const along = points.map((p) => p.getComponent(k));
          expect(out[k]).toBeCloseTo(Math.min(...along), 9);
          expect(out[k + 3]).toBeCloseTo(Math.max(...along), 9);
        }
      }),
    );
  });
});

describe('the matrices of bones in their parents', () => {
  it('the matrices of bones in their parents are those of the pose, whenever one asks', () => {
    const bones = new Bones({ name: 'made', joints: [joint(-1), joint(0)] });
    const pose = new Float64Array(9);
    bones.pose(pose);
    bones.pose(Float64Array.from([1, 2, 3, 0, 0, 0, 0, 0, 0.5]));
    const [root, arm] = bones.bones;
    expect(arm.matrix.elements.slice(12, 15)).toEqual(Float64Array.of(0, 1, 0));
    expect(arm.matrix.elements[0]).toBeCloseTo(Math.cos(0.5), 15);
    expect(new Matrix4().multiplyMatrices(root.matrix, arm.matrix).elements).toEqual(
      Array.from(arm.matrixWorld.elements),
    );
    bones.pose(pose);
    expect(arm.matrix.elements[0]).toBe(1);
  });
});
