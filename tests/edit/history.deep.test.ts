/** What undo costs: the history may hold what its steps changed, and nothing else. */
import { describe, expect, it } from 'vitest';
import type { Edit } from '../../src/edit/change.ts';
import type { Command } from '../../src/edit/command.ts';
import { Store } from '../../src/edit/store.ts';
import type { Document } from '../../src/model/document.ts';
import { keysOf, type Take } from '../../src/model/takes/take.ts';
import { character, documentOf, skin, takeOfValues } from '../helpers/builders.ts';

const KEYS = 100_000;

/** A take with one channel of many keys. */
function longTake(count = KEYS): Take {
  const short = takeOfValues('long', [0]);
  const column = () => ({ kinds: new Uint8Array(count), slopes: new Float64Array(count) });
  const times = Float64Array.from({ length: count }, (_, i) => i);
  const channel = { ...short.channels[0], times, values: times.slice(), tangentsIn: column(), tangentsOut: column() };
  return { ...short, channels: [channel] };
}

/** As a command on one key does it: a column anew, everything else shared. */
const setValue: Command<{ readonly key: number; readonly value: number }, Edit> = {
  id: 'test.setValue',
  label: () => 'Set value',
  run(document, { key, value }) {
    const [first] = document.characters;
    const [channel] = first.takes[0].channels;
    const values = keysOf(channel).values.slice();
    // Two keys, as far apart as they can be.
    values[key] = value;
    values[values.length - 1 - key] = -value;
    const takes = [{ ...first.takes[0], channels: [{ ...channel, values }] }];
    return { document: { ...document, characters: [{ ...first, takes }] }, keys: [{ channel: 0, indices: [key] }] };
  },
};

const rename: Command<string> = {
  id: 'test.rename',
  label: () => 'Rename',
  run: (document, name) => ({ ...document, characters: document.characters.map((c) => ({ ...c, name })) }),
};

/** Bytes of all buffers that can be reached from an object, without those that can be reached from another. */
function bytesHeld(from: unknown, without: unknown): number {
  const seen = new Set<unknown>();
  const visit = (value: unknown): number => {
    if (typeof value !== 'object' || value === null || seen.has(value)) return 0;
    seen.add(value);
    if (ArrayBuffer.isView(value)) return visit(value.buffer);
    if (value instanceof ArrayBuffer) return value.byteLength;
    return Object.values(value).reduce<number>((sum, inside) => sum + visit(inside), 0);
  };
  visit(without);
  return visit(from);
}

describe('the history', () => {
  const start = documentOf(character({ skins: [skin()], takes: [longTake()], shownTake: 0 }));

  it('holds what its steps changed, however long the channels and however many the steps', () => {
    const store = new Store(start);
    for (let i = 0; i < 200; i++) {
      store.apply(setValue, { key: (i * 7919) % KEYS, value: i });
      // A step in between that changes something else must not hold on to the columns as they were then.
      store.apply(rename, `name ${i}`);
    }
    const held = bytesHeld(store, store.document);
    expect(held).toBeGreaterThan(0);
    expect(held).toBeLessThan(200 * 128);
  });

  it('undoes and redoes everything through long channels, including the selection', () => {
    const store = new Store(documentOf(character({ takes: [longTake(400)], shownTake: 0 })));
    store.select({ characterId: 'c1' });
    const states: { readonly document: Document; readonly keys: unknown }[] = [];
    const now = () => ({ document: structuredClone(store.document), keys: store.selection.keys });
    for (let i = 0; i < 20; i++) {
      states.push(now());
      store.apply(setValue, { key: i * 20, value: -i });
    }
    const last = now();
    for (const before of [...states].reverse()) {
      expect(store.undo()).toBe(true);
      expect(now()).toEqual(before);
    }
    for (const after of [...states.slice(1), last]) {
      expect(store.redo()).toBe(true);
      expect(store.document).toEqual(after.document);
    }
  });

  it('undoes to the identical document before a step, whatever was amended since', () => {
    const store = new Store(start);
    store.apply(rename, 'b');
    const amended = { ...store.document, isOpeningSample: true };
    store.amend(amended);
    store.undo();
    expect(store.document).toBe(start);
    store.redo();
    expect(store.document).toEqual(amended);
    store.undo();
    store.amend({ ...start, charactersMade: 9 });
    store.redo();
    expect(store.document).toEqual(amended);
  });
});
