/** Pins held in takes of all kinds, whatever their curves and the way of their joints. */
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { holdPins } from '../../../src/edit/commands/hold.ts';
import {
  type Channel,
  type KeyedChannel,
  keysOf,
  restChannel,
  SAMPLED,
  type Take,
} from '../../../src/model/takes/take.ts';
import { checkChannel } from '../../helpers/invariants.ts';
import { evenly } from '../dice.ts';
import { channelOf, channels } from '../keys/channels.ts';
import { apart, footAt, HOLD, LEG, REACH, shown, slide, store, TOLERANCE, takeOf, valuesAt, walk } from './held-leg.ts';

describe('takes of other kinds', () => {
  it('takes of other kinds that repeat are baked over the playback range, and continue as before', () => {
    const looped = walk();
    const all = looped.channels.map((channel, c): Channel => {
      if (keysOf(channel).times.length === 0) return channel;
      const kind = c === 0 ? 'cycle_offset' : 'cycle';
      return { ...channel, extrapolateIn: kind, extrapolateOut: kind };
    });
    const s = store({ takes: [{ ...looped, range: [0, 6], channels: all }] });
    const before = shown(s);
    const place = footAt(before, 2.5);
    s.apply(holdPins, { ...HOLD, range: [2.4, 2.8], atSeconds: 2.5 });
    expect(slide(shown(s), place, 2.4, 2.8)).toBeLessThan(TOLERANCE);
    for (const seconds of [0, 0.5, 2.29, 2.91, 4.5, 5.9]) {
      valuesAt(shown(s), seconds).forEach((value, d) => {
        expect(value).toBeCloseTo(valuesAt(before, seconds)[d], 9);
      });
    }
  });

  it('takes of other kinds of samples get other frames, and those outside are exactly unchanged', () => {
    const rows = 61;
    const values = new Float64Array(15 * rows);
    for (let f = 0; f < rows; f++) {
      values[15 * f] = 0.1 * Math.sin(f / 9);
      values[15 * f + 3] = 20 * Math.sin(f / 7);
      values[15 * f + 6] = 50 + 10 * Math.sin(f / 5);
    }
    const scales = Float64Array.from({ length: 15 }, (_, c) => (c < 3 ? 1 : Math.PI / 180));
    const samples = { frameCount: rows, frameSeconds: 1 / 30, startSeconds: 0, firstChannel: 0, values, scales };
    const channels = Array.from({ length: 15 }, () => SAMPLED);
    const take: Take = {
      name: 'take',
      range: [0, 2],
      channels,
      samples: { ...samples, interpolation: 'linear' },
    };
    const s = store({ takes: [take] });
    const place = footAt(shown(s), 0.5);
    s.apply(holdPins, HOLD);
    const now = takeOf(s).samples?.values ?? values;
    const framesChanged = Array.from({ length: rows }, (_, f) => f).filter((f) =>
      now.subarray(15 * f, 15 * f + 15).some((value, c) => value !== values[15 * f + c]),
    );
    // Held are frames 15 to 30; three on either side go there and back, of which the outermost gets nothing.
    expect([framesChanged[0], framesChanged[framesChanged.length - 1]]).toEqual([13, 32]);
    expect(takeOf(s).channels).toEqual(channels);
    for (let f = 15; f <= 30; f++) expect(apart(footAt(shown(s), f / 30), place)).toBeLessThan(1e-4 * REACH);
    expect(slide(shown(s), place, 0.5, 1)).toBeLessThan(2 * TOLERANCE);
    s.undo();
    expect(takeOf(s)).toBe(take);
  });

  it('takes of other kinds with quaternions keep to one side of them', () => {
    const bent = (j: number) => ({
      ...LEG.joints[j],
      motion: { kind: 'quaternion' } as const,
      limits: [],
      pose: [0, 0, 0, 1],
    });
    const joints = [bent(0), bent(1), bent(2), LEG.joints[3]];
    const all: Channel[] = Array.from({ length: 3 + 12 + 3 }, () => restChannel());
    for (const j of [0, 1]) {
      const turn = (k: number) => (j === 0 ? 0.4 * Math.sin(k) : 1 + 0.3 * Math.sin(2 * k)) / 2;
      // The negative of what is usual.
      all[3 + 4 * j] = channelOf(Array.from({ length: 9 }, (_, k) => [k / 4, -Math.sin(turn(k))] as const));
      all[3 + 4 * j + 3] = channelOf(Array.from({ length: 9 }, (_, k) => [k / 4, -Math.cos(turn(k))] as const));
    }
    all[14] = restChannel(1);
    const s = store({ skeleton: { ...LEG, joints }, takes: [{ name: 'turning', range: [0, 2], channels: all }] });
    const place = footAt(shown(s), 0.5);
    s.apply(holdPins, HOLD);
    expect(slide(shown(s), place, 0.5, 1)).toBeLessThan(TOLERANCE);
    for (let t = 0; t < 2; t += 0.01) expect(valuesAt(shown(s), t)[6]).toBeLessThan(-0.5);
  });

  it('takes of other kinds are held to their ends, if nothing comes before or after', () => {
    const s = store();
    const place = footAt(shown(s), 0);
    s.apply(holdPins, { ...HOLD, range: [-1, 9], atSeconds: 0 });
    expect(slide(shown(s), place, 0, 2)).toBeLessThan(TOLERANCE);
    for (const { times } of takeOf(s).channels.map(keysOf))
      for (const time of times) expect(time >= 0 && time <= 2).toBe(true);
  });
});

describe('whatever the way', () => {
  const wave = fc.record({ height: evenly, phase: evenly, often: evenly });
  const moment = evenly.map((x) => 0.2 + 1.6 * x);

  /** Between the moments that are looked at it slid further than at any of them. */
  const SLID = [
    { height: 0, phase: 0, often: 0 },
    { height: 0.07607001066207886, phase: 0.27410661336034536, often: 0.946050938218832 },
    { height: 0.42853956390172243, phase: 0.8116739178076386, often: 0.8125711316242814 },
    { height: 0.041463736444711685, phase: 0.7419948596507311, often: 0.3978219283744693 },
    { height: 0.8810158837586641, phase: 0, often: 0.2331058569252491 },
    { height: 0.9448522180318832, phase: 0.43306917417794466, often: 0.7764134705066681 },
    { height: 0.8755024150013924, phase: 0.001748216338455677, often: 0.8665342843160033 },
    { height: 0.48492153733968735, phase: 0.9635243909433484, often: 0.7949800817295909 },
    { height: 0.33371810149401426, phase: 0.4577729608863592, often: 0.45827419869601727 },
  ];

  it('whatever the way of the joints, the point stays in place, between frames too, and no curve deviates', {
    timeout: 60_000,
  }, () => {
    fc.assert(
      fc.property(fc.array(wave, { minLength: 9, maxLength: 9 }), moment, moment, (waves, a, b) => {
        const all = waves.map(({ height, phase, often }) =>
          channelOf(
            Array.from({ length: 17 }, (_, k) => [k / 8, 0.3 * height * Math.sin(often * k + 7 * phase)] as const),
          ),
        );
        const made = [...all, ...Array.from({ length: 6 }, () => restChannel())];
        const s = store({ takes: [{ name: 'any', range: [0, 2], channels: made }] });
        const range = [Math.min(a, b), Math.max(a, b)] as const;
        const place = footAt(shown(s), a);
        s.apply(holdPins, { ...HOLD, range, atSeconds: a });
        expect(slide(shown(s), place, ...range)).toBeLessThan(TOLERANCE);
      }),
      { numRuns: 8, examples: [[SLID, 0.5823565781116486, 0.564058494567871]] },
    );
  });
});

describe('whatever the curves', () => {
  const some = fc.array(channels(1, { steps: true, maxLength: 6 }), { minLength: 9, maxLength: 9 });
  const moment = fc.integer({ min: 0, max: 16 }).map((n) => n / 8);
  const small = (channel: KeyedChannel): KeyedChannel => ({
    ...channel,
    values: channel.values.map((v) => Math.atan(v)),
    tangentsIn: { ...channel.tangentsIn, slopes: channel.tangentsIn.slopes.map((v) => Math.atan(v)) },
    tangentsOut: { ...channel.tangentsOut, slopes: channel.tangentsOut.slopes.map((v) => Math.atan(v)) },
  });

  it('a hold is undone to the identical document, and keeps the curves outside unchanged', { timeout: 60_000 }, () => {
    fc.assert(
      fc.property(some, moment, moment, moment, (given, a, b, at) => {
        const all = [...given.map(small), ...Array.from({ length: 6 }, () => restChannel(0.1))];
        const s = store({ takes: [{ name: 'any', range: [0, 2], channels: all }] });
        const { document } = s;
        const before = shown(s);
        const range = [Math.min(a, b), Math.max(a, b)] as const;
        s.apply(holdPins, { ...HOLD, range, atSeconds: at, framesPerSecond: 8, easeSeconds: 0.125 });
        const after = shown(s);
        for (const channel of after.takes[0].channels) checkChannel(channel);
        // Not at the moments of steps, which have a value of their own.
        for (let t = 0.0123; t < 2; t += 0.0617) {
          if (t > range[0] - 0.13 && t < range[1] + 0.13) continue;
          const then = valuesAt(before, t);
          valuesAt(after, t).forEach((value, d) => {
            expect(Math.abs(value - then[d])).toBeLessThan(1e-9 * (1 + Math.abs(then[d])));
          });
        }
        if (s.document !== document) {
          s.undo();
          expect(s.document).toEqual(document);
        }
      }),
      { numRuns: 10 },
    );
  });
});
