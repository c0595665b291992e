import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { wholeSteps } from '../../../src/edit/keys/steps.ts';
import { keysWithin, withKeysTweened } from '../../../src/edit/keys/tween.ts';
import { channelOf, channels, pointsOf, withSome } from './channels.ts';

const five = channelOf([
  [0, 0],
  [1, 5],
  [2, -1],
  [3, 4],
  [4, 8],
]);
const values = (tween: Parameters<typeof withKeysTweened>[2], indices = [1, 2, 3]) =>
  pointsOf(withKeysTweened(five, indices, tween)).map(([, value]) => value);

describe('tweening selected keys', () => {
  it('sets a run to values between the keys around it, or beyond', () => {
    expect(values({ kind: 'tween', u: 0.5 })).toEqual([0, 4, 4, 4, 8]);
    expect(values({ kind: 'tween', u: 1.25 }, [2])).toEqual([0, 5, 3.75, 4, 8]);
  });

  it('relaxes a run to the line, and pushes it away', () => {
    expect(values({ kind: 'relax', amount: 1 })).toEqual([0, 2, 4, 6, 8]);
    expect(values({ kind: 'relax', amount: -1 })).toEqual([0, 8, -6, 2, 8]);
  });

  it('eases out of the key before, into the key after, and along the line between', () => {
    expect(values({ kind: 'ease', amount: 0 })).toEqual([0, 2, 4, 6, 8]);
    expect(values({ kind: 'ease', amount: 0.25 })).toEqual([0, 0.5, 2, 4.5, 8]);
    expect(values({ kind: 'ease', amount: -0.25 })).toEqual([0, 3.5, 6, 7.5, 8]);
  });

  it('leaves runs at an end alone, and everything that is not selected', () => {
    expect(withKeysTweened(five, [0, 1, 4], { kind: 'tween', u: 0.5 })).toBe(five);
    expect(keysWithin([five], [{ channel: 0, indices: [0, 1, 4] }])).toEqual([]);
    expect(keysWithin([five, five], [{ channel: 1, indices: [0, 2, 3] }])).toEqual([{ channel: 1, indices: [2, 3] }]);
    fc.assert(
      fc.property(withSome(channels(1, { steps: true })), ({ channel, some }) => {
        const after = withKeysTweened(channel, some, { kind: 'relax', amount: 0.5 });
        const whole = new Set(wholeSteps(channel, some));
        expect(after.times).toBe(channel.times);
        channel.values.forEach((value, k) => {
          // A held step follows the key before it.
          if (!whole.has(k) && !whole.has(k - 1)) expect(after.values[k]).toBe(value);
        });
        expect(withKeysTweened(channel, some, { kind: 'relax', amount: 0 })).toBe(channel);
      }),
    );
  });
});
