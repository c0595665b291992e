/** Bones fitted to positions: exact where they can be, near where not, and the best rotations. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { median } from '../../../src/evaluate/tree-fit/bones.ts';
import { FittedTree } from '../../../src/evaluate/tree-fit/fit-tree.ts';
import { type JointTree, knownCounts, treesOf } from '../../../src/evaluate/tree-fit/known-trees.ts';
import { clearRotation, nearestRotation } from '../../../src/evaluate/tree-fit/nearest-rotation.ts';
import { multiply3, setIdentity3, turnAbout, turnVector } from '../../../src/math/mat3.ts';

const unit = fc.tuple(
  fc.double({ min: -1, max: 1, noNaN: true }),
  fc.double({ min: -1, max: 1, noNaN: true }),
  fc.double({ min: -1, max: 1, noNaN: true }),
);
const rotations = fc.tuple(unit, fc.double({ min: -3.1, max: 3.1, noNaN: true })).map(([[x, y, z], angle]) => {
  const length = Math.hypot(x, y, z) || 1;
  const out = new Float64Array(9);
  const axis = length === 1 && x === 0 && y === 0 && z === 0 ? [1, 0, 0] : [x / length, y / length, z / length];
  turnAbout(axis[0], axis[1], axis[2], Math.cos(angle), Math.sin(angle), out, 0);
  return out;
});
const matrices = fc
  .array(fc.double({ min: -1, max: 1, noNaN: true }), { minLength: 9, maxLength: 9 })
  .map((list) => Float64Array.from(list));
const identity = new Float64Array(9);
setIdentity3(identity);
const turnVectorOf = (r: Float64Array, [x, y, z]: readonly number[]) =>
  [0, 1, 2].map((k) => r[k] * x + r[3 + k] * y + r[6 + k] * z);
const along = (m: Float64Array, r: Float64Array) => m.reduce((sum, v, k) => sum + v * r[k], 0);

it('the median is that of sorted values, whichever repeat', () => {
  const values = fc.oneof(fc.double({ noNaN: true, min: -1e9, max: 1e9 }), fc.integer({ min: 0, max: 3 }));
  fc.assert(
    fc.property(fc.array(values, { minLength: 1, maxLength: 60 }), (list) => {
      const sorted = list.toSorted((a, b) => a - b);
      const half = list.length >> 1;
      const expected = list.length % 2 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
      // Either zero will do.
      expect(median(Float64Array.from(list)) + 0).toBe(expected + 0);
    }),
  );
});

describe('the rotation that fits vectors best', () => {
  it('is a rotation, and no other fits better', () => {
    fc.assert(
      fc.property(matrices, rotations, rotations, (m, start, other) => {
        const r = start.slice();
        nearestRotation(m, r, identity);
        const product = new Float64Array(9);
        const transposed = Float64Array.from([0, 3, 6, 1, 4, 7, 2, 5, 8], (k) => r[k]);
        multiply3(transposed, 0, r, 0, product, 0);
        product.forEach((v, k) => {
          expect(v).toBeCloseTo(k % 4 === 0 ? 1 : 0, 9);
        });
        expect(along(m, r)).toBeGreaterThanOrEqual(along(m, other) - 1e-7);
      }),
      { numRuns: 300 },
    );
  });

  it('is found directly, the same one, where it is clearly the best', () => {
    let found = 0;
    const part = fc.integer({ min: -50, max: 50 }).map((n) => n / 50);
    const vector = fc.tuple(part, part, part);
    const vectors = fc.array(fc.tuple(vector, vector), { minLength: 1, maxLength: 4 });
    fc.assert(
      fc.property(
        vectors,
        rotations,
        fc.constantFrom(1e-9, 1, 1e12),
        fc.constantFrom(0, 1),
        (pairs, turn, size, noise) => {
          const m = new Float64Array(9);
          let [squares, turnedSquares] = [0, 0];
          for (const [a, error] of pairs) {
            const b = turnVectorOf(turn, a).map((v, k) => size * (v + noise * error[k]));
            squares += a.reduce((sum, v) => sum + v * v, 0);
            turnedSquares += b.reduce((sum, v) => sum + v * v, 0);
            for (let k = 0; k < 9; k++) m[k] += b[k % 3] * a[Math.floor(k / 3)];
          }
          const direct = turn.slice();
          if (!clearRotation(m, Math.sqrt(squares * turnedSquares), direct)) {
            expect(direct).toEqual(turn);
            return;
          }
          found++;
          const r = direct.slice();
          nearestRotation(m, r, direct);
          direct.forEach((v, k) => void expect(Math.abs(v - r[k])).toBeLessThan(1e-8));
        },
      ),
      { numRuns: 500 },
    );
    expect(found).toBeGreaterThan(200);
  });

  it('of vectors along one line, it is the one nearest to the given', () => {
    const m = new Float64Array(9);
    // x is taken to y; the turn about y is free.
    m[1] = 1;
    const r = identity.slice();
    nearestRotation(m, r, identity);
    [0, 1, 0, -1, 0, 0, 0, 0, 1].forEach((v, k) => {
      expect(r[k]).toBeCloseTo(v, 6);
    });
  });

  it('of nothing, it is the given', () => {
    const near = new Float64Array(9);
    turnAbout(0, 0, 1, 0, 1, near, 0);
    const r = identity.slice();
    nearestRotation(new Float64Array(9), r, near);
    expect(r).toEqual(near);
  });
});

/** Any tree of so many joints: each below one before it. */
const trees = fc.integer({ min: 1, max: 12 }).chain((count) =>
  fc.array(fc.nat(1000), { minLength: count, maxLength: count }).map((list): JointTree => {
    const parents = list.map((n, j) => (j === 0 ? -1 : n % j));
    return {
      label: 'any',
      names: parents.map((_, j) => `j${j}`),
      parents,
      points: parents.map((_, j): readonly [number] => [j]),
    };
  }),
);

/** Runs a fit over all frames; the joints where they come to be. */
function fittedOf(tree: JointTree, values: Float64Array, pointCount: number) {
  const frameCount = values.length / (3 * pointCount);
  const fit = new FittedTree({ frameCount, pointCount, values, width: 3 }, tree);
  const count = tree.names.length;
  const [q, places] = [new Float64Array(4 * count), new Float64Array(3 * count)];
  for (let frame = 0; frame < frameCount; frame++) fit.write(frame, q, places);
  return fit;
}

describe('bones fitted to positions', () => {
  it('positions of a tree of bones are met, however it turns', () => {
    fc.assert(
      fc.property(
        trees.chain((tree) =>
          fc.tuple(
            fc.constant(tree),
            fc.array(unit, { minLength: tree.names.length, maxLength: tree.names.length }),
            fc.array(fc.array(rotations, { minLength: tree.names.length, maxLength: tree.names.length }), {
              minLength: 1,
              maxLength: 5,
            }),
          ),
        ),
        ([tree, offsets, frames]) => {
          const count = tree.names.length;
          const values = new Float64Array(3 * count * frames.length);
          frames.forEach((turns, frame) => {
            const world = new Float64Array(9 * count);
            tree.parents.forEach((parent, j) => {
              const at = 3 * (frame * count + j);
              if (parent < 0) {
                world.set(turns[j], 0);
                return;
              }
              multiply3(world, 9 * parent, turns[j], 0, world, 9 * j);
              turnVector(world, 9 * parent, Float64Array.from(offsets[j]), 0, values, at);
              for (let k = 0; k < 3; k++) values[at + k] += values[3 * (frame * count + parent) + k];
            });
          });
          const { largestDistance, meanDistance } = fittedOf(tree, values, count);
          expect(largestDistance).toBeLessThan(1e-6);
          expect(meanDistance).toBeLessThanOrEqual(largestDistance);
        },
      ),
      { numRuns: 100 },
    );
  });

  it('points that are all in one place, or stay there in some frames, have finite rotations', () => {
    const [tree] = treesOf(17);
    const values = new Float64Array(3 * 17 * 4);
    for (let i = 3 * 17 * 2; i < values.length; i++) values[i] = Math.sin(i);
    const fit = new FittedTree({ frameCount: 4, pointCount: 17, values, width: 3 }, tree);
    const count = tree.names.length;
    const [q, places] = [new Float64Array(4 * count), new Float64Array(3 * count)];
    for (let frame = 0; frame < 4; frame++) {
      fit.write(frame, q, places);
      expect([...q, ...places].every(Number.isFinite)).toBe(true);
    }
  });
});

/** Joints at random, but each below the one before it on its way down, by an axis that is up. */
const crouching = fc.tuple(
  fc.constantFrom(...knownCounts().flatMap((count) => treesOf(count))),
  fc.constantFrom(0, 1, 2),
  fc.constantFrom(1, -1),
  fc.integer({ min: 1, max: 1000 }),
);

describe('the rest of a known tree', () => {
  it('is a T-pose along the axis that the body stands along, whatever it does in the first frame', () => {
    fc.assert(
      fc.property(crouching, ([tree, up, sign, seed]) => {
        const { names, parents, points } = tree;
        const pointCount = Math.max(...points.flat()) + 1;
        const values = new Float64Array(3 * pointCount);
        points.forEach(([point, second], j) => {
          if (second !== undefined) return;
          const isBelow = /knee|ankle|foot|toe|heel/.test(names[j]);
          for (let k = 0; k < 3; k++) values[3 * point + k] = 0.3 * Math.sin(seed * (3 * point + k + 1));
          values[3 * point + up] += sign * (isBelow ? -1 : /hip|pelvis/.test(names[j]) ? 0 : 1);
        });
        const { joints } = fittedOf(tree, values, pointCount);
        const offset = (name: string) =>
          Array.from(joints.offsets)
            .slice(3 * names.indexOf(name))
            .slice(0, 3);
        const along = (name: string) => offset(name).map((v) => v / (Math.hypot(...offset(name)) || 1) + 0);
        const upwards = [0, 1, 2].map((k) => (k === up ? sign : 0));
        expect(along('left_knee')).toEqual(upwards.map((v) => expect.closeTo(-v, 9)));
        const [left, right] = ['left_wrist', 'right_wrist'].map(along);
        expect(left).toEqual(right.map((v) => expect.closeTo(-v, 9)));
        expect(left.reduce((sum, v, k) => sum + v * upwards[k], 0)).toBeCloseTo(0, 9);
        expect(joints.parents).toBe(parents);
      }),
    );
  });
});

describe('the known trees', () => {
  it('each has one root, joints of different names, and a point for each', () => {
    for (const points of knownCounts()) {
      const text = `${points}`;
      for (const { names, parents, points: from } of treesOf(points)) {
        expect(new Set(names).size, text).toBe(names.length);
        expect(
          parents.filter((parent) => parent < 0),
          text,
        ).toHaveLength(1);
        expect(names[parents.indexOf(-1)]).toBe('pelvis');
        expect(new Set(from.flat()).size, text).toBe(points);
      }
    }
  });
});
