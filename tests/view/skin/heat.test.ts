import { describe, expect, it } from 'vitest';
import { heatColour } from '../../../src/view/skin/heat.ts';

/** CIE lightness of an sRGB colour, 0 to 100. */
function lightness([r, g, b]: readonly number[]): number {
  const linear = (byte: number) => {
    const x = byte / 255;
    return x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4;
  };
  const y = 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
  return y > 0.008856 ? 116 * Math.cbrt(y) - 16 : 903.3 * y;
}

describe('the colours of the influence map', () => {
  it('get lighter all the way, by steps that are nowhere twice the usual', () => {
    const steps = 20;
    const all = Array.from({ length: steps + 1 }, (_, i) => lightness(heatColour(i / steps)));
    const usual = (all[steps] - all[0]) / steps;
    for (let i = 0; i < steps; i++) {
      expect(all[i + 1]).toBeGreaterThan(all[i]);
      expect(all[i + 1] - all[i]).toBeLessThan(2 * usual);
    }
  });

  it('the colours of the influence map go from a deep blue to a warm light, and stay there beyond', () => {
    const [r0, , b0] = heatColour(0);
    const [r1, , b1] = heatColour(1);
    expect(b0).toBeGreaterThan(r0);
    expect(r1).toBeGreaterThan(b1);
    expect(heatColour(-3)).toEqual(heatColour(0));
    expect(heatColour(3)).toEqual(heatColour(1));
  });
});
