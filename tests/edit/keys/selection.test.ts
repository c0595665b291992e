import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import {
  allKeys,
  countKeys,
  hasKey,
  keyCountOf,
  keysAtTime,
  toggleKeys,
  unionKeys,
  withoutKeys,
} from '../../../src/edit/keys/selection.ts';
import type { ChannelKeys } from '../../../src/model/session.ts';
import type { Take } from '../../../src/model/takes/take.ts';
import { restChannel } from '../../../src/model/takes/take.ts';
import { channelOf } from './channels.ts';

const take: Take = {
  name: 'walk',
  range: [0, 1],
  channels: [
    channelOf([
      [0, 0],
      [1, 0],
      [1, 1],
      [2, 0],
    ]),
    restChannel(1),
    channelOf([
      [1, 0],
      [3, 0],
    ]),
  ],
};

describe('finding keys', () => {
  it('finds all keys of all channels or of some, none of keyless ones', () => {
    expect(allKeys(take)).toEqual([
      { channel: 0, indices: [0, 1, 2, 3] },
      { channel: 2, indices: [0, 1] },
    ]);
    expect(allKeys(take, [2, 1, 2, 9])).toEqual([{ channel: 2, indices: [0, 1] }]);
  });

  it('finds the keys at a time, both of a step', () => {
    expect(keysAtTime(take, undefined, 1 + 1e-12)).toEqual([
      { channel: 0, indices: [1, 2] },
      { channel: 2, indices: [0] },
    ]);
    expect(keysAtTime(take, [0], 1.5)).toEqual([]);
  });

  it('finding keys counts them, a step as one, and knows each', () => {
    expect(countKeys(take.channels, [])).toBe(0);
    expect(countKeys(take.channels, allKeys(take))).toBe(5);
    // Of a step only one half is one key too, and so is a key that is gone.
    const halves = [{ channel: 0, indices: [2, 3, 9] }];
    expect(countKeys(take.channels, halves)).toBe(3);
    expect(take.channels.map(keyCountOf)).toEqual([3, 0, 2]);
    const some = [{ channel: 2, indices: [1, 4, 7] }];
    expect([1, 2, 4, 7, 8].map((k) => hasKey(some, 2, k))).toEqual([true, false, true, true, false]);
    expect(hasKey(some, 1, 1)).toBe(false);
    expect(hasKey(undefined, 1, 1)).toBe(false);
  });
});

describe('sets of keys', () => {
  const sets = fc
    .uniqueArray(fc.tuple(fc.nat(4), fc.nat(6)), { selector: ([c, k]) => `${c}:${k}`, maxLength: 20 })
    .map((pairs) => pairs.map(([c, k]) => `${c}:${k}`));
  const toKeys = (names: Iterable<string>): ChannelKeys[] => {
    const all = new Map<number, number[]>();
    for (const name of names) {
      const [channel, index] = name.split(':').map(Number);
      all.set(channel, [...(all.get(channel) ?? []), index]);
    }
    return [...all.entries()]
      .sort(([a], [b]) => a - b)
      .map(([channel, indices]) => ({ channel, indices: indices.sort((a, b) => a - b) }));
  };

  it('sets of keys are united, toggled and taken away as sets are, and stay in order', () => {
    fc.assert(
      fc.property(sets, sets, (a, b) => {
        const [inA, inB] = [new Set(a), new Set(b)];
        const [keysA, keysB] = [toKeys(a), toKeys(b)];
        const without = a.filter((name) => !inB.has(name));
        expect(unionKeys(keysA, keysB)).toEqual(toKeys(new Set([...a, ...b])));
        expect(withoutKeys(keysA, keysB)).toEqual(toKeys(without));
        expect(toggleKeys(keysA, keysB)).toEqual(toKeys([...without, ...b.filter((name) => !inA.has(name))]));
      }),
    );
  });
});
