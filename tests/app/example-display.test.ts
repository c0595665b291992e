import { describe, expect, it } from 'vitest';
import { SampleDisplay } from '../../src/app/example-display.ts';
import { Store } from '../../src/edit/store.ts';
import { EMPTY_DOCUMENT } from '../../src/model/document.ts';
import { DEFAULT_SETTINGS } from '../../src/ui/state/settings.ts';
import { observable } from '../../src/ui/widgets/observable.ts';
import { character } from '../ui/builders.ts';

describe('what a sample asks to be drawn', () => {
  const settings = () => {
    const all = observable(DEFAULT_SETTINGS);
    const store = new Store();
    const display = new SampleDisplay(all, store);
    const names = () => all.get().display.names;
    const setNames = (on: boolean) => all.update((now) => ({ ...now, display: { ...now.display, names: on } }));
    const show = (...ids: string[]) => {
      const known = new Map(store.document.characters.map((c) => [c.id, c]));
      const characters = ids.map((id) => known.get(id) ?? character({ id }));
      store.apply({ id: 'test', label: () => 'Open', run: () => ({ ...EMPTY_DOCUMENT, characters }) }, undefined);
    };
    return { all, names, setNames, store, show, display, open: display.show.bind(display) };
  };

  it('display options of an example apply until another example opens', () => {
    const { names, open, all } = settings();
    open({ names: true });
    expect(names()).toBe(true);
    open();
    expect(names()).toBe(false);
    expect(all.get().display).toEqual(DEFAULT_SETTINGS.display);
  });

  it('display options of an example are restored when any other character opens', () => {
    const { names, open, show } = settings();
    show('a');
    open({ names: true });
    show('a', 'sample');
    expect(names()).toBe(true);
    show('a', 'sample', 'b');
    expect(names()).toBe(false);
  });

  it('display options of an example are restored when it is removed, and not when others are', () => {
    const { names, open, show, store } = settings();
    show('a');
    open({ names: true });
    show('a', 'sample');
    show('sample');
    expect(names()).toBe(true);
    store.undo();
    store.undo();
    expect(names()).toBe(false);
  });

  it('display options of an example come back with it by undo, as they were left, and go again by redo', () => {
    const { names, open, show, store, setNames } = settings();
    open({ names: true, bones: false });
    show('sample');
    show('sword');
    expect(names()).toBe(false);
    store.undo();
    expect(names()).toBe(true);
    store.redo();
    expect(names()).toBe(false);
    store.undo();
    setNames(false);
    show('sample', 'sword');
    store.undo();
    expect(names()).toBe(false);
  });

  it('display options of an example are not remembered', () => {
    const { all, names, setNames, open, display } = settings();
    open({ names: true });
    expect(names()).toBe(true);
    expect(display.without(all.get())).toEqual(DEFAULT_SETTINGS);
    open();
    setNames(true);
    expect(display.without(all.get()).display.names).toBe(true);
  });

  it('display options keep what the user sets', () => {
    const { names, setNames, open } = settings();
    setNames(true);
    open({ names: true });
    open();
    expect(names()).toBe(true);
    setNames(false);
    open({ names: true });
    setNames(false);
    open();
    expect(names()).toBe(false);
  });
});
