import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { eulerNear, quaternionOfEuler, quaternionsOfEulers, turnEuler, turnedNear } from '../../src/math/euler.ts';
import { expectClose, WITHIN } from '../helpers/close.ts';
import { evenly } from '../helpers/evenly.ts';

const quaternion = ([a, b, c]: ArrayLike<number> & Iterable<number>) => {
  const q = new Float64Array(4);
  quaternionOfEuler(a / 2, b / 2, c / 2, q, 0);
  return q;
};
const near = (q: Float64Array, angles: Iterable<number>) => {
  const found = Float64Array.from(angles);
  eulerNear(q, found, 0);
  return found;
};
/** |p · q| is the cosine of half the angle between two rotations. 1 − it would lose half the digits. */
const apart = (p: Float64Array, q: Float64Array) => {
  const dot = p.reduce((sum, x, i) => sum + x * q[i], 0);
  return Math.hypot(...p.map((x, i) => x - Math.sign(dot) * q[i]));
};

const RIGHT = Math.PI / 2;
const angle = evenly(-7, 7);
const anyAngles = fc.tuple(angle, angle, angle);
/** Right angles up to rounding, and beside them. */
const lockedBeta = fc
  .tuple(fc.constantFrom(RIGHT, -RIGHT, 3 * RIGHT), fc.constantFrom(0, 1e-16, 1e-13, 1e-11, 1e-8, -1e-9, 1e-4))
  .map(([right, off]) => right + off);
const lockedAngles = fc.tuple(angle, lockedBeta, angle);

describe('the quaternion of Euler angles', () => {
  it('the quaternion of Euler angles is the product of the three about the axes, x applied first', () => {
    const multiply = (p: readonly number[], q: readonly number[]) => [
      p[3] * q[0] + p[0] * q[3] + p[1] * q[2] - p[2] * q[1],
      p[3] * q[1] + p[1] * q[3] + p[2] * q[0] - p[0] * q[2],
      p[3] * q[2] + p[2] * q[3] + p[0] * q[1] - p[1] * q[0],
      p[3] * q[3] - p[0] * q[0] - p[1] * q[1] - p[2] * q[2],
    ];
    fc.assert(
      fc.property(anyAngles, (angles) => {
        const [x, y, z] = angles.map((value, axis) => {
          const q = [0, 0, 0, Math.cos(value / 2)];
          q[axis] = Math.sin(value / 2);
          return q;
        });
        expectClose(quaternion(angles), multiply(z, multiply(y, x)), WITHIN.rounding);
      }),
    );
  });
});

it('two quaternions at once are those of each set of angles, near each other or not', () => {
  const step = fc.oneof(evenly(-0.25, 0.25), evenly(-1e-9, 1e-9), fc.constant(0), evenly(-7, 7));
  fc.assert(
    fc.property(anyAngles, fc.tuple(step, step, step), ([a, b, c], [da, db, dc]) => {
      const [p, q] = [new Float64Array(4), new Float64Array(4)];
      quaternionsOfEulers(a / 2, b / 2, c / 2, (a + da) / 2, (b + db) / 2, (c + dc) / 2, p, q);
      expectClose(p, quaternion([a, b, c]), WITHIN.rounding);
      expectClose(q, quaternion([a + da, b + db, c + dc]), WITHIN.rounding);
    }),
    { numRuns: 1000 },
  );
});

describe('the Euler angles of a quaternion', () => {
  it('Euler angles of a quaternion give it back, in gimbal lock too', () => {
    fc.assert(
      fc.property(fc.oneof(anyAngles, lockedAngles), fc.oneof(anyAngles, lockedAngles), (angles, from) => {
        const q = quaternion(angles);
        expect(apart(quaternion(near(q, from)), q)).toBeLessThan(1e-11);
      }),
      { numRuns: 2000 },
    );
  });

  it('the Euler angles of a quaternion are those that it was made of, if they are looked for there', () => {
    fc.assert(
      fc.property(anyAngles, (angles) => {
        // Beside gimbal lock the angles themselves are uncertain.
        fc.pre(Math.abs(Math.cos(angles[1])) > 1e-3);
        expectClose(near(quaternion(angles), angles), angles, 1e-12);
        expectClose(
          near(
            quaternion(angles).map((x) => -x),
            angles,
          ),
          angles,
          1e-12,
        );
      }),
    );
  });

  it('the Euler angles of a quaternion stay unchanged in gimbal lock', () => {
    fc.assert(
      fc.property(angle, fc.constantFrom(RIGHT, -RIGHT, 3 * RIGHT), angle, (a, b, c) => {
        expectClose(near(quaternion([a, b, c]), [a, b, c]), [a, b, c], 1e-11);
      }),
    );
  });

  it('the Euler angles of a quaternion are nearer than the other set and than any turned by whole turns', () => {
    fc.assert(
      fc.property(anyAngles, anyAngles, (angles, from) => {
        const square = (set: ArrayLike<number>) => from.reduce((sum, x, i) => sum + (set[i] - x) ** 2, 0);
        const [a, b, c] = angles;
        const sets = [
          [a, b, c],
          [a + Math.PI, Math.PI - b, c + Math.PI],
        ].map((set) => set.map((x, i) => turnedNear(x, from[i])));
        const least = Math.min(...sets.map(square));
        fc.pre(Math.abs(Math.cos(b)) > 1e-3);
        expect(square(near(quaternion(angles), from))).toBeLessThan(least + 1e-9);
      }),
      { numRuns: 1000 },
    );
  });
});

describe('turning Euler angles by a little', () => {
  const step = evenly(-0.15, 0.15);
  const unlocked = fc.tuple(angle, evenly(-2, 2), angle);

  it('gives the angles of the other rotation, nearest to those given', () => {
    let turned = 0;
    fc.assert(
      fc.property(fc.oneof(unlocked, lockedAngles), fc.tuple(step, step, step), (angles, steps) => {
        const to = angles.map((value, i) => value + steps[i]);
        const found = Float64Array.from(angles);
        const q = quaternion(to);
        if (!turnEuler(quaternion(angles), 0, q, 0, found, 0)) {
          expect([...found]).toEqual(angles);
          return;
        }
        turned++;
        expect(apart(quaternion(found), q)).toBeLessThan(1e-12);
        if (Math.abs(Math.cos(to[1])) > 1e-3 && Math.abs(Math.cos(angles[1])) > 1e-3) {
          expectClose(found, near(q, angles), 1e-10);
        }
      }),
      { numRuns: 2000 },
    );
    expect(turned).toBeGreaterThan(150);
  });

  it('says so where the rotations are far apart', () => {
    const angles = Float64Array.of(0.1, 0.2, 0.3);
    expect(turnEuler(quaternion([0.1, 0.2, 0.3]), 0, quaternion([2, 0.2, 0.3]), 0, angles, 0)).toBe(false);
    expect(turnEuler(quaternion([0.1, 0.2, 0.3]), 0, Float64Array.of(NaN, 0, 0, 1), 0, angles, 0)).toBe(false);
    expect([...angles]).toEqual([0.1, 0.2, 0.3]);
  });
});
