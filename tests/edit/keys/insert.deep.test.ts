import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { insertKey } from '../../../src/edit/keys/insert.ts';
import { withKeysMoved } from '../../../src/edit/keys/move.ts';
import { compileChannels } from '../../../src/evaluate/compiled-take.ts';
import { evaluateChannel, evaluateSlope } from '../../../src/evaluate/curves.ts';
import { type Channel, EXTRAPOLATIONS, keysOf, restChannel } from '../../../src/model/takes/take.ts';
import { LINEAR } from '../../../src/model/takes/tangent-kinds.ts';
import { checkChannel } from '../../helpers/invariants.ts';
import { between, channelOf, channels, channelsOrRest, pointsOf, rowsOf, slopesAt, valueAt } from './channels.ts';

/** Of the curve's largest value. */
const SHAPE = 1e-9;

/** Times all over, and just beside the keys. */
function probes(channel: Channel): number[] {
  const near = [...keysOf(channel).times].flatMap((t) => [t - 1e-3, t - 1e-7, t, t + 1e-7, t + 1e-3]);
  return [...near, ...Array.from({ length: 400 }, (_, i) => -60 + i * 0.3017)];
}

function expectSameShape(after: Channel, before: Channel, times = probes(after)): void {
  const curves = compileChannels([before, after]);
  const was = times.map((t) => evaluateChannel(curves, 0, t));
  const scale = Math.max(1, ...was.map(Math.abs));
  times.forEach((t, i) => {
    const off = Math.abs(evaluateChannel(curves, 1, t) - was[i]);
    if (!(off <= SHAPE * scale)) expect.fail(`at ${t} s the curve is off by ${off}: ${was[i]} is meant`);
  });
}

const anyTime = fc.oneof(
  between(-50, 50),
  fc.integer({ min: -450, max: 450 }).map((tick) => tick / 8),
);

/** A time, often right next to a key. */
const moments = (channel: Channel) =>
  keysOf(channel).times.length === 0
    ? anyTime
    : fc.oneof(
        anyTime,
        fc
          .tuple(fc.constantFrom(...keysOf(channel).times), fc.constantFrom(-1, 1), fc.integer({ min: 1, max: 7 }))
          .map(([t, sign, power]) => t + sign * 10 ** -power),
      );

describe('a key inserted on the curve', () => {
  it('a key inserted on the curve keeps the shape of the curve and of its extrapolation', () => {
    const cases = channelsOrRest({ steps: true, extrapolations: ['constant', 'linear'] }).chain((channel) =>
      fc.tuple(fc.constant(channel), fc.array(moments(channel), { minLength: 1, maxLength: 5 })),
    );
    fc.assert(
      fc.property(cases, ([channel, times]) => {
        let after = channel;
        for (const time of times) {
          const inserted = insertKey(after, time);
          checkChannel(inserted.channel);
          expect(inserted.channel.times[inserted.index]).toBeCloseTo(time, 8);
          expect(inserted.periodChanged).toBe(false);
          after = inserted.channel;
        }
        expectSameShape(after, channel);
      }),
      { numRuns: 200 },
    );
  });

  it('a key inserted on the curve keeps cycles and bounces too, if it is between the ends', () => {
    const cases = channels(2, { steps: true }).chain((channel) => {
      const inside = between(channel.times[0], channel.times[channel.times.length - 1]);
      return fc.tuple(fc.constant(channel), fc.array(inside, { minLength: 1, maxLength: 5 }));
    });
    fc.assert(
      fc.property(cases, ([channel, times]) => {
        let after = channel;
        for (const time of times) after = insertKey(after, time).channel;
        // Not on the boundaries of periods, where a hair's breadth of rounding is the other side of a jump.
        expectSameShape(
          after,
          channel,
          Array.from({ length: 400 }, (_, i) => -60 + i * 0.3017),
        );
      }),
    );
  });

  it('a key inserted on the curve has the value and slope of the extrapolated curve when inserted beyond the ends', () => {
    fc.assert(
      fc.property(channels(1), anyTime, (channel, time) => {
        const curve = compileChannels([channel]);
        const { channel: after, index } = insertKey(channel, time);
        fc.pre(after !== channel);
        expect(after.values[index]).toBe(evaluateChannel(curve, 0, time));
        const [before, behind] = slopesAt(after, index);
        expect(before).toBeCloseTo(evaluateSlope(curve, 0, time, 'in'), 6);
        expect(behind).toBeCloseTo(evaluateSlope(curve, 0, time, 'out'), 6);
      }),
    );
  });

  it('reports a changed period only for curves that cycle or bounce, and only beyond their ends', () => {
    fc.assert(
      fc.property(channels(2), anyTime, (channel, time) => {
        const { channel: after, periodChanged } = insertKey(channel, time);
        fc.pre(after !== channel);
        const outside = time < channel.times[0] || time > channel.times[channel.times.length - 1];
        const repeats = [channel.extrapolateIn, channel.extrapolateOut].some((e) => EXTRAPOLATIONS.indexOf(e) > 1);
        expect(periodChanged).toBe(repeats && outside);
      }),
    );
  });
});

describe('a key inserted between two others and moved', () => {
  /** Of its values, after it was moved by that much. */
  const cornerOf = (channel: Channel, time: number, by: number) => {
    const { channel: after, index } = insertKey(channel, time);
    const { channel: moved } = withKeysMoved(after, [index], 0, by, 'replace');
    const [before, behind] = slopesAt(moved, index);
    return Math.abs(before - behind);
  };
  const isLinear = (channel: Channel, index: number) =>
    keysOf(channel).tangentsOut.kinds[index] === LINEAR && keysOf(channel).tangentsIn.kinds[index + 1] === LINEAR;

  it('a key inserted between two others makes no corner when it is moved, unless it is between linear ones', () => {
    const cases = channels(2, { steps: true }).chain((channel) => {
      const inside = between(channel.times[0], channel.times[channel.times.length - 1]);
      return fc.tuple(fc.constant(channel), inside, between(-5, 5));
    });
    fc.assert(
      fc.property(cases, ([channel, time, by]) => {
        const { channel: after, index } = insertKey(channel, time);
        fc.pre(after !== channel && !isLinear(channel, index - 1));
        expect(cornerOf(channel, time, by)).toBe(0);
      }),
      { numRuns: 200 },
    );
  });

  it('a key inserted between two others stays smooth on a straight line of smooth keys, which keeps its shape', () => {
    const lines = fc.record({
      times: fc.uniqueArray(fc.integer({ min: 0, max: 40 }), { minLength: 2, maxLength: 6 }),
      slope: fc.integer({ min: -8, max: 8 }),
      at: between(0.01, 0.99),
      by: between(-5, 5),
    });
    fc.assert(
      fc.property(lines, ({ times, slope, at, by }) => {
        const sorted = times.toSorted((a, b) => a - b);
        const line = channelOf(sorted.map((t) => [t / 4, (slope * t) / 4] as const));
        const time = (sorted[0] + at * (sorted[sorted.length - 1] - sorted[0])) / 4;
        const { channel, index } = insertKey(line, time);
        fc.pre(channel !== line);
        // Not beyond the ends: there a slope extends any distance, so one that differs by rounding is kept as a number.
        const kinds = rowsOf(channel)
          .flatMap((row) => row.slice(2))
          .slice(1, -1);
        expect(kinds).toEqual(kinds.map(() => 'smooth'));
        const largest = Math.max(1, ...line.values.map(Math.abs));
        const curves = compileChannels([line, channel]);
        for (const t of probes(channel)) {
          const [meant, found] = [evaluateChannel(curves, 0, t), evaluateChannel(curves, 1, t)];
          const off = Math.abs(found - meant);
          if (!(off < 1e-12 * largest)) expect.fail(`at ${t} s the line is off by ${off}: ${meant} is meant`);
        }
        expect(index).toBeGreaterThan(0);
        expect(cornerOf(line, time, by)).toBe(0);
      }),
    );
  });

  it('a key inserted between two others is flat between flat ones at one level, and linear between linear ones', () => {
    for (const kind of ['flat', 'linear'] as const) {
      const channel = channelOf([
        [0, 1, kind],
        [1, 1, kind],
      ]);
      expect(rowsOf(insertKey(channel, 0.25).channel)[1]).toEqual([0.25, 1, kind, kind]);
    }
  });
});

describe('neighbours of an inserted key', () => {
  it('neighbours of an inserted key become numbers if smooth would resolve to another slope, on both of their sides', () => {
    const channel = channelOf([
      [0, 0],
      [1, 1],
      [2, 0],
      [3, 1],
    ]);
    const { channel: after, index } = insertKey(channel, 1.25);
    expect(index).toBe(2);
    expect(rowsOf(after).map((row) => [row[2], row[3]])).toEqual([
      ['smooth', 'smooth'],
      [0, 0],
      [expect.any(Number), expect.any(Number)],
      [0, 0],
      ['smooth', 'smooth'],
    ]);
  });

  it('neighbours of an inserted key become numbers where linear would bend, and only on the side of the new key', () => {
    const channel = channelOf([
      [0, 0, 'linear'],
      [1, 1, 'linear', 'linear'],
      [2, 0, 'flat', 'linear'],
      [3, 5, 'linear'],
    ]);
    const { channel: after } = insertKey(channel, 1.5);
    expect(rowsOf(after).map((row) => [row[2], row[3]])).toEqual([
      ['linear', 'linear'],
      ['linear', -1],
      [expect.any(Number), expect.any(Number)],
      ['flat', 'linear'],
      ['linear', 'linear'],
    ]);
  });

  it('neighbours of an inserted key stay linear along a straight line, of which the new key becomes a linear key', () => {
    const line = channelOf(
      [
        [0, 0, 'linear'],
        [0.3, 0.1, 'linear'],
        [1, 0.7, 'linear'],
      ],
      'linear',
    );
    for (const time of [-0.7, 0.1, 0.4, 0.8, 1.9]) {
      expect(rowsOf(insertKey(line, time).channel).flatMap((row) => row.slice(2))).toEqual(Array(8).fill('linear'));
    }
  });

  it('neighbours of an inserted key stay smooth if they resolve to the same slope, as on a line', () => {
    const line = channelOf(
      [
        [0, 0],
        [1, 2],
        [2, 4],
        [3, 6],
      ],
      'linear',
    );
    expect(rowsOf(insertKey(line, 1.5).channel)).toEqual([
      [0, 0, 'smooth', 'smooth'],
      [1, 2, 'smooth', 'smooth'],
      [1.5, 3, 'smooth', 'smooth'],
      [2, 4, 'smooth', 'smooth'],
      [3, 6, 'smooth', 'smooth'],
    ]);
  });

  it('an inserted key makes tangents at the ends fixed if linear extrapolation uses the slope of the end segment', () => {
    const channel = channelOf(
      [
        [0, 0, 'linear', 5],
        [1, 1, 0, 'smooth'],
      ],
      'linear',
    );
    const { channel: after } = insertKey(channel, 0.5);
    expect(slopesAt(after, 0)).toEqual([1, 5]);
    expect(slopesAt(after, 2)).toEqual([0, 1]);
  });

  it('neighbours of an inserted key that are no neighbours of it are left alone', () => {
    const channel = channelOf([0, 1, 0, 1, 0, 1].map((v, t) => [t, v] as const));
    const { channel: after } = insertKey(channel, 2.5);
    const rows = rowsOf(after);
    expect([rows[0], rows[1], rows[5], rows[6]].flatMap((row) => row.slice(2))).toEqual(Array(8).fill('smooth'));
  });
});

describe('a key inserted past the ends', () => {
  const hill = (before: Channel['extrapolateIn']) =>
    channelOf(
      [
        [0, 0, 3],
        [1, 1, 2],
        [2, 0, 3],
      ],
      before,
    );

  it('a key inserted past the ends is level with constant extrapolation, and the old end becomes level on its outer side', () => {
    expect(rowsOf(insertKey(hill('constant'), 3).channel).slice(2)).toEqual([
      [2, 0, 3, 'flat'],
      [3, 0, 'flat', 'flat'],
    ]);
    expect(rowsOf(insertKey(hill('constant'), -1).channel).slice(0, 2)).toEqual([
      [-1, 0, 'flat', 'flat'],
      [0, 0, 'flat', 3],
    ]);
  });

  it('a key inserted past the ends keeps the kind of the old end if that is level anyway', () => {
    const channel = channelOf([
      [0, 0, 'linear'],
      [1, 1, 'linear'],
    ]);
    expect(rowsOf(insertKey(channel, 2).channel)).toEqual([
      [0, 0, 'linear', 'linear'],
      [1, 1, 'linear', 'linear'],
      [2, 1, 'linear', 'flat'],
    ]);
  });

  it('a key inserted past the ends lies on the line of linear extrapolation', () => {
    const { channel } = insertKey(hill('linear'), 4);
    expect(pointsOf(channel)[3]).toEqual([4, 6]);
    expect(rowsOf(channel)[2]).toEqual([2, 0, 3, 3]);
    expect(valueAt(channel, 100)).toBeCloseTo(294, 9);
  });

  it('takes the value of the repetition it lands in, and says that the period changed', () => {
    const once = insertKey(hill('cycle'), 3);
    expect(once.periodChanged).toBe(true);
    expect(pointsOf(once.channel)[3]).toEqual([3, 1]);
    const back = insertKey(hill('bounce'), -0.5);
    expect(back.channel.values[0]).toBe(valueAt(hill('bounce'), 0.5));
    expect(back.periodChanged).toBe(true);
  });

  it('reports no period for a single key at rest, however it is said to repeat', () => {
    expect(insertKey(channelOf([[1, 2]], 'cycle'), 3).periodChanged).toBe(false);
    expect(insertKey(channelOf([[1, 2, 4]], 'cycle', 'linear'), 3).periodChanged).toBe(true);
  });
});

describe('inserting at an existing key', () => {
  it('changes nothing, and finds that key', () => {
    const channel = channelOf([
      [0, 0],
      [1, 1],
    ]);
    expect(insertKey(channel, 1)).toEqual({ channel, index: 1, periodChanged: false });
    expect(insertKey(channel, 1 + 1e-12).channel).toBe(channel);
  });

  it('finds the later key of a step, which holds from then on', () => {
    const channel = channelOf([
      [0, 0],
      [1, 1],
      [1, 2],
      [2, 0],
    ]);
    expect(insertKey(channel, 1)).toMatchObject({ channel, index: 2 });
  });

  it('puts a key at the value of a channel without keys', () => {
    const { channel } = insertKey(restChannel(2.5), 1);
    expect(rowsOf(channel)).toEqual([[1, 2.5, 'smooth', 'smooth']]);
    checkChannel(channel);
  });
});
