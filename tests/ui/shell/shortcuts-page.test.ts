import { expect, it } from 'vitest';
import { ACTIONS } from '../../../src/ui/shell/actions.ts';
import { ESSENTIALS } from '../../../src/ui/shell/help/essential-shortcuts.ts';
import { foundShortcuts } from '../../../src/ui/shell/help/shortcuts-page.ts';
import { menuEntries } from '../../../src/ui/state/actions/menu-entries.ts';
import { workbench } from '../builders.ts';

it('the essential shortcuts are some twenty, each of an action that has a key', () => {
  const lines = ESSENTIALS.flatMap((one) => one.lines);
  expect(lines.length).toBeGreaterThanOrEqual(20);
  expect(lines.length).toBeLessThanOrEqual(24);
  for (const { what, ids, how } of lines) {
    expect(ids === undefined, what).toBe(how !== undefined);
    for (const id of ids ?? []) expect(ACTIONS.find((action) => action.id === id)?.shortcuts?.[0], id).toBeDefined();
  }
});

it('shortcuts are found by words of their names, and so are gestures of the mouse', () => {
  const { wb } = workbench();
  const { actions, gestures } = foundShortcuts(wb, { text: 'mirror pose' });
  expect(actions[0]?.id).toBe('pose.mirror');
  expect(gestures).toEqual([]);
  const pins = foundShortcuts(wb, { text: 'remove a pin' });
  expect(pins.gestures.flatMap(({ lines }) => lines.map(([what]) => what))).toContain('Pin a point, or remove a pin');
  expect(foundShortcuts(wb, { text: 'no such thing' })).toEqual({ actions: [], gestures: [] });
});

it('a pressed key finds what it does in each panel, also once it was remapped', () => {
  const { wb } = workbench();
  const found = (...pressed: string[]) => foundShortcuts(wb, { text: 'x', pressed }).actions.map(({ id }) => id);
  expect(found('F')).toEqual(expect.arrayContaining(['view.frameSelection', 'timeline.fitSelected']));
  expect(found('Ctrl+Z')).toEqual(['edit.undo']);
  wb.settings.update((s) => ({ ...s, keys: { 'edit.undo': ['Q'] } }));
  expect(found('Ctrl+Z')).toEqual([]);
  expect(found('Q')).toContain('edit.undo');
});

it('the entries of the menu Keys that delete say what they delete', () => {
  const { wb } = workbench();
  const labels = menuEntries(wb, 'Keys').flatMap((entry) => (entry.kind === 'item' ? [entry.label] : []));
  expect(labels).toContain('Delete selected keys');
  expect(new Set(labels).size).toBe(labels.length);
  expect(labels.filter((label) => /^Delete keys$|^Delete$/.test(label))).toEqual([]);
});
