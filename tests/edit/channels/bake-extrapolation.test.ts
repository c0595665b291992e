import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { unrolled, withExtrapolationBaked } from '../../../src/edit/channels/bake-extrapolation.ts';
import { CommandError } from '../../../src/edit/command-error.ts';
import { compileChannels } from '../../../src/evaluate/compiled-take.ts';
import { evaluateChannel } from '../../../src/evaluate/curves.ts';
import {
  type Channel,
  EXTRAPOLATIONS,
  type Extrapolation,
  type KeyedChannel,
  keysOf,
} from '../../../src/model/takes/take.ts';
import { checkChannel } from '../../helpers/invariants.ts';
import { channelOf, channels, expectNoCrowd, pointsOf, rowsOf, valueAt } from '../keys/channels.ts';

/** Of the curve's largest value. */
const SHAPE = 1e-9;

/** Same values at these times; where both jump, on one side of the jump or the other. */
function expectSameShape(after: Channel, before: Channel, times: readonly number[]): void {
  const both = compileChannels([before, after]);
  const at = (c: number, t: number) => evaluateChannel(both, c, t);
  const scale = Math.max(1, ...times.map((t) => Math.abs(at(0, t))));
  for (const t of times) {
    const value = at(1, t);
    const meant = [t, t - 1e-9, t + 1e-9].map((near) => at(0, near));
    // Beside a time the curve has gone on a little.
    const within = SHAPE * scale;
    const off = Math.abs(value - meant[0]);
    if (off <= within) continue;
    const jump = Math.max(...meant) - Math.min(...meant);
    const nearest = Math.min(...meant.map((m) => Math.abs(value - m)));
    if (!(jump > 1e-3 && nearest <= 1e-5 * scale)) expect.fail(`at ${t} s it is off by ${off}: ${meant[0]} is meant`);
  }
}

const first = (c: KeyedChannel) => keysOf(c).times[0];
const last = (c: KeyedChannel) => keysOf(c).times[keysOf(c).times.length - 1];
/** Seconds beyond an end: none, or more than rounding. */
const away = fc.oneof(
  fc.constant(0),
  fc.double({ min: 1e-3, max: 40, noNaN: true }),
  fc.integer({ min: 0, max: 200 }).map((t) => t / 8),
);
const shares = fc.array(fc.double({ min: 0, max: 1, noNaN: true }), { minLength: 30, maxLength: 30 });

describe('baking the extrapolation', () => {
  it.each(EXTRAPOLATIONS)('leaves the shape of %s between both ends', (before) => {
    const cases = channels(1, { steps: true, maxLength: 6, extrapolations: EXTRAPOLATIONS });
    fc.assert(
      fc.property(cases, away, away, shares, (made, early, late, where) => {
        const channel = { ...made, extrapolateIn: before };
        const period = last(channel) - first(channel);
        // A few periods are as good as a thousand.
        const reach = period > 0 ? 5 * period : 40;
        const from = first(channel) - Math.min(early, reach);
        const to = last(channel) + Math.min(late, reach);
        for (const bake of [
          (c: KeyedChannel) => withExtrapolationBaked(c, from, to).channel,
          (c: KeyedChannel) => unrolled(c, from, to),
        ]) {
          const after = bake(channel);
          checkChannel(after);
          expectSameShape(
            after,
            channel,
            where.map((u) => Math.min(to, from + u * (to - from))),
          );
          expectSameShape(
            after,
            channel,
            [from, ...channel.times, to].filter((t) => t !== last(channel)),
          );
        }
      }),
      { numRuns: 200 },
    );
  });

  it('puts the curve between keys from the first moment to the last', () => {
    fc.assert(
      fc.property(channels(1, { maxLength: 5 }), away, away, (channel, early, late) => {
        const from = first(channel) - Math.min(early, 10);
        const to = last(channel) + Math.min(late, 10);
        const after = unrolled(channel, from, to);
        expect(first(after)).toBeCloseTo(from, 9);
        expect(last(after)).toBeCloseTo(to, 9);
        expectNoCrowd(after);
      }),
    );
  });

  const wave = (extrapolation: Extrapolation, end = 0) =>
    channelOf(
      [
        [0, 0, 1],
        [1, 2, 'smooth'],
        [2, end, 'linear'],
      ],
      extrapolation,
    );

  it('copies the keys of a cycle whose ends meet, one key at each seam', () => {
    const { channel, keysBefore, keysAfter, periodChanged } = withExtrapolationBaked(wave('cycle'), -2, 6);
    expect(pointsOf(channel)).toEqual([
      [-2, 0],
      [-1, 2],
      [0, 0],
      [1, 2],
      [2, 0],
      [3, 2],
      [4, 0],
      [5, 2],
      [6, 0],
    ]);
    expect([keysBefore, keysAfter, periodChanged]).toEqual([3, 9, false]);
    // In from the last key, out from the first one; kinds inside a copy stay.
    expect(rowsOf(channel)[4]).toEqual([2, 0, -2, 1]);
    expect(rowsOf(channel)[5]).toEqual([3, 2, 'smooth', 'smooth']);
  });

  it('baking the extrapolation makes a step of a cycle that jumps, except where it ends', () => {
    expect(pointsOf(withExtrapolationBaked(wave('cycle', 5), 0, 4).channel)).toEqual([
      [0, 0],
      [1, 2],
      [2, 5],
      [2, 0],
      [3, 2],
      [4, 5],
    ]);
  });

  it('baking the extrapolation climbs with cycle_offset', () => {
    expect(pointsOf(withExtrapolationBaked(wave('cycle_offset', 5), -2, 4).channel)).toEqual([
      [-2, -5],
      [-1, -3],
      [0, 0],
      [1, 2],
      [2, 5],
      [3, 7],
      [4, 10],
    ]);
  });

  it('mirrors every other copy with bounce, tangents and all', () => {
    const { channel } = withExtrapolationBaked(wave('bounce', 5), 0, 6);
    expect(rowsOf(channel)).toEqual([
      [0, 0, 1, 1],
      [1, 2, 'smooth', 'smooth'],
      [2, 5, 3, -3],
      [3, 2, 'smooth', 'smooth'],
      [4, 0, -1, 1],
      [5, 2, 'smooth', 'smooth'],
      [6, 5, 3, 3].map((x, i) => (i === 3 ? 3 : x)),
    ]);
  });

  it('cuts the last copy with a key on the curve', () => {
    const channel = wave('cycle', 5);
    const { channel: after } = withExtrapolationBaked(channel, 0, 2.5);
    expect(pointsOf(after).slice(3)).toEqual([
      [2, 0],
      [2.5, valueAt(channel, 2.5)],
    ]);
    expect(valueAt(after, 2.4)).toBeCloseTo(valueAt(channel, 2.4), 12);
  });

  it('needs one key for linear, which continues', () => {
    const { channel } = withExtrapolationBaked(wave('linear', 5), -3, 4);
    expect(pointsOf(channel)).toEqual([
      [-3, -3],
      [0, 0],
      [1, 2],
      [2, 5],
      [4, 11],
    ]);
    expect([channel.extrapolateIn, channel.extrapolateOut]).toEqual(['linear', 'linear']);
    expect(valueAt(channel, 5)).toBe(14);
  });

  it('needs none for constant, and leaves a channel that it has nothing to do with', () => {
    const constant = wave('constant');
    expect(withExtrapolationBaked(constant, -5, 5).channel).toBe(constant);
    const inside = wave('cycle');
    expect(withExtrapolationBaked(inside, 0, 2).channel).toBe(inside);
    const lone = channelOf([[0, 3]], 'cycle');
    expect(withExtrapolationBaked(lone, -5, 5).channel).toBe(lone);
    const none = channelOf([], 'cycle');
    expect(withExtrapolationBaked(none, -5, 5).channel).toBe(none);
  });

  it('baking the extrapolation makes what repeated constant, and reports if the other side repeats with another period', () => {
    const { channel, periodChanged } = withExtrapolationBaked(wave('cycle'), 0, 5);
    expect([channel.extrapolateIn, channel.extrapolateOut]).toEqual(['cycle', 'constant']);
    expect(periodChanged).toBe(true);
  });

  it('baking the extrapolation refuses a million keys', () => {
    expect(() => withExtrapolationBaked(wave('cycle'), 0, 1e7)).toThrow(CommandError);
  });
});
