import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { compileChannels, compileTake } from '../../src/evaluate/compiled-take.ts';
import { evaluateChannel } from '../../src/evaluate/curves.ts';
import { readAnim } from '../../src/formats/anim/read.ts';
import { writeAnim } from '../../src/formats/anim/write.ts';
import { autoSlope, crossesSeam, withAutoRecognised } from '../../src/model/takes/auto-slope.ts';
import { type KeyedChannel, keysOf, type Take } from '../../src/model/takes/take.ts';
import { AUTO_TANGENT, FIXED_TANGENT } from '../../src/model/takes/tangent-kinds.ts';
import { channelOf, channels, rowsOf } from '../edit/keys/channels.ts';

/** The channel with `auto` tangents throughout. */
function auto(channel: KeyedChannel): KeyedChannel {
  const side = {
    kinds: new Uint8Array(channel.times.length).fill(AUTO_TANGENT),
    slopes: new Float64Array(channel.times.length),
  };
  return { ...channel, tangentsIn: side, tangentsOut: side };
}

const takeOf = (channel: KeyedChannel): Take => ({ name: 'x', range: [0, 1], channels: [channel] });
const textOf = (take: Take) => {
  const { text } = writeAnim(take, 'x.anim');
  return text;
};
const readBack = (channel: KeyedChannel) => {
  const [read] = readAnim(textOf(takeOf(channel)), 'x.anim').value?.channels ?? [];
  return keysOf(read);
};

describe('auto slopes', () => {
  it('keep the digits of a file while they are the formula’s within rounding', () => {
    const anim = (slope: string, value = 6) =>
      `animation {\n range 0 2\n numchannels 1\n channel {\n  extrapolate constant constant\n  keys 3 {\n   0 0 flat flat\n   1 1 ${slope} ${slope}\n   2 ${value} flat flat\n  }\n }\n}\n`;
    for (const slope of ['3', '2.9999999999999996', '3.0000000000000004']) {
      const take = readAnim(anim(slope), 'x.anim').value;
      expect(keysOf(take?.channels[0]).tangentsIn.kinds[1]).toBe(AUTO_TANGENT);
      expect(take && textOf(take)).toContain(` ${slope} ${slope}\n`);
    }
    const read = keysOf(readAnim(anim('2.9999999999999996'), 'x.anim').value?.channels[0]);
    const moved = { ...read, kind: 'keys', values: Float64Array.of(0, 1, 4) } as const;
    expect(textOf(takeOf(moved))).toContain(' 2 2\n');
  });

  it('never lead a curve out of the values of the two keys around it', () => {
    fc.assert(
      fc.property(channels(2, { steps: true }), fc.double({ min: 0, max: 1, noNaN: true }), (given, share) => {
        const channel = auto(given);
        const { times, values } = channel;
        const compiled = compileChannels([channel]);
        for (let k = 0; k + 1 < times.length; k++) {
          const time = times[k] + share * (times[k + 1] - times[k]);
          if (time >= times[k + 1]) continue;
          const value = evaluateChannel(compiled, 0, time);
          const [low, high] = [Math.min(values[k], values[k + 1]), Math.max(values[k], values[k + 1])];
          const rounding = 1e-12 * Math.max(1, Math.abs(low), Math.abs(high));
          expect(value).toBeGreaterThanOrEqual(low - rounding);
          expect(value).toBeLessThanOrEqual(high + rounding);
        }
      }),
    );
  });

  it('are level at extremes, holds and ends that are no seam', () => {
    fc.assert(
      fc.property(channels(1, { steps: true }), (channel) => {
        const { values, times } = channel;
        const last = times.length - 1;
        for (let k = 1; k < last; k++) {
          if ((values[k] - values[k - 1]) * (values[k + 1] - values[k]) <= 0) expect(autoSlope(channel, k)).toBe(0);
        }
        if (!crossesSeam(channel)) expect([autoSlope(channel, 0), autoSlope(channel, last)]).toEqual([0, 0]);
        else expect(autoSlope(channel, 0)).toBe(autoSlope(channel, last));
      }),
    );
  });

  it('are written as numbers and read as auto again, and the file is the same when written again', () => {
    fc.assert(
      fc.property(channels(1, { steps: true }), (given) => {
        const text = textOf(takeOf(auto(given)));
        const { value } = readAnim(text, 'x.anim');
        expect(new Set([...keysOf(value?.channels[0]).tangentsIn.kinds])).toEqual(new Set([AUTO_TANGENT]));
        expect(value && textOf(value)).toBe(text);
      }),
    );
  });

  it('are no reason to write a file without them in other bytes', () => {
    fc.assert(
      fc.property(channels(1, { steps: true }), (given) => {
        // Any slopes, as a file has them: rounding of other programs included.
        const text = textOf(takeOf(given));
        const { value } = readAnim(text, 'x.anim');
        expect(value && textOf(value)).toBe(text);
      }),
    );
  });

  it('are told from zeros that are written for other reasons', () => {
    const kinds = (channel: KeyedChannel) => rowsOf(readBack(channel) as KeyedChannel).map((row) => row.slice(2));
    // All are the formula's.
    expect(
      kinds(
        channelOf([
          [0, 0, 0],
          [1, 1, 0],
          [2, 0, 0],
        ]),
      ),
    ).toEqual([
      ['auto', 'auto'],
      ['auto', 'auto'],
      ['auto', 'auto'],
    ]);
    // One is not, and none but zeros are.
    expect(
      kinds(
        channelOf([
          [0, 0, 0],
          [1, 1, 0, 0.5],
          [2, 0, 0],
        ]),
      ),
    ).toEqual([
      [0, 0],
      [0, 0.5],
      [0, 0],
    ]);
    // One that isn't 0 is.
    expect(
      kinds(
        channelOf([
          [0, 0, 0],
          [1, 1, 1, 0.5],
          [2, 2, 0],
        ]),
      ),
    ).toEqual([
      ['auto', 'auto'],
      ['auto', 0.5],
      ['auto', 'auto'],
    ]);
  });

  it('are the same channel where nothing is recognised', () => {
    const channel = channelOf([
      [0, 0, 'smooth'],
      [1, 1, 7],
      [2, 0, 'flat'],
    ]);
    expect(withAutoRecognised(channel)).toBe(channel);
    expect(channel.tangentsIn.kinds[1]).toBe(FIXED_TANGENT);
  });

  it('follow a change of the other end of a long loop although its first keys stay', () => {
    const many = Array.from({ length: 700 }, (_, k) => [k, k === 699 ? 0 : Math.sin(k / 5), 'auto'] as const);
    const loop = channelOf(many, 'cycle');
    const before = { ...takeOf(loop) };
    compileTake(before);
    const changed = { ...loop, values: loop.values.map((v, k) => (k === 698 ? -0.2 : v)) };
    const after = compileTake({ ...before, channels: [changed] });
    const alone = compileChannels([{ ...changed }]);
    expect(after.cubics).toEqual(alone.cubics);
    const still = { ...changed, extrapolateOut: 'constant' as const };
    expect(compileTake({ ...before, channels: [still] }).cubics).toEqual(compileChannels([{ ...still }]).cubics);
  });
});
