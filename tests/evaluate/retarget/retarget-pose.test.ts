import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { compileSkeleton } from '../../../src/evaluate/kinematics.ts';
import { retargetBody } from '../../../src/evaluate/retarget/body.ts';
import { planRetarget } from '../../../src/evaluate/retarget/make-plan.ts';
import { automaticPairs } from '../../../src/evaluate/retarget/match.ts';
import { retargetPose } from '../../../src/evaluate/retarget/retarget-pose.ts';
import { jointDofCount } from '../../../src/model/skeleton/dofs.ts';
import { EULER_ORDERS, type Skeleton } from '../../../src/model/skeleton/skeleton.ts';
import type { Space } from '../../../src/model/space.ts';
import type { RetargetOptions } from '../../../src/model/takes/retarget.ts';
import { BVH_ROOT, driverOf, PARTS, type Part, person, takeOfRows } from './people.ts';

const CENTIMETRES_Z_UP: Space = { up: 'z', unit: 'centimetres', lift: 0 };

/** One frame of the source's DOFs. */
function pose(skeleton: Skeleton, place: readonly number[], angles: readonly number[]): number[] {
  return [...place, ...angles.slice(0, jointDofCount(skeleton) - 3)];
}

const anyPose = fc.tuple(
  fc.array(fc.double({ min: -2, max: 2, noNaN: true }), { minLength: 3, maxLength: 3 }),
  fc.array(fc.double({ min: -1.2, max: 1.2, noNaN: true }), { minLength: 63, maxLength: 63 }),
);

interface Case {
  readonly source: Skeleton;
  readonly target: Skeleton;
  readonly sourceSpace?: Space;
  readonly targetSpace?: Space;
  readonly options?: Partial<RetargetOptions>;
  readonly clamps?: boolean;
}

/** Both characters in the scene, at the first frame of a one-frame take. */
function put({ source, target, sourceSpace, targetSpace, options, clamps = true }: Case, row: readonly number[]) {
  const pairs = automaticPairs(source, target, sourceSpace, targetSpace);
  const driver = driverOf(source, takeOfRows(source, [row, row]), pairs, options, sourceSpace);
  const plan = planRetarget(driver, target, targetSpace, clamps);
  const dofs = Float64Array.from(plan.restDofs);
  retargetPose(plan, 0, dofs);
  return {
    own: retargetBody(target, targetSpace, dofs),
    other: retargetBody(source, sourceSpace, Float64Array.from(row)),
    plan,
    dofs,
    pairs,
  };
}

const BONES: readonly (readonly [Part, Part])[] = (['left', 'right'] as const).flatMap((side) =>
  (
    [
      ['arm', 'forearm'],
      ['forearm', 'hand'],
      ['thigh', 'shin'],
      ['shin', 'foot'],
    ] as const
  ).map(([a, b]) => [`${side} ${a}`, `${side} ${b}`] as const),
);

function direction(points: Float64Array, from: Part, to: Part): number[] {
  const [a, b] = [3 * PARTS.indexOf(from), 3 * PARTS.indexOf(to)];
  const d = [0, 1, 2].map((k) => points[b + k] - points[a + k]);
  return d.map((v) => v / Math.hypot(...d));
}

/** The largest difference of any bone's direction. */
function worstDirection(own: Float64Array, other: Float64Array, bones = BONES): number {
  return Math.max(
    ...bones.flatMap(([a, b]) => {
      const d = direction(other, a, b);
      return direction(own, a, b).map((v, k) => Math.abs(v - d[k]));
    }),
  );
}

const FREE = { plantsFeet: false } as const;

describe('a take on another character', () => {
  it('points every bone as the source does, whatever the names, the size and the rest pose', () => {
    const source = person({ names: (part) => part.replace('left ', 'l').replace('right ', 'r') });
    const target = person({ names: (part) => `Bip:${part}`, size: 0.6, droop: 0.9 });
    fc.assert(
      fc.property(anyPose, ([place, angles]) => {
        const { own, other } = put({ source, target, options: FREE }, pose(source, place, angles));
        expect(worstDirection(own.points, other.points)).toBeLessThan(1e-9);
      }),
      { numRuns: 40 },
    );
  });

  it('a take on another character does so from centimetres with z up to metres with y up, and back', () => {
    const tall = person({ size: 100, zUp: true });
    const small = person({ droop: 0.5 });
    fc.assert(
      fc.property(anyPose, ([place, angles]) => {
        for (const [source, target] of [
          [tall, small],
          [small, tall],
        ]) {
          const sourceSpace = source === tall ? CENTIMETRES_Z_UP : undefined;
          const targetSpace = target === tall ? CENTIMETRES_Z_UP : undefined;
          const row = pose(source, place, angles);
          const { own, other } = put(
            { source, target, options: FREE, ...(sourceSpace && { sourceSpace }), ...(targetSpace && { targetSpace }) },
            row,
          );
          expect(worstDirection(own.points, other.points)).toBeLessThan(1e-9);
        }
      }),
      { numRuns: 20 },
    );
  });

  it.each(['quaternion', ...EULER_ORDERS] as const)('a take on another character turns joints that are %s', (kind) => {
    const source = person();
    const target = person({
      droop: 0.7,
      motion: (part) => (part === 'hips' ? BVH_ROOT : kind === 'quaternion' ? { kind } : { kind: 'ball', order: kind }),
    });
    fc.assert(
      fc.property(anyPose, ([place, angles]) => {
        const { own, other } = put({ source, target, options: FREE }, pose(source, place, angles));
        expect(worstDirection(own.points, other.points)).toBeLessThan(1e-9);
      }),
      { numRuns: 10 },
    );
  });

  it('a take on another character is the very same pose on the very same skeleton', () => {
    const source = person();
    fc.assert(
      fc.property(anyPose, ([place, angles]) => {
        const { own, other } = put({ source, target: source, options: FREE }, pose(source, place, angles));
        // But for its height: a take of one frame has its feet on the ground there.
        const shift = own.points.map(
          (v, i) => v - other.points[i] - (i % 3 === 1 ? own.points[1] - other.points[1] : 0),
        );
        expect(Math.max(...shift.map(Math.abs))).toBeLessThan(1e-9);
        expect(Math.max(...own.rotations.map((v, i) => Math.abs(v - other.rotations[i])))).toBeLessThan(1e-9);
      }),
      { numRuns: 40 },
    );
  });

  it('bends a knee that is a hinge, with the thigh turned so that the shin points where it should', () => {
    const source = person();
    const target = person({
      motion: (part) =>
        part === 'hips'
          ? BVH_ROOT
          : part.endsWith('shin')
            ? { kind: 'hinge', axis: [1, 0, 0] }
            : { kind: 'ball', order: 'xyz' },
    });
    // The source's knee bends inwards as much as backwards, which a hinge can't.
    const row = new Array<number>(jointDofCount(source)).fill(0);
    const compiled = compileSkeleton(source);
    const shin = compiled.firstDof[PARTS.indexOf('left shin')];
    row[1] = 0.9;
    row[shin] = 0.8;
    row[shin + 2] = 0.8;
    const { own, other } = put({ source, target, options: FREE }, row);
    expect(worstDirection(own.points, other.points)).toBeLessThan(1e-9);
  });

  it('a take on another character stays within limits where the character holds them', () => {
    const source = person();
    const plain = person();
    const joints = plain.joints.map((j) =>
      j.name.endsWith('arm') ? { ...j, limits: j.limits.map(() => ({ min: -0.3, max: 0.2 })) } : j,
    );
    const target = { ...plain, joints };
    fc.assert(
      fc.property(anyPose, ([place, angles]) => {
        const { dofs } = put({ source, target, options: FREE }, pose(source, place, angles));
        const compiled = compileSkeleton(target);
        joints.forEach((joint, j) => {
          if (!joint.name.endsWith('arm')) return;
          for (let d = compiled.firstDof[j]; d < compiled.firstDof[j + 1]; d++) {
            expect(dofs[d]).toBeGreaterThanOrEqual(-0.3);
            expect(dofs[d]).toBeLessThanOrEqual(0.2);
          }
        });
      }),
      { numRuns: 20 },
    );
  });
});

describe('the way of the hips', () => {
  const row = (skeleton: Skeleton, x: number, y: number, z: number) => {
    const values = new Array<number>(jointDofCount(skeleton)).fill(0);
    values.splice(0, 3, x, y, z);
    return values;
  };

  it('the way of the hips is scaled by the length of the legs, and who stands stands', () => {
    const source = person({ size: 100 });
    const target = person({ size: 0.5 });
    // Its toes are 3 cm above its soles; a guessed space puts joints on the ground.
    const sourceSpace: Space = { up: 'y', unit: 'centimetres', lift: -0.03 };
    const { own, plan } = put({ source, target, sourceSpace, options: FREE }, row(source, 200, 90, -40));
    expect(plan.scale).toBeCloseTo(0.5, 12);
    const [x, y, z] = own.points;
    expect([x, y, z]).toEqual([expect.closeTo(1, 9), expect.closeTo(0.45, 9), expect.closeTo(-0.2, 9)]);
    const toe = own.points[3 * PARTS.indexOf('left toe') + 1];
    expect(toe).toBeCloseTo(0.5 * 0.03, 9);
  });

  it('the way of the hips is scaled by what one says', () => {
    const person1 = person();
    const { own } = put({ source: person1, target: person1, options: { ...FREE, scale: 2 } }, row(person1, 1, 0.9, 0));
    expect(own.points[0]).toBeCloseTo(2, 9);
  });
});

describe('planted feet', () => {
  it('planted feet are where the source’s are in proportion, with shins too short for rotations alone', () => {
    const source = person();
    const odd = person({ size: 0.7 });
    // The same legs, but for shins that are longer and thighs that are shorter than in proportion.
    const joints = odd.joints.map((j) => {
      const factor = j.name.endsWith('shin') ? 0.8 : j.name.endsWith('foot') ? 1.2 : 1;
      return { ...j, offset: [j.offset[0], j.offset[1] * factor, j.offset[2]] as const };
    });
    const target = { ...odd, joints };
    const first = compileSkeleton(source).firstDof;
    const bent = (bend: number, height: number) => {
      const values = new Array<number>(jointDofCount(source)).fill(0);
      values[1] = height;
      for (const side of ['left', 'right'] as const) {
        values[first[PARTS.indexOf(`${side} thigh`)]] = -bend;
        values[first[PARTS.indexOf(`${side} shin`)]] = 2 * bend;
        values[first[PARTS.indexOf(`${side} foot`)]] = -bend;
      }
      return values;
    };
    // Crouching: the ankles stay, the hips go down and (for thighs and shins differ) back and forth.
    const rows = Array.from({ length: 20 }, (_, f) => {
      const bend = 0.3 + 0.3 * Math.sin(f / 3);
      return bent(bend, 0.9 - 0.8 * (1 - Math.cos(bend)));
    });
    const pairs = automaticPairs(source, target);
    const driver = (plantsFeet: boolean) => driverOf(source, takeOfRows(source, rows), pairs, { plantsFeet });
    const slide = (plantsFeet: boolean) => {
      const plan = planRetarget(driver(plantsFeet), target, undefined, true);
      const dofs = Float64Array.from(plan.restDofs);
      const at = rows.map((_, f) => {
        retargetPose(plan, f * 0.1, dofs);
        return retargetBody(target, undefined, dofs).points[3 * PARTS.indexOf('left toe') + 2];
      });
      const sourceAt = rows.map(
        (row) => retargetBody(source, undefined, Float64Array.from(row)).points[3 * PARTS.indexOf('left toe') + 2],
      );
      return at.map((z, f) => z - plan.scale * sourceAt[f]);
    };
    const spread = (values: readonly number[]) => Math.max(...values) - Math.min(...values);
    expect(spread(slide(false))).toBeGreaterThan(0.005);
    // But for knees that are straight, which are never quite.
    expect(spread(slide(true))).toBeLessThan(1e-6);
  });
});
