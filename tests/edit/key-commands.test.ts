import { describe, expect, it } from 'vitest';
import { setExtrapolation } from '../../src/edit/commands/extrapolation.ts';
import {
  addKey,
  insertKeys,
  moveKeys,
  removeKeys,
  rippleKeys,
  scaleKeys,
  setKeys,
} from '../../src/edit/commands/keys.ts';
import { pasteKeys } from '../../src/edit/commands/paste.ts';
import { setSlopes, setTangents, unifyTangents } from '../../src/edit/commands/tangents.ts';
import { copyKeys } from '../../src/edit/keys/clipboard.ts';
import { Store, withSelectedKeys } from '../../src/edit/store.ts';
import { shownTake } from '../../src/model/document.ts';
import { keysOf, restChannel } from '../../src/model/takes/take.ts';
import { character, documentOf } from '../helpers/builders.ts';
import { channelOf, pointsOf, rowsOf } from './keys/channels.ts';

const walk = {
  name: 'walk',
  range: [0, 3] as const,
  channels: [
    channelOf([
      [0, 0],
      [1, 10],
      [2, 0],
    ]),
    channelOf([
      [0.5, 1],
      [1, 2],
    ]),
    restChannel(4),
  ],
};
const start = documentOf(character({ takes: [walk], shownTake: 0 }));
const characterId = 'c1';

function opened(): Store {
  const store = new Store(start);
  store.select({ characterId });
  return store;
}

const channelIn = (store: Store, index: number) => {
  const channel = shownTake(store.document.characters[0])?.channels[index];
  if (!channel) throw new Error('There is no such channel.');
  return channel;
};

describe('commands on keys', () => {
  it('leave the selection with the keys they were about, wherever these are', () => {
    const store = opened();
    const keys = [{ channel: 0, indices: [0] }];
    store.select(withSelectedKeys(store.selection, keys));
    store.apply(moveKeys, { characterId, keys, seconds: 1.5 });
    expect(store.selection.keys).toEqual([{ channel: 0, indices: [1] }]);
    store.undo();
    expect(store.selection.keys).toEqual(keys);
  });

  it('leave every channel and take that they are not about the object it is', () => {
    const store = opened();
    store.apply(moveKeys, { characterId, keys: [{ channel: 0, indices: [0] }], seconds: 0, values: [1] });
    expect(channelIn(store, 1)).toBe(walk.channels[1]);
    expect(keysOf(channelIn(store, 0)).times).toBe(keysOf(walk.channels[0]).times);
  });

  it('make no step if nothing changes', () => {
    const store = opened();
    store.apply(moveKeys, { characterId, keys: [{ channel: 0, indices: [0] }], seconds: 0 });
    store.apply(setTangents, { characterId, keys: [{ channel: 0, indices: [0] }], side: 'both', kind: 'smooth' });
    store.apply(unifyTangents, { characterId, keys: [{ channel: 0, indices: [0] }] });
    store.apply(setExtrapolation, { characterId, channels: [0, 1], side: 'both', extrapolation: 'constant' });
    expect(store.document).toBe(start);
    expect(store.undoLabel).toBeUndefined();
  });

  it('insert keys on several curves and select them, including existing ones', () => {
    const store = opened();
    store.apply(insertKeys, { characterId, channels: [1, 0, 2], timeSeconds: 1 });
    expect(pointsOf(channelIn(store, 2))).toEqual([[1, 4]]);
    expect(channelIn(store, 0)).toBe(walk.channels[0]);
    expect(store.selection.keys).toEqual([
      { channel: 0, indices: [1] },
      { channel: 1, indices: [1] },
      { channel: 2, indices: [0] },
    ]);
  });

  it('add a key beside a curve', () => {
    const store = opened();
    store.apply(addKey, { characterId, channel: 0, timeSeconds: 0.5, value: -3 });
    expect(rowsOf(channelIn(store, 0))[1]).toEqual([0.5, -3, 'smooth', 'smooth']);
    store.apply(addKey, { characterId, channel: 0, timeSeconds: 1.5, value: 2, tangents: 'linear' });
    expect(rowsOf(channelIn(store, 0))[3]).toEqual([1.5, 2, 'linear', 'linear']);
  });

  it('leave an emptied channel standing at the value it had at that moment', () => {
    const store = opened();
    store.apply(removeKeys, { characterId, keys: [{ channel: 1, indices: [0, 1] }], timeSeconds: 0.75 });
    expect(channelIn(store, 1)).toEqual(restChannel(1.5));
    expect(store.selection.keys).toBeUndefined();
  });

  it('ripple channels no further than the one with the least room, so that poses stay poses', () => {
    const store = opened();
    const keys = [
      { channel: 0, indices: [1] },
      { channel: 1, indices: [1] },
    ];
    store.apply(rippleKeys, { characterId, keys, seconds: -3 });
    expect([...keysOf(channelIn(store, 0)).times]).toEqual([0, 0.5, 1.5]);
    expect([...keysOf(channelIn(store, 1)).times]).toEqual([0.5, 0.5]);
  });

  it('scale each channel about a value of its own', () => {
    const store = opened();
    const keys = [
      { channel: 0, indices: [0, 1] },
      { channel: 1, indices: [1] },
    ];
    store.apply(scaleKeys, { characterId, keys, pivotSeconds: 0, timeFactor: 1, valueFactor: 2, pivotValues: [10, 0] });
    expect([...keysOf(channelIn(store, 0)).values]).toEqual([-10, 10, 0]);
    expect([...keysOf(channelIn(store, 1)).values]).toEqual([1, 4]);
  });

  it("commands on keys keep keys selected when their channel's extrapolation changes", () => {
    const store = opened();
    const keys = [{ channel: 0, indices: [1] }];
    store.select(withSelectedKeys(store.selection, keys));
    store.apply(setExtrapolation, { characterId, channels: [0], side: 'out', extrapolation: 'cycle_offset' });
    expect(channelIn(store, 0)).toMatchObject({ extrapolateIn: 'constant', extrapolateOut: 'cycle_offset' });
    expect(store.selection.keys).toBe(keys);
  });

  it('paste at a time, and select the pasted keys', () => {
    const store = opened();
    const copied = copyKeys(walk, [{ channel: 1, indices: [0, 1] }]);
    store.apply(pasteKeys, { characterId, copied, timeSeconds: 0, into: [2], mode: 'merge' });
    expect(pointsOf(channelIn(store, 2))).toEqual([
      [0, 1],
      [0.5, 2],
    ]);
    expect(store.selection.keys).toEqual([{ channel: 2, indices: [0, 1] }]);
  });
});

describe('commands on keys refuse, and change nothing', () => {
  const keys = [{ channel: 0, indices: [0, 1] }];
  const copied = copyKeys(walk, keys);
  it.each<[string, string, () => unknown]>([
    ['a typed time for two keys', 'Only one key', () => setKeys.run(start, { characterId, keys, timeSeconds: 1 })],
    ['nothing typed', 'Give at least one', () => setKeys.run(start, { characterId, keys })],
    [
      'keys of no channel',
      'no channel number 7',
      () => unifyTangents.run(start, { characterId, keys: [{ channel: 7, indices: [0] }] }),
    ],
    [
      'keys that are not there',
      'no key number 3',
      () => unifyTangents.run(start, { characterId, keys: [{ channel: 0, indices: [3] }] }),
    ],
    [
      'keys out of order',
      'ascending',
      () => unifyTangents.run(start, { characterId, keys: [{ channel: 0, indices: [1, 0] }] }),
    ],
    [
      'no keys of a channel',
      'name at least one key',
      () => unifyTangents.run(start, { characterId, keys: [{ channel: 0, indices: [] }] }),
    ],
    ['too few values', 'for each channel', () => moveKeys.run(start, { characterId, keys, seconds: 0, values: [] })],
    ['what is no number', 'finite', () => moveKeys.run(start, { characterId, keys, seconds: Number.NaN })],
    ['an endless slope', 'finite', () => setSlopes.run(start, { characterId, keys, side: 'in', slope: 1 / 0 })],
    [
      'an empty clipboard',
      'nothing to paste',
      () => pasteKeys.run(start, { characterId, copied: copyKeys(walk, []), timeSeconds: 0, mode: 'merge' }),
    ],
    [
      'more channels than copied',
      'be pasted into 2 channels',
      () =>
        pasteKeys.run(start, {
          characterId,
          copied: copyKeys(walk, [
            { channel: 0, indices: [0] },
            { channel: 1, indices: [0] },
          ]),
          timeSeconds: 0,
          mode: 'merge',
          into: [1],
        }),
    ],
    [
      'columns that don’t fit',
      'columns of keys',
      () =>
        pasteKeys.run(start, {
          characterId,
          copied: { ...copied, channels: [{ ...copied.channels[0], values: Float64Array.of(1) }] },
          timeSeconds: 0,
          mode: 'merge',
        }),
    ],
    [
      'a character without a take',
      'has no current take',
      () => unifyTangents.run(documentOf(character()), { characterId, keys }),
    ],
  ])('a command on keys refuses %s, and changes nothing', (_what, sentence, run) => {
    expect(run).toThrow(sentence);
  });
});

describe('the Edit menu', () => {
  const keys = [{ channel: 0, indices: [0, 1] }];
  const one = [{ channel: 0, indices: [0] }];
  it.each([
    ['Move 2 keys on tx of joint0', moveKeys.label(start, { characterId, keys, seconds: 1 })],
    ['Move key on tx of joint0', moveKeys.label(start, { characterId, keys: one, seconds: 1 })],
    ['Insert key on tx of joint0', insertKeys.label(start, { characterId, channels: [0], timeSeconds: 0 })],
    ['Delete 2 keys on tx of joint0', removeKeys.label(start, { characterId, keys, timeSeconds: 0 })],
    [
      'Set 2 keys on tx of joint0 to smooth',
      setTangents.label(start, { characterId, keys, side: 'both', kind: 'smooth' }),
    ],
    [
      'Set key on tx of joint0 to flat after',
      setTangents.label(start, { characterId, keys: one, side: 'out', kind: 'flat' }),
    ],
    ['Set value of key on tx of joint0', setKeys.label(start, { characterId, keys: one, value: 1 })],
    [
      'Set tx of joint0 to cycle with offset after',
      setExtrapolation.label(start, { characterId, channels: [0], side: 'out', extrapolation: 'cycle_offset' }),
    ],
    [
      'Paste 2 keys on hero',
      pasteKeys.label(start, { characterId, copied: copyKeys(walk, keys), timeSeconds: 0, mode: 'merge' }),
    ],
  ])('the Edit menu says "%s"', (meant, label) => {
    expect(label).toBe(meant);
  });
});
