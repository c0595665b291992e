import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { areSelected, keysBetween, nearestKeyTime, selectedCount, spanOf } from '../../../src/edit/keys/row-keys.ts';
import { keysOf } from '../../../src/model/takes/take.ts';
import { channel } from '../../ui/builders.ts';
import { channels, someKeys } from '../../ui/editors/dope/arbitrary.ts';

const span = fc.tuple(fc.double({ min: -1, max: 2, noNaN: true }), fc.double({ min: 0, max: 1, noNaN: true }));

describe('keys between two times', () => {
  it('keys between two times are those found by a walk over all keys', () => {
    fc.assert(
      fc.property(channels, span, (all, [from, length]) => {
        const to = from + length;
        const of = [...all.keys()];
        const walked = someKeys(all, (c, i) => keysOf(all[c]).times[i] >= from && keysOf(all[c]).times[i] <= to);
        expect(keysBetween(all, of, from, to)).toEqual(walked);
      }),
    );
  });

  it('include keys on both ends, and both keys of a step', () => {
    expect(keysBetween([channel(0, 1, 1, 2)], [0], 1, 2)).toEqual([{ channel: 0, indices: [1, 2, 3] }]);
  });

  it('leave out channels that have none there', () => {
    expect(keysBetween([channel(0), channel(5)], [0, 1], 4, 6)).toEqual([{ channel: 1, indices: [0] }]);
  });
});

describe('the nearest key', () => {
  it('the nearest key is the one found by a walk over all keys', () => {
    const at = fc.double({ min: -1, max: 2, noNaN: true });
    fc.assert(
      fc.property(channels, at, fc.double({ min: 0.001, max: 1, noNaN: true }), (all, time, reach) => {
        const distances = all.map(keysOf).flatMap(({ times }) => [...times].map((t) => Math.abs(t - time)));
        const least = Math.min(...distances, Number.POSITIVE_INFINITY);
        const found = nearestKeyTime(all, [...all.keys()], time, reach);
        if (least > reach) expect(found).toBeUndefined();
        else expect(Math.abs((found ?? Number.NaN) - time)).toBe(least);
      }),
    );
  });

  it('the nearest key is not one of another row', () => {
    expect(nearestKeyTime([channel(0), channel(1)], [1], 0.1, 2)).toBe(1);
  });
});

describe('what is selected of a row', () => {
  it('what is selected of a row is all of some keys exactly where each one is', () => {
    fc.assert(
      fc.property(channels, fc.func(fc.boolean()), fc.func(fc.boolean()), (all, coinA, coinB) => {
        const keys = someKeys(all, coinA);
        const selected = someKeys(all, coinB);
        const each = keys.every(({ channel: c, indices }) => indices.every((i) => coinB(c, i)));
        expect(areSelected(keys, selected)).toBe(each);
      }),
    );
  });

  it('counts the selected keys of its own channels only', () => {
    const selected = [
      { channel: 0, indices: [1] },
      { channel: 2, indices: [0, 4] },
      { channel: 5, indices: [3] },
    ];
    expect(selectedCount([], [1, 2, 5], selected)).toBe(3);
    expect(selectedCount([], [1, 3], selected)).toBe(0);
  });
});

describe('the span of some keys', () => {
  const all = [channel(0, 1, 2), channel(0.5, 3)];

  it('extends from the first to the last of them', () => {
    const keys = [
      { channel: 0, indices: [1, 2] },
      { channel: 1, indices: [0] },
    ];
    expect(spanOf(all, keys)).toEqual([0.5, 2]);
  });

  it('the span of some keys is undefined without keys, and ignores removed keys', () => {
    expect(spanOf(all, [])).toBeUndefined();
    expect(spanOf(all, [{ channel: 1, indices: [7] }])).toBeUndefined();
    expect(spanOf(all, [{ channel: 9, indices: [0] }])).toBeUndefined();
  });
});
