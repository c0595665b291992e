import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { type Motion, QUANTITIES, type Quantity, quantityOf } from '../../../src/evaluate/measure/quantities.ts';

const FRAME = 1 / 60;

function motion(count: number, at: (seconds: number) => readonly [number, number, number]): Motion {
  return { positions: Float64Array.from(Array.from({ length: count }, (_, f) => at(f * FRAME)).flat()) };
}

function turning(count: number, degrees: (seconds: number) => number): Motion {
  const half = (f: number) => (degrees(f * FRAME) * Math.PI) / 360;
  const rotations = Float64Array.from(
    Array.from({ length: count }, (_, f) => [
      0,
      0.6 * Math.sin(half(f)),
      0.8 * Math.sin(half(f)),
      Math.cos(half(f)),
    ]).flat(),
  );
  return { positions: new Float64Array(3 * count), rotations };
}

function values(of: Motion, quantity: Quantity): number[] {
  const found = quantityOf(of, quantity, FRAME);
  if (!found) throw new Error(`it has no ${quantity}`);
  return [...found];
}

function expectAll(list: readonly number[], expected: number, tolerance: number): void {
  expect(list.length).toBeGreaterThan(0);
  for (const value of list) expect(Math.abs(value - expected)).toBeLessThanOrEqual(tolerance);
}

describe('quantities of a motion', () => {
  it('the speed on a circle is radius times angular speed, and the acceleration points inwards with its square', () => {
    const [radius, omega] = [2, 3];
    const circle = motion(200, (t) => [radius * Math.cos(omega * t), 1, radius * Math.sin(omega * t)]);
    // A chord is shorter than its arc by sin(x)/x.
    const half = omega * FRAME;
    const speed = values(circle, 'speed');
    expectAll(speed.slice(1, -1), (radius * Math.sin(half)) / FRAME, 1e-10);
    expectAll(speed, radius * omega, 0.01);
    expectAll(values(circle, 'acceleration'), radius * omega ** 2, 0.01);
    expectAll(values(circle, 'height'), 1, 0);
  });

  it('the acceleration of free fall is that of gravity in every frame, and its speed grows with time', () => {
    const fall = motion(61, (t) => [1, 10 - 4.905 * t * t, 2]);
    expectAll(values(fall, 'acceleration'), 9.81, 1e-8);
    values(fall, 'speed').forEach((speed, f) => {
      const isEnd = f === 0 || f === 60;
      expect(Math.abs(speed - 9.81 * f * FRAME)).toBeLessThanOrEqual(isEnd ? (9.81 * FRAME) / 2 + 1e-9 : 1e-9);
    });
    expect(values(fall, 'x')).toEqual(new Array(61).fill(1));
    expect(values(fall, 'z')).toEqual(new Array(61).fill(2));
    expect(values(fall, 'height')[60]).toBeCloseTo(5.095, 12);
  });

  it('a constant angular speed is measured as it is, and the angle grows with it to 180 degrees and comes back', () => {
    const joint = turning(121, (t) => 120 * t);
    expectAll(values(joint, 'angularSpeed'), 120, 1e-9);
    values(joint, 'angle').forEach((angle, f) => {
      const turned = 120 * f * FRAME;
      expect(angle).toBeCloseTo(turned > 180 ? 360 - turned : turned, 9);
    });
  });

  it('the angle of a tiny rotation is not rounded to none', () => {
    expect(
      values(
        turning(2, () => 1e-7),
        'angle',
      )[0],
    ).toBeCloseTo(1e-7, 15);
  });

  it('speeds and accelerations do not depend on where a motion is and how it is turned', () => {
    const point = fc.tuple(...[0, 1, 2].map(() => fc.double({ min: -10, max: 10, noNaN: true })));
    fc.assert(
      fc.property(
        fc.array(point, { minLength: 1, maxLength: 12 }),
        point,
        fc.double({ min: -7, max: 7, noNaN: true }),
        (points, [a, b, c], angle) => {
          const [sin, cos] = [Math.sin(angle), Math.cos(angle)];
          const moved = points.map(([x, y, z]) => [cos * x + sin * z + a, y + b, cos * z - sin * x + c]);
          for (const quantity of ['speed', 'acceleration'] as const) {
            const one = values({ positions: Float64Array.from(points.flat()) }, quantity);
            const two = values({ positions: Float64Array.from(moved.flat()) }, quantity);
            one.forEach((value, f) => void expect(Math.abs(value - two[f])).toBeLessThan(1e-9 / FRAME ** 2));
          }
        },
      ),
    );
  });

  it('a motion of one frame has no speed, and a point neither angle nor contact', () => {
    const one = turning(1, () => 30);
    for (const quantity of QUANTITIES) {
      if (quantity === 'contact') continue;
      expect(values(one, quantity)).toHaveLength(1);
      if (quantity !== 'angle') expect(values(one, quantity)).toEqual([0]);
    }
    expect(
      quantityOf(
        motion(2, () => [0, 0, 0]),
        'angle',
        FRAME,
      ),
    ).toBeUndefined();
    expect(quantityOf(one, 'contact', FRAME)).toBeUndefined();
  });
});
