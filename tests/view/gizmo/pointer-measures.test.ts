import { describe, expect, it } from 'vitest';
import type { Vec3 } from '../../../src/math/vec3.ts';
import {
  diagonalMeasure,
  rollMeasure,
  type Sight,
  slideMeasure,
  turnMeasure,
  upMeasure,
  viewTurnMeasure,
} from '../../../src/view/gizmo/pointer-measures.ts';
import { expectClose } from '../../helpers/close.ts';

/** Looks along −z, 100 pixels per unit, the origin at the centre of 800 × 600. */
const flat: Sight = {
  toScreen: ([x, y, z]) => ({ x: 400 + 100 * x, y: 300 - 100 * y, depth: 10 - z }),
  rayAt: (x, y) => ({ origin: [(x - 400) / 100, (300 - y) / 100, 10], direction: [0, 0, -1] }),
  inPlaneOf: ([, , z], x, y) => [(x - 400) / 100, (300 - y) / 100, z],
  unitsPerPixel: () => 0.01,
};
const ORIGIN: Vec3 = [0, 0, 0];
const around = (degrees: number, radius = 100): [number, number] => [
  400 + radius * Math.cos((degrees * Math.PI) / 180),
  300 - radius * Math.sin((degrees * Math.PI) / 180),
];

describe('a ring that faces the viewer', () => {
  it('a ring that faces the viewer turns with the hand, round and round', () => {
    const measure = turnMeasure(flat, [0, 0, 1], ORIGIN, 1, ...around(10));
    let total = 0;
    for (let a = 10; a <= 10 + 400; a += 20) total += measure(...around(a));
    expect(total).toBeCloseTo((400 * Math.PI) / 180, 9);
  });

  it('a ring that faces the viewer turns the other way when it is seen from behind', () => {
    const measure = turnMeasure(flat, [0, 0, -1], ORIGIN, 1, ...around(0));
    expect(measure(...around(30))).toBeCloseTo(-Math.PI / 6, 9);
  });
});

describe('a ring seen aslant', () => {
  it('a ring seen aslant stays under the pointer', () => {
    const axis: Vec3 = [Math.SQRT1_2, 0, Math.SQRT1_2];
    // Points of the ring, by angle from y: y · cos + (axis × y) · sin.
    const at = (angle: number): [number, number] => {
      const side: Vec3 = [-Math.SQRT1_2, 0, Math.SQRT1_2];
      const { x, y } = flat.toScreen([side[0] * Math.sin(angle), Math.cos(angle), side[2] * Math.sin(angle)]);
      return [x, y];
    };
    const measure = turnMeasure(flat, axis, ORIGIN, 1, ...at(0.2));
    expect(measure(...at(0.9))).toBeCloseTo(0.7, 9);
    expect(measure(...at(0.4))).toBeCloseTo(-0.5, 9);
  });
});

describe('a ring on edge', () => {
  it('a ring on edge turns along its line, its near half by the right-hand rule', () => {
    // About x, seen along −z: the near part, at +z, moves down the screen as the angle grows.
    const measure = turnMeasure(flat, [1, 0, 0], ORIGIN, 1, 400, 300);
    expect(measure(400, 350)).toBeCloseTo(0.5, 9);
    expect(measure(480, 350)).toBeCloseTo(0, 9);
  });
});

describe('other ways of a hand', () => {
  it('other ways of a hand turns about the line of sight', () => {
    const measure = viewTurnMeasure(flat, ORIGIN, ...around(170));
    expect(measure(...around(190))).toBeCloseTo(Math.PI / 9, 9);
  });

  it('slides along an axis by what its point under the pointer does', () => {
    const axis: Vec3 = [0.6, 0, 0.8];
    const measure = slideMeasure(flat, axis, ORIGIN, 460, 300);
    // The screen shows 0.6 of a motion along it.
    expect(measure(520, 330)).toBeCloseTo(1, 9);
  });

  it('other ways of a hand does not slide along what points at the viewer', () => {
    const measure = slideMeasure(flat, [0, 0, 1], ORIGIN, 400, 300);
    expect(measure(500, 300)).toBe(0);
  });

  it('counts pixels upwards, and up to the right', () => {
    const up = upMeasure(300);
    expect([up(0, 290), up(0, 295)]).toEqual([10, -5]);
    expect(diagonalMeasure(0, 0)(10, -10)).toBeCloseTo(10 * Math.SQRT2, 9);
  });

  it('rolls a ball: to the right about the viewer’s up, down about the right', () => {
    const roll = rollMeasure(flat, ORIGIN, 50, 400, 300);
    const right = roll(425, 300);
    expectClose([...(right?.axis ?? []), right?.angle ?? 0], [0, 1, 0, 0.5], 1e-9);
    const down = roll(425, 350);
    expectClose([...(down?.axis ?? []), down?.angle ?? 0], [1, 0, 0, 1], 1e-9);
    expect(roll(425, 350)).toBeUndefined();
  });
});
