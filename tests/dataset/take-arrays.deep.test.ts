import fc from 'fast-check';
import { beforeAll, describe, expect, it } from 'vitest';
import { loadFiles, openLoaded } from '../../src/cli/load.ts';
import { FloatPool } from '../../src/dataset/float-pool.ts';
import { type TakeOptions, takeOf } from '../../src/dataset/take.ts';
import { type TakeArrays, takeArrays } from '../../src/dataset/take-arrays.ts';
import { eachFrame } from '../../src/evaluate/bake.ts';
import { endSitePositions } from '../../src/evaluate/end-sites.ts';
import { compileSkeleton, worldMatrices } from '../../src/evaluate/kinematics.ts';
import { applySpace } from '../../src/evaluate/space/space.ts';
import { writeRotationPart } from '../../src/math/mat3.ts';
import { writeRotation } from '../../src/math/quaternion.ts';
import type { Character } from '../../src/model/document.ts';
import { filePose } from '../../src/model/skeleton/dofs.ts';
import { dofsOf } from '../../src/model/skeleton/joint-types.ts';
import { UNLIMITED } from '../../src/model/skeleton/skeleton.ts';
import type { Space } from '../../src/model/space.ts';
import { SAMPLED } from '../../src/model/takes/take.ts';
import { bvhMotion, motion } from '../formats/arbitraries.ts';
import { character, joint } from '../helpers/builders.ts';
import { BVH_FILES } from '../helpers/bvh-files.ts';
import { expectClose } from '../helpers/close.ts';
import { expectEqual } from '../helpers/equal.ts';
import { conformance, describeShared, sharedPath } from '../helpers/shared.ts';

function opened(name: string): readonly Character[] {
  return openLoaded(loadFiles([sharedPath(`data/bvh/${name}`)], '/')).document.characters;
}

const of = (character: Character, options: TakeOptions = {}) =>
  takeArrays(takeOf(character, options), new FloatPool('float64'));

/** Every number of a take, from the evaluator's matrices, compared with the arrays. */
function expectEvaluated(character: Character, options: TakeOptions, got: TakeArrays, tolerance: number): void {
  const take = takeOf(character, options);
  const { skeleton: own, space, frames } = take;
  const compiled = compileSkeleton(own);
  const J = own.joints.length;
  const world = new Float64Array(16 * J);
  const positions: number[] = [];
  const ends: number[] = [];
  const rotations: number[] = [];
  const at = new Float64Array(3);
  const up = new Float64Array(9);
  const push = (list: number[], x: number, y: number, z: number) => {
    applySpace(space, x, y, z, at);
    list.push(...at);
  };
  eachFrame(take.character, frames, (dofs) => {
    worldMatrices(compiled, dofs, world);
    for (let j = 0; j < J; j++) {
      push(positions, world[16 * j + 12], world[16 * j + 13], world[16 * j + 14]);
      writeRotationPart(world, 16 * j, up, 0, 3);
      for (let c = 0; c < 3; c++) {
        const [x, y, z] = up.subarray(3 * c, 3 * c + 3);
        rotations.push(...(space?.up === 'z' ? [x, z, -y] : [x, y, z]));
      }
    }
    for (const { position } of endSitePositions(own, world)) push(ends, ...position);
  });
  const T = frames.frameCount;
  expect(got.frameCount).toBe(T);
  const size = positions.reduce((most, x) => Math.max(most, Math.abs(x)), 1);
  expectClose(
    got.positions.map((x) => x / size),
    positions.map((x) => x / size),
    tolerance,
    'positions',
  );
  expectClose(
    got.endPositions.map((x) => x / size),
    ends.map((x) => x / size),
    tolerance,
    'End Sites',
  );
  const turned = new Float64Array(9 * J * T);
  for (let i = 0; i < J * T; i++) {
    const [x, y, z, w] = got.worldQuat.subarray(4 * i, 4 * i + 4);
    writeRotation(x, y, z, w, turned, 9 * i, 3);
  }
  expectClose(turned, rotations, tolerance, 'world rotations');
}

/** What holds for any take by itself. */
function expectConsistent(a: TakeArrays): void {
  const { frameCount: T, parents } = a;
  const J = parents.length;
  const q = (list: ArrayLike<number>, t: number, j: number) =>
    Array.from({ length: 4 }, (_, k) => list[4 * (t * J + j) + k]);
  const dot = (p: readonly number[], r: readonly number[]) => p.reduce((s, x, k) => s + x * r[k], 0);
  // Written so that NaN is worst; `expect` takes most of the time for so many numbers.
  const worst = { length: 0, sign: 0, product: 0, velocity: 0 };
  const see = (what: keyof typeof worst, off: number) => {
    if (!(off <= worst[what])) worst[what] = off;
  };
  for (let t = 0; t < T; t++) {
    for (let j = 0; j < J; j++) {
      for (const list of [a.localQuat, a.worldQuat]) {
        const now = q(list, t, j);
        see('length', Math.abs(dot(now, now) - 1));
        see('sign', t === 0 ? -now[3] : -1e-9 - dot(now, q(list, t - 1, j)));
      }
      const [bx, by, bz, bw] = q(a.localQuat, t, j);
      const [ax, ay, az, aw] = parents[j] < 0 ? [0, 0, 0, 1] : q(a.worldQuat, t, parents[j]);
      const product = [
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
      ];
      see('product', 1 - Math.abs(dot(product, q(a.worldQuat, t, j))));
      const m = new Float64Array(9);
      writeRotation(bx, by, bz, bw, m, 0, 3);
      expectClose(a.local6d.subarray(6 * (t * J + j), 6 * (t * J + j) + 6), m.subarray(0, 6), 1e-12, '6D');
    }
  }
  const at = (t: number, i: number) => a.positions[3 * J * t + i];
  for (let i = 0; i < 3 * J && T > 1; i++) {
    for (let t = 0; t < T; t++) {
      const [before, after] = [Math.max(0, t - 1), Math.min(T - 1, t + 1)];
      const speed = ((at(after, i) - at(before, i)) * a.fps) / (after - before);
      see('velocity', Math.abs(a.velocities[3 * J * t + i] - speed) / Math.max(1, Math.abs(speed)));
    }
  }
  expect(worst.length).toBeLessThan(1e-9);
  expect(worst.sign).toBe(0);
  expect(worst.product).toBeLessThan(1e-9);
  expect(worst.velocity).toBeLessThanOrEqual(1e-9);
}

interface Positions {
  readonly files: Readonly<
    Record<
      string,
      {
        readonly nodes: readonly (readonly [string, number, string | null])[];
        readonly positions: Readonly<Record<string, readonly (readonly number[])[]>>;
        readonly positions_add?: Readonly<Record<string, readonly (readonly number[])[]>>;
        readonly tolerance: number;
      }
    >
  >;
}

describeShared('the arrays of the real takes', () => {
  let expected: Positions;
  beforeAll(() => {
    expected = conformance<Positions>('bvh-positions.json');
  });

  it.each(BVH_FILES)('raw positions of %s are those of the reference', (name) => {
    const characters = opened(name);
    const { nodes, positions, positions_add, tolerance } = expected.files[name];
    const isAdded = characters.some(({ skeleton: s }) =>
      s?.joints.some((j) => j.motion.kind === 'bvh' && j.motion.positions === 'add'),
    );
    const arrays = characters.map((character) => of(character, { isRaw: true }));
    for (const [frame, points] of Object.entries(isAdded ? (positions_add ?? positions) : positions)) {
      const joints = points.filter((_, i) => nodes[i][2] !== null).flat();
      const ends = points.filter((_, i) => nodes[i][2] === null).flat();
      const row = (list: ArrayLike<number>, T: number) => {
        const width = list.length / T;
        return Array.from({ length: width }, (_, i) => list[Number(frame) * width + i]);
      };
      const got = arrays.flatMap((a) => row(a.positions, a.frameCount));
      const gotEnds = arrays.flatMap((a) => row(a.endPositions, a.frameCount));
      expect(got.length).toBe(joints.length);
      expect(Math.max(...got.map((x, i) => Math.abs(x - joints[i])))).toBeLessThanOrEqual(tolerance);
      expect(gotEnds.length).toBe(ends.length);
      expect(Math.max(0, ...gotEnds.map((x, i) => Math.abs(x - ends[i])))).toBeLessThanOrEqual(tolerance);
    }
  });

  it.each(BVH_FILES)('in metres, positions and rotations of %s are the evaluator’s', (name) => {
    for (const character of opened(name)) {
      const few = { fps: 5 };
      expectEvaluated(character, few, of(character, few), 1e-9);
      expectConsistent(of(character, few));
    }
  });

  it('a crop is a part of the whole, but for velocities at its ends', () => {
    const [character] = opened('cmu-01_01.bvh');
    const whole = of(character);
    const part = of(character, { crop: { from: 3, to: 5 } });
    const J = part.names.length;
    expect([part.frameCount, part.times[0], part.times[240]]).toEqual([241, 3, 5]);
    expectEqual(part.positions, whole.positions.subarray(360 * 3 * J, 601 * 3 * J));
    expectEqual(part.contacts, whole.contacts.subarray(360 * 2, 601 * 2));
    expectEqual(part.velocities.subarray(3 * J, 240 * 3 * J), whole.velocities.subarray(361 * 3 * J, 600 * 3 * J));
  });

  it('at a quarter of its frames per second a take has every fourth frame as it is', () => {
    const [character] = opened('cmu-01_01.bvh');
    const [whole, quarter] = [of(character), of(character, { fps: 30 })];
    const J = whole.names.length;
    expect([quarter.fps, quarter.frameCount, whole.frameCount]).toEqual([30, 688, 2752]);
    for (const t of [0, 1, 344, 687]) {
      expect(quarter.positions.subarray(3 * J * t, 3 * J * (t + 1))).toEqual(
        whole.positions.subarray(12 * J * t, 12 * J * t + 3 * J),
      );
    }
  });

  it('walking feet are in turn on the ground, and never slide far while they are', () => {
    const [character] = opened('cmu-01_01.bvh');
    const a = of(character);
    expect([...a.contactJoints].map((j) => a.names[j])).toEqual(['LeftToeBase', 'RightToeBase']);
    const standing = a.contacts.reduce((s, c) => s + c, 0) / a.contacts.length;
    expect(standing).toBeGreaterThan(0.3);
    expect(standing).toBeLessThan(0.9);
    const J = a.names.length;
    a.contacts.forEach((contact, i) => {
      const at = 3 * (Math.floor(i / 2) * J + a.contactJoints[i % 2]);
      if (contact) expect(Math.hypot(...a.velocities.subarray(at, at + 3))).toBeLessThan(0.6);
    });
  });

  it('a take retargeted to its own skeleton is itself', () => {
    for (const name of ['cmu-01_01.bvh', 'rokoko-dance.bvh', 'bandai-namco-bow-normal.bvh']) {
      const [character] = opened(name);
      const options = { fps: 10 };
      const plain = of(character, options);
      const again = of(character, { ...options, target: { character } });
      expectClose(again.positions, plain.positions, 1e-3, name);
      expect(again.carrier).toBe(plain.carrier);
    }
  });

  it('mirrored, a take has its left foot on the ground when the right one was', () => {
    const [character] = opened('cmu-01_01.bvh');
    const [plain, mirrored] = [of(character), of(character, { isMirrored: true })];
    const swapped = plain.contacts.map((_, i) => plain.contacts[i ^ 1]);
    const same = mirrored.contacts.filter((c, i) => c === swapped[i]).length / swapped.length;
    expect(same).toBeGreaterThan(0.99);
    const left = plain.names.indexOf('LeftHand');
    const right = plain.names.indexOf('RightHand');
    const height = (a: TakeArrays, j: number, t: number) => a.positions[3 * (t * a.names.length + j) + 1];
    // The arms of this person are not equally long.
    for (const t of [0, 1000, 2000]) expect(height(mirrored, left, t)).toBeCloseTo(height(plain, right, t), 1);
  });

  it('retargeted to another skeleton, a take has that one’s joints and size, and its own length', () => {
    const [source] = opened('rokoko-dance.bvh');
    const [target] = opened('cmu-01_01.bvh');
    const plain = of(source, { fps: 10 });
    const a = of(source, { fps: 10, target: { character: target } });
    expect(a.names).toEqual(target.skeleton?.joints.map(({ name }) => name));
    expect([a.frameCount, a.fps]).toEqual([plain.frameCount, 10]);
    expectConsistent(a);
    expectEvaluated(source, { fps: 10, target: { character: target } }, a, 1e-9);
  });
});

/** Never 0, since nothing turns at a scale of 0. */
const small = fc.integer({ min: -300, max: 300 }).map((n) => n / 100 + 0.003);
const vec3 = fc.tuple(small, small, small);

/** A skeleton of any joint types, and samples in radians and lengths. */
const anyCharacter: fc.Arbitrary<Character> = fc
  .array(fc.record({ motion: fc.oneof(motion, bvhMotion), offset: vec3, above: fc.nat(2), end: vec3 }), {
    minLength: 1,
    maxLength: 6,
  })
  .chain((parts) => {
    // In pre-order: a child of the joint before, or of one of that one's ancestors.
    const parents: number[] = [];
    parts.forEach(({ above }, j) => {
      let parent = j - 1;
      for (let up = 0; up < above && parent > 0; up++) parent = parents[parent];
      parents.push(parent);
    });
    const joints = parts.map(({ motion: own, offset, end }, j) =>
      joint(parents[j], {
        ...{ motion: own, offset, endSites: [end] },
        limits: dofsOf(own).map(() => UNLIMITED),
        pose: dofsOf(own).map(({ rest }) => rest),
      }),
    );
    const own = { name: 'any', joints };
    const width = filePose(own, 0).length;
    return fc.array(small, { minLength: 4 * width, maxLength: 4 * width }).map((values) =>
      character({
        skeleton: own,
        shownTake: 0,
        takes: [
          {
            name: 'any',
            range: [0, 0.3],
            channels: Array.from({ length: width }, () => SAMPLED),
            samples: {
              ...{ frameCount: 4, frameSeconds: 0.1, startSeconds: 0, firstChannel: 0, interpolation: 'linear' },
              values: Float64Array.from(values),
              scales: new Float64Array(width).fill(1),
            },
          },
        ],
      }),
    );
  });

const anySpace: fc.Arbitrary<Space> = fc.record({
  up: fc.constantFrom('y', 'z'),
  unit: fc.constantFrom('centimetres', 'metres'),
  lift: small,
});

describe('the arrays of any take', () => {
  it('are those of the evaluator’s matrices, whatever the joints', () => {
    let seen = 0;
    fc.assert(
      fc.property(anyCharacter, anySpace, fc.boolean(), (own, space, isRaw) => {
        const placed = { ...own, space };
        const a = of(placed, { isRaw });
        // Pitches and axes are of any size.
        if (!a.positions.every((x) => Math.abs(x) < 1e4)) return;
        seen++;
        expectEvaluated(placed, { isRaw }, a, 1e-6);
        expectConsistent(a);
      }),
      { numRuns: 60 },
    );
    expect(seen).toBeGreaterThan(50);
  });
});
