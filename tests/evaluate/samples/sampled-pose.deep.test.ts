import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { compileSkeleton, worldMatrices } from '../../../src/evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../../src/evaluate/pose.ts';
import { RADIANS_PER_DEGREE } from '../../../src/math/degrees.ts';
import type { Character } from '../../../src/model/document.ts';
import { rootDofCount } from '../../../src/model/skeleton/dofs.ts';
import { dofsOf } from '../../../src/model/skeleton/joint-types.ts';
import {
  type BvhChannel,
  EULER_ORDERS,
  type EulerOrder,
  type Motion,
  UNLIMITED,
} from '../../../src/model/skeleton/skeleton.ts';
import { INTERPOLATIONS, type Interpolation } from '../../../src/model/takes/samples.ts';
import { restChannel, SAMPLED } from '../../../src/model/takes/take.ts';
import { character, joint, takeOfValues } from '../../helpers/builders.ts';
import { expectClose, WITHIN } from '../../helpers/close.ts';
import { evenly } from '../../helpers/evenly.ts';

/** A joint of that motion, and what samples say of it: a row a frame, a frame a second; angles in degrees. */
function take(motion: Motion, rows: readonly (readonly number[])[], interpolation: Interpolation = 'linear') {
  const dofs = dofsOf(motion);
  const skeleton = {
    name: 'hero',
    joints: [joint(-1, { offset: [0, 0, 0], motion, limits: dofs.map(() => UNLIMITED), pose: dofs.map(() => 0) })],
  };
  const firstChannel = rootDofCount(skeleton);
  return character({
    skeleton,
    takes: [
      {
        name: 'take',
        range: [0, rows.length - 1],
        channels: Array.from({ length: firstChannel + dofs.length }, (_, c) =>
          c < firstChannel ? restChannel() : SAMPLED,
        ),
        samples: {
          frameCount: rows.length,
          frameSeconds: 1,
          startSeconds: 0,
          firstChannel,
          values: Float64Array.from(rows.flat()),
          scales: Float64Array.from(dofs, ({ unit }) => (unit === 'angle' ? RADIANS_PER_DEGREE : 1)),
          interpolation,
        },
      },
    ],
    shownTake: 0,
  });
}

/** The DOFs of the joint, without the root translation. */
function poseOf(c: Character, time: number): number[] {
  const out = new Float64Array(dofCountOf(c));
  poseAt(c, time, out);
  return [...out.subarray(rootDofCount(c.skeleton))];
}

const degrees = (c: Character, time: number) => poseOf(c, time).map((x) => x / RADIANS_PER_DEGREE);

/** Columns of the joint's rotation, 9 numbers. */
function rotationOf(c: Character, time: number): number[] {
  const out = new Float64Array(dofCountOf(c));
  poseAt(c, time, out);
  const world = new Float64Array(16);
  if (c.skeleton) worldMatrices(compileSkeleton(c.skeleton), out, world);
  return [0, 4, 8].flatMap((column) => [...world.subarray(column, column + 3)]);
}

/** Written plainly, to be held against: quaternions w x y z. */
type Quaternion = readonly [number, number, number, number];

const product = ([a, b, c, d]: Quaternion, [e, f, g, h]: Quaternion): Quaternion => [
  a * e - b * f - c * g - d * h,
  a * f + b * e + c * h - d * g,
  a * g - b * h + c * e + d * f,
  a * h + b * g - c * f + d * e,
];
const dot = (p: Quaternion, q: Quaternion) => p.reduce((sum, x, i) => sum + x * q[i], 0);
/** Of rotations in degrees about axes, multiplied from left to right. */
function quaternionOf(axes: readonly string[], angles: readonly number[]): Quaternion {
  return axes.reduce<Quaternion>(
    (q, axis, i) => {
      const half = (angles[i] * RADIANS_PER_DEGREE) / 2;
      const [x, y, z] = ['x', 'y', 'z'].map((name) => (name === axis ? Math.sin(half) : 0));
      return product(q, [Math.cos(half), x, y, z]);
    },
    [1, 0, 0, 0],
  );
}
function slerp(p: Quaternion, to: Quaternion, t: number): Quaternion {
  const q = dot(p, to) < 0 ? times(to, -1) : to;
  const theta = Math.acos(Math.min(1, dot(p, q)));
  if (theta < 1e-7) return plus(times(p, 1 - t), times(q, t));
  return plus(times(p, Math.sin((1 - t) * theta) / Math.sin(theta)), times(q, Math.sin(t * theta) / Math.sin(theta)));
}
const times = ([a, b, c, d]: Quaternion, s: number): Quaternion => [a * s, b * s, c * s, d * s];
const plus = (p: Quaternion, q: Quaternion): Quaternion => [p[0] + q[0], p[1] + q[1], p[2] + q[2], p[3] + q[3]];
const matrixOf = ([w, x, y, z]: Quaternion) => [
  ...[1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)],
  ...[2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)],
  ...[2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)],
];

const angle = fc.oneof(evenly(-400, 400), fc.constantFrom(-180, -90, 0, 90, 179, -179, 270));
const row = fc.tuple(angle, angle, angle);
const part = evenly(0.001, 0.999);

/** A joint of BVH that lists its axes in that order. */
const bvh = (axes: readonly string[], positions: readonly BvhChannel[] = []): Motion => ({
  kind: 'bvh',
  // One of x, y and z each.
  channels: [...positions, ...axes.map((axis) => `r${axis}` as BvhChannel)],
  positions: 'replace',
});

describe('samples at their frames', () => {
  it("samples at their frames are the file's own values, however they are interpolated and whatever the joint", () => {
    const anyMotion = fc.constantFrom<Motion>(
      { kind: 'ball', order: 'yzx' },
      bvh(['z', 'x', 'y']),
      bvh(['y', 'x']),
      { kind: 'hinge', axis: [1, 0, 0] },
      { kind: 'quaternion' },
      { kind: 'free', order: 'xyz' },
    );
    fc.assert(
      fc.property(
        anyMotion,
        fc.array(fc.array(angle, { minLength: 6, maxLength: 6 }), { minLength: 1, maxLength: 5 }),
        fc.constantFrom(...INTERPOLATIONS),
        (motion, long, interpolation) => {
          const dofs = dofsOf(motion);
          const rows = long.map((values) => values.slice(0, dofs.length));
          const c = take(motion, rows, interpolation);
          rows.forEach((values, frame) => {
            const scaled = values.map((x, d) => (dofs[d].unit === 'angle' ? x * RADIANS_PER_DEGREE : x));
            expect(poseOf(c, frame)).toEqual(scaled);
          });
          expect(poseOf(c, -1)).toEqual(poseOf(c, 0));
          expect(poseOf(c, 99)).toEqual(poseOf(c, rows.length - 1));
        },
      ),
    );
  });
});

describe('nearest', () => {
  it('nearest is the nearer frame, all of it', () => {
    const c = take(
      bvh(['z', 'x', 'y'], ['tx', 'ty', 'tz']),
      [
        [1, 2, 3, 10, 20, 30],
        [4, 5, 6, 170, -170, 90],
      ],
      'nearest',
    );
    for (const time of [0.1, 0.49]) expect(poseOf(c, time)).toEqual(poseOf(c, 0));
    for (const time of [0.5, 0.9]) expect(poseOf(c, time)).toEqual(poseOf(c, 1));
  });
});

describe('linear', () => {
  it('linear is slerp of the rotation that the listed angles make, in every order', () => {
    fc.assert(
      fc.property(fc.constantFrom(...EULER_ORDERS), row, row, part, (order, from, to, t) => {
        const axes = [...order];
        const [p, q] = [from, to].map((angles) => quaternionOf(axes, angles));
        // Half a turn goes either way.
        fc.pre(Math.abs(dot(p, q)) > 1e-6);
        const expected = matrixOf(slerp(p, q, t));
        expectClose(rotationOf(take(bvh(axes), [from, to]), t), expected, 1e-10, `${order} at ${t}`);
      }),
      { numRuns: 500 },
    );
  });

  it('linear is the same of balls and free joints, whose angles stand as x, y, z', () => {
    fc.assert(
      fc.property(fc.constantFrom(...EULER_ORDERS), row, row, part, (order: EulerOrder, from, to, t) => {
        const turned = (angles: readonly number[]) =>
          quaternionOf(
            [...order].reverse(),
            [...order].reverse().map((axis) => angles['xyz'.indexOf(axis)]),
          );
        fc.pre(Math.abs(dot(turned(from), turned(to))) > 1e-6);
        const expected = matrixOf(slerp(turned(from), turned(to), t));
        expectClose(rotationOf(take({ kind: 'ball', order }, [from, to]), t), expected, 1e-10, order);
        const free = take({ kind: 'free', order }, [
          [1, 2, 3, ...from],
          [3, 2, 7, ...to],
        ]);
        expectClose(rotationOf(free, t), expected, 1e-10, order);
        expectClose(poseOf(free, t).slice(0, 3), [1 + 2 * t, 2, 3 + 4 * t], WITHIN.rounding);
      }),
    );
  });

  it('linear is that of a quaternion joint, whatever the sign and the length of what the frames hold', () => {
    const number = evenly(-2, 2);
    const some = fc.tuple(number, number, number, number).filter((q) => Math.hypot(...q) > 0.1);
    fc.assert(
      fc.property(some, some, part, ([x, y, z, w], [x1, y1, z1, w1], t) => {
        const unit = (q: Quaternion) => times(q, 1 / Math.hypot(...q));
        const p = unit([w, x, y, z]);
        const q = unit([w1, x1, y1, z1]);
        fc.pre(Math.abs(dot(p, q)) > 1e-6);
        const c = take({ kind: 'quaternion' }, [
          [x, y, z, w],
          [x1, y1, z1, w1],
        ]);
        expectClose(rotationOf(c, t), matrixOf(slerp(p, q, t)), 1e-10);
      }),
    );
    const flipping = take({ kind: 'quaternion' }, [
      [0, 0, 0, 2],
      [0, 0, 0, -1],
      [0, 0, 0, 0],
    ]);
    expectClose(
      [0.25, 0.75, 1.5].map((t) => poseOf(flipping, t)[3]),
      [1.75, -1.25, -0.5],
      WITHIN.rounding,
    );
  });

  it('linear stays at the angles of the frames where they go on smoothly', () => {
    const step = evenly(-20, 20);
    fc.assert(
      fc.property(fc.constantFrom(...EULER_ORDERS), row, fc.tuple(step, step, step), (order, from, steps) => {
        const axes = [...order];
        // The angle in the middle, a good way off gimbal lock.
        const lock = Math.abs(Math.cos(from[1] * RADIANS_PER_DEGREE));
        fc.pre(lock > 0.6);
        const to = from.map((x, i) => x + steps[i]);
        const c = take(bvh(axes), [from, to]);
        let last = degrees(c, 0);
        for (let t = 1; t <= 64; t++) {
          const now = degrees(c, t / 64);
          for (let i = 0; i < 3; i++) expect(Math.abs(now[i] - last[i])).toBeLessThan(3);
          last = now;
        }
      }),
    );
  });

  it('linear goes from 179° to −179° by 2°, and jumps halfway, from the one number to the other', () => {
    const c = take(bvh(['z', 'x', 'y']), [
      [179, 0, 0],
      [-179, 0, 0],
    ]);
    expectClose(degrees(c, 0.25), [179.5, 0, 0], WITHIN.rounding);
    expectClose(degrees(c, 0.75), [-179.5, 0, 0], WITHIN.rounding);
  });

  it('linear does not see that the file goes from one set of angles to the other', () => {
    // (z, x, y) and (z + 180°, 180° − x, y + 180°) are one rotation.
    const c = take(bvh(['z', 'x', 'y']), [
      [10, 80, 20],
      [190, 100 - 4, 200],
    ]);
    expectClose(degrees(c, 0.25), [10, 81, 20], 1e-11);
    expectClose(degrees(c, 0.75), [190, 97, 200], 1e-11);
  });

  it('passes through gimbal lock, and stands in it, without a jump', () => {
    const through = take(bvh(['z', 'x', 'y']), [
      [10, 85, 20],
      [10, 95, 20],
    ]);
    for (const t of [0.2, 0.5, 0.50001, 0.9]) expectClose(degrees(through, t), [10, 85 + 10 * t, 20], 1e-10);
    const within = take(bvh(['z', 'x', 'y']), [
      [10, 90, 20],
      [30, 90, 50],
    ]);
    for (const t of [0.2, 0.5, 0.9]) expectClose(degrees(within, t), [10 + 20 * t, 90, 20 + 30 * t], 1e-10);
  });

  it('linear turns one angle, and each of two, the shorter way round', () => {
    const hinge = take({ kind: 'hinge', axis: [0, 1, 0] }, [[350], [10], [-350]]);
    expectClose(
      [0.25, 0.75, 1.25].map((t) => degrees(hinge, t)[0]),
      [355, 5, 10],
      1e-11,
    );
    const two = take(bvh(['x', 'z']), [
      [170, 0],
      [-170, 40],
    ]);
    expectClose(degrees(two, 0.25), [175, 10], WITHIN.rounding);
    expectClose(degrees(two, 0.75), [-175, 30], WITHIN.rounding);
  });

  it('takes each angle by itself where another one of the joint has keys', () => {
    const c = take(bvh(['z', 'x', 'y']), [
      [170, 0, 0],
      [-170, 40, 80],
    ]);
    const [sampled] = c.takes;
    const [key] = takeOfValues('key', [0.5]).channels;
    const channels = sampled.channels.with(rootDofCount(c.skeleton) + 1, key);
    const mixed = { ...c, takes: [{ ...sampled, channels }] };
    expectClose(poseOf(mixed, 0.25), [175 * RADIANS_PER_DEGREE, 0.5, 20 * RADIANS_PER_DEGREE], WITHIN.rounding);
  });

  it('linear turns a screw as far as the file says, for that is how far it goes', () => {
    const c = take({ kind: 'screw', axis: [0, 1, 0], pitch: 2 }, [[0], [720]]);
    expectClose(degrees(c, 0.5), [360], WITHIN.rounding);
  });
});

describe('cubic', () => {
  /** How fast the rotation's matrix changes beside a time. */
  const speed = (c: Character, time: number, step: number) => {
    const [a, b] = [rotationOf(c, time), rotationOf(c, time + step)];
    return b.map((x, i) => (x - a[i]) / step);
  };
  const fewDegrees = evenly(-60, 60);
  const someRow = fc.tuple(fewDegrees, fewDegrees, fewDegrees);

  it('cubic comes to each frame as it goes on from it, also where the file jumps there', () => {
    const flips = fc.array(fc.constantFrom(0, 1, 2), { minLength: 5, maxLength: 5 });
    fc.assert(
      fc.property(fc.array(someRow, { minLength: 5, maxLength: 5 }), flips, (rows, flip) => {
        const written = rows.map(([z, x, y], i) =>
          flip[i] === 0 ? [z, x, y] : flip[i] === 1 ? [z + 360, x, y - 720] : [z + 180, 180 - x, y - 180],
        );
        const c = take(bvh(['z', 'x', 'y']), written, 'cubic');
        for (let frame = 1; frame < 4; frame++) {
          expectClose(rotationOf(c, frame - 1e-5), rotationOf(c, frame), 1e-3, 'where it comes to');
          expectClose(speed(c, frame - 2e-5, 1e-5), speed(c, frame + 1e-5, 1e-5), 5e-3, 'speeds');
        }
        // And it is the same motion as without the jumps.
        const plain = take(bvh(['z', 'x', 'y']), rows, 'cubic');
        for (const t of [0.3, 1.4, 2.5, 3.6]) expectClose(rotationOf(c, t), rotationOf(plain, t), 1e-10);
      }),
    );
  });

  it('cubic turns evenly about one axis, and moves evenly, where the frames do', () => {
    const rows = [0, 1, 2, 3].map((k) => [k, 2 * k, 0, 170 + 4 * k > 180 ? 4 * k - 190 : 170 + 4 * k, 0, 0]);
    const c = take(bvh(['z', 'x', 'y'], ['tx', 'ty', 'tz']), rows, 'cubic');
    for (const t of [0.3, 1.5, 2.6]) {
      expectClose(poseOf(c, t).slice(0, 3), [t, 2 * t, 0], WITHIN.rounding);
      const turn = (170 + 4 * t) * RADIANS_PER_DEGREE;
      // On a line in four numbers, not on a circle: off by less than a thousandth of a degree at 4° a frame.
      expectClose(rotationOf(c, t).slice(0, 2), [Math.cos(turn), Math.sin(turn)], 2e-5);
    }
  });

  it('takes the shorter way of an angle by itself from each frame to the next', () => {
    const c = take({ kind: 'hinge', axis: [0, 1, 0] }, [[170], [175], [-180], [-175], [-170]], 'cubic');
    expectClose(
      [0.4, 1.4, 1.6, 2.5].map((t) => degrees(c, t)[0]),
      [172, 177, -182, -177.5],
      1e-10,
    );
  });

  it('cubic is smooth in a quaternion joint whose signs jump', () => {
    const plain = [0, 1, 3, 4].map((k) => [Math.sin(k / 9), 0, 0, Math.cos(k / 9)]);
    const c = take({ kind: 'quaternion' }, plain, 'cubic');
    const flipped = take(
      { kind: 'quaternion' },
      plain.map((q, i) => q.map((x) => (i % 2 ? -x : x))),
      'cubic',
    );
    for (const t of [0.3, 1.2, 1.9, 2.7]) {
      expectClose(rotationOf(flipped, t), rotationOf(c, t), WITHIN.rounding);
      expect(Math.hypot(...poseOf(c, t))).toBeCloseTo(1, 12);
    }
  });
});
