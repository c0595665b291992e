import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { withLoop } from '../../../src/edit/channels/make-loop.ts';
import { FLAT } from '../../../src/model/takes/tangent-kinds.ts';
import { expectClose, WITHIN } from '../../helpers/close.ts';
import { checkChannel } from '../../helpers/invariants.ts';
import { channelOf, channels, pointsOf, slopesAt, valueAt } from '../keys/channels.ts';

const step = (k: number, of: number) => (k < 0 ? k + of : k);

describe('making a loop', () => {
  it('brings the last key to the first one, and gives both sides of the seam one slope', () => {
    fc.assert(
      fc.property(channels(2, { steps: true }), fc.boolean(), (channel, keepsOffset) => {
        const { channel: loop, slope } = withLoop(channel, keepsOffset);
        checkChannel(loop);
        const end = step(-1, loop.times.length);
        expect(slopesAt(loop, 0)).toEqual([slope, slope]);
        expect(slopesAt(loop, end)).toEqual([slope, slope]);
        if (!keepsOffset) expect(loop.values[end]).toBe(loop.values[0]);
        const goesOn = keepsOffset ? 'cycle_offset' : 'cycle';
        expect([loop.extrapolateIn, loop.extrapolateOut]).toEqual([goesOn, goesOn]);
      }),
    );
  });

  it('making a loop has no seam to be seen, in value or in slope', () => {
    fc.assert(
      fc.property(channels(2), fc.boolean(), (channel, keepsOffset) => {
        const { channel: loop, slope } = withLoop(channel, keepsOffset);
        const h = 2 ** -24;
        const end = loop.times[loop.times.length - 1];
        for (const seam of [end, loop.times[0]]) {
          const [before, there, after] = [-h, 0, h].map((by) => valueAt(loop, seam + by));
          expectClose([(there - before) / h, (after - there) / h], [slope, slope], 0.02);
        }
      }),
    );
  });

  it('making a loop changes nothing the second time', () => {
    fc.assert(
      fc.property(channels(1, { steps: true }), fc.boolean(), (channel, keepsOffset) => {
        const once = withLoop(channel, keepsOffset).channel;
        expect(withLoop(once, keepsOffset).channel).toBe(once);
      }),
    );
  });

  it('takes the slope that smooth would have if the keys went on', () => {
    const { channel, slope, moved } = withLoop(
      channelOf([
        [0, 1],
        [1, 3],
        [3, -2],
        [6, 5],
      ]),
    );
    // (3 − 1 + 1 − −2) in 1 + 3 seconds.
    expect(slope).toBe(1.25);
    expect(moved).toBe(-4);
    expect(pointsOf(channel).at(-1)).toEqual([6, 1]);
    // As the keys copied by hand would have it.
    const byHand = channelOf([
      [3, -2],
      [6, 1],
      [7, 3],
    ]);
    expectClose(slopesAt(byHand, 1), [slope, slope], WITHIN.rounding);
  });

  it('making a loop keeps what was shaped by hand: flat ends, a number on one side, the mean of two', () => {
    const ends = (out: 'flat' | 'smooth' | number, into: 'flat' | 'linear' | number) =>
      withLoop(
        channelOf([
          [0, 0, 'smooth', out],
          [1, 5],
          [2, 0, into, 'smooth'],
        ]),
      );
    expect(ends('flat', 'flat').slope).toBe(0);
    expect(ends('flat', 'flat').channel.tangentsOut.kinds[0]).toBe(FLAT);
    expect(ends(4, 'linear').slope).toBe(4);
    expect(ends('smooth', -2).slope).toBe(-2);
    expect(ends(4, -2).slope).toBe(1);
  });

  it('making a loop lets what travels travel on', () => {
    const { channel, moved } = withLoop(
      channelOf([
        [0, 0],
        [1, 2],
        [2, 3],
      ]),
      true,
    );
    expect(moved).toBe(0);
    expect(slopesAt(channel, 2)).toEqual([1.5, 1.5]);
    expect(valueAt(channel, 5)).toBe(8);
  });

  it('leaves a channel without time between its keys', () => {
    for (const rows of [
      [],
      [[1, 2]],
      [
        [1, 2],
        [1, 3],
      ],
    ] as const) {
      const channel = channelOf(rows);
      expect(withLoop(channel)).toEqual({ channel, moved: 0, slope: 0 });
    }
  });

  it('closes over steps at the ends', () => {
    const { channel } = withLoop(
      channelOf([
        [0, 9, 'flat'],
        [0, 1, 'flat'],
        [1, 3],
        [2, 7, 'flat'],
        [2, 8, 'flat'],
      ]),
    );
    expect([...channel.values]).toEqual([1, 1, 3, 1, 1]);
  });
});
