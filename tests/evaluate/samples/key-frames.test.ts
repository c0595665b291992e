/** The rate that the keys of a take say, where they say one. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { keyFrames } from '../../../src/evaluate/samples/key-frames.ts';
import { type Channel, type KeyedChannel, restChannel, type Take } from '../../../src/model/takes/take.ts';
import { LINEAR, SMOOTH } from '../../../src/model/takes/tangent-kinds.ts';

function keysAt(times: readonly number[], kind = LINEAR): KeyedChannel {
  const side = { kinds: new Uint8Array(times.length).fill(kind), slopes: new Float64Array(times.length) };
  const values = Float64Array.from(times, (_, k) => Math.sin(k));
  const constant = 'constant' as const;
  return {
    kind: 'keys',
    ...{ extrapolateIn: constant, extrapolateOut: constant, times: Float64Array.from(times), values },
    ...{ tangentsIn: side, tangentsOut: side },
  };
}

function takeOf(range: readonly [number, number], ...channels: Channel[]): Take {
  return { name: 'x', range, channels };
}

const every = (seconds: number, count: number, start = 0) =>
  Array.from({ length: count }, (_, k) => start + k * seconds);

describe('the rate of a take of keys', () => {
  it('the rate of a take of keys is that of its keys to the last bit, whatever the frame time', () => {
    fc.assert(
      fc.property(fc.double({ min: 1e-4, max: 0.1, noNaN: true }), fc.integer({ min: 2, max: 500 }), (dt, count) => {
        const times = every(dt, count);
        const take = takeOf([0, times[count - 1]], restChannel(), keysAt(times), keysAt(times.slice(0, 1)));
        expect(keyFrames(take)).toEqual({ startSeconds: 0, frameSeconds: dt, frameCount: count });
      }),
    );
  });

  it('the frame rate of keys is that of the channel with the most, where all others are at its frames', () => {
    const times = every(0.01, 101, 1);
    const some = keysAt([1.25, 1.5, 1.51]);
    expect(keyFrames(takeOf([1, 2], some, keysAt(times)))?.frameCount).toBe(101);
    expect(keyFrames(takeOf([1, 2], keysAt([1.255]), keysAt(times)))).toBeUndefined();
  });

  it('the rate of a take of keys is none of keys that are uneven, that do not fill the range, or that are few and far between', () => {
    const none = (range: readonly [number, number], ...channels: Channel[]) =>
      expect(keyFrames(takeOf(range, ...channels))).toBeUndefined();
    none([0, 1], keysAt([0, 0.3, 1]));
    none([0, 2], keysAt(every(0.01, 101)));
    none([0, 1], keysAt(every(0.5, 3)));
    none([0, 1], keysAt(every(1 / 12, 13), SMOOTH));
    none([0, 1], restChannel());
    none([0, 0], keysAt([0]));
    expect(keyFrames(takeOf([0, 1], keysAt(every(1 / 24, 25), SMOOTH)))?.frameCount).toBe(25);
  });
});
