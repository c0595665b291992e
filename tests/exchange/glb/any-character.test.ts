import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { type Channel, EXTRAPOLATIONS, FIXED_TANGENT } from '../../../src/model/clip.ts';
import { rootDofCount } from '../../../src/model/dofs.ts';
import { dofsOf } from '../../../src/model/joint-types.ts';
import { type Skeleton, UNLIMITED } from '../../../src/model/skeleton.ts';
import { motion } from '../../formats/arbitraries.ts';
import { character, joint } from '../../helpers/builders.ts';
import { glbOf, inThree, offBy } from '../../helpers/glb.ts';

const value = fc.double({ min: -2, max: 2, noNaN: true });
const extrapolation = fc.constantFrom(...EXTRAPOLATIONS);

/** Values around `rest`, so that scales are not 0. */
const channel = (rest: number) =>
  fc
    .record({
      times: fc.array(fc.integer({ min: -8, max: 16 }), { minLength: 1, maxLength: 4 }),
      values: fc.array(value, { minLength: 4, maxLength: 4 }),
      slopes: fc.array(value, { minLength: 8, maxLength: 8 }),
      kinds: fc.array(fc.integer({ min: 0, max: 3 }), { minLength: 8, maxLength: 8 }),
      extrapolateIn: extrapolation,
      extrapolateOut: extrapolation,
    })
    .map(({ times, values, slopes, kinds, extrapolateIn, extrapolateOut }): Channel => {
      const sorted = [...times].sort((a, b) => a - b);
      const tangents = (from: number) => ({
        kinds: Uint8Array.from(sorted, (_, k) => kinds[from + k]),
        slopes: Float64Array.from(sorted, (_, k) => (kinds[from + k] === FIXED_TANGENT ? slopes[from + k] : 0)),
      });
      return {
        kind: 'keys',
        extrapolateIn,
        extrapolateOut,
        times: Float64Array.from(sorted, (t) => t / 8),
        values: Float64Array.from(sorted, (_, k) => rest + values[k] * (rest === 1 ? 0.3 : 1)),
        tangentsIn: tangents(0),
        tangentsOut: tangents(4),
      };
    });

const anyone = fc
  .array(motion, { minLength: 1, maxLength: 4 })
  // Pitches and axes of 1e300 leave every program's floats.
  .filter((all) => all.every((of) => of.kind !== 'screw' || Math.abs(of.pitch) < 10))
  .map((motions): Skeleton => {
    const joints = motions.map((of, i) =>
      joint(i - 1, {
        name: `j${i}`,
        offset: [0, 1, 0.2],
        motion: of,
        limits: dofsOf(of).map((_, d) => (d === 0 ? { min: -1.5, max: 1.5 } : UNLIMITED)),
        pose: dofsOf(of).map(({ rest }) => rest),
      }),
    );
    return { name: 'any', joints };
  })
  .chain((skeleton) => {
    const rests = [
      ...Array.from({ length: rootDofCount(skeleton) }, () => 0),
      ...skeleton.joints.flatMap(({ motion: of }) => dofsOf(of).map(({ rest }) => rest)),
    ];
    return fc.tuple(fc.constant(skeleton), fc.tuple(...rests.map(channel)));
  });

/** Away from eighths of a second, where values may jump. */
const TIMES = Array.from({ length: 25 }, (_, i) => (i + 0.37) / 8);

describe('any character as GLB', () => {
  it.each(['linear', 'cubic'] as const)(
    'three.js shows any joints and any curves as they are here: %s',
    async (keys) => {
      await fc.assert(
        fc.asyncProperty(anyone, async ([skeleton, channels]) => {
          const own = character({
            name: 'any',
            skeleton,
            clips: [{ name: 'take', range: [-0.5, 2.75], channels }],
            shownClip: 0,
          });
          const made = glbOf(own, { keys });
          const { joints } = offBy(own, made, await inThree(made), 0, TIMES);
          expect(joints).toBeLessThanOrEqual(made.report.tolerance * 1.02);
        }),
        { numRuns: 25 },
      );
    },
  );
});
