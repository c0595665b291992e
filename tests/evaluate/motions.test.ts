import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { direction } from '../../src/evaluate/motions/axis.ts';
import type { MotionPart } from '../../src/evaluate/motions/motion.ts';
import { jointMotion } from '../../src/evaluate/motions.ts';
import { determinant3, multiplyAffine, setIdentity as writeIdentity } from '../../src/math/mat4.ts';
import { writeRotation } from '../../src/math/quaternion.ts';
import { displaces, dofsOf } from '../../src/model/skeleton/joint-types.ts';
import { skelMotionOf } from '../../src/model/skeleton/skel-motion.ts';
import type { Motion } from '../../src/model/skeleton/skeleton.ts';
import { bvhMotion, motion } from '../formats/arbitraries.ts';
import { expectClose } from '../helpers/close.ts';

const at = (of: Motion, values: readonly number[]) => {
  const out = new Float64Array(18).fill(7);
  jointMotion(of).write(Float64Array.of(9, ...values), 1, out, 1);
  expect([out[0], out[17]]).toEqual([7, 7]);
  return out.slice(1, 17);
};
const derivative = (of: Motion, values: readonly number[], dof: number) => {
  const out = new Float64Array(18).fill(7);
  jointMotion(of).writeDerivative(Float64Array.of(9, ...values), 1, dof, out, 1);
  expect([out[0], out[17]]).toEqual([7, 7]);
  return out.slice(1, 17);
};

const setIdentity = (m: Float64Array) => {
  writeIdentity(m);
  return m;
};
const times = (a: Float64Array, b: Float64Array) => {
  const out = new Float64Array(16);
  multiplyAffine(a, 0, b, 0, out, 0);
  return out;
};
const partMatrix = (kind: MotionPart['kind'], [x, y, z, w]: Float64Array) => {
  const m = setIdentity(new Float64Array(16));
  if (kind === 'rotation') writeRotation(x, y, z, w, m, 0, 4);
  else if (kind === 'translation') m.set([x, y, z], 12);
  else [m[0], m[5], m[10]] = [x, y, z];
  return m;
};

/** Away from 0, which scales that keep their volume and quaternions do not like. */
const value = fc.double({ min: 0.3, max: 3, noNaN: true });
const signed = fc.tuple(value, fc.constantFrom(1, -1)).map(([v, s]) => v * s);
const isPositive = (of: Motion) => of.kind === 'scale' && of.mode === 'volume';
/** Pitches and axes of 1e300 would drown every difference in rounding. */
const tame = (of: Motion) => of.kind !== 'screw' || Math.abs(of.pitch) < 100;
const posed = fc
  .oneof(motion, bvhMotion)
  .filter(tame)
  .chain((of) => fc.tuple(fc.constant(of), fc.tuple(...dofsOf(of).map(() => (isPositive(of) ? value : signed)))));

describe('any motion', () => {
  it('any motion keeps the origin where it is unless it is said to displace it', () => {
    fc.assert(
      fc.property(posed, ([of, values]) => {
        const [x, y, z] = at(of, values).slice(12, 15);
        if (!displaces(of)) expect(Math.hypot(x, y, z)).toBe(0);
        else expect(Math.hypot(x, y, z)).toBeGreaterThan(0);
      }),
    );
  });

  it('any motion has the derivatives that finite differences have', () => {
    fc.assert(
      fc.property(posed, ([of, values]) => {
        const h = 1e-5;
        values.forEach((_, dof) => {
          const moved = (by: number) =>
            at(
              of,
              values.map((v, i) => (i === dof ? v + by : v)),
            );
          const [back, ahead] = [moved(-h), moved(h)];
          const slope = ahead.map((v, i) => (v - back[i]) / (2 * h));
          expectClose(derivative(of, values, dof), slope, 1e-7, `${of.kind} ${dofsOf(of)[dof].name}`);
        });
      }),
      { numRuns: 400 },
    );
  });

  it('any motion that stretches is the product of its parts, which change smoothly with its DOFs', () => {
    let compared = 0;
    fc.assert(
      fc.property(posed, ([of, values]) => {
        const { parts, stretches } = jointMotion(of);
        expect(parts !== undefined).toBe(stretches === true);
        if (!parts) return;
        const numbers = (by: number) =>
          parts.map((part) => {
            const out = new Float64Array(4);
            part.write(Float64Array.of(9, ...values.map((v) => v + by)), 1, out);
            return out;
          });
        let product = setIdentity(new Float64Array(16));
        numbers(0).forEach((n, i) => {
          product = times(product, partMatrix(parts[i].kind, n));
        });
        expectClose(at(of, values), product, 1e-12, of.kind);
        const moved = numbers(1e-6);
        numbers(0).forEach((n, i) => {
          expectClose(n, moved[i], 1e-4, `part ${i}`);
        });
        compared++;
      }),
      { numRuns: 1000 },
    );
    expect(compared).toBeGreaterThan(100);
  });

  it('any motion does nothing with its DOFs at rest', () => {
    fc.assert(
      fc.property(fc.oneof(motion, bvhMotion), (of) => {
        expectClose(
          at(
            of,
            dofsOf(of).map((dof) => dof.rest),
          ),
          IDENTITY,
          1e-15,
          of.kind,
        );
      }),
    );
  });

  it('any motion turns without stretching where it has neither scale nor shear', () => {
    fc.assert(
      fc.property(posed, ([of, values]) => {
        fc.pre(of.kind !== 'scale' && of.kind !== 'shear' && !dofsOf(of).some(({ name }) => /^s/.test(name)));
        expect(determinant3(at(of, values))).toBeCloseTo(1, 12);
      }),
    );
  });
});

const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

describe('a scale that keeps the volume', () => {
  const volume: Motion = { kind: 'scale', mode: 'volume', axis: [1, 2, -2] };

  it('a scale that keeps the volume keeps it', () => {
    fc.assert(
      fc.property(fc.double({ min: 0.01, max: 100, noNaN: true }), (s) => {
        expect(determinant3(at(volume, [s]))).toBeCloseTo(1, 9);
      }),
    );
  });

  it('a scale that keeps the volume stays finite where there is nothing left of it', () => {
    for (const s of [0, -1, -1e300, 1e-300]) {
      expect(at(volume, [s]).every(Number.isFinite)).toBe(true);
      expectClose(derivative(volume, [s], 0), new Float64Array(16), 1e-300, `s = ${s}`);
    }
  });
});

describe('a quaternion', () => {
  const quaternion: Motion = { kind: 'quaternion' };

  it('a quaternion turns by its direction, whatever its length', () => {
    const expected = at(quaternion, [0.1, -0.2, 0.3, 0.4]);
    for (const scale of [1e-200, 1e-3, -1, 7, 1e200]) {
      expectClose(
        at(
          quaternion,
          [0.1, -0.2, 0.3, 0.4].map((v) => v * scale),
        ),
        expected,
        1e-14,
        `times ${scale}`,
      );
    }
  });

  it('a quaternion turns nothing without a length', () => {
    expect([...at(quaternion, [0, 0, 0, 0])]).toEqual(IDENTITY);
    expect(derivative(quaternion, [0, 0, 0, 0], 1)).toEqual(new Float64Array(16));
  });
});

describe('an axis', () => {
  it('an axis is of length 1 whatever is written, and x where nothing is', () => {
    expectClose(direction([3e-200, 0, 4e-200]), [0.6, 0, 0.8], 1e-15, 'tiny');
    expectClose(direction([0, -3e200, 4e200]), [0, -0.6, 0.8], 1e-15, 'huge');
    expect(direction([0, -0, 0])).toEqual([1, 0, 0]);
  });
});

describe('a joint of BVH as one of .skel', () => {
  it('a joint of BVH as one of .skel has the same matrix from the same numbers in another order', () => {
    fc.assert(
      fc.property(bvhMotion, fc.array(signed, { minLength: 6, maxLength: 6 }), (of, values) => {
        const { motion: made, dofMap } = skelMotionOf(of);
        expect(dofMap.map((dof) => of.channels[dof])).toEqual(dofsOf(made).map(({ name }) => name));
        expectClose(
          at(
            made,
            dofMap.map((dof) => values[dof]),
          ),
          at(of, values),
          1e-14,
          of.channels.join(' '),
        );
      }),
    );
  });

  it('a joint of BVH as one of .skel is the simplest that can do it', () => {
    const kindOf = (...channels: ('tx' | 'ty' | 'tz' | 'rx' | 'ry' | 'rz')[]) =>
      skelMotionOf({ kind: 'bvh', channels, positions: 'replace' }).motion;
    expect(kindOf()).toEqual({ kind: 'fixed' });
    expect(kindOf('rz', 'rx', 'ry')).toEqual({ kind: 'ball', order: 'yxz' });
    expect(kindOf('tx', 'ty', 'tz', 'rz', 'ry', 'rx')).toEqual({ kind: 'free', order: 'xyz' });
    expect(kindOf('rx', 'ty', 'rz')).toEqual({ kind: 'compound', dofs: ['ty', 'rx', 'rz'] });
  });
});
