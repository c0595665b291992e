/** Labels along the value axes. */
import { describe, expect, it } from 'vitest';
import { valueTicks } from '../../../../../src/ui/editors/curves/scene/ticks.ts';

const labels = (low: number, high: number, pixels: number, degrees: boolean) =>
  valueTicks({ low, high }, pixels, 30, degrees).flatMap((tick) => tick.label ?? []);

describe('value ticks', () => {
  it('value ticks are divisors of the turn, in degrees', () => {
    expect(labels(-Math.PI, Math.PI, 150, true)).toEqual(['−180°', '−90°', '0°', '90°', '180°']);
    expect(labels(-Math.PI / 4, Math.PI / 4, 200, true)).toEqual(['−45°', '−30°', '−15°', '0°', '15°', '30°', '45°']);
    expect(labels(0, 40 * Math.PI, 150, true)).toContain('1800°');
  });

  it('value ticks are 1, 2 and 5 in radians, lengths and weights', () => {
    expect(labels(-1, 1, 150, false)).toEqual(['−1', '−0.5', '0', '0.5', '1']);
    expect(labels(0, 0.0101, 170, false)).toEqual(['0', '0.002', '0.004', '0.006', '0.008', '0.01']);
  });

  it('value ticks are exact in model units', () => {
    for (const { value, label } of valueTicks({ low: -2, high: 2 }, 300, 30, true)) {
      if (label) expect((value * 180) / Math.PI).toBeCloseTo(Number(label.replace('−', '-').replace('°', '')), 9);
    }
  });

  it('value ticks are never closer than asked, nor infinitely many', () => {
    for (const extent of [1e-8, 1e-3, 0.3, 7, 1e4, 1e9]) {
      for (const degrees of [true, false]) {
        const ticks = valueTicks({ low: -extent / 3, high: extent }, 300, 30, degrees).filter((t) => t.label);
        expect(ticks.length).toBeGreaterThan(0);
        expect(ticks.length).toBeLessThanOrEqual(11);
        expect(new Set(ticks.map((t) => t.label)).size).toBe(ticks.length);
      }
    }
  });

  it('an empty axis has no value ticks', () => {
    expect(valueTicks({ low: 1, high: 1 }, 300, 30, true)).toEqual([]);
    expect(valueTicks({ low: 0, high: Number.POSITIVE_INFINITY }, 300, 30, false)).toEqual([]);
  });
});
