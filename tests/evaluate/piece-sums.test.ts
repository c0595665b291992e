import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { compileChannels } from '../../src/evaluate/compiled-take.ts';
import { evaluateChannel } from '../../src/evaluate/curves.ts';
import { PieceSums } from '../../src/evaluate/piece-sums.ts';
import { EXTRAPOLATIONS } from '../../src/model/takes/take.ts';
import { between, channelOf, channels } from '../edit/keys/channels.ts';

const any = fc.array(channels(1, { steps: true, maxLength: 5 }), { minLength: 1, maxLength: 4 });

describe('sums of channels by pieces', () => {
  it('have the values of the channels one by one, in whatever order times are asked for', () => {
    fc.assert(
      fc.property(any, fc.array(between(-30, 30), { maxLength: 30 }), (all, times) => {
        const curves = compileChannels(all);
        const terms = all.map((_, channel) => ({ curves, channel, factor: 0.5 + channel }));
        const sums = new PieceSums([terms, ...terms.map((term) => [term])]);
        // Keys and seams of repetitions, too, forwards and back.
        const own = all.flatMap(({ times: keys }) => [...keys].flatMap((t) => [t, t + (keys.at(-1) ?? 0) - keys[0]]));
        for (const time of [...own, ...times, ...own.toReversed()]) {
          sums.evaluate(time);
          const each = terms.map(({ channel, factor }) => factor * evaluateChannel(curves, channel, time));
          const size = each.reduce((sum, value) => sum + Math.abs(value), 1);
          [each.reduce((sum, value) => sum + value, 0), ...each].forEach((value, i) => {
            const off = Math.abs(sums.values[i] - value);
            if (!(off < 1e-8 * size)) expect.fail(`sum ${i} is off by ${off} at ${time}: ${value} is meant`);
          });
        }
      }),
    );
  });

  it('have the values at infinity and at no time that a channel has', () => {
    for (const extrapolation of EXTRAPOLATIONS) {
      const channel = channelOf(
        [
          [0, 1],
          [1, 3],
        ],
        extrapolation,
      );
      const curves = compileChannels([channel]);
      const sums = new PieceSums([[{ curves, channel: 0, factor: 2 }]]);
      for (const time of [0.5, Infinity, -Infinity, Number.NaN, 1e300, -1e300]) {
        sums.evaluate(time);
        expect(sums.values[0]).toBe(2 * evaluateChannel(curves, 0, time));
      }
    }
  });
});
