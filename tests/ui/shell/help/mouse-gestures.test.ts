import { describe, expect, it } from 'vitest';
import { ACTIONS } from '../../../../src/ui/shell/actions.ts';
import { MOUSE_GESTURES, macText } from '../../../../src/ui/shell/help/mouse-gestures.ts';
import { TABS } from '../../../../src/ui/shell/timeline/timeline-tabs.ts';
import { findAction, runAction } from '../../../../src/ui/state/actions/action.ts';
import { DEFAULT_SETTINGS } from '../../../../src/ui/state/settings.ts';
import { actionFor, shortcutsFor } from '../../../../src/ui/state/shortcuts.ts';
import { TIMELINE_TABS } from '../../../../src/ui/state/timeline.ts';
import { workbench } from '../../builders.ts';

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

describe('the names of panels', () => {
  it('a tab of the timeline has the same name in the View menu, and on the page of shortcuts if it is there', () => {
    const places = MOUSE_GESTURES.map(({ where }) => where.replace(/^(Mouse )?in (the )?/i, ''));
    const named = Object.values(TABS).map(({ label }) => label.toLowerCase());
    for (const name of ['curve editor', 'dope sheet', 'pose library']) {
      expect(named).toContain(name);
      expect(places).toContain(name);
    }
    const { wb } = workbench();
    for (const name of TIMELINE_TABS) {
      runAction(wb, `page.tab.${name}`);
      expect(wb.timeline.view.get().tab).toBe(name);
      expect(findAction(wb, `page.tab.${name}`)?.label).toBe(TABS[name].label);
    }
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
