import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { type BoneSegments, squareToBone } from '../../../src/evaluate/weights/bones.ts';
import { heatWeights } from '../../../src/evaluate/weights/heat-weights.ts';
import type { Attachments } from '../../../src/model/skin.ts';
import { bonesFrom, chain, finish, type Mesh, together, tube, weightOf } from './meshes.ts';

/** Weights are kept in ten-thousandths. */
const ROUNDED = 1.0001e-4;

const weigh = (mesh: Mesh, bones: BoneSegments, most = 4) => finish(heatWeights(mesh, bones, most));

/** All sums are 1, all weights above 0, no joint twice at a vertex, no vertex without. */
function expectPartition({ start, joints, weights }: Attachments, vertexCount: number, most: number) {
  expect(start.length).toBe(vertexCount + 1);
  for (let v = 0; v < vertexCount; v++) {
    const own = [...joints.subarray(start[v], start[v + 1])];
    const parts = [...weights.subarray(start[v], start[v + 1])];
    const isInOrder = own.every((joint, k) => k === 0 || joint > own[k - 1]);
    const isWhole = Math.abs(parts.reduce((a, b) => a + b, 0) - 1) < 1e-12;
    if (own.length > 0 && own.length <= most && isInOrder && Math.min(...parts) > 0 && isWhole) continue;
    expect.fail(`vertex ${v} has the joints ${own} by ${parts}`);
  }
}

describe('weights of a tube over three joints', () => {
  const [around, along] = [16, 30];
  const mesh = tube({ around, along, radius: 0.5, length: 6 });
  const { attachments, byDistance } = weigh(mesh, chain(0, 2, 4, 6));
  const up = (joint: number) => Array.from({ length: along + 1 }, (_, r) => weightOf(attachments, r * around, joint));

  it('sum to 1, and none is below 0', () => {
    expectPartition(attachments, mesh.positions.length / 3, 4);
    expect(byDistance).toBe(0);
  });

  it('rise to each bone, and fall behind it', () => {
    const peaks = [0, along / 2, along];
    peaks.forEach((peak, joint) => {
      const weights = up(joint);
      for (let r = 1; r <= along; r++) {
        const rise = weights[r] - weights[r - 1];
        // A weight below the least that is kept ends at once.
        if (r <= peak) expect(rise).toBeGreaterThan(-ROUNDED);
        else expect(rise).toBeLessThan(0.01);
      }
      expect(weights[peak]).toBeGreaterThan(0.85);
    });
  });

  it('weights of a tube over three joints are even at a joint, and change little by little around it', () => {
    for (const [ring, before, after] of [
      [10, 0, 1],
      [20, 1, 2],
    ]) {
      expect(Math.abs(up(before)[ring] - up(after)[ring])).toBeLessThan(0.02);
      // A fifth of the bone's width from ring to ring.
      for (let r = 1; r <= along; r++) expect(Math.abs(up(before)[r] - up(before)[r - 1])).toBeLessThan(0.2);
      expect(up(after)[ring - 5]).toBeLessThan(0.12);
    }
  });

  it('weights of a tube over three joints are the same all around', () => {
    let most = 0;
    for (let v = 0; v < around * (along + 1); v++) {
      for (let joint = 0; joint < 3; joint++) {
        const first = weightOf(attachments, v - (v % around), joint);
        most = Math.max(most, Math.abs(weightOf(attachments, v, joint) - first));
      }
    }
    expect(most).toBeLessThan(2 * ROUNDED);
  });

  it('know nothing of units, nor of which way triangles are wound', () => {
    const scaled = (by: number, { positions, triangles }: Mesh): Mesh => ({
      positions: positions.map((x) => by * x),
      triangles: triangles.toReversed(),
    });
    const bones = chain(0, 2, 4, 6);
    const large = weigh(scaled(1000, mesh), { ...bones, ends: bones.ends.map((x) => 1000 * x) });
    let most = 0;
    for (let v = 0; v < mesh.positions.length / 3; v++) {
      for (let joint = 0; joint < 3; joint++) {
        const difference = weightOf(large.attachments, v, joint) - weightOf(attachments, v, joint);
        most = Math.max(most, Math.abs(difference));
      }
    }
    expect(most).toBeLessThan(2 * ROUNDED);
  });
});

describe('two legs that are closer than they are wide', () => {
  const plan = { around: 12, along: 16, radius: 0.5, length: 4 };
  const left = tube({ ...plan, at: [-0.55, 0] });
  const right = tube({ ...plan, at: [0.55, 0] });
  const legs = together(left, right);
  const count = left.positions.length / 3;
  const bones = bonesFrom(
    [
      [-0.55, 4, 0],
      [-0.55, 0, 0],
    ],
    [
      [0.55, 4, 0],
      [0.55, 0, 0],
    ],
  );

  /** Σ of what each leg's vertices get of the other leg's joint, at most. */
  function bleeding(attachments: Attachments): number {
    let worst = 0;
    for (let v = 0; v < 2 * count; v++) worst = Math.max(worst, weightOf(attachments, v, v < count ? 1 : 0));
    return worst;
  }

  it('two legs that are closer than they are wide follow their own bones only', () => {
    expect(bleeding(weigh(legs, bones).attachments)).toBe(0);
  });

  it('two legs that are closer than they are wide do so with bones that are nearer to the other leg’s inner side than its own', () => {
    const inside = bonesFrom(
      [
        [-0.15, 4, 0],
        [-0.15, 0, 0],
      ],
      [
        [0.95, 4, 0],
        [0.95, 0, 0],
      ],
    );
    expect(squareToBone(inside.ends, 0, 0.05, 2, 0)).toBeLessThan(squareToBone(inside.ends, 1, 0.05, 2, 0));
    expect(bleeding(weigh(legs, inside).attachments)).toBe(0);
  });

  it('would not by distance alone', () => {
    const start = Uint32Array.from({ length: 2 * count + 1 }, (_, v) => 2 * v);
    const joints = Uint32Array.from({ length: 4 * count }, (_, a) => a % 2);
    const weights = Float64Array.from(joints, (joint, a) => {
      const [x, y, z] = legs.positions.subarray(3 * (a >> 1), 3 * (a >> 1) + 3);
      const parts = [0, 1].map((b) => 1 / squareToBone(bones.ends, b, x, y, z));
      return parts[joint] / (parts[0] + parts[1]);
    });
    expect(bleeding({ start, joints, weights })).toBeGreaterThan(0.2);
  });
});

describe('a body put together from parts', () => {
  it('a body put together from parts is seen through where they overlap, as one inside', () => {
    // An arm that begins in the middle of the trunk: the trunk's bone is seen through the arm's skin.
    const trunk = tube({ around: 16, along: 12, radius: 1, length: 4 });
    const upright = tube({ around: 12, along: 16, radius: 0.3, length: 4 });
    const arm: Mesh = {
      ...upright,
      positions: upright.positions.map((_, i) => {
        const [x, y, z] = upright.positions.subarray(i - (i % 3), i - (i % 3) + 3);
        return [0.2 + y, 2 + x, -z][i % 3];
      }),
    };
    const bones = bonesFrom(
      [
        [0, 0, 0],
        [0, 4, 0],
      ],
      [
        [1, 2, 0],
        [4.2, 2, 0],
      ],
    );
    const { attachments, byDistance } = weigh(together(trunk, arm), bones);
    expect(byDistance).toBe(0);
    const trunkCount = trunk.positions.length / 3;
    for (let v = 0; v < trunkCount; v++) {
      // On the side without the arm.
      if (trunk.positions[3 * v] < -0.1) expect(weightOf(attachments, v, 0)).toBeGreaterThan(0.85);
    }
    for (let v = 0; v < arm.positions.length / 3; v++) {
      if (arm.positions[3 * v] > 2) expect(weightOf(attachments, trunkCount + v, 1)).toBeGreaterThan(0.95);
    }
  });

  it('treats vertices that a seam has doubled as one', () => {
    const whole = tube({ around: 8, along: 20, radius: 0.5, length: 4 });
    // Every triangle with three vertices of its own.
    const positions = Float64Array.from(
      [...whole.triangles].flatMap((v) => [...whole.positions.subarray(3 * v, 3 * v + 3)]),
    );
    const soup = { positions, triangles: Uint32Array.from(whole.triangles.keys()) };
    const bones = chain(0, 2, 4);
    const [one, many] = [weigh(whole, bones), weigh(soup, bones)];
    let most = 0;
    whole.triangles.forEach((v, corner) => {
      for (let joint = 0; joint < 2; joint++) {
        const difference = weightOf(one.attachments, v, joint) - weightOf(many.attachments, corner, joint);
        most = Math.max(most, Math.abs(difference));
      }
    });
    expect(most).toBeLessThan(2 * ROUNDED);
  });
});

describe('weights', () => {
  it('mirror where mesh and bones do', () => {
    const arms = tube({ around: 12, along: 24, radius: 0.4, length: 6 });
    const mesh: Mesh = { ...arms, positions: arms.positions.map((x, i) => (i % 3 === 1 ? x - 3 : x)) };
    const bones = bonesFrom(
      [
        [0, -0.5, 0],
        [0, 0.5, 0],
      ],
      [
        [0, 0.5, 0],
        [0, 3, 0],
      ],
      [
        [0, -0.5, 0],
        [0, -3, 0],
      ],
    );
    const { attachments } = weigh(mesh, bones);
    for (let ring = 0; ring <= 24; ring++) {
      for (let k = 0; k < 12; k++) {
        const [v, mirrored] = [12 * ring + k, 12 * (24 - ring) + k];
        for (const [joint, other] of [
          [0, 0],
          [1, 2],
        ]) {
          const difference = weightOf(attachments, v, joint) - weightOf(attachments, mirrored, other);
          expect(Math.abs(difference)).toBeLessThan(2 * ROUNDED);
        }
      }
    }
  });

  it('weights are all of the one joint where there is one', () => {
    const mesh = tube({ around: 6, along: 2, radius: 1, length: 1 });
    const { attachments } = weigh(
      mesh,
      bonesFrom([
        [0, 0, 0],
        [0, 0, 0],
      ]),
    );
    expect([...attachments.weights]).toEqual(Array(mesh.positions.length / 3).fill(1));
  });

  it('weights go by distance where a vertex is in no triangle', () => {
    const mesh = tube({ around: 6, along: 8, radius: 0.5, length: 4 });
    const lone = { ...mesh, positions: Float64Array.from([...mesh.positions, 0.5, 3.9, 7]) };
    const { attachments, byDistance } = weigh(lone, chain(0, 2, 4));
    expect(byDistance).toBe(1);
    const v = mesh.positions.length / 3;
    expect(weightOf(attachments, v, 1)).toBeGreaterThan(weightOf(attachments, v, 0));
  });

  it('weights are there for a mesh far larger than its skeleton, and for one without a triangle', () => {
    const mesh = tube({ around: 8, along: 8, radius: 500, length: 2000 });
    expectPartition(weigh(mesh, chain(0, 0.5, 1)).attachments, mesh.positions.length / 3, 4);
    const points = { positions: mesh.positions, triangles: new Uint32Array(0) };
    const { attachments, byDistance } = weigh(points, chain(0, 0.5, 1));
    expectPartition(attachments, points.positions.length / 3, 4);
    expect(byDistance).toBe(points.positions.length / 3);
  });

  it('share 1 whatever the mesh is like', () => {
    const number = fc.double({ min: -2, max: 2, noNaN: true });
    const triangle = fc.tuple(fc.nat(29), fc.nat(29), fc.nat(29));
    fc.assert(
      fc.property(
        fc.array(number, { minLength: 90, maxLength: 90 }),
        fc.array(triangle, { maxLength: 60 }),
        fc.array(number, { minLength: 18, maxLength: 18 }),
        fc.integer({ min: 1, max: 5 }),
        (positions, triangles, ends, most) => {
          const mesh = { positions: Float64Array.from(positions), triangles: Uint32Array.from(triangles.flat()) };
          const bones = { joints: Uint32Array.of(0, 1, 4), ends: Float64Array.from(ends) };
          expectPartition(weigh(mesh, bones, most).attachments, 30, most);
        },
      ),
      { numRuns: 60 },
    );
  });

  it('pause often, and never go back in what they say is done', () => {
    const steps = heatWeights(tube({ around: 60, along: 100, radius: 0.5, length: 6 }), chain(0, 2, 4, 6), 4);
    let last = 0;
    let pauses = 0;
    for (const part of steps) {
      expect(part).toBeGreaterThanOrEqual(last);
      expect(part).toBeLessThanOrEqual(1);
      last = part;
      pauses++;
    }
    expect(pauses).toBeGreaterThan(20);
  });
});
