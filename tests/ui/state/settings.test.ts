import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { DEFAULT_SETTINGS, parseSettings, rememberedSettings } from '../../../src/ui/state/settings.ts';

describe('parseSettings', () => {
  it.each([null, '', 'not json', '[]', '42', '{"panels":7,"display":[],"keys":"x","folds":null}'])(
    'gives the defaults for %s',
    (text) => {
      expect(parseSettings(text)).toEqual(DEFAULT_SETTINGS);
    },
  );

  it('parseSettings reads back what was written', () => {
    const settings = {
      ...DEFAULT_SETTINGS,
      theme: 'light' as const,
      angles: 'radians' as const,
      display: { ...DEFAULT_SETTINGS.display, skin: 'xray' as const, grid: false },
      panels: { ...DEFAULT_SETTINGS.panels, outlinerWidth: 300, inspectorOpen: false },
      gizmoScale: 1.5,
      measured: { quantity: 'contact', subject: 'mass' },
      folds: { 'inspector/all': true },
      keys: { 'draw.axes': ['Q'], 'draw.grid': [] },
      singleKeys: false,
    };
    expect(parseSettings(JSON.stringify(settings))).toEqual(settings);
  });

  it('takes the good parts and leaves the rest', () => {
    const text = JSON.stringify({
      theme: 'pink',
      angles: 'radians',
      display: { skin: 'glass', grid: 'yes', bones: true },
      gizmoScale: 40,
      measured: { quantity: 3, subject: 'mass' },
      panels: { outlinerWidth: -5, inspectorWidth: 1e9, filesHeight: 100 },
      folds: { a: true, b: 'no' },
      keys: { a: ['X'], b: [3] },
    });
    expect(parseSettings(text)).toEqual({
      ...DEFAULT_SETTINGS,
      angles: 'radians',
      display: { ...DEFAULT_SETTINGS.display, bones: true },
      panels: { ...DEFAULT_SETTINGS.panels, filesHeight: 100 },
      measured: { quantity: 'speed', subject: 'mass' },
      folds: { a: true },
      keys: { a: ['X'] },
    });
  });

  it('parseSettings never begins with a camera that follows, or a drawer over the viewport', () => {
    const settings = parseSettings(
      JSON.stringify({ display: { follow: true }, panels: { drawer: 'outliner', timelineDrawer: true } }),
    );
    expect(settings.display.follow).toBe(false);
    expect(settings.panels.drawer).toBe('none');
    expect(settings.panels.timelineDrawer).toBe(false);
  });
});

describe('rememberedSettings', () => {
  beforeEach(() => void vi.useFakeTimers());
  afterEach(() => void vi.useRealTimers());

  function storage() {
    const kept = new Map<string, string>();
    const writes: string[] = [];
    const store = {
      getItem: (key: string) => kept.get(key) ?? null,
      setItem: (key: string, value: string) => {
        kept.set(key, value);
        writes.push(value);
      },
    };
    // The part of a Storage that is used.
    return { store: store as unknown as Storage, writes };
  }

  it('rememberedSettings is next time what it was left as', () => {
    const { store } = storage();
    rememberedSettings(() => store).update((s) => ({ ...s, theme: 'dark' }));
    vi.runAllTimers();
    expect(rememberedSettings(() => store).get().theme).toBe('dark');
  });

  it('rememberedSettings writes a drag once', () => {
    const { store, writes } = storage();
    const settings = rememberedSettings(() => store);
    for (let width = 200; width < 300; width++) {
      settings.update((s) => ({ ...s, panels: { ...s.panels, outlinerWidth: width } }));
    }
    vi.runAllTimers();
    expect(writes).toHaveLength(1);
    expect(parseSettings(writes[0]).panels.outlinerWidth).toBe(299);
  });

  it('works where the browser forbids storage', () => {
    const settings = rememberedSettings(() => {
      throw new Error('SecurityError');
    });
    settings.update((s) => ({ ...s, theme: 'dark' }));
    expect(() => vi.runAllTimers()).not.toThrow();
    expect(settings.get().theme).toBe('dark');
  });
});

it('bones are never thinner than a quarter of their width, nor thicker than four times, whatever was kept', () => {
  const kept = (boneThickness: unknown) => parseSettings(JSON.stringify({ display: { boneThickness } })).display;
  expect(kept(0).boneThickness).toBe(0.25);
  expect(kept(2.5).boneThickness).toBe(2.5);
  expect(kept(100).boneThickness).toBe(4);
  expect(kept('thick').boneThickness).toBe(1);
});
