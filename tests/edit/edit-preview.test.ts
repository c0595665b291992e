import { describe, expect, it, vi } from 'vitest';
import { renameCharacter } from '../../src/edit/commands/characters.ts';
import { EditPreview } from '../../src/edit/edit-preview.ts';
import { Store } from '../../src/edit/store.ts';
import { character, documentOf } from '../ui/builders.ts';

const start = documentOf(character({ name: 'a' }));

function preview() {
  const store = new Store(start);
  const ended = vi.fn();
  const made = new EditPreview(store, 'Simplify', ended);
  const show = (name: string) => made.show(renameCharacter.run(made.base, { characterId: 'c1', name }));
  return { store, ended, made, show, name: () => store.document.characters[0].name };
}

describe('a change that is tried', () => {
  it('a change that is tried is one step when kept', () => {
    const { store, ended, made, show, name } = preview();
    show('b');
    show('c');
    made.keep();
    expect([name(), store.undoLabel]).toEqual(['c', 'Simplify']);
    store.undo();
    expect(store.document).toBe(start);
    expect(ended).not.toHaveBeenCalled();
  });

  it('a change that is tried is not what a crash may keep, until it is kept; a drag is', () => {
    const { store, made, show } = preview();
    const { selection } = store;
    show('b');
    store.select({ characterId: 'c1' });
    expect(store.confirmed).toEqual({ document: start, selection });
    expect(store.confirmed.document).toBe(start);
    made.keep();
    expect(store.confirmed.document).toBe(store.document);
    const drag = store.begin('Drag');
    drag.preview(renameCharacter.run(drag.base, { characterId: 'c1', name: 'c' }));
    expect(store.confirmed.document).toBe(store.document);
  });

  it('leaves no trace when put back', () => {
    const { store, ended, made, show } = preview();
    show('b');
    made.putBack();
    expect(store.document).toBe(start);
    expect(store.undoLabel).toBeUndefined();
    expect(ended).not.toHaveBeenCalled();
  });

  it('a change that is tried is put back and over when something else changes, and says so once', () => {
    const { store, ended, made, show, name } = preview();
    show('b');
    store.apply(renameCharacter, { characterId: 'c1', name: 'c' });
    expect([name(), made.over]).toEqual(['c', true]);
    show('d');
    made.keep();
    store.undo();
    expect(store.document).toBe(start);
    expect(ended).toHaveBeenCalledTimes(1);
  });
});
