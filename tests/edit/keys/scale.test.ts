import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { type Scaling, withKeysScaled } from '../../../src/edit/keys/scale.ts';
import { wholeSteps } from '../../../src/edit/keys/steps.ts';
import { compileChannels } from '../../../src/evaluate/compiled-take.ts';
import { evaluateChannel } from '../../../src/evaluate/curves.ts';
import { FIXED_TANGENT } from '../../../src/model/takes/tangent-kinds.ts';
import { checkChannel } from '../../helpers/invariants.ts';
import { between, channelOf, channels, expectNoCrowd, pointsOf, rowsOf, withSome } from './channels.ts';

const by = (more: Partial<Scaling>): Scaling => ({
  pivotSeconds: 0,
  timeFactor: 1,
  pivotValue: 0,
  valueFactor: 1,
  ...more,
});
const two = channelOf([
  [1, 10, 'linear', 4],
  [2, 20, 6, 'smooth'],
]);

describe('scaling keys', () => {
  it('pivots about a time, and makes slopes less steep in proportion to the time', () => {
    const { channel, indices } = withKeysScaled(two, [0, 1], by({ pivotSeconds: 1, timeFactor: 2 }));
    expect(rowsOf(channel)).toEqual([
      [1, 10, 'linear', 2],
      [3, 20, 3, 'smooth'],
    ]);
    expect(indices).toEqual([0, 1]);
    expect(channel.values).toBe(two.values);
  });

  it('pivots about a value, and makes slopes steeper in proportion', () => {
    const { channel } = withKeysScaled(two, [0, 1], by({ pivotValue: 10, valueFactor: 3 }));
    expect(rowsOf(channel)).toEqual([
      [1, 10, 'linear', 12],
      [2, 40, 18, 'smooth'],
    ]);
    expect(channel.times).toBe(two.times);
  });

  it('mirrors time with a negative factor: sides change places and slopes change sign', () => {
    const { channel, indices } = withKeysScaled(two, [0, 1], by({ pivotSeconds: 1, timeFactor: -1 }));
    expect(rowsOf(channel)).toEqual([
      [0, 20, 'smooth', -6],
      [1, 10, -4, 'linear'],
    ]);
    expect(indices).toEqual([0, 1]);
  });

  it('mirrors values without changing the sides', () => {
    const { channel } = withKeysScaled(two, [1], by({ valueFactor: -1 }));
    expect(rowsOf(channel)[1]).toEqual([2, -20, -6, 'smooth']);
  });

  it('scaling keys turns a step round with its time', () => {
    const step = channelOf([
      [0, 1],
      [1, 2],
      [1, 3],
    ]);
    expect(pointsOf(withKeysScaled(step, [0, 1, 2], by({ timeFactor: -1 })).channel)).toEqual([
      [-1, 3],
      [-1, 2],
      [0, 1],
    ]);
  });

  it('scaling keys keeps the last of the keys that end at one time', () => {
    const { channel, indices } = withKeysScaled(two, [0, 1], by({ pivotSeconds: 5, timeFactor: 0 }));
    expect(pointsOf(channel)).toEqual([[5, 20]]);
    expect(indices).toEqual([0]);
    checkChannel(channel);
  });

  it('replaces keys at the times that it moves others to', () => {
    expect(pointsOf(withKeysScaled(two, [0], by({ timeFactor: 2 })).channel)).toEqual([[2, 10]]);
    expect(pointsOf(withKeysScaled(two, [0], by({ timeFactor: 2 }), 'step').channel)).toEqual([
      [2, 20],
      [2, 10],
    ]);
  });

  it('scaling keys returns the channel itself if nothing changes', () => {
    expect(withKeysScaled(two, [0, 1], by({ pivotSeconds: 1e9, pivotValue: 1e9 })).channel).toBe(two);
    expect(withKeysScaled(two, [0], by({ pivotSeconds: 1, timeFactor: 7 })).channel.times).toBe(two.times);
  });

  it('refuses slopes that are no numbers', () => {
    expect(() => withKeysScaled(two, [0], by({ pivotSeconds: 1, timeFactor: 1e-320 }))).toThrow('too steep');
  });
});

const factor = fc.tuple(between(0.05, 20), fc.boolean()).map(([size, mirrored]) => (mirrored ? -size : size));
const pivot = between(-30, 30);

describe('scaling any keys', () => {
  it('scaling any keys leaves sound channels', () => {
    fc.assert(
      fc.property(withSome(channels(1, { steps: true })), pivot, factor, factor, ({ channel, some }, p, t, v) => {
        const scaling = by({ pivotSeconds: p, timeFactor: t, pivotValue: p, valueFactor: v });
        const { channel: after, indices } = withKeysScaled(channel, some, scaling);
        checkChannel(after);
        expectNoCrowd(after);
        expect(indices).toHaveLength(t === 1 ? some.length : wholeSteps(channel, some).length);
      }),
    );
  });

  it('scaling any keys comes back when scaled by the inverse', () => {
    fc.assert(
      fc.property(channels(1, { steps: true }), pivot, factor, factor, (channel, p, t, v) => {
        const all = [...channel.times.keys()];
        const there = withKeysScaled(
          channel,
          all,
          by({ pivotSeconds: p, timeFactor: t, pivotValue: p, valueFactor: v }),
        );
        const inverse = by({ pivotSeconds: p, timeFactor: 1 / t, pivotValue: p, valueFactor: 1 / v });
        const back = withKeysScaled(there.channel, there.indices, inverse).channel;
        expect(back.tangentsIn.kinds).toEqual(channel.tangentsIn.kinds);
        expect(back.tangentsOut.kinds).toEqual(channel.tangentsOut.kinds);
        for (const k of all) {
          expect(back.times[k]).toBeCloseTo(channel.times[k], 10);
          expect(back.values[k]).toBeCloseTo(channel.values[k], 9);
          expect(back.tangentsOut.slopes[k]).toBeCloseTo(channel.tangentsOut.slopes[k], 9);
          if (channel.tangentsIn.kinds[k] === FIXED_TANGENT) {
            expect(back.tangentsIn.slopes[k]).toBeCloseTo(channel.tangentsIn.slopes[k], 9);
          }
        }
      }),
    );
  });

  it('scales the whole curve if all keys are scaled, mirrored or not', () => {
    fc.assert(
      fc.property(channels(2), factor, factor, between(0, 1), (channel, t, v, u) => {
        const all = [...channel.times.keys()];
        const after = withKeysScaled(channel, all, by({ timeFactor: t, valueFactor: v })).channel;
        const curves = compileChannels([channel, after]);
        const time = channel.times[0] + u * (channel.times[all.length - 1] - channel.times[0]);
        const meant = evaluateChannel(curves, 0, time) * v;
        expect(Math.abs(evaluateChannel(curves, 1, time * t) - meant)).toBeLessThan(
          1e-9 * Math.max(1e3, Math.abs(meant)),
        );
      }),
    );
  });
});
