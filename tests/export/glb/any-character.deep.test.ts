import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { glbOf, inThree } from '../../helpers/glb.ts';
import { offBy } from '../../helpers/glb-off.ts';
import { anyone } from '../any-character.ts';

/** Away from eighths of a second, where values may jump. */
const TIMES = Array.from({ length: 25 }, (_, i) => (i + 0.37) / 8);

describe('any character as GLB', () => {
  it.each(['linear', 'cubic'] as const)(
    'three.js shows any joints and any curves as they are here: %s',
    async (keys) => {
      await fc.assert(
        fc.asyncProperty(anyone, async (own) => {
          const made = glbOf(own, { keys });
          const { joints, vertices } = offBy(own, made, await inThree(made), 0, TIMES);
          expect(Math.max(joints, vertices)).toBeLessThanOrEqual(made.report.tolerance);
        }),
        { numRuns: 15 },
      );
    },
  );
});
