import { describe, expect, it } from 'vitest';
import { Cholesky } from '../../../src/evaluate/weights/cholesky.ts';
import { eliminationOrder } from '../../../src/evaluate/weights/elimination-order.ts';
import { laplacian } from '../../../src/evaluate/weights/laplacian.ts';
import { weld } from '../../../src/evaluate/weights/weld.ts';
import { finish, tube } from './meshes.ts';

const RESIDUAL = 1e-10;

const { positions, triangles } = tube({ around: 24, along: 60, radius: 0.5, length: 3 });
const mesh = finish(weld(positions, triangles));
const matrix = finish(laplacian(mesh));

describe('the Laplacian of a closed surface', () => {
  it('the Laplacian of a closed surface has rows that sum to 0, and areas that sum to the surface', () => {
    for (let i = 0; i < mesh.vertexCount; i++) {
      let sum = matrix.diagonal[i];
      for (let e = matrix.start[i]; e < matrix.start[i + 1]; e++) sum -= matrix.values[e];
      expect(Math.abs(sum)).toBeLessThan(RESIDUAL);
    }
    const area = matrix.areas.reduce((a, b) => a + b);
    // Of the prism with 24 sides.
    const side = 2 * 0.5 * Math.sin(Math.PI / 24);
    const cap = (24 * 0.5 * 0.5 * Math.sin((2 * Math.PI) / 24)) / 2;
    expect(area).toBeCloseTo(24 * side * 3 + 2 * cap, 9);
  });

  it('the Laplacian of a closed surface is symmetric', () => {
    const at = (i: number, j: number) => {
      for (let e = matrix.start[i]; e < matrix.start[i + 1]; e++) if (matrix.columns[e] === j) return matrix.values[e];
      return 0;
    };
    let most = 0;
    for (let i = 0; i < mesh.vertexCount; i++) {
      for (let e = matrix.start[i]; e < matrix.start[i + 1]; e++) {
        most = Math.max(most, Math.abs(at(matrix.columns[e], i) - matrix.values[e]));
      }
    }
    expect(most).toBeLessThan(5e-13);
  });
});

describe('a sparse factorisation', () => {
  it('solves what it was made for', () => {
    const added = Float64Array.from(positions, (_, i) => (i % 7 === 0 ? 0.3 : 0)).subarray(0, mesh.vertexCount);
    const system = finish(Cholesky.of(matrix, added, mesh.positions));
    const right = Float64Array.from(added, (_, i) => Math.sin(i));
    const x = new Float64Array(mesh.vertexCount);
    for (const _ of system.solve(right, x));
    for (let i = 0; i < mesh.vertexCount; i++) {
      let sum = (matrix.diagonal[i] + added[i]) * x[i] - right[i];
      for (let e = matrix.start[i]; e < matrix.start[i + 1]; e++) sum -= matrix.values[e] * x[matrix.columns[e]];
      expect(Math.abs(sum)).toBeLessThan(RESIDUAL);
    }
  });

  it('takes every vertex once, in an order in which halves of the mesh know nothing of each other', () => {
    const order = finish(eliminationOrder(matrix, mesh.positions));
    expect([...order].sort((a, b) => a - b)).toEqual([...order.keys()]);
    const half = mesh.vertexCount >> 1;
    const first = new Set(order.subarray(0, half));
    let separators = 0;
    for (const v of order.subarray(half)) {
      const touches = matrix.columns.subarray(matrix.start[v], matrix.start[v + 1]).some((n) => first.has(n));
      if (touches) separators++;
    }
    // A ring or two around the middle of the tube.
    expect(separators).toBeLessThanOrEqual(2 * 24);
    for (const v of order.subarray(mesh.vertexCount - separators)) {
      expect(matrix.columns.subarray(matrix.start[v], matrix.start[v + 1]).some((n) => first.has(n))).toBe(true);
    }
  });
});
