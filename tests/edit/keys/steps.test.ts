import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { withKeysMoved, withValues } from '../../../src/edit/keys/move.ts';
import { withKeysRemoved } from '../../../src/edit/keys/remove.ts';
import { isHeld, wholeSteps, withoutStepsAfter, withStepsAfter } from '../../../src/edit/keys/steps.ts';
import { channelOf, channels, expectNoCrowd, pointsOf, rowsOf, valueAt, withSome } from './channels.ts';

const three = channelOf([
  [0, 0],
  [1, 3],
  [2, 1],
]);
const stepped = withStepsAfter(three, [0, 1]).channel;

describe('steps', () => {
  it('hold a key up to the next one, and are taken back by the same keys', () => {
    expect(rowsOf(stepped)).toEqual([
      [0, 0, 'smooth', 'flat'],
      [1, 0, 'flat', 'flat'],
      [1, 3, 'smooth', 'flat'],
      [2, 3, 'flat', 'flat'],
      [2, 1, 'smooth', 'smooth'],
    ]);
    expect([0.5, 0.999, 1, 1.9, 2].map((time) => valueAt(stepped, time))).toEqual([0, 0, 3, 3, 1]);
    expect(withStepsAfter(stepped, [0, 1, 2]).channel).toBe(stepped);
    const without = withoutStepsAfter(stepped, [0, 1, 2]);
    expect(pointsOf(without.channel)).toEqual(pointsOf(three));
    expect(without.indices).toEqual([0, 1]);
  });

  it('of the last key are only flat', () => {
    expect(rowsOf(withStepsAfter(three, [2]).channel)[2]).toEqual([2, 1, 'smooth', 'flat']);
  });

  it('follow the key that they hold', () => {
    expect(pointsOf(withValues(stepped, [0], () => 5))).toEqual([
      [0, 5],
      [1, 5],
      [1, 3],
      [2, 3],
      [2, 1],
    ]);
    // All of them raised: each held key by as much as its own.
    const all = withKeysMoved(stepped, [0, 1, 2, 3, 4], 0, 1).channel;
    expect(pointsOf(all).map(([, value]) => value)).toEqual([1, 1, 4, 4, 2]);
    // The earlier half alone has no value of its own.
    expect(withValues(stepped, [1], () => 9)).toBe(stepped);
  });

  it('are moved and deleted as one, and a hold goes on where the key of the next one is deleted', () => {
    const { channel, indices } = withKeysMoved(stepped, [2], 0.25, 0);
    expect(pointsOf(channel)).toEqual([
      [0, 0],
      [1.25, 0],
      [1.25, 3],
      [2, 3],
      [2, 1],
    ]);
    expect(indices).toEqual([1, 2]);
    for (const half of [1, 2]) {
      expect(pointsOf(withKeysRemoved(stepped, [half]))).toEqual([
        [0, 0],
        [2, 0],
        [2, 1],
      ]);
    }
  });

  it('change the earlier key of a step that is there already, and never make three keys at a time', () => {
    const jump = channelOf([
      [0, 0],
      [1, 2],
      [1, 3],
    ]);
    expect(pointsOf(withStepsAfter(jump, [0]).channel)).toEqual([
      [0, 0],
      [1, 0],
      [1, 3],
    ]);
  });

  it('keep any curve piecewise constant after the keys, and everything else', () => {
    fc.assert(
      fc.property(withSome(channels(1, { steps: true })), ({ channel, some }) => {
        const { channel: after, indices } = withStepsAfter(channel, some);
        expectNoCrowd(after);
        expect(indices).toEqual(wholeSteps(after, indices));
        const given = new Set(wholeSteps(channel, some));
        for (const k of given) {
          if (!(channel.times[k + 1] > channel.times[k])) continue;
          const middle = (channel.times[k] + channel.times[k + 1]) / 2;
          expect(valueAt(after, middle)).toBe(channel.values[k]);
        }
        for (let k = 0; k + 1 < after.times.length; k++) {
          if (after.times[k] === after.times[k + 1] && indices.includes(k - 1)) expect(isHeld(after, k)).toBe(true);
        }
      }),
    );
  });
});
