import { isDeepStrictEqual } from 'node:util';
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { Keeper } from '../../../src/app/autosave/keeper.ts';
import { Origins } from '../../../src/app/autosave/origins.ts';
import { readSession } from '../../../src/app/autosave/restore.ts';
import type { SessionState } from '../../../src/app/autosave/session-state.ts';
import { DEFAULT_PLAYBACK } from '../../../src/edit/playback.ts';
import { NOTHING_SELECTED } from '../../../src/model/session.ts';
import type { Joint } from '../../../src/model/skeleton/skeleton.ts';
import type { KeyedChannel } from '../../../src/model/takes/take.ts';
import { DEFAULT_TIMELINE_VIEW } from '../../../src/ui/state/timeline.ts';
import { parse } from '../../../src/worker/parse.ts';
import { character, documentOf, skeleton, takeOfValues } from '../../helpers/builders.ts';
import { type MemoryStore, memoryStore } from './memory-store.ts';

function key(value: number, count = 1): KeyedChannel {
  const column = () => Float64Array.from({ length: count }, (_, i) => value + i);
  const tangents = () => ({ kinds: new Uint8Array(count), slopes: column() });
  const rest = { extrapolateIn: 'constant', extrapolateOut: 'constant' } as const;
  return { kind: 'keys', ...rest, times: column(), values: column(), tangentsIn: tangents(), tangentsOut: tangents() };
}

const keys = (count: number) => Array.from({ length: count }, (_, i) => key(i));

function stateOf(...takes: readonly (readonly KeyedChannel[])[]): SessionState {
  return {
    document: documentOf(
      character({ takes: takes.map((channels, i) => ({ ...takeOfValues(`take ${i}`, []), channels })) }),
    ),
    selection: NOTHING_SELECTED,
    transport: DEFAULT_PLAYBACK,
    timeline: DEFAULT_TIMELINE_VIEW,
    camera: { target: [0, 1, 0], azimuth: 0.5, polar: 1, distance: 3 },
  };
}

const worker = { run: async (_: 'parse', { files }: Parameters<typeof parse>[0]) => parse({ files }, () => undefined) };
const options = { signal: new AbortController().signal, onProgress: () => undefined };
const readBack = (store: MemoryStore) => readSession('s', store, worker, new Origins(1000), options);
/** Vitest's own comparison of long lists takes seconds. */
const expectSame = (a: unknown, b: unknown) => expect(isDeepStrictEqual(a, b)).toBe(true);

/** Of what a save wrote. */
const written = (store: MemoryStore) => store.writes[store.writes.length - 1].chunks;
const headBytes = (store: MemoryStore) => JSON.stringify(store.writes[store.writes.length - 1].head).length;

describe('chunks', () => {
  it('an edit of one of 5,000 channels writes little, and so does one that adds a channel', async () => {
    const store = memoryStore();
    const keeper = new Keeper('s', store, new Origins());
    const channels = keys(5000);
    await keeper.save(stateOf(channels), 1);
    expect(written(store).length).toBeGreaterThan(20);
    const edited = channels.with(2000, key(-1));
    await keeper.save(stateOf(edited), 2);
    // Its own, and the character's.
    expect(written(store).length).toBeLessThanOrEqual(2);
    expect(headBytes(store)).toBeLessThan(20_000);
    const longer = edited.toSpliced(3, 0, key(-2));
    await keeper.save(stateOf(longer), 3);
    expect(written(store).length).toBeLessThanOrEqual(3);
    expectSame((await readBack(store)).state, stateOf(longer));
  });

  it('edits again and again of one place leave no more chunks behind', async () => {
    const store = memoryStore();
    const keeper = new Keeper('s', store, new Origins());
    let channels: readonly KeyedChannel[] = keys(1000);
    await keeper.save(stateOf(channels), 1);
    const before = store.sessions.get('s')?.chunks.size ?? 0;
    for (let i = 0; i < 30; i++) {
      channels = channels.with((i * 37) % 1000, key(i, 3));
      await keeper.save(stateOf(channels), 2);
    }
    expect(store.sessions.get('s')?.chunks.size).toBeLessThanOrEqual(before + 2);
  });

  it('an edit of one of 20,000 joints writes little', async () => {
    const store = memoryStore();
    const keeper = new Keeper('s', store, new Origins());
    const [joint] = skeleton(1).joints;
    const joints: readonly Joint[] = Array.from({ length: 20_000 }, (_, i) => ({ ...joint, parent: i - 1 }));
    const withJoints = (all: readonly Joint[]): SessionState => ({
      ...stateOf(),
      document: documentOf(character({ skeleton: { name: 'long', joints: all } })),
    });
    await keeper.save(withJoints(joints), 1);
    const edited = withJoints(joints.with(11_000, { ...joints[11_000], offset: [1, 2, 3] }));
    await keeper.save(edited, 2);
    expect(written(store).length).toBeLessThanOrEqual(2);
    expectSame((await readBack(store)).state, edited);
  });

  it('takes that share channels share them again, without storing them twice', async () => {
    const store = memoryStore();
    const keeper = new Keeper('s', store, new Origins());
    const channels = keys(500);
    await keeper.save(stateOf(channels), 1);
    const before = store.sessions.get('s')?.chunks.size ?? 0;
    await keeper.save(stateOf(channels, channels), 2);
    expect(store.sessions.get('s')?.chunks.size).toBe(before);
    const { state } = await readBack(store);
    const [one, other] = state.document.characters[0].takes;
    expect(one.channels[499]).toBe(other.channels[499]);
  });

  it('what a list no longer has is deleted, and a session that was read is written anew, without rest', async () => {
    const store = memoryStore();
    const keeper = new Keeper('s', store, new Origins());
    await keeper.save(stateOf(keys(500), keys(500)), 1);
    const two = store.sessions.get('s')?.chunks.size ?? 0;
    const one = stateOf(keys(500));
    await keeper.save(one, 2);
    expect(store.sessions.get('s')?.chunks.size).toBeLessThan(two);
    const back = await readBack(store);
    const next = back.keeper();
    await next.save(back.state, 3);
    expectSame((await readBack(store)).state, one);
    await next.save(stateOf([]), 4);
    expect(store.sessions.get('s')?.chunks.size).toBe(0);
  });

  it('a save at once between the slices of another is the last one', async () => {
    const store = memoryStore();
    const keeper = new Keeper('s', store, new Origins());
    const channels = keys(20_000);
    const slow = keeper.save(stateOf(channels), 1);
    // It begins to encode.
    await Promise.resolve();
    await Promise.resolve();
    const now = stateOf(channels.slice(0, 9));
    await Promise.all([slow, keeper.saveAtOnce(now, 2)]);
    expectSame((await readBack(store)).state, now);
    await keeper.save(stateOf([]), 3);
    expect(store.sessions.get('s')?.chunks.size).toBe(0);
  });

  it('comes back whole after any edits, failed saves and saves at once that overtake others', async () => {
    const edit = fc.record({
      at: fc.nat(299),
      how: fc.constantFrom('set', 'add', 'remove', 'copy', 'long'),
      save: fc.constantFrom('wait', 'fail', 'overtake', 'clear', 'restore'),
    });
    await fc.assert(
      fc.asyncProperty(fc.array(edit, { minLength: 1, maxLength: 8 }), async (edits) => {
        const store = memoryStore();
        let keeper = new Keeper('s', store, new Origins());
        let takes: readonly (readonly KeyedChannel[])[] = [keys(300), keys(30)];
        let last = stateOf(...takes);
        await keeper.save(last, 0);
        for (const { at, how, save } of edits) {
          const [first, ...others] = takes;
          if (how === 'set') takes = [first.with(at % first.length, key(at)), ...others];
          if (how === 'add') takes = [first.toSpliced(at, 0, key(at), key(at + 1)), ...others];
          if (how === 'remove') takes = [first.toSpliced(at % first.length, 9), ...others];
          if (how === 'copy') takes = [first, first.with(0, key(at)), ...others.slice(0, 2)];
          if (how === 'long') takes = [first.with(at % first.length, key(at, 5000)), ...others];
          const now = stateOf(...takes);
          if (save === 'fail') {
            store.onWrite = () => {
              throw new DOMException('full', 'QuotaExceededError');
            };
            await keeper.save(now, 1).catch(() => undefined);
            store.onWrite = () => undefined;
          } else if (save === 'overtake') {
            const running = keeper.save(last, 1);
            await Promise.all([running, keeper.saveAtOnce(now, 2)]);
            // Whichever was last.
            await keeper.save(now, 3);
            last = now;
          } else {
            if (save === 'clear') store.sessions.clear();
            await keeper.save(now, 1);
            last = now;
          }
          const back = await readBack(store);
          expectSame(back.state, last);
          if (save === 'restore') {
            keeper = back.keeper();
            takes = back.state.document.characters[0].takes.map(({ channels }) => channels as KeyedChannel[]);
          }
        }
        // Nothing is left of what was.
        await keeper.save(stateOf([]), 9);
        const stored = store.sessions.get('s');
        expect([stored?.chunks.size, stored?.pieces.size]).toEqual([0, 0]);
      }),
      { numRuns: 6 },
    );
  });
});
