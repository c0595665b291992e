import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { copyKeys, type PasteMode, withKeysPasted } from '../../../src/edit/keys/clipboard.ts';
import { allKeys } from '../../../src/edit/keys/selection.ts';
import { type Channel, keysOf, restChannel, type Take } from '../../../src/model/takes/take.ts';
import { checkChannel } from '../../helpers/invariants.ts';
import { channelOf, channels, channelsOrRest, expectNoCrowd, pointsOf, rowsOf } from './channels.ts';

const takeOf = (...all: Channel[]): Take => ({ name: 'walk', range: [0, 1], channels: all });

const walk = takeOf(
  channelOf([
    [1, 10, 'linear', 3],
    [2, 20, 'smooth'],
    [5, 50, 'flat'],
  ]),
  channelOf([
    [0, 1],
    [2.5, 2],
  ]),
  restChannel(7),
);
const paste = (copied: ReturnType<typeof copyKeys>, timeSeconds: number, mode: PasteMode, into?: number[]) =>
  withKeysPasted(walk, copied, { timeSeconds, mode, into });

describe('copying keys', () => {
  it('copies them as they are, with times relative to the earliest', () => {
    const copied = copyKeys(walk, [
      { channel: 0, indices: [1] },
      { channel: 1, indices: [1] },
    ]);
    expect(copied.seconds).toBe(0.5);
    expect(copied.channels.map((c) => [c.channel, [...c.times], [...c.values]])).toEqual([
      [0, [0], [20]],
      [1, [0.5], [2]],
    ]);
  });

  it('copying keys is plain data that outlives the take', () => {
    expect(structuredClone(copyKeys(walk, allKeys(walk)))).toEqual(copyKeys(walk, allKeys(walk)));
  });
});

describe('pasting keys', () => {
  const first = copyKeys(walk, [{ channel: 0, indices: [0, 1] }]);

  it('pastes them among existing keys, replacing those they land on, tangents included', () => {
    const { channels: after, keys } = paste(first, 4, 'merge');
    expect(rowsOf(after[0])).toEqual([
      [1, 10, 'linear', 3],
      [2, 20, 'smooth', 'smooth'],
      [4, 10, 'linear', 3],
      [5, 20, 'smooth', 'smooth'],
    ]);
    expect(keys).toEqual([{ channel: 0, indices: [2, 3] }]);
    expect(after[1]).toBe(walk.channels[1]);
  });

  it('replaces what lies between the first and the last of them', () => {
    const { channels: after } = paste(first, 1.5, 'replace');
    expect(pointsOf(after[0])).toEqual([
      [1, 10],
      [1.5, 10],
      [2.5, 20],
      [5, 50],
    ]);
  });

  it('moves existing and later keys by their duration', () => {
    const { channels: after, keys } = paste(first, 1.5, 'insert');
    expect(pointsOf(after[0])).toEqual([
      [1, 10],
      [1.5, 10],
      [2.5, 20],
      [3, 20],
      [6, 50],
    ]);
    expect(keys).toEqual([{ channel: 0, indices: [1, 2] }]);
  });

  it('pasting keys keeps the times of channels together: the earliest key of all is put at the given time', () => {
    const copied = copyKeys(walk, allKeys(walk, [0, 1]));
    const { channels: after } = paste(copied, 10, 'merge');
    expect([...keysOf(after[1]).times]).toEqual([0, 2.5, 10, 12.5]);
    expect([...keysOf(after[0]).times]).toEqual([1, 2, 5, 11, 12, 15]);
  });

  it('puts the keys of one channel into any number of others, keyless ones too', () => {
    const { channels: after, keys } = paste(first, 0, 'merge', [2, 1]);
    expect(pointsOf(after[2])).toEqual([
      [0, 10],
      [1, 20],
    ]);
    checkChannel(after[2]);
    expect(pointsOf(after[1])).toEqual([
      [0, 10],
      [1, 20],
      [2.5, 2],
    ]);
    expect(after[0]).toBe(walk.channels[0]);
    expect(keys).toEqual([
      { channel: 1, indices: [0, 1] },
      { channel: 2, indices: [0, 1] },
    ]);
  });

  it('puts the keys of several channels into as many others, in the order given', () => {
    const copied = copyKeys(walk, [
      { channel: 0, indices: [2] },
      { channel: 1, indices: [1] },
    ]);
    const { channels: after } = paste(copied, 0, 'replace', [2, 0]);
    expect(pointsOf(after[2])).toEqual([[2.5, 50]]);
    expect(pointsOf(after[0])).toEqual([
      [0, 2],
      [5, 50],
    ]);
  });

  it('pasting keys refuses channels that don’t fit', () => {
    const both = copyKeys(walk, allKeys(walk, [0, 1]));
    expect(() => paste(both, 0, 'merge', [2])).toThrow(
      'Keys copied from 2 channels can only be pasted into 2 channels',
    );
    expect(() => paste(first, 0, 'merge', [3])).toThrow('no channel 3');
    expect(() => paste(both, 0, 'merge', [2, 2])).toThrow('pasted into only once');
    expect(() => withKeysPasted(takeOf(), first, { timeSeconds: 0, mode: 'merge' })).toThrow('no channel 0');
  });

  it('returns valid channels and the pasted keys at their positions, whatever is pasted', () => {
    const time = fc.integer({ min: -160, max: 160 }).map((tick) => tick / 8);
    const mode = fc.constantFrom<PasteMode[]>('merge', 'replace', 'insert');
    fc.assert(
      fc.property(channels(1, { steps: true }), channelsOrRest({ steps: true }), time, mode, (from, to, at, how) => {
        const take = takeOf(from, to);
        const copied = copyKeys(take, allKeys(take, [0]));
        const { channels: after, keys } = withKeysPasted(take, copied, { timeSeconds: at, mode: how, into: [1] });
        checkChannel(after[1]);
        expectNoCrowd(after[1]);
        const pasted = keys[0].indices.map((k) => [keysOf(after[1]).times[k] - at, keysOf(after[1]).values[k]]);
        expect(pasted).toEqual(pointsOf(from).map(([t, v]) => [t - from.times[0], v]));
        expect(after[0]).toBe(from);
      }),
    );
  });
});
