import { describe, expect, it } from 'vitest';
import { delayOf, gifWriter } from '../../src/io/gif-writer.ts';

describe('frames of a GIF', () => {
  it.each([1, 12, 24, 25, 29.97, 30, 50])(
    'frames of a GIF at %d fps last as long as the range, within half a unit',
    (fps) => {
      const delays = Array.from({ length: 100 }, (_, i) => delayOf(i, fps));
      let end = 0;
      delays.forEach((delay, i) => {
        end += delay;
        expect(delay % 10).toBe(0);
        expect(Math.abs(end - (1000 * (i + 1)) / fps)).toBeLessThanOrEqual(5);
      });
      expect(Math.min(...delays)).toBeGreaterThanOrEqual(20);
    },
  );

  it('frames of a GIF that programs would play slowly are refused', () => {
    // Refused before anything of the canvas is used.
    const nothing = {} as unknown as Parameters<typeof gifWriter>[0];
    expect(() => gifWriter(nothing, 60)).toThrow('at most 50 frames per second, found 60');
  });
});
