import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { putKey } from '../../../src/edit/keys/put-key.ts';
import { withKeysRemoved } from '../../../src/edit/keys/remove.ts';
import { rippleRoom, withKeysRippled } from '../../../src/edit/keys/ripple.ts';
import { withKeysSet, withKeysSnapped } from '../../../src/edit/keys/set.ts';
import { keysOf, restChannel } from '../../../src/model/takes/take.ts';
import { SMOOTH } from '../../../src/model/takes/tangent-kinds.ts';
import { checkChannel } from '../../helpers/invariants.ts';
import { channelOf, channels, expectNoCrowd, pointsOf, rowsOf, valueAt, withSome } from './channels.ts';

const three = channelOf(
  [
    [0, 0, 'linear'],
    [1, 3, 'linear'],
    [3, 5, 2],
  ],
  'cycle',
);

describe('putting a key', () => {
  it('adds it in its place, with the tangents asked for', () => {
    const { channel, index } = putKey(three, 2, 7, SMOOTH);
    expect(index).toBe(2);
    expect(rowsOf(channel)[2]).toEqual([2, 7, 'smooth', 'smooth']);
    checkChannel(channel);
  });

  it('gives a key that is there the value, and leaves it its tangents', () => {
    const { channel, index } = putKey(three, 3 - 1e-12, 7, SMOOTH);
    expect(index).toBe(2);
    expect(rowsOf(channel)[2]).toEqual([3, 7, 2, 2]);
    expect(channel.times).toBe(three.times);
    expect(putKey(three, 3, 5, SMOOTH).channel).toBe(three);
  });

  it('changes the later key of a step, which holds from then on', () => {
    const step = channelOf([
      [0, 1],
      [0, 2],
    ]);
    expect(pointsOf(putKey(step, 0, 9, SMOOTH).channel)).toEqual([
      [0, 1],
      [0, 9],
    ]);
  });

  it('putting a key makes a keyless channel one that is keyed', () => {
    const { channel } = putKey(restChannel(4), 1, 2, SMOOTH);
    expect(pointsOf(channel)).toEqual([[1, 2]]);
    checkChannel(channel);
  });
});

describe('removing keys', () => {
  it('leaves the others what they are', () => {
    expect(rowsOf(withKeysRemoved(three, [1]))).toEqual([rowsOf(three)[0], rowsOf(three)[2]]);
    expect(withKeysRemoved(three, [])).toBe(three);
  });

  it('leaves a channel that has lost all standing at a value', () => {
    const bare = withKeysRemoved(three, [0, 1, 2], 1.5);
    expect(keysOf(bare).times).toHaveLength(0);
    expect(valueAt(bare, 10)).toBe(1.5);
    expect(bare.extrapolateIn).toBe('cycle');
    expect(withKeysRemoved(three, [0, 1, 2])).not.toHaveProperty('rest');
  });
});

describe('rippling keys', () => {
  it('rippling keys takes all later keys along', () => {
    const { channel, indices } = withKeysRippled(three, [1], 0.5);
    expect(pointsOf(channel)).toEqual([
      [0, 0],
      [1.5, 3],
      [3.5, 5],
    ]);
    expect(indices).toEqual([1]);
  });

  it('rippling keys comes back as far as the key before, and makes a step with it', () => {
    expect(rippleRoom(three, 1)).toBe(-1);
    expect(rippleRoom(three, 0)).toBe(Number.NEGATIVE_INFINITY);
    const { channel, indices } = withKeysRippled(three, [1], -7);
    expect(pointsOf(channel)).toEqual([
      [0, 0],
      [0, 3],
      [2, 5],
    ]);
    expect(indices).toEqual([1]);
  });

  it('leaves at most two keys at one time when a step meets a step', () => {
    const steps = channelOf([
      [0, 1],
      [0, 2],
      [1, 3],
      [1, 4],
      [2, 5],
    ]);
    for (const from of [2, 3]) {
      const { channel, indices } = withKeysRippled(steps, [from, 4], -1);
      expect(pointsOf(channel)).toEqual([
        [0, 1],
        [0, 4],
        [1, 5],
      ]);
      expect(indices).toEqual([1, 2]);
    }
  });

  it('rippling keys keeps the distances of all that ripples, and everything before', () => {
    fc.assert(
      fc.property(
        withSome(channels(2)),
        fc.integer({ min: -160, max: 160 }).map((tick) => tick / 8),
        ({ channel, some }, seconds) => {
          const { channel: after, indices } = withKeysRippled(channel, some, seconds);
          checkChannel(after);
          expectNoCrowd(after);
          expect(indices).toEqual(some);
          const by = Math.max(seconds, rippleRoom(channel, some[0]));
          expect([...after.times]).toEqual([...channel.times].map((t, k) => (k < some[0] ? t : t + by)));
          expect(after.values).toEqual(channel.values);
        },
      ),
    );
  });
});

describe('typed numbers', () => {
  it('typed numbers are set exactly, slopes on their own side', () => {
    const { channel, indices } = withKeysSet(three, [0], { timeSeconds: 2, value: -1, slopeOut: 0.5 });
    expect(rowsOf(channel)).toEqual([
      [1, 3, 'linear', 'linear'],
      [2, -1, 'linear', 0.5],
      [3, 5, 2, 2],
    ]);
    expect(indices).toEqual([1]);
  });

  it('replace another key at the typed time', () => {
    expect(pointsOf(withKeysSet(three, [0], { timeSeconds: 3 }).channel)).toEqual([
      [1, 3],
      [3, 0],
    ]);
  });

  it('change nothing if they are the same', () => {
    expect(withKeysSet(three, [2], { timeSeconds: 3, value: 5, slopeIn: 2, slopeOut: 2 }).channel).toBe(three);
  });
});

describe('snapping to frames', () => {
  it('moves keys to the nearest frame, and keeps those that are on one', () => {
    const loose = channelOf([
      [0.04, 1],
      [0.1, 2],
      [0.26, 3],
    ]);
    const { channel, indices } = withKeysSnapped(loose, [0, 1, 2], 10);
    expect(pointsOf(channel)).toEqual([
      [0, 1],
      [0.1, 2],
      [0.3, 3],
    ]);
    expect(indices).toEqual([0, 1, 2]);
    expect(withKeysSnapped(channel, [0, 1, 2], 10).channel).toBe(channel);
  });

  it('snapping to frames keeps the last of the keys on one frame, and the halves of a step', () => {
    const loose = channelOf([
      [0.98, 1],
      [1, 2],
      [1.97, 3],
      [1.97, 4],
    ]);
    expect(pointsOf(withKeysSnapped(loose, [0, 1, 2, 3], 10).channel)).toEqual([
      [1, 2],
      [2, 3],
      [2, 4],
    ]);
  });

  it('takes frames that begin elsewhere than at 0', () => {
    const loose = channelOf([
      [0.02, 1],
      [0.14, 2],
      [0.31, 3],
    ]);
    const { channel } = withKeysSnapped(loose, [0, 1, 2], 10, 0.05);
    expect(pointsOf(channel).map(([t, v]) => [Number(t.toFixed(9)), v])).toEqual([
      [0.05, 1],
      [0.15, 2],
      [0.35, 3],
    ]);
    expect(withKeysSnapped(channel, [0, 1, 2], 10, 0.05).channel).toBe(channel);
  });

  it('snapping to frames does no harm to the half of a step that is not selected', () => {
    const step = channelOf([
      [1, 1],
      [1, 2],
    ]);
    expect(withKeysSnapped(step, [0], 10).channel).toBe(step);
  });
});
