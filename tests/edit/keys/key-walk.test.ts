import { describe, expect, it } from 'vitest';
import { nearestKey, walkChannels, walkKeys } from '../../../src/edit/keys/key-walk.ts';
import { keysOf, restChannel } from '../../../src/model/takes/take.ts';
import { channel } from '../../ui/builders.ts';

const channels = [channel(0, 1, 2, 3), restChannel(), channel(0.4, 2.2)];
const one = (c: number, ...indices: number[]) => [{ channel: c, indices }];

describe('going from key to key', () => {
  it('begins at the key nearest to the playhead, in the first channel that has any', () => {
    expect(walkKeys(channels, [], [1, 2, 0], 2, 1, false)).toEqual(one(2, 1));
  });

  it('continues from the last selected key, and back from the first', () => {
    expect(walkKeys(channels, one(0, 1, 2), [0], 0, 1, false)).toEqual(one(0, 3));
    expect(walkKeys(channels, one(0, 1, 2), [0], 0, -1, false)).toEqual(one(0, 0));
  });

  it('going from key to key stays at the ends', () => {
    expect(walkKeys(channels, one(0, 3), [0], 0, 1, false)).toEqual(one(0, 3));
    expect(walkKeys(channels, one(0, 0), [0], 0, -1, true)).toEqual(one(0, 0));
  });

  it('adds on either side, in order', () => {
    expect(walkKeys(channels, one(0, 1), [0], 0, 1, true)).toEqual(one(0, 1, 2));
    expect(walkKeys(channels, one(0, 1), [0], 0, -1, true)).toEqual(one(0, 0, 1));
  });

  it('crosses to the key nearest in time of the next channel that has keys', () => {
    expect(walkChannels(channels, one(0, 2), [0, 1, 2], 1)).toEqual(one(2, 1));
    expect(walkChannels(channels, one(2, 0), [0, 1, 2], -1)).toEqual(one(0, 0));
    expect(walkChannels(channels, one(2, 0), [0, 1, 2], 1)).toEqual(one(2, 0));
  });

  it('finds the nearest key, of two as near the earlier', () => {
    expect([-5, 0.5, 0.6, 9].map((time) => nearestKey(keysOf(channels[0]).times, time))).toEqual([0, 0, 1, 3]);
  });
});
