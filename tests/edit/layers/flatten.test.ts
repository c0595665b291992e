import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { flattened } from '../../../src/edit/layers/flatten.ts';
import { compileTake } from '../../../src/evaluate/compiled-take.ts';
import { evaluateChannel } from '../../../src/evaluate/curves.ts';
import { evaluateMotion, takeMotion } from '../../../src/evaluate/take-motion.ts';
import { motionsOf } from '../../../src/model/takes/layers.ts';
import { keysOf, restChannel, type Take } from '../../../src/model/takes/take.ts';
import { checkChannel } from '../../helpers/invariants.ts';
import { between, channelOf, channels, expectNoCrowd, rowsOf } from '../keys/channels.ts';
import { swinging } from '../samples/made.ts';
import { layeredTake, layeredTakes, layerOf } from './layered.ts';

/** The first channel's value as it is shown. */
function shownAt(take: Take, time: number): number {
  const out = new Float64Array(take.channels.length);
  evaluateMotion(takeMotion(take, undefined), time, out, out.length);
  return out[0];
}

const plainAt = (take: Take, time: number) => evaluateChannel(compileTake(take), 0, time);

/** All times of keys, at which values may jump. */
const keyTimes = (take: Take) => motionsOf(take).flatMap(({ channels: [channel] }) => [...keysOf(channel).times]);

const shares = fc.array(between(0, 1), { minLength: 20, maxLength: 20 });

describe('flattening layers under constant weights', () => {
  it('gives the same values between the keys and in the range, and beyond where nothing was baked', () => {
    fc.assert(
      fc.property(layeredTakes(), shares, (take, where) => {
        const { take: plain, bakedCount } = flattened(take, undefined);
        expect(plain.layers).toBeUndefined();
        checkChannel(plain.channels[0]);
        expectNoCrowd(plain.channels[0]);
        const times = bakedCount > 0 ? [...keysOf(plain.channels[0]).times] : keyTimes(take);
        const [first, last] = [Math.min(...times), Math.max(...times)];
        const [from, to] = bakedCount > 0 ? [first, last] : [first - 20, last + 20];
        if (bakedCount > 0) expect([first <= take.range[0], last >= take.range[1]]).toEqual([true, true]);
        if (times.length === 0) return;
        const within = 1e-9 * Math.max(1, ...where.map((u) => Math.abs(shownAt(take, from + u * (to - from)))), 2000);
        for (const u of where) {
          const time = from + u * (to - from);
          const off = (at: number) => Math.abs(plainAt(plain, time) - shownAt(take, at));
          // Where a repetition meets another the value may jump, and rounding decides on which side a time is.
          expect(Math.min(off(time), off(time - 1e-9), off(time + 1e-9)), `at ${time}`).toBeLessThan(within * 100);
        }
      }),
    );
  });

  it('has keys at the union of keys, and a jump as two at one time', () => {
    const base = channelOf([
      [0, 1, 'flat'],
      [1, 2, 'flat'],
      [1, 3, 'flat'],
      [2, 0, 'flat'],
    ]);
    const wave = channelOf([
      [0.5, 0, 'linear'],
      [2, 1, 'linear'],
    ]);
    const { take } = flattened(layeredTake([base], [layerOf([wave], { weight: 0.5 })]), undefined);
    expect(rowsOf(take.channels[0]).map(([time]) => time)).toEqual([0, 0.5, 1, 1, 2]);
    expect(rowsOf(take.channels[0])[2][1]).toBeCloseTo(2 + 1 / 6, 12);
    expect(rowsOf(take.channels[0])[3][1]).toBeCloseTo(3 + 1 / 6, 12);
  });

  it('of channels that never change is one key, at the earliest of theirs', () => {
    const still = (time: number, value: number) => channelOf([[time, value, 'flat']], 'cycle', 'linear');
    const take = layeredTake([still(2, 1)], [layerOf([still(1, 4)], { weight: 0.25 })]);
    expect(rowsOf(flattened(take, undefined).take.channels[0]).map((row) => row.slice(0, 2))).toEqual([[1, 2]]);
    const rest = layeredTake([restChannel(3)], [layerOf([still(1, 4)], { weight: 0.25 })]);
    expect(rowsOf(flattened(rest, undefined).take.channels[0]).map((row) => row.slice(0, 2))).toEqual([[1, 4]]);
  });

  it('leaves channels that no layer touches as they are, to the object', () => {
    const base = channelOf([
      [0, 1, 'auto'],
      [1, 2, 'smooth'],
    ]);
    const other = layerOf([channelOf([[0, 5]])], { mute: true });
    for (const layer of [other, { ...other, mute: false, weight: 0 }, layerOf([restChannel()]), layerOf([])]) {
      expect(flattened(layeredTake([base], [layer]), undefined).take.channels[0]).toBe(base);
    }
    const plain = { name: 'walk', range: [0, 1], channels: [base] } as const;
    expect(flattened(plain, undefined).take).toBe(plain);
  });
});

describe('flattening a weight over time', () => {
  it('is within the tolerance at any time of the range, with at most a key a frame more', () => {
    /** As an animator's: slopes of a few units a second, on eighths of seconds. */
    const scaled = (by: number) =>
      channels(2, { maxLength: 6, extrapolations: ['constant', 'linear', 'cycle'] }).map((channel) => ({
        ...channel,
        values: channel.values.map((value) => value * by),
        tangentsIn: { ...channel.tangentsIn, slopes: channel.tangentsIn.slopes.map((slope) => slope * by) },
        tangentsOut: { ...channel.tangentsOut, slopes: channel.tangentsOut.slopes.map((slope) => slope * by) },
      }));
    const [curve, weight] = [scaled(0.005), scaled(0.02)];
    fc.assert(
      fc.property(curve, curve, weight, fc.boolean(), shares, (base, own, w, isAdditive, where) => {
        const layer = layerOf([own], {
          weight: { ...w, extrapolateIn: 'constant', extrapolateOut: 'constant' },
          mode: isAdditive ? 'additive' : 'override',
        });
        const take = { ...layeredTake([base], [layer]), framesPerSecond: 30 };
        const { take: plain, isFitted } = flattened(take, undefined);
        expect(isFitted).toEqual([true]);
        checkChannel(plain.channels[0]);
        const most = 61 + 2 * (base.times.length + own.times.length + w.times.length) + 2;
        expect(keysOf(plain.channels[0]).times.length).toBeLessThanOrEqual(most);
        for (const u of where) expect(Math.abs(plainAt(plain, 2 * u) - shownAt(take, 2 * u))).toBeLessThan(1e-3);
      }),
      { numRuns: 60 },
    );
  });
});

describe('flattening over samples', () => {
  it('is the sum at each frame, and leaves other columns as they are', () => {
    const [base] = swinging().takes;
    const count = base.channels.length;
    const lift = channelOf([
      [0, 0, 'flat'],
      [1, 0.5, 'flat'],
    ]);
    const own = Array.from({ length: count }, (_, c) => (c === 4 ? lift : restChannel()));
    const take = layeredTake(base.channels, [layerOf(own, { weight: 0.5 })], base.range);
    const layered: Take = { ...take, ...(base.samples && { samples: base.samples }) };
    const { take: plain } = flattened(layered, undefined);
    const [before, after] = [base.samples, plain.samples];
    if (!before || !after) throw new Error('Samples were expected.');
    const column = 4 - before.firstChannel;
    for (let i = 0; i < after.values.length; i++) {
      const isTouched = i % after.scales.length === column;
      const time = before.startSeconds + Math.floor(i / after.scales.length) * before.frameSeconds;
      const more = isTouched
        ? (0.5 * evaluateChannel(compileTake({ channels: [lift] }), 0, time)) / before.scales[column]
        : 0;
      if (isTouched) expect(after.values[i]).toBeCloseTo(before.values[i] + more, 9);
      else expect(after.values[i]).toBe(before.values[i]);
    }
  });
});
