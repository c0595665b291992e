import fc from 'fast-check';
import { expect, it } from 'vitest';
import { smoothstep } from '../../src/math/smoothstep.ts';

it('a smoothstep is 0 before, 1 after, and half in the middle, either way round', () => {
  expect([-9, 2, 3, 4, 99].map((x) => smoothstep(2, 4, x))).toEqual([0, 0, 0.5, 1, 1]);
  expect([-9, 2, 3, 4, 99].map((x) => smoothstep(4, 2, x))).toEqual([1, 1, 0.5, 0, 0]);
});

it('a smoothstep never falls', () => {
  const x = fc.double({ min: -1, max: 2, noNaN: true });
  fc.assert(
    fc.property(x, x, (a, b) => {
      expect(smoothstep(0, 1, Math.max(a, b))).toBeGreaterThanOrEqual(smoothstep(0, 1, Math.min(a, b)) - 1e-15);
    }),
  );
});
