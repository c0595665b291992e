import fc from 'fast-check';
import { describe, expect, it, vi } from 'vitest';
import type { Edit } from '../../src/edit/change.ts';
import type { Command } from '../../src/edit/command.ts';
import { removeCharacter, renameCharacter } from '../../src/edit/commands/characters.ts';
import { Store } from '../../src/edit/store.ts';
import { character, documentOf, skeleton, takeOfValues } from '../helpers/builders.ts';

const start = documentOf(character({ name: 'a' }));
const rename = (name: string) => ({ characterId: 'c1', name });
const nameIn = (store: Store) => store.document.characters[0].name;

describe('Store', () => {
  it('undoes and redoes a step to the identical objects', () => {
    const store = new Store(start);
    store.apply(renameCharacter, rename('b'));
    const after = store.document;
    expect(store.undo()).toBe(true);
    expect(store.document).toBe(start);
    expect(store.redo()).toBe(true);
    expect(store.document).toBe(after);
  });

  it('names the steps that undo and redo would take', () => {
    const store = new Store(start);
    store.apply(renameCharacter, rename('b'));
    expect([store.undoLabel, store.redoLabel]).toEqual(['Rename a to b', undefined]);
    store.undo();
    expect([store.undoLabel, store.redoLabel]).toEqual([undefined, 'Rename a to b']);
  });

  it('Store makes no step of a command that changes nothing', () => {
    const store = new Store(start);
    store.apply(renameCharacter, rename('a'));
    expect(store.undoLabel).toBeUndefined();
  });

  it('tells of each step made here, once, and of nothing else', () => {
    const store = new Store(start);
    const told = vi.fn();
    const stop = store.onStep(({ document }, before) =>
      told(before.document.characters[0].name, document.characters[0].name),
    );
    store.apply(renameCharacter, rename('b'));
    store.apply(renameCharacter, rename('b'));
    const drag = store.begin('Drag');
    drag.preview(renameCharacter.run(drag.base, rename('c')));
    drag.preview(renameCharacter.run(drag.base, rename('d')));
    drag.commit();
    const other = store.begin('Drag');
    other.preview(renameCharacter.run(other.base, rename('e')));
    other.cancel();
    store.undo();
    store.redo();
    store.select({ characterId: 'c1' });
    store.replace('Open', start);
    expect(told.mock.calls).toEqual([
      ['a', 'b'],
      ['b', 'd'],
    ]);
    stop();
    store.apply(renameCharacter, rename('f'));
    expect(told).toHaveBeenCalledTimes(2);
  });

  it('reports when there is nothing to undo or redo', () => {
    const store = new Store(start);
    expect([store.undo(), store.redo()]).toEqual([false, false]);
  });

  it('changes nothing when a command is refused', () => {
    const store = new Store(start);
    expect(() => store.apply(renameCharacter, { characterId: 'nobody', name: 'x' })).toThrow('no character "nobody"');
    expect(store.document).toBe(start);
    expect(store.undoLabel).toBeUndefined();
  });

  it('selects nothing of a removed character, and selects it again when it is restored', () => {
    const store = new Store(start);
    store.select({ characterId: 'c1', joint: 1 });
    store.apply(removeCharacter, { characterId: 'c1' });
    expect(store.selection).toEqual({});
    store.undo();
    expect(store.selection).toEqual({ characterId: 'c1', joint: 1 });
  });

  it('brings the selection back with the step', () => {
    const store = new Store(start);
    store.select({ characterId: 'c1', joint: 1 });
    store.apply(renameCharacter, rename('b'));
    store.select({ characterId: 'c1', joint: 0 });
    store.undo();
    expect(store.selection).toEqual({ characterId: 'c1', joint: 1 });
    store.redo();
    expect(store.selection).toEqual({ characterId: 'c1', joint: 0 });
  });

  it('Store makes one step of a drag, however many previews it had', () => {
    const store = new Store(start);
    const drag = store.begin('Drag');
    for (const name of ['b', 'c', 'd']) drag.preview(renameCharacter.run(drag.base, rename(name)));
    expect(nameIn(store)).toBe('d');
    drag.commit();
    expect(store.undoLabel).toBe('Drag');
    store.undo();
    expect(store.document).toBe(start);
  });

  it('gives a cancelled drag up without a trace, and ignores what its hand still does', () => {
    const store = new Store(start);
    const drag = store.begin('Drag');
    drag.preview(renameCharacter.run(drag.base, rename('b')));
    drag.cancel();
    drag.preview(renameCharacter.run(drag.base, rename('c')));
    drag.commit();
    expect(store.document).toBe(start);
    expect(store.undoLabel).toBeUndefined();
  });

  it('commits a drag that is under way before the next step', () => {
    const store = new Store(start);
    const drag = store.begin('Drag');
    drag.preview(renameCharacter.run(drag.base, rename('b')));
    store.apply(renameCharacter, rename('c'));
    store.undo();
    expect(nameIn(store)).toBe('b');
    store.undo();
    expect(nameIn(store)).toBe('a');
  });

  it('reverts what was only tried before anything else happens', () => {
    const others: readonly ((store: Store) => void)[] = [
      (store) => store.apply(renameCharacter, rename('c')),
      (store) => store.replace('Open', documentOf(character({ name: 'c' }))),
      (store) => store.begin('Drag').commit(),
      (store) => store.undo(),
      (store) => store.redo(),
      (store) => store.settle(),
    ];
    for (const other of others) {
      const store = new Store(start);
      const trial = store.begin('Simplify', 'tried');
      trial.preview(renameCharacter.run(trial.base, rename('b')));
      const seen: string[] = [];
      store.subscribe((now) => seen.push(now.document.characters[0].name));
      other(store);
      expect(seen[0]).toBe('a');
      expect(trial.closed).toBe(true);
      trial.preview(renameCharacter.run(trial.base, rename('d')));
      trial.commit();
      trial.cancel();
      expect(['a', 'c']).toContain(nameIn(store));
      store.undo();
      expect(store.document).toBe(start);
      expect(store.undoLabel).toBeUndefined();
    }
  });

  it('Store makes one step of a kept trial, and none of others', () => {
    const store = new Store(start);
    const trial = store.begin('Simplify', 'tried');
    expect(trial.closed).toBe(false);
    trial.preview(renameCharacter.run(trial.base, rename('b')));
    trial.commit();
    expect([trial.closed, store.undoLabel, nameIn(store)]).toEqual([true, 'Simplify', 'b']);
    const other = store.begin('Resample', 'tried');
    other.preview(renameCharacter.run(other.base, rename('c')));
    other.cancel();
    expect([other.closed, store.undoLabel, nameIn(store)]).toEqual([true, 'Simplify', 'b']);
  });

  it('amends without a step', () => {
    const store = new Store(start);
    store.amend(documentOf(character({ name: 'b' })));
    expect(store.undoLabel).toBeUndefined();
    expect(nameIn(store)).toBe('b');
  });

  it('a listener that throws neither undoes the change nor keeps it from the other listeners', () => {
    const store = new Store(start);
    const heard: string[] = [];
    store.subscribe(() => {
      throw new Error('no picture');
    });
    store.subscribe((now) => heard.push(now.document.characters[0].name));
    expect(() => store.apply(renameCharacter, rename('b'))).toThrow('no picture');
    expect([heard, nameIn(store)]).toEqual([['b'], 'b']);
  });

  it('passes the previous state to listeners, and stops when they unsubscribe', () => {
    const store = new Store(start);
    const heard = vi.fn();
    const leave = store.subscribe(heard);
    store.apply(renameCharacter, rename('b'));
    expect(heard).toHaveBeenCalledTimes(1);
    expect(heard.mock.calls[0][1].document).toBe(start);
    leave();
    store.undo();
    expect(heard).toHaveBeenCalledTimes(1);
  });

  it('restores every document on the way, whatever was done', () => {
    const name = fc.string().map((end) => `a${end}`);
    const step = fc.oneof(
      fc.record({ kind: fc.constant('apply' as const), name }),
      fc.record({ kind: fc.constant('drag' as const), name }),
      fc.record({ kind: fc.constant('select' as const), joint: fc.nat(3) }),
    );
    fc.assert(
      fc.property(fc.array(step, { maxLength: 100 }), (steps) => {
        const store = new Store(start);
        const documents = [store.document];
        for (const s of steps) {
          if (s.kind === 'select') {
            store.select({ characterId: 'c1', joint: s.joint });
            continue;
          }
          if (s.kind === 'apply') store.apply(renameCharacter, rename(s.name));
          else {
            const drag = store.begin('Drag');
            drag.preview(renameCharacter.run(drag.base, rename(s.name)));
            drag.commit();
          }
          if (store.document !== documents.at(-1)) documents.push(store.document);
        }
        for (const document of documents.slice(0, -1).reverse()) {
          store.undo();
          expect(store.document).toBe(document);
        }
        expect(store.undo()).toBe(false);
        for (const document of documents.slice(1)) {
          store.redo();
          expect(store.document).toBe(document);
        }
        expect(store.redo()).toBe(false);
      }),
    );
  });

  it('selects the joint that a change says it was about, and takes it back with the change', () => {
    const about = (joint: number | undefined, characterId = 'c1'): Command<{ readonly name: string }, Edit> => ({
      ...renameCharacter,
      run: (document, { name }) => ({
        document: renameCharacter.run(document, rename(name)),
        keys: [],
        selected: { characterId, ...(joint !== undefined && { joint }) },
      }),
      label: () => 'Rename',
    });
    const played = documentOf(
      character({ name: 'a', skeleton: skeleton(4), takes: [takeOfValues('walk', [1])], shownTake: 0 }),
    );
    const store = new Store(played);
    store.select({ characterId: 'c1', joint: 3, vertex: 5, keys: [{ channel: 0, indices: [0] }] });
    const before = store.selection;
    store.apply(about(2), { name: 'b' });
    // Keys are the take's, which is still the same; the vertex was another thing to look at.
    expect(store.selection).toEqual({ characterId: 'c1', joint: 2, keys: [{ channel: 0, indices: [0] }] });
    const same = store.selection;
    store.apply(about(2), { name: 'c' });
    expect(store.selection).toBe(same);
    store.apply(about(undefined), { name: 'd' });
    expect(store.selection).toEqual({ characterId: 'c1', keys: [{ channel: 0, indices: [0] }] });
    for (let step = 0; step < 3; step++) store.undo();
    expect(store.selection).toBe(before);
    store.apply(about(1), { name: 'a' });
    expect(store.selection.joint).toBe(3);
  });

  it('selects what a preview is about, and the previous selection when it is cancelled', () => {
    const store = new Store(documentOf(character({ name: 'a', skeleton: skeleton(4) })));
    store.select({ characterId: 'c1', joint: 1 });
    const drag = store.begin('Drag');
    const to = (name: string, joint: number) => ({
      document: renameCharacter.run(drag.base, rename(name)),
      keys: [],
      selected: { characterId: 'c1', joint },
    });
    drag.preview(to('b', 2));
    drag.preview(to('c', 3));
    expect(store.selection).toEqual({ characterId: 'c1', joint: 3 });
    drag.cancel();
    expect(store.selection).toEqual({ characterId: 'c1', joint: 1 });
  });

  it('selects what a document made elsewhere is about, and else keeps what is still there', () => {
    const two = (...joints: number[]) =>
      joints.map((n, i) => ({ ...character({ skeleton: skeleton(n) }), id: `c${i + 1}` }));
    const store = new Store(documentOf(...two(4, 4)));
    const selected = { characterId: 'c1', joint: 3 };
    store.select(selected);
    store.replace('Reload', documentOf(...two(4, 2)));
    expect(store.selection).toBe(selected);
    store.replace('Reload', documentOf(...two(2, 2)));
    expect(store.selection).toEqual({ characterId: 'c1' });
    store.replace('Open', { document: documentOf(...two(2, 2, 2)), selected: { characterId: 'c3' } });
    expect(store.selection).toEqual({ characterId: 'c3' });
    store.replace('Reload', documentOf(...two(2, 2)));
    expect(store.selection).toEqual({});
    for (let step = 0; step < 4; step++) store.undo();
    expect(store.selection).toBe(selected);
  });

  it('selects no keys that the selected character does not have, where a command about another changes nothing', () => {
    const walker = character({ id: 'w', takes: [takeOfValues('walk', [1, 2])], shownTake: 0 });
    const store = new Store(documentOf(walker, character({ id: 'bare' })));
    const selecting: Command<undefined, Edit> = {
      id: 'test.select',
      label: () => 'Select',
      run: (document) => ({ document, keys: [{ channel: 1, indices: [0] }] }),
    };
    store.select({ characterId: 'bare' });
    store.apply(selecting, undefined);
    expect(store.selection).toEqual({ characterId: 'bare' });
    store.select({ characterId: 'w' });
    store.apply(selecting, undefined);
    expect(store.selection.keys).toEqual([{ channel: 1, indices: [0] }]);
  });
});
