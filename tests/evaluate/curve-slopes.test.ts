import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { compileChannels } from '../../src/evaluate/compiled-take.ts';
import { evaluateChannel, evaluateSlope } from '../../src/evaluate/curves.ts';
import { keySlope } from '../../src/evaluate/slopes.ts';
import { keysOf, restChannel } from '../../src/model/takes/take.ts';
import { between, channelOf, channels, channelsOrRest } from '../edit/keys/channels.ts';

/** Of a difference over 2⁻²⁰ s, for slopes of up to some thousands and cubics to match. */
const WITHIN = 1e-3;

describe('the slope of a channel', () => {
  it('the slope of a channel is the difference quotient of its values, inside and beyond, however it is extrapolated', () => {
    fc.assert(
      fc.property(channelsOrRest(), between(-60, 60), (channel, time) => {
        const curve = compileChannels([channel]);
        const h = 2 ** -20;
        const value = (t: number) => evaluateChannel(curve, 0, t);
        const [left, right] = [(value(time) - value(time - h)) / h, (value(time + h) - value(time)) / h];
        // Not where a key or the seam of a repetition is near: there the curve may have a corner or a jump.
        fc.pre(Math.abs(left - right) < 1);
        const scale = Math.max(1, Math.abs(left), ...keysOf(channel).values.map(Math.abs)) * 100;
        expect(Math.abs(evaluateSlope(curve, 0, time, 'in') - (left + right) / 2)).toBeLessThan(WITHIN * scale);
        expect(Math.abs(evaluateSlope(curve, 0, time, 'out') - (left + right) / 2)).toBeLessThan(WITHIN * scale);
      }),
    );
  });

  it('the slope of a channel is that of the tangents at keys, each on its side', () => {
    fc.assert(
      fc.property(channels(3), (channel) => {
        const curve = compileChannels([channel]);
        for (let k = 1; k < channel.times.length - 1; k++) {
          const [into, out] = (['in', 'out'] as const).map((side) => evaluateSlope(curve, 0, channel.times[k], side));
          const scale = Math.max(1, Math.abs(into), Math.abs(out), ...keysOf(channel).values.map(Math.abs));
          expect(Math.abs(into - keySlope(channel, k, 'in')) / scale).toBeLessThan(1e-9);
          expect(Math.abs(out - keySlope(channel, k, 'out')) / scale).toBeLessThan(1e-9);
        }
      }),
    );
  });

  const saw = (extrapolation: 'constant' | 'linear' | 'cycle' | 'cycle_offset' | 'bounce') =>
    compileChannels([
      channelOf(
        [
          [0, 0, 5, 1],
          [2, 4, 3, 7],
        ],
        extrapolation,
      ),
    ]);
  const sides = (curve: ReturnType<typeof saw>, time: number) =>
    (['in', 'out'] as const).map((side) => evaluateSlope(curve, 0, time, side));

  it('the slope at the ends of a channel is that of its extrapolation', () => {
    expect(sides(saw('constant'), 0)).toEqual([0, 1]);
    expect(sides(saw('constant'), 2)).toEqual([3, 0]);
    expect(sides(saw('linear'), 0)).toEqual([5, 1]);
    expect(sides(saw('linear'), 2)).toEqual([3, 7]);
    expect(sides(saw('cycle'), 0)).toEqual([3, 1]);
    expect(sides(saw('cycle'), 2)).toEqual([3, 1]);
    expect(sides(saw('bounce'), 0)).toEqual([-1, 1]);
    expect(sides(saw('bounce'), 2)).toEqual([3, -3]);
  });

  it('the slope at later seams of a channel is that of the repetitions that meet there', () => {
    expect(sides(saw('cycle'), 6)).toEqual([3, 1]);
    expect(sides(saw('cycle_offset'), -4)).toEqual([3, 1]);
    expect(sides(saw('bounce'), 4)).toEqual([-1, 1]);
    expect(sides(saw('bounce'), -2)).toEqual([3, -3]);
  });

  it('the slope of a channel is 0 where there are no keys, and at times that are none', () => {
    expect(sides(compileChannels([restChannel(3)]), 1)).toEqual([0, 0]);
    expect(sides(compileChannels([restChannel()]), 1)).toEqual([0, 0]);
    expect(sides(saw('linear'), Number.NaN)).toEqual([0, 0]);
  });
});
