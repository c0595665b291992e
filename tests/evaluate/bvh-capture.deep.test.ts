import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { bakeTake, framesOf, ownFrames } from '../../src/evaluate/bake.ts';
import { framesFor, toBvhCapture } from '../../src/evaluate/bvh-capture.ts';
import { zxyAngles } from '../../src/evaluate/rotations/euler-angles.ts';
import { writeRotationPart } from '../../src/math/mat3.ts';
import type { Character } from '../../src/model/document.ts';
import { filePose, jointDofCount, rootDofCount } from '../../src/model/skeleton/dofs.ts';
import { dofsOf } from '../../src/model/skeleton/joint-types.ts';
import { AXIS_PAIRS, COMPOUND_DOFS, EULER_ORDERS, type Motion, UNLIMITED } from '../../src/model/skeleton/skeleton.ts';
import { characterOf, positionsAt } from '../edit/convert/round-trip.ts';
import { character, joint, takeOfValues } from '../helpers/builders.ts';
import { bvhJoint, captureOf } from '../helpers/bvh.ts';

const axis = fc
  .tuple(fc.integer({ min: -3, max: 3 }), fc.integer({ min: -3, max: 3 }), fc.integer({ min: -3, max: 3 }))
  .filter((v) => v.some((x) => x !== 0));
const rigid: fc.Arbitrary<Motion> = fc.oneof(
  fc.constantFrom(...EULER_ORDERS).map((order): Motion => ({ kind: 'ball', order })),
  fc.constantFrom(...EULER_ORDERS).map((order): Motion => ({ kind: 'free', order })),
  fc.constantFrom(...AXIS_PAIRS).map((order): Motion => ({ kind: 'universal', order })),
  axis.map((a): Motion => ({ kind: 'hinge', axis: a })),
  axis.map((a): Motion => ({ kind: 'prismatic', axis: a })),
  axis.map((a): Motion => ({ kind: 'screw', axis: a, pitch: 0.5 })),
  fc.constantFrom<Motion>({ kind: 'quaternion' }, { kind: 'translational' }, { kind: 'fixed' }),
  fc.shuffledSubarray(COMPOUND_DOFS.slice(0, 6)).map((dofs): Motion => ({ kind: 'compound', dofs })),
);
const stretching: fc.Arbitrary<Motion> = fc.oneof(
  fc
    .constantFrom('uniform', 'xyz', 'axis')
    .chain((mode) => axis.map((a): Motion => ({ kind: 'scale', mode: mode as 'uniform', axis: a }))),
  fc.constant<Motion>({ kind: 'shear' }),
  fc.shuffledSubarray([...COMPOUND_DOFS]).map((dofs): Motion => ({ kind: 'compound', dofs })),
);
const value = fc.double({ min: -3, max: 3, noNaN: true });

/** A character of joints in a row, every DOF of which is keyed differently at 0 and 1 second. */
function moving(motions: fc.Arbitrary<Motion>): fc.Arbitrary<Character> {
  return fc.array(motions, { minLength: 1, maxLength: 5 }).chain((all) => {
    const joints = all.map((motion, j) =>
      joint(j - 1, {
        motion,
        offset: [j, 1, -0.5],
        limits: dofsOf(motion).map(() => UNLIMITED),
        pose: dofsOf(motion).map(({ rest }) => rest),
      }),
    );
    const skeleton = { name: 'x', joints };
    const count = rootDofCount(skeleton) + jointDofCount(skeleton);
    const keys = fc.array(value, { minLength: count, maxLength: count });
    return fc.tuple(keys, keys).map(([from, to]) => {
      const take = takeOfValues('x_move', from, [0, 1]);
      const channels = take.channels.map((channel, c) => ({
        ...channel,
        times: Float64Array.of(0, 1),
        values: Float64Array.of(from[c], to[c]),
        tangentsIn: { kinds: Uint8Array.of(1, 1), slopes: new Float64Array(2) },
        tangentsOut: { kinds: Uint8Array.of(1, 1), slopes: new Float64Array(2) },
      }));
      return character({ skeleton, pose: filePose(skeleton, 0), takes: [{ ...take, channels }], shownTake: 0 });
    });
  });
}

/** The largest distance between a joint of a character and that of its character, over some frames. */
function worst(who: Character): number {
  const { capture } = toBvhCapture(who, framesOf([0, 1], 10));
  let most = 0;
  for (let frame = 0; frame <= 10; frame++) {
    const there = positionsAt(characterOf(capture), frame / 10);
    positionsAt(who, frame / 10).forEach((p, j) => {
      most = Math.max(most, Math.hypot(...p.map((v, k) => v - there[j][k])));
    });
  }
  return most;
}

describe('any character as a capture of BVH', () => {
  it('any character as a capture of BVH keeps the places of joints of every rigid type', () => {
    fc.assert(
      fc.property(moving(rigid), (who) => {
        expect(worst(who)).toBeLessThan(1e-8);
      }),
    );
  });

  it('any character as a capture of BVH keeps the positions of joints that scale and shear, and reports what it can not store', () => {
    const of = fc.oneof(rigid, stretching);
    fc.assert(
      fc.property(
        moving(of).filter((who) => smallestFactor(who) > 0.05),
        (who) => {
          expect(worst(who)).toBeLessThan(1e-7);
        },
      ),
    );
    const skeleton = { name: 'x', joints: [joint(-1, { motion: { kind: 'shear' }, pose: [0, 0, 0] })] };
    const { diagnostics } = toBvhCapture(character({ skeleton }), framesOf([0, 0], 1), 'x.bvh');
    expect(diagnostics).toMatchObject([{ severity: 'info', code: 'scale-not-held', file: 'x.bvh' }]);
  });

  it('gives balls their own angles as channels, what is applied last first', () => {
    const skeleton = { name: 'x', joints: [joint(-1), joint(0, { motion: { kind: 'ball', order: 'yxz' } })] };
    const who = character({
      skeleton,
      takes: [takeOfValues('x', [1, 2, 3, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6])],
      shownTake: 0,
    });
    const { capture } = toBvhCapture(who, framesOf([0, 0], 30));
    expect(capture.skeleton.joints.map(({ motion }) => motion)).toEqual([
      { kind: 'bvh', channels: ['tx', 'ty', 'tz', 'rz', 'ry', 'rx'], positions: 'replace' },
      { kind: 'bvh', channels: ['rz', 'rx', 'ry'], positions: 'replace' },
    ]);
    const degrees = [0.3, 0.2, 0.1, 0.6, 0.4, 0.5].map((v) => (v * 180) / Math.PI);
    const row = Array.from(capture.take?.samples?.values ?? []);
    expect(row.slice(0, 3)).toEqual([1, 3, 3]);
    row.slice(3).forEach((v, i) => {
      expect(v).toBeCloseTo(degrees[i], 12);
    });
  });

  it('any character as a capture of BVH is the very samples of a take that nobody changed', () => {
    const own = captureOf({ name: 'x', joints: [bvhJoint(-1, ['tx', 'ty', 'tz', 'rx'])] }, [[1, 2, 3, 4]]);
    const who = characterOf(own);
    expect(toBvhCapture(who, framesFor(who, 30)).capture.take).toBe(own.take);
  });

  it('writes what is still sampled to the last bit where other channels have keys', () => {
    const rows = [
      [1, 2, 3, 0.1, 45.678901234567],
      [1, 2, 4, 0.7, 5.4321],
    ];
    const own = captureOf({ name: 'x', joints: [bvhJoint(-1, ['tx', 'ty', 'tz', 'rx', 'rz'])] }, rows);
    if (!own.take) throw new Error('There is a take.');
    const channels = own.take.channels.map((c, i) => (i === 3 ? takeOfValues('', [Math.PI]).channels[0] : c));
    const who = characterOf({ ...own, take: { ...own.take, channels } });
    const { capture } = toBvhCapture(who, framesFor(who, 30));
    expect(Array.from(capture.take?.samples?.values ?? [])).toEqual([
      1, 2, 3, 180, 45.678901234567, 1, 2, 4, 180, 5.4321,
    ]);
  });

  it('any character as a capture of BVH is one frame of the pose as set where there is no take', () => {
    const who = character({ pose: [5, 0, 0, 0, 0, Math.PI / 2, 0, 0, 0] });
    const { capture } = toBvhCapture(who, framesFor(who, 30));
    expect(capture.take?.samples?.frameCount).toBe(1);
    expect(Array.from(capture.take?.samples?.values ?? []).slice(0, 4)).toEqual([5, 1, 0, 90]);
  });
});

/** Of all scales: what flattens a joint leaves nothing of its frame. */
function smallestFactor(who: Character): number {
  let least = 1;
  for (let frame = 0; frame <= 10; frame++) {
    const dofs = bakeTake(who, { startSeconds: frame / 10, frameSeconds: 1, frameCount: 1 }).values;
    let d = rootDofCount(who.skeleton);
    for (const { motion } of who.skeleton?.joints ?? []) {
      for (const { name } of dofsOf(motion)) {
        if (name.startsWith('s')) least = Math.min(least, dofs[d]);
        d++;
      }
    }
  }
  return least;
}

describe('the frames of a take', () => {
  it('the frames of a take are as many as fit, with both ends of a range that holds whole ones', () => {
    expect(framesOf([0, 2.3], 30).frameCount).toBe(70);
    expect(framesOf([0, 68 * 0.0333333], 30).frameCount).toBe(69);
    expect(framesOf([0, 68 * 0.0333333], 60).frameCount).toBe(137);
    expect(framesOf([0, 68.4 / 30], 30).frameCount).toBe(69);
    expect(framesOf([0, 67.99 / 30], 30).frameCount).toBe(68);
    expect(framesOf([1, 1], 30)).toEqual({ startSeconds: 1, frameSeconds: 1 / 30, frameCount: 1 });
    expect(framesOf([-1, 0.99], 1).frameCount).toBe(2);
  });

  it('the frames of a take are the samples’ own where there are some', () => {
    const own = captureOf({ name: 'x', joints: [bvhJoint(-1, ['rx'])] }, [[1], [2]], 0.25);
    expect(ownFrames(characterOf(own))).toEqual({ startSeconds: 0, frameSeconds: 0.25, frameCount: 2 });
    expect(ownFrames(character())).toBeUndefined();
  });

  it('leave out what was set by hand over the take, and the character’s offset in time', () => {
    const who = character({ takes: [takeOfValues('x', new Array(9).fill(0.5))], shownTake: 0, timeOffsetSeconds: 7 });
    const touched = { ...who, unkeyed: { timeSeconds: 0, dofs: [3], values: [9] } };
    expect(bakeTake(touched, framesOf([0, 0], 1)).values).toEqual(new Float64Array(9).fill(0.5));
  });
});

describe('angles of a matrix', () => {
  it('make the same rotation again, at gimbal lock too, and stay near those before', () => {
    const near = fc.oneof(value, fc.constantFrom(Math.PI / 2, -Math.PI / 2, Math.PI / 2 - 1e-9, 0));
    fc.assert(
      fc.property(near, near, near, (a, b, c) => {
        const m = rotation(a, b, c);
        const angles = Float64Array.of(a + 0.01, b, c - 0.01);
        zxyAngles(m, 0, angles, 0);
        const again = rotation(angles[0], angles[1], angles[2]);
        again.forEach((v, i) => {
          expect(Math.abs(v - m[i])).toBeLessThan(1e-12);
        });
      }),
    );
  });

  it('angles of a matrix are of a rotation whatever the matrix does besides', () => {
    const flat = new Float64Array(16);
    writeRotationPart(flat, 0, flat, 0, 4);
    expect(Array.from(flat.subarray(0, 11), (v) => v + 0)).toEqual([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
    const mirrored = Float64Array.of(2, 0, 0, 0, 5, 3, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1);
    writeRotationPart(mirrored, 0, mirrored, 0, 4);
    expect(Array.from(mirrored.subarray(0, 11), (v) => v + 0)).toEqual([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
  });
});

/** Rz(a)·Rx(b)·Ry(c). */
function rotation(a: number, b: number, c: number): Float64Array {
  const [sa, ca, sb, cb, sc, cc] = [a, b, c].flatMap((v) => [Math.sin(v), Math.cos(v)]);
  return Float64Array.of(
    ca * cc - sa * sb * sc,
    sa * cc + ca * sb * sc,
    -cb * sc,
    0,
    -sa * cb,
    ca * cb,
    sb,
    0,
    ca * sc + sa * sb * cc,
    sa * sc - ca * sb * cc,
    cb * cc,
    0,
    0,
    0,
    0,
    1,
  );
}
