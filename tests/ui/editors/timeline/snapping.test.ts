import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import {
  frameNumber,
  nudgeStep,
  snapSeconds,
  snapValue,
  valueStep,
} from '../../../../src/ui/editors/timeline/snapping.ts';
import { skeleton } from '../../builders.ts';

const seconds = fc.double({ min: -100, max: 100, noNaN: true });
const rate = fc.constantFrom(1, 23.976, 24, 25, 30, 60, 120);

describe('snapping to frames', () => {
  it('moves the grabbed key to a whole frame, at most half a frame away', () => {
    fc.assert(
      fc.property(seconds, seconds, rate, (key, by, framesPerSecond) => {
        const moved = key + snapSeconds(key, by, framesPerSecond);
        expect(Math.abs(moved * framesPerSecond - Math.round(moved * framesPerSecond))).toBeLessThan(1e-6);
        expect(Math.abs(moved - (key + by))).toBeLessThanOrEqual(0.5 / framesPerSecond + 1e-9);
      }),
    );
  });

  it('moves a key between frames to one, even if hardly dragged', () => {
    expect(snapSeconds(0.51, 0, 10)).toBeCloseTo(-0.01, 12);
  });
});

describe('snapping to values', () => {
  it('lands on a whole number of steps', () => {
    expect(0.37 + snapValue(0.37, 0.2, 0.25)).toBeCloseTo(0.5, 12);
  });

  it('snapping to values keeps a move if there is no step', () => {
    expect(snapValue(1, 0.123, 0)).toBe(0.123);
  });

  it('snapping to values has steps of round degrees, not of round radians', () => {
    const degrees = 180 / Math.PI;
    for (const pixelsPerUnit of [3, 40, 700]) {
      const step = valueStep(pixelsPerUnit, degrees) * degrees;
      const leading = step / 10 ** Math.floor(Math.log10(step) + 1e-9);
      expect([1, 2, 5].some((n) => Math.abs(n - leading) < 1e-9)).toBe(true);
    }
  });

  it('snapping to values has steps that a mouse can tell apart, also where a curve is drawn upside down', () => {
    for (const pixelsPerUnit of [1e-3, 5, 1e6, -5]) {
      expect(valueStep(pixelsPerUnit, 1) * Math.abs(pixelsPerUnit)).toBeGreaterThanOrEqual(12 - 1e-9);
    }
  });
});

describe('steps of the arrow keys', () => {
  it('steps of the arrow keys are a degree where angles are shown in degrees, else a hundredth', () => {
    expect(nudgeStep('angle', true, undefined)).toBeCloseTo(Math.PI / 180, 15);
    expect(nudgeStep('angle', false, undefined)).toBe(0.01);
    expect(nudgeStep('weight', true, undefined)).toBe(0.01);
  });

  it('steps of the arrow keys are about a hundredth of the character for its lengths', () => {
    const joints = skeleton(['hips', -1], ['spine', 0]).joints;
    const tall = (height: number) => ({
      name: 'tall',
      joints: joints.map((j) => ({ ...j, offset: [0, height, 0] as const })),
    });
    expect([1, 1.8, 180, 0.02].map((height) => nudgeStep('length', true, tall(height)))).toEqual([
      0.01, 0.01, 1, 0.001,
    ]);
    expect(nudgeStep('length', true, undefined)).toBe(0.01);
  });
});

describe('frames of a time', () => {
  it('frames of a time are whole but for rounding', () => {
    expect(frameNumber(0.1 + 0.2, 10)).toBe(3);
    expect(frameNumber(0.25, 10)).toBe(2.5);
  });
});
