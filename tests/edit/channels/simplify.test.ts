import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { simplifyChannel } from '../../../src/edit/channels/simplify.ts';
import { compileTake } from '../../../src/evaluate/compiled-take.ts';
import { evaluateChannel } from '../../../src/evaluate/curves.ts';
import { type Channel, type KeyedChannel, keysOf } from '../../../src/model/takes/take.ts';
import { FIXED_TANGENT } from '../../../src/model/takes/tangent-kinds.ts';
import { checkChannel } from '../../helpers/invariants.ts';
import { referenceTake } from '../../helpers/reference.ts';
import { describeShared } from '../../helpers/shared.ts';
import { channelOf, channels, pointsOf, rowsOf, slopesAt, type Tangent, valueAt } from '../keys/channels.ts';
import { largestSampled } from './sampled.ts';

const first = (c: Channel) => keysOf(c).times[0];
const last = (c: Channel) => keysOf(c).times[keysOf(c).times.length - 1];

/** As a recording has it: a key a frame. */
function recorded(f: (t: number) => number, frames: number, tangents: Tangent = 'linear', rate = 30): KeyedChannel {
  return channelOf(Array.from({ length: frames + 1 }, (_, i) => [i / rate, f(i / rate), tangents]));
}

function expectWithin(before: Channel, after: Channel, tolerance: number): void {
  expect(largestSampled(before, after, first(before), last(before), 5000)).toBeLessThanOrEqual(tolerance);
}

describe('simplifying', () => {
  it('simplifying never gets further from the curve than the tolerance, and says how far it gets', () => {
    fc.assert(
      fc.property(
        channels(1, { steps: true, maxLength: 25 }),
        fc.double({ min: 1e-6, max: 200, noNaN: true }),
        (channel, tolerance) => {
          const done = simplifyChannel(channel, tolerance);
          checkChannel(done.channel);
          expect(done.largestError).toBeLessThanOrEqual(tolerance);
          expect(done.keysAfter).toBe(done.channel.times.length);
          expect(done.keysBefore).toBe(channel.times.length);
          if (channel.times.length < 2) return;
          const sampled = largestSampled(channel, done.channel, first(channel), last(channel), 1000);
          expect(sampled).toBeLessThanOrEqual(done.largestError * (1 + 1e-9) + 1e-9);
        },
      ),
      { numRuns: 500 },
    );
  });

  it('simplifying keeps the time and value of each remaining key', () => {
    fc.assert(
      fc.property(
        channels(2, { steps: true, maxLength: 25 }),
        fc.double({ min: 0.01, max: 200 }),
        (channel, tolerance) => {
          const kept = pointsOf(simplifyChannel(channel, tolerance).channel);
          const were = pointsOf(channel);
          expect(were).toEqual(expect.arrayContaining(kept));
          expect(kept[0]).toEqual(were[0]);
          expect(kept.at(-1)).toEqual(were.at(-1));
        },
      ),
    );
  });

  it('changes nothing beyond ends that are constant or linear', () => {
    const cases = channels(1, { steps: true, maxLength: 25, extrapolations: ['constant', 'linear'] });
    fc.assert(
      fc.property(cases, fc.double({ min: 0.01, max: 200, noNaN: true }), (channel, tolerance) => {
        const { channel: after } = simplifyChannel(channel, tolerance);
        for (const t of [first(channel) - 7, last(channel) + 7]) {
          expect(valueAt(after, t)).toBeCloseTo(valueAt(channel, t), 9);
        }
      }),
    );
  });

  it('returns the same channel if no key can be removed', () => {
    const zigzag = recorded((t) => (Math.round(t * 30) % 2 ? 1 : -1), 60);
    expect(simplifyChannel(zigzag, 0.1).channel).toBe(zigzag);
    expect(simplifyChannel(zigzag, 0.1)).toMatchObject({ keysBefore: 61, keysAfter: 61, largestError: 0 });
    const lone = channelOf([[0, 3]]);
    expect(simplifyChannel(lone, 1)).toEqual({
      channel: lone,
      keysBefore: 1,
      keysAfter: 1,
      largestError: 0,
      atSeconds: 0,
    });
  });

  it('removes keys that change nothing, at any tolerance', () => {
    const straight = channelOf([
      [0, 0, 'linear'],
      [1, 1, 'linear'],
      [1.5, 1.5, 'smooth'],
      [4, 4, 'linear'],
    ]);
    expect(pointsOf(simplifyChannel(straight, 1e-12).channel)).toEqual([
      [0, 0],
      [4, 4],
    ]);
  });

  it('simplifying turns a key a frame into few, smooth on both sides', () => {
    // A cubic with exact slopes over a span h is off by h⁴/384: 9 spans for two waves at 1 %.
    const { channel, keysAfter, keysBefore } = simplifyChannel(
      recorded((t) => Math.sin(2 * Math.PI * t), 60),
      0.01,
    );
    expect(keysBefore).toBe(61);
    expect(keysAfter).toBeLessThanOrEqual(11);
    for (let k = 1; k + 1 < keysAfter; k++) expect(slopesAt(channel, k)[0]).toBe(slopesAt(channel, k)[1]);
  });

  it('sees through noise that the tolerance hides', () => {
    let seed = 1;
    const noise = () => {
      seed = (seed * 16807) % 2147483647;
      return 0.01 * (seed / 2147483647 - 0.5);
    };
    const noisy = recorded((t) => Math.sin(t) + noise(), 3000);
    const { channel, keysAfter } = simplifyChannel(noisy, 0.02);
    expect(keysAfter).toBeLessThan(100);
    expectWithin(noisy, channel, 0.02);
  });

  it('simplifying keeps a corner as a corner, and the rest smooth', () => {
    const ball = recorded((t) => Math.abs(Math.sin(Math.PI * t)), 90, 'linear');
    const { channel, keysAfter } = simplifyChannel(ball, 0.01);
    expect(keysAfter).toBeLessThan(20);
    const bounce = channel.times.findIndex((t) => Math.abs(t - 1) < 1e-9);
    const [before, after] = slopesAt(channel, bounce);
    expect(before).toBeLessThan(-2.5);
    expect(after).toBeGreaterThan(2.5);
  });

  it('simplifying keeps steps', () => {
    const step = channelOf([
      [0, 0, 'linear'],
      [1, 0, 'linear'],
      [2, 0, 'linear'],
      [2, 5, 'linear'],
      [3, 5, 'linear'],
      [4, 5, 'linear'],
    ]);
    const { channel, keysAfter } = simplifyChannel(step, 1e-3);
    expect(keysAfter).toBe(4);
    expect(valueAt(channel, 1.999)).toBeCloseTo(0, 2);
    expect(valueAt(channel, 2)).toBe(5);
  });

  it('leaves tangents what they are at keys that keep their neighbours', () => {
    const row = (i: number) => [i, i < 10 ? 0 : i % 2 ? 3 : -3, i % 3 ? 'smooth' : 'flat'] as const;
    const half = channelOf(Array.from({ length: 20 }, (_, i) => row(i)));
    const { channel } = simplifyChannel(half, 0.01);
    expect(channel.times.length).toBeLessThan(20);
    expect(rowsOf(channel).slice(-8)).toEqual(rowsOf(half).slice(-8));
  });

  it('takes keys inside the range only, and leaves the curve outside exactly', () => {
    const wave = recorded((t) => Math.sin(t) + 0.2 * Math.sin(9 * t), 300, 'smooth');
    const { channel, keysAfter } = simplifyChannel(wave, 0.05, [3, 6]);
    expect(keysAfter).toBeLessThan(230);
    expectWithin(wave, channel, 0.05);
    for (const [from, to] of [
      [0, 3],
      [6, 10],
    ]) {
      expect(largestSampled(wave, channel, from, to, 3000)).toBeLessThan(1e-12);
      const inside = (c: Channel) => [...keysOf(c).times].filter((t) => t >= from && t <= to).length;
      expect(inside(channel)).toBe(inside(wave));
    }
  });

  it('simplifying keeps the seam of a cycle smooth', () => {
    for (const extrapolation of ['cycle', 'cycle_offset'] as const) {
      const rise = extrapolation === 'cycle' ? 0 : 0.5;
      const wave = {
        ...recorded((t) => Math.sin(2 * Math.PI * t + 1) + rise * t, 60),
        extrapolateIn: extrapolation,
        extrapolateOut: extrapolation,
      };
      const { channel, keysAfter } = simplifyChannel(wave, 0.01);
      expect(keysAfter).toBeLessThan(14);
      expect(slopesAt(channel, 0)[1]).toBe(slopesAt(channel, keysAfter - 1)[0]);
      // Beyond the ends as well.
      expect(largestSampled(wave, channel, -4, 6, 5000)).toBeLessThanOrEqual(0.01 + 1e-9);
    }
  });

  it('simplifying keeps the slope that continues beyond the ends, as a number', () => {
    const wave = { ...recorded(Math.sin, 60), extrapolateOut: 'linear' as const };
    const { channel, keysAfter } = simplifyChannel(wave, 0.01);
    expect(keysAfter).toBeLessThan(10);
    expect(channel.tangentsOut.kinds[keysAfter - 1]).toBe(FIXED_TANGENT);
    expect(slopesAt(channel, keysAfter - 1)[1]).toBe(slopesAt(wave, 60)[1]);
  });

  it('needs fewer keys with more tolerance', () => {
    const wave = recorded((t) => Math.sin(t) + 0.3 * Math.sin(3.3 * t), 900);
    const counts = [1e-4, 1e-3, 1e-2, 1e-1].map((tolerance) => simplifyChannel(wave, tolerance).keysAfter);
    expect(counts).toEqual([...counts].sort((a, b) => b - a));
    expect(counts[3]).toBeLessThan(counts[0] / 4);
  });
});

describeShared('simplifying the walk of the wasp', () => {
  it.each([0.001, 0.01, 0.1])('simplifying the walk of the wasp stays within %d of every curve', (tolerance) => {
    const take = referenceTake('data/cse169/wasp_walk.anim');
    const keyed = take.channels.filter((c) => c.kind === 'keys');
    expect(keyed).toHaveLength(take.channels.length);
    const before = compileTake(take);
    const done = keyed.map((c) => simplifyChannel(c, tolerance));
    const after = compileTake({ ...take, channels: done.map((d) => d.channel) });
    for (let c = 0; c < take.channels.length; c++) {
      const { times } = keyed[c];
      for (let i = 0; i <= 2000; i++) {
        const t = times[0] + (i / 2000) * (times[times.length - 1] - times[0]);
        const off = Math.abs(evaluateChannel(after, c, t) - evaluateChannel(before, c, t));
        if (!(off <= tolerance)) expect.fail(`channel ${c} is off by ${off} at ${t} s`);
      }
    }
    const keys = (list: readonly KeyedChannel[]) => list.reduce((sum, { times }) => sum + times.length, 0);
    expect(keys(done.map((d) => d.channel))).toBeLessThanOrEqual(keys(keyed));
  });
});
