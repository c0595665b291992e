import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { withStepsAfter } from '../../../src/edit/keys/steps.ts';
import {
  setSlope,
  setTangentKind,
  tangentKindsOf,
  withTangentsBroken,
  withTangentsUnified,
} from '../../../src/edit/keys/tangents.ts';
import { FIXED_TANGENT, FLAT, SMOOTH, TANGENT_CHOICES } from '../../../src/model/takes/tangent-kinds.ts';
import { checkChannel } from '../../helpers/invariants.ts';
import { between, channelOf, channels, rowsOf, slopesAt, valueAt, withSome } from './channels.ts';

const three = channelOf([
  [0, 0, 'linear'],
  [1, 3, 'linear'],
  [3, 5, 2],
]);

describe('setting tangents', () => {
  it('sets one side or both, and nothing else', () => {
    expect(rowsOf(setTangentKind(three, [1], 'in', SMOOTH))[1]).toEqual([1, 3, 'smooth', 'linear']);
    expect(rowsOf(setTangentKind(three, [1], 'out', SMOOTH))[1]).toEqual([1, 3, 'linear', 'smooth']);
    const flat = setTangentKind(three, [1, 2], 'both', FLAT);
    expect(rowsOf(flat).map((row) => [row[2], row[3]])).toEqual([
      ['linear', 'linear'],
      ['flat', 'flat'],
      ['flat', 'flat'],
    ]);
    checkChannel(flat);
    expect(flat.times).toBe(three.times);
    expect(flat.values).toBe(three.values);
  });

  it('freezes the slope there is when it makes them numbers', () => {
    expect(rowsOf(setTangentKind(three, [1], 'both', FIXED_TANGENT))[1]).toEqual([1, 3, 3, 1]);
    expect(rowsOf(setTangentKind(three, [1], 'in', FIXED_TANGENT))[1]).toEqual([1, 3, 3, 'linear']);
  });

  it('setting tangents makes the side a number when its slope is set', () => {
    expect(rowsOf(setSlope(three, [0, 1], 'out', -7)).map((row) => [row[2], row[3]])).toEqual([
      ['linear', -7],
      ['linear', -7],
      [2, 2],
    ]);
  });

  it('setting tangents returns the channel itself if nothing changes', () => {
    expect(setSlope(three, [2], 'both', 2)).toBe(three);
    expect(setTangentKind(three, [2], 'both', FIXED_TANGENT)).toBe(three);
    expect(setTangentKind(three, [], 'both', FLAT)).toBe(three);
    expect(setSlope(three, [2], 'out', 3).tangentsIn).toBe(three.tangentsIn);
  });
});

describe('the kinds of selected tangents', () => {
  it('the kinds of keys that are all steps are steps, also of the last one, which has nothing to hold', () => {
    const { channel } = withStepsAfter(three, [0, 1, 2]);
    const all = [{ channel: 0, indices: [...channel.times.keys()] }];
    const last = [{ channel: 0, indices: [channel.times.length - 1] }];
    const kinds = (keys: typeof all) =>
      TANGENT_CHOICES.filter((_, kind) => tangentKindsOf([channel], keys, 'out') & (1 << kind)).map(({ name }) => name);
    expect(kinds(all)).toEqual(['step']);
    expect(kinds(last)).toEqual(['flat']);
  });
});

describe('unifying tangents', () => {
  it('gives both sides the mean of their slopes', () => {
    expect(rowsOf(withTangentsUnified(three, [1]))[1]).toEqual([1, 3, 2, 2]);
  });

  it('unifying tangents does not change keys whose sides are equal', () => {
    expect(withTangentsUnified(three, [0, 2])).toBe(three);
  });
});

describe('breaking tangents', () => {
  it('breaking tangents makes both sides the numbers they are', () => {
    expect(rowsOf(withTangentsBroken(three, [1]))[1]).toEqual([1, 3, 3, 1]);
  });

  it('breaking tangents changes no curve', () => {
    fc.assert(
      fc.property(withSome(channels(1, { steps: true })), between(-60, 60), ({ channel, some }, time) => {
        const broken = withTangentsBroken(channel, some);
        checkChannel(broken);
        // Plus 0: −0 is 0 here.
        const plain = (k: number, c: typeof channel) => slopesAt(c, k).map((slope) => slope + 0);
        for (const k of some) expect(plain(k, broken)).toEqual(plain(k, channel));
        expect(valueAt(broken, time) + 0).toBe(valueAt(channel, time) + 0);
      }),
    );
  });
});
