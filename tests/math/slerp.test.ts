import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { slerpWeight } from '../../src/math/slerp.ts';
import { evenly } from '../helpers/evenly.ts';

describe('the weights of slerp', () => {
  it('the weights of slerp are sin(t·θ) / sin θ to thirteen digits, by series and by sines', () => {
    const part = evenly(0, 1);
    // Densest about the angle where one takes over from the other, 0.2 rad.
    const angle = fc.oneof(evenly(1e-3, Math.PI / 2), evenly(0.15, 0.25));
    fc.assert(
      fc.property(part, angle, (t, theta) => {
        const expected = Math.sin(t * theta) / Math.sin(theta);
        // The cosine of an angle of 1e-3 says what the angle is to ten digits only; the weight hardly depends on it.
        expect(Math.abs(slerpWeight(t, Math.cos(theta)) - expected)).toBeLessThan(3e-14);
      }),
      { numRuns: 2000 },
    );
  });

  it('slerp of equal rotations is linear, also if rounding made the cosine more than 1', () => {
    for (const cosine of [1, 1 + 2 ** -52, 1 - 2 ** -53]) expect(slerpWeight(0.3, cosine)).toBeCloseTo(0.3, 15);
  });

  it('the weights of slerp are exact at both ends', () => {
    for (const cosine of [1, 0.99, 0.98, 0.5, 0]) {
      expect(slerpWeight(0, cosine)).toBe(0);
      expect(slerpWeight(1, cosine)).toBeCloseTo(1, 14);
    }
  });
});
