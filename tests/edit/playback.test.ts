import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import {
  advance,
  DEFAULT_PLAYBACK,
  intoRange,
  LOOP_MODES,
  type Playback,
  pause,
  play,
  stepFrames,
} from '../../src/edit/playback.ts';

const playing = (more: Partial<Playback>): Playback => ({ ...DEFAULT_PLAYBACK, playing: true, range: [1, 3], ...more });

describe('advance', () => {
  it('advance does nothing while paused', () => {
    const paused = playing({ playing: false, timeSeconds: 2 });
    expect(advance(paused, 1)).toBe(paused);
  });

  it('moves by elapsed time and rate', () => {
    expect(advance(playing({ timeSeconds: 1, rate: 0.5 }), 1).timeSeconds).toBe(1.5);
    expect(advance(playing({ timeSeconds: 2, rate: -0.5 }), 1).timeSeconds).toBe(1.5);
  });

  it('wraps round at both ends when looping', () => {
    expect(advance(playing({ timeSeconds: 2.5 }), 1).timeSeconds).toBeCloseTo(1.5, 12);
    expect(advance(playing({ timeSeconds: 1.5, rate: -1 }), 1).timeSeconds).toBeCloseTo(2.5, 12);
  });

  it('stops at the end it runs into when played once', () => {
    expect(advance(playing({ timeSeconds: 2.5, loop: 'once' }), 1)).toMatchObject({ timeSeconds: 3, playing: false });
    expect(advance(playing({ timeSeconds: 1.5, loop: 'once', rate: -1 }), 1)).toMatchObject({
      timeSeconds: 1,
      playing: false,
    });
  });

  it('advance turns round at both ends in ping-pong', () => {
    const back = advance(playing({ timeSeconds: 2.5, loop: 'pingpong' }), 1);
    expect(back).toMatchObject({ timeSeconds: 2.5, turned: true, rate: 1 });
    expect(advance(back, 2)).toMatchObject({ timeSeconds: 1.5, turned: false, rate: 1 });
  });

  it('runs on past the range when told to', () => {
    expect(advance(playing({ timeSeconds: 2.5, loop: 'continue' }), 10).timeSeconds).toBe(12.5);
  });

  it('advance stays at the one moment of an empty range', () => {
    expect(advance(playing({ timeSeconds: 9, range: [2, 2] }), 1).timeSeconds).toBe(2);
  });

  it('advance never leaves the range and never gets lost, whatever the clock does', () => {
    fc.assert(
      fc.property(
        fc.constantFrom(...LOOP_MODES.filter((m) => m !== 'continue')),
        fc.double({ min: -4, max: 4, noNaN: true }),
        fc.array(fc.double({ min: 0, max: 1e4, noNaN: true }), { maxLength: 20 }),
        (loop, rate, ticks) => {
          let state = playing({ loop, rate, timeSeconds: 2 });
          for (const tick of ticks) state = advance(state, tick);
          expect(state.timeSeconds).toBeGreaterThanOrEqual(1);
          expect(state.timeSeconds).toBeLessThanOrEqual(3);
          expect(state.rate).toBe(rate);
        },
      ),
    );
  });
});

describe('play', () => {
  it('starts again when `once` had reached its end', () => {
    expect(play(playing({ playing: false, loop: 'once', timeSeconds: 3 })).timeSeconds).toBe(1);
    expect(play(playing({ playing: false, loop: 'once', timeSeconds: 1, rate: -1 })).timeSeconds).toBe(3);
  });
});

describe('intoRange', () => {
  it('moves a time beyond the range to its nearer end, and leaves others where they are', () => {
    const at = (timeSeconds: number) => ({ ...DEFAULT_PLAYBACK, range: [1, 2] as const, timeSeconds });
    expect([0, 3].map((seconds) => intoRange(at(seconds)).timeSeconds)).toEqual([1, 2]);
    for (const seconds of [1, 1.5, 2]) {
      const playback = at(seconds);
      expect(intoRange(playback)).toBe(playback);
    }
  });
});

describe('stepFrames', () => {
  it('steps to the neighbouring frame, also from between two', () => {
    const at = (timeSeconds: number, frames: number) => stepFrames(playing({ timeSeconds }), frames).timeSeconds * 30;
    expect(at(10 / 30, 1)).toBeCloseTo(11, 9);
    expect(at(10.4 / 30, 1)).toBeCloseTo(11, 9);
    expect(at(10.4 / 30, -1)).toBeCloseTo(10, 9);
  });
});

describe('pause', () => {
  const paused = (timeSeconds: number, onFrame: boolean, range: readonly [number, number] = [1, 3]) =>
    pause(playing({ timeSeconds, range }), onFrame);

  it('stops at the very moment, or on the nearest frame', () => {
    expect(paused(1.417, false)).toMatchObject({ playing: false, timeSeconds: 1.417 });
    expect(paused(1.417, true)).toMatchObject({ playing: false, timeSeconds: 43 / 30 });
    expect(paused(1.411, true).timeSeconds).toBe(42 / 30);
  });

  it('pause stays within a range that does not end on a frame, and does not move in one without frames', () => {
    expect(paused(1.418, true, [1, 1.42]).timeSeconds).toBe(42 / 30);
    expect(paused(1.41, true, [1.41, 3]).timeSeconds).toBe(43 / 30);
    expect(paused(1.411, true, [1.41, 1.412]).timeSeconds).toBe(1.411);
  });

  it('uses the nearest frame when playing past the range', () => {
    expect(paused(9.99, true).timeSeconds).toBe(300 / 30);
  });
});
