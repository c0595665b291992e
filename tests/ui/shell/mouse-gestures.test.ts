import { describe, expect, it } from 'vitest';
import { ACTIONS } from '../../../src/ui/shell/actions.ts';
import { MOUSE_GESTURES, macText } from '../../../src/ui/shell/mouse-gestures.ts';
import { DEFAULT_SETTINGS } from '../../../src/ui/state/settings.ts';
import { actionFor, shortcutsFor } from '../../../src/ui/state/shortcuts.ts';

describe('what the mouse does', () => {
  it('what the mouse does is listed once in each place', () => {
    for (const { lines } of MOUSE_GESTURES) {
      const names = lines.map(([what]) => what);
      expect(new Set(names).size).toBe(names.length);
    }
  });

  it('what the mouse does is told a Mac by its own keys', () => {
    expect(macText('Ctrl+click or Alt+drag')).toBe('⌘ click or ⌥ drag');
    expect(macText('Shift+wheel')).toBe('Shift+wheel');
  });
});

describe('what keys do in the plot', () => {
  it.each([
    ['S', 'timeline.scaleDrag'],
    ['Enter', 'timeline.insertKey'],
  ])('%s is an action, found on the page of shortcuts', (key, id) => {
    expect(actionFor([key], ACTIONS, 'timeline', DEFAULT_SETTINGS)?.id).toBe(id);
  });

  it('scaling goes with the other single keys, and can be given another one', () => {
    const action = ACTIONS.find((a) => a.id === 'timeline.scaleDrag');
    expect(action && shortcutsFor(action, { ...DEFAULT_SETTINGS, singleKeys: false })).toEqual([]);
    const keys = { 'timeline.scaleDrag': ['X'] };
    expect(actionFor(['X'], ACTIONS, 'timeline', { ...DEFAULT_SETTINGS, keys })?.id).toBe('timeline.scaleDrag');
  });
});
