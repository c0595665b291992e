import fc from 'fast-check';
import { expect, it } from 'vitest';
import { scrubbedTime } from '../../../../src/ui/editors/takes/scrub-time.ts';

/** Four seconds of a take at 120 frames per second, in a chart of 500 pixels for five seconds. */
const VIEW = { window: { from: -0.5, to: 4.5 }, width: 500 };
const FRAMES = { startSeconds: 0, frameSeconds: 1 / 120, frameCount: 481 };

it('a drag in the chart goes to frames of the finer take, whatever the playback frame rate', () => {
  expect(scrubbedTime(151, VIEW, FRAMES, 30)).toBeCloseTo(121 / 120, 12);
  expect(scrubbedTime(151, VIEW, FRAMES, undefined)).toBe(1.01);
});

it('a drag past an edge of the chart ends at what is shown and measured', () => {
  expect(scrubbedTime(-15000, VIEW, FRAMES, 30)).toBe(0);
  expect(scrubbedTime(15000, VIEW, FRAMES, 30)).toBeCloseTo(4, 12);
  const inside = { window: { from: 1, to: 2 }, width: 500 };
  expect(scrubbedTime(-15000, inside, FRAMES, undefined)).toBe(1);
  expect(scrubbedTime(15000, inside, FRAMES, undefined)).toBe(2);
  // Neither are takes without common time scrolled away.
  expect(scrubbedTime(-15000, VIEW, undefined, 30)).toBe(-0.5);
  expect(scrubbedTime(-15000, { window: { from: 7, to: 8 }, width: 500 }, FRAMES, undefined)).toBe(7);
});

it('a scrubbed time is one of the frames, and never outside of them', () => {
  fc.assert(
    fc.property(fc.double({ min: -1e5, max: 1e5, noNaN: true }), fc.integer({ min: 1, max: 200 }), (x, frameCount) => {
      const time = scrubbedTime(x, VIEW, { ...FRAMES, frameCount }, 30);
      const frame = time / FRAMES.frameSeconds;
      expect(frame).toBeCloseTo(Math.round(frame), 6);
      expect(Math.round(frame)).toBeGreaterThanOrEqual(0);
      expect(Math.round(frame)).toBeLessThan(frameCount);
    }),
  );
});
