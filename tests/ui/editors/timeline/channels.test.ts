import { describe, expect, it } from 'vitest';
import { restChannel } from '../../../../src/model/takes/take.ts';
import {
  channelName,
  drawnChannels,
  listedChannels,
  spokenName,
} from '../../../../src/ui/editors/timeline/channels.ts';
import { channel, character, skeleton, take } from '../../builders.ts';

const keyed = () => channel(0, 1);
/** Root translation, hips and leg: nine channels, of which hips ry (4) has no keys. */
const walker = character({
  skeleton: skeleton(['hips', -1], ['leg', 0]),
  morphs: [
    {
      name: 'smile',
      positions: { indices: new Uint32Array(0), values: new Float64Array(0) },
      normals: { indices: new Uint32Array(0), values: new Float64Array(0) },
    },
  ],
  takes: [take([0, 1], ...Array.from({ length: 10 }, (_, i) => (i === 4 ? restChannel() : keyed())))],
});
const all = { list: 'all', pinned: [], filter: '' } as const;
const numbers = (list: readonly { channel: number }[]) => list.map((c) => c.channel);

describe('listed channels', () => {
  it('the list has the selected joint’s channels, with the root translation for the root', () => {
    const list = { ...all, list: 'selected' } as const;
    expect(numbers(listedChannels(walker, { characterId: 'c1', joint: 1 }, list))).toEqual([6, 7, 8]);
    expect(numbers(listedChannels(walker, { characterId: 'c1', joint: 0 }, list))).toEqual([0, 1, 2, 3, 4, 5]);
  });

  it('listed channels are the root’s where no joint of this character is selected', () => {
    const list = { ...all, list: 'selected' } as const;
    expect(numbers(listedChannels(walker, {}, list))).toEqual([0, 1, 2, 3, 4, 5]);
    const other = { characterId: 'other', joint: 1 };
    expect(numbers(listedChannels(walker, other, list))).toEqual([0, 1, 2, 3, 4, 5]);
  });

  it('listed channels are all where no joint is selected and the root doesn’t move', () => {
    const list = { ...all, list: 'selected' } as const;
    const channels = Array.from({ length: 9 }, (_, i) => (i === 7 ? keyed() : restChannel()));
    expect(listedChannels({ ...walker, takes: [take([0, 1], ...channels)] }, {}, list)).toHaveLength(10);
    expect(listedChannels({ ...walker, takes: [] }, {}, list)).toHaveLength(10);
  });

  it('the list tells which DOF a linked one follows, whatever its keys', () => {
    const bones = skeleton(['hips', -1], ['leg', 0]);
    const couples = [{ dof: 'ry', joint: 0, follows: 'rx', gain: 2, offset: 0 }];
    const joints = bones.joints.map((joint, j) => (j === 1 ? { ...joint, couples } : joint));
    const coupled = { ...walker, skeleton: { ...bones, joints } };
    const follows = listedChannels(coupled, {}, all).map((listed) => listed.follows);
    expect(follows).toEqual(Array.from({ length: 10 }, (_, i) => (i === 7 ? 'hips rx' : undefined)));
  });

  it('channels are named by joint and DOF, morphs by their own name, others by number', () => {
    const more = { ...walker, takes: [take([0, 1], ...Array.from({ length: 12 }, keyed))] };
    const named = listedChannels(more, {}, all).map(channelName);
    expect(named[0]).toBe('hips tx');
    expect(named[7]).toBe('leg ry');
    expect(named.slice(9)).toEqual(['smile', 'channel 10', 'channel 11']);
  });

  it('the filter matches every word, in any order', () => {
    expect(numbers(listedChannels(walker, {}, { ...all, filter: 'rx leg' }))).toEqual([6]);
    expect(numbers(listedChannels(walker, {}, { ...all, filter: 'nothing' }))).toEqual([]);
  });

  it('pinned channels are listed, if they still exist', () => {
    expect(numbers(listedChannels(walker, {}, { ...all, list: 'pinned', pinned: [2, 7, 99] }))).toEqual([2, 7]);
  });

  it('channels without animation are listed, without keys', () => {
    const bare = { ...walker, takes: [] };
    expect(listedChannels(bare, {}, all).map((c) => c.keyCount)).toEqual(new Array(10).fill(0));
  });
});

describe('drawn channels', () => {
  const list = listedChannels(walker, { characterId: 'c1', joint: 0 }, { ...all, list: 'selected' });

  it('channels with keys are drawn unless hidden', () => {
    expect(drawnChannels(list, { hidden: [0] })).toEqual([1, 2, 3, 5]);
  });

  it('only isolated channels are drawn, even if hidden', () => {
    expect(drawnChannels(list, { hidden: [0], isolated: [0, 3] })).toEqual([0, 3]);
  });

  it('all channels are drawn again when no isolated one is listed any more', () => {
    expect(drawnChannels(list, { hidden: [], isolated: [8] })).toEqual([0, 1, 2, 3, 5]);
  });
});

it('names a channel as it is spoken', () => {
  expect(spokenName({ joint: 'leg_fl', dof: 'rx' })).toBe('rx of leg_fl');
  expect(spokenName({ joint: '', dof: 'blink' })).toBe('blink');
});
