import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { withKeysMoved } from '../../../src/edit/keys/move.ts';
import { wholeSteps } from '../../../src/edit/keys/steps.ts';
import { checkChannel } from '../../helpers/invariants.ts';
import { channelOf, channels, expectNoCrowd, pointsOf, rowsOf, withSome } from './channels.ts';

const four = channelOf([
  [0, 10, 'linear'],
  [1, 11, 'smooth'],
  [2, 12, 5],
  [3, 13, 'flat'],
]);
const stairs = channelOf([
  [0, 10],
  [1, 11],
  [1, 12],
  [2, 13],
]);
const valuesOf = (channel: typeof four) => [...channel.values];

describe('moving keys', () => {
  it('moves in time and value, keeping tangents', () => {
    const { channel, indices } = withKeysMoved(four, [1, 2], 0.25, 100);
    expect(rowsOf(channel)).toEqual([
      [0, 10, 'linear', 'linear'],
      [1.25, 111, 'smooth', 'smooth'],
      [2.25, 112, 5, 5],
      [3, 13, 'flat', 'flat'],
    ]);
    expect(indices).toEqual([1, 2]);
  });

  it('crosses other keys freely, and says where the moved ones are', () => {
    const { channel, indices } = withKeysMoved(four, [0, 2], 1.5, 0);
    expect(pointsOf(channel)).toEqual([
      [1, 11],
      [1.5, 10],
      [3, 13],
      [3.5, 12],
    ]);
    expect(indices).toEqual([1, 3]);
  });

  it('replaces the key it lands on, even where the times differ in their last digits', () => {
    const { channel, indices } = withKeysMoved(four, [1], 2, 0);
    expect(valuesOf(channel)).toEqual([10, 12, 11]);
    expect(indices).toEqual([2]);
    const thirds = channelOf([
      [0.1, 1],
      [0.1 + 0.2, 2],
    ]);
    expect(pointsOf(withKeysMoved(thirds, [0], 0.2, 0).channel)).toEqual([[0.1 + 0.2, 1]]);
    expect(pointsOf(withKeysMoved(thirds, [0], 0.2 - 1e-12, 0).channel)).toEqual([[0.1 + 0.2, 1]]);
  });

  it('moving keys makes a step with the key it lands on if requested, applying from then on', () => {
    const { channel, indices } = withKeysMoved(four, [1], 2, 0, 'step');
    expect(pointsOf(channel)).toEqual([
      [0, 10],
      [2, 12],
      [3, 13],
      [3, 11],
    ]);
    expect(indices).toEqual([3]);
    expect(valuesOf(withKeysMoved(four, [3], -3, 0, 'step').channel)).toEqual([10, 13, 11, 12]);
  });

  it('lets only the first that was there and the last that came stay where steps meet keys', () => {
    expect(valuesOf(withKeysMoved(stairs, [0], 1, 0, 'step').channel)).toEqual([11, 10, 13]);
    expect(valuesOf(withKeysMoved(stairs, [1, 2], 1, 0, 'step').channel)).toEqual([10, 13, 12]);
    expect(valuesOf(withKeysMoved(stairs, [1, 2], 1, 0, 'replace').channel)).toEqual([10, 11, 12]);
  });

  it('moving keys keeps a step a step that moves as one', () => {
    const { channel, indices } = withKeysMoved(stairs, [1, 2], 5, 0);
    expect(pointsOf(channel)).toEqual([
      [0, 10],
      [2, 13],
      [6, 11],
      [6, 12],
    ]);
    expect(indices).toEqual([2, 3]);
  });

  it('moves a step in time as one, whichever half is named', () => {
    for (const half of [1, 2]) {
      const { channel, indices } = withKeysMoved(stairs, [half], -0.5, 0);
      expect(pointsOf(channel)).toEqual([
        [0, 10],
        [0.5, 11],
        [0.5, 12],
        [2, 13],
      ]);
      expect(indices).toEqual([1, 2]);
    }
  });

  it('moves half of a step in value only without harm to the other', () => {
    expect(valuesOf(withKeysMoved(stairs, [1], 0, 5).channel)).toEqual([10, 16, 12, 13]);
    expect(valuesOf(withKeysMoved(stairs, [2], 0, 5).channel)).toEqual([10, 11, 17, 13]);
  });

  it('refuses to move to times that are not finite', () => {
    expect(() => withKeysMoved(four, [0], 1e308, 0).channel.times).not.toThrow();
    expect(() => withKeysMoved(withKeysMoved(four, [0], 1e308, 0).channel, [3], 1e308, 0)).toThrow('too large');
    expect(() => withKeysMoved(withKeysMoved(four, [0], 0, 1e308).channel, [0], 0, 1e308)).toThrow(
      'value is too large',
    );
  });
});

describe('what moving leaves alone', () => {
  it('what moving does not change is the channel itself if nothing moves', () => {
    expect(withKeysMoved(four, [1, 2], 0, 0)).toEqual({ channel: four, indices: [1, 2] });
    expect(withKeysMoved(four, [1, 2], 0, 0).channel).toBe(four);
    expect(withKeysMoved(four, [1], 1e-30, 1e-30).channel).toBe(four);
  });

  it('what moving leaves alone is the column of times where keys move in value', () => {
    const { channel } = withKeysMoved(four, [1], 0, 2);
    expect(channel.times).toBe(four.times);
    expect(channel.tangentsIn).toBe(four.tangentsIn);
    expect(channel.tangentsOut).toBe(four.tangentsOut);
  });

  it('what moving leaves alone is every other column where keys move in time without crossing', () => {
    const { channel } = withKeysMoved(four, [1], 0.5, 0);
    expect(channel.values).toBe(four.values);
    expect(channel.tangentsIn).toBe(four.tangentsIn);
    expect(channel.tangentsOut).toBe(four.tangentsOut);
  });

  it('what moving leaves alone is what comes out the same though keys have crossed', () => {
    const level = channelOf([0, 1, 2].map((t) => [t, 7, 'flat'] as const));
    const { channel } = withKeysMoved(level, [0], 1.5, 0);
    expect([...channel.times]).toEqual([1, 1.5, 2]);
    expect(channel.values).toBe(level.values);
    expect(channel.tangentsIn).toBe(level.tangentsIn);
  });
});

describe('moving any keys', () => {
  const seconds = fc.integer({ min: -160, max: 160 }).map((tick) => tick / 8);
  const collision = fc.constantFrom('replace' as const, 'step' as const);

  it('leaves sound channels, at most two keys at a time, and every key that nothing landed on', () => {
    fc.assert(
      fc.property(withSome(channels(1, { steps: true })), seconds, collision, ({ channel, some }, by, onCollision) => {
        const { channel: after, indices } = withKeysMoved(channel, some, by, 0, onCollision);
        checkChannel(after);
        expectNoCrowd(after);
        const whole = by === 0 ? some : wholeSteps(channel, some);
        const moved = new Set(whole);
        const landed = new Set(whole.map((k) => channel.times[k] + by));
        const stay = [...channel.times.keys()].filter(
          (k) => !moved.has(k) && (by === 0 || !landed.has(channel.times[k])),
        );
        for (const k of stay) expect(pointsOf(after)).toContainEqual([channel.times[k], channel.values[k]]);
        expect(indices).toEqual([...new Set(indices)].sort((a, b) => a - b));
        if (onCollision === 'replace') expect(indices).toHaveLength(whole.length);
      }),
    );
  });

  it('says where the very keys are that were moved', () => {
    // Values are what tells keys apart.
    const told = channels(1, { steps: true }).map((c) => ({ ...c, values: c.values.map((_v, k) => k) }));
    fc.assert(
      fc.property(withSome(told), seconds, ({ channel, some }, by) => {
        const { channel: after, indices } = withKeysMoved(channel, some, by, 0);
        const whole = by === 0 ? some : wholeSteps(channel, some);
        expect(indices.map((k) => after.values[k])).toEqual(whole);
        expect(indices.map((k) => after.times[k])).toEqual(whole.map((k) => channel.times[k] + by));
      }),
    );
  });

  it('restores the exact numbers when moved back, if no key was landed on', () => {
    fc.assert(
      // A sixteenth off the eighths that keys are on: nothing is landed on, and nothing is rounded.
      fc.property(withSome(channels(1, { steps: true })), seconds, ({ channel, some }, by) => {
        const there = withKeysMoved(channel, some, by + 1 / 16, 0);
        const back = withKeysMoved(there.channel, there.indices, -by - 1 / 16, 0);
        // Half of a step that was taken out comes back as one key landing on another.
        fc.pre(!some.some((k) => halved(channel.times, some, k)));
        expect(rowsOf(back.channel)).toEqual(rowsOf(channel));
        expect(back.indices).toEqual(some);
      }),
    );
  });
});

function halved(times: Float64Array, some: readonly number[], k: number): boolean {
  return [k - 1, k + 1].some((other) => times[other] === times[k] && !some.includes(other));
}

describe('a hundred thousand keys', () => {
  const count = 100_000;
  const long = channelOf(Array.from({ length: count }, (_, k) => [k / 30, Math.sin(k), 'linear'] as const));

  it('a hundred thousand keys are moved all at once, and stay whole', () => {
    const all = Array.from({ length: count }, (_, k) => k);
    const { channel, indices } = withKeysMoved(long, all, 1 / 60, 0.5);
    expect(channel.times).toHaveLength(count);
    expect(indices).toEqual(all);
    expect([channel.tangentsIn, channel.tangentsOut]).toEqual([long.tangentsIn, long.tangentsOut]);
    expect(channel.tangentsIn).toBe(long.tangentsIn);
    expect([channel.times[70_000], channel.values[70_000]]).toEqual([70_000 / 30 + 1 / 60, Math.sin(70_000) + 0.5]);
  });

  it('let one through from beginning to end', () => {
    const { channel, indices } = withKeysMoved(long, [0], 5000, 0);
    expect(indices).toEqual([count - 1]);
    expect([channel.times[0], channel.times[count - 1]]).toEqual([1 / 30, 5000]);
  });
});
