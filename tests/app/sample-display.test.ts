import { describe, expect, it } from 'vitest';
import { sampleDisplay } from '../../src/app/sample-display.ts';
import { observable } from '../../src/ui/observable.ts';
import { DEFAULT_SETTINGS } from '../../src/ui/settings.ts';

describe('what a sample asks to be drawn', () => {
  const settings = () => {
    const all = observable(DEFAULT_SETTINGS);
    const names = () => all.get().display.names;
    const setNames = (on: boolean) => all.update((now) => ({ ...now, display: { ...now.display, names: on } }));
    return { all, names, setNames, open: sampleDisplay(all) };
  };

  it('is drawn from then on, until another sample opens', () => {
    const { names, open, all } = settings();
    open({ names: true });
    expect(names()).toBe(true);
    open();
    expect(names()).toBe(false);
    expect(all.get().display).toEqual(DEFAULT_SETTINGS.display);
  });

  it('stays as a person has set it', () => {
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
