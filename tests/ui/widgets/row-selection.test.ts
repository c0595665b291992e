import { expect, it } from 'vitest';
import { type PressedKey, RowSelection, type RowSelectionParts } from '../../../src/ui/widgets/table/row-selection.ts';

const NONE = { shiftKey: false, ctrlKey: false, metaKey: false, altKey: false };
const SHIFT = { ...NONE, shiftKey: true };
const CTRL = { ...NONE, ctrlKey: true };
const ROWS = ['a', 'b', 'c', 'd', 'e'];
const PAGE = 3;

/** A list in which several rows can be selected, and what it was told. */
function listOf(rows: readonly string[] = ROWS, more: Partial<RowSelectionParts<string>> = {}) {
  const told: string[] = [];
  const picks = new RowSelection<string>({
    keyOf: (row) => row,
    selectOnly: (row) => told.push(`only ${row}`),
    toggle: (row) => told.push(`toggle ${row}`),
    selectRange: (all, to, adds) => told.push(`${adds ? 'add' : 'range'} ${all.join('')} to ${to}`),
    focus: (row) => told.push(`focus ${row}`),
    selectAll: (all) => told.push(`all ${all.join('')}`),
    ...more,
  });
  picks.show(rows);
  /** What a key does, and `-` if it isn't taken. */
  const press = (key: string, modifiers: Omit<PressedKey, 'key'> = NONE, page: number | undefined = PAGE) =>
    picks.takesKey({ ...modifiers, key }, page) ? told.splice(0).join() : `-${told.splice(0).join()}`;
  const click = (row: string, modifiers = NONE) => {
    picks.pressed(row, modifiers);
    return told.splice(0).join();
  };
  return { picks, press, click };
}

it('arrows, pages and both ends go to a row and select it, and stop at the ends', () => {
  const { press, picks } = listOf();
  const keys = ['ArrowDown', 'ArrowDown', 'PageDown', 'ArrowDown', 'ArrowUp', 'PageUp', 'ArrowUp', 'End', 'Home'];
  expect(keys.map((key) => press(key))).toEqual(
    ['a', 'b', 'e', 'e', 'd', 'a', 'a', 'e', 'a'].map((row) => `only ${row}`),
  );
  expect(picks.focused).toBe('a');
});

it('Shift extends from where the range began, there and back, by click and by key', () => {
  const { press, click } = listOf();
  expect(click('c')).toBe('only c');
  expect(press('ArrowDown', SHIFT)).toBe('range cd to d');
  expect(press('End', SHIFT)).toBe('range cde to e');
  expect(click('a', SHIFT)).toBe('range abc to a');
  expect(press('ArrowDown', SHIFT)).toBe('range bc to b');
  // The next one begins anew.
  expect(press('ArrowDown')).toBe('only c');
  expect(press('ArrowUp', SHIFT)).toBe('range bc to b');
});

it('a range begins at the focused row if nothing else began one, and at its own row if that is gone', () => {
  const { press, picks, click } = listOf();
  picks.focusedKey = 'b';
  expect(press('ArrowDown', SHIFT)).toBe('range bc to c');
  click('e');
  picks.show(['a', 'b']);
  expect(click('b', SHIFT)).toBe('range b to b');
});

it('Ctrl toggles by click and with Space, a range begins there, and Ctrl with Shift adds the range', () => {
  const { press, click } = listOf();
  expect(click('b', CTRL)).toBe('toggle b');
  expect(click('d', { ...SHIFT, ctrlKey: true })).toBe('add bcd to d');
  expect(press(' ', CTRL)).toBe('toggle d');
  expect(press('ArrowDown', SHIFT)).toBe('range de to e');
  // Space alone plays.
  expect(press(' ')).toBe('-');
});

it('Ctrl with arrows moves without selecting, and leaves where a range begins', () => {
  const { press, click } = listOf();
  click('a');
  expect(press('ArrowDown', CTRL)).toBe('focus b');
  expect(press('ArrowDown', CTRL)).toBe('focus c');
  expect(press('ArrowDown', SHIFT)).toBe('range abcd to d');
});

it('Ctrl+A selects all, and is another’s where the list has no such thing, or no rows', () => {
  expect(listOf().press('a', CTRL)).toBe('all abcde');
  expect(listOf().press('A', { ...CTRL, shiftKey: true })).toBe('-');
  expect(listOf([]).press('a', CTRL)).toBe('-');
  const { selectAll: _, ...without } = { selectAll: undefined };
  expect(
    new RowSelection<string>({ keyOf: String, selectOnly() {}, toggle() {}, ...without }).takesKey(
      { ...CTRL, key: 'a' },
      1,
    ),
  ).toBe(false);
});

it('a list of one selected row knows no ranges, and no keys with Ctrl', () => {
  const picks = new RowSelection<string>({ keyOf: String, selectOnly: (row) => told.push(row) });
  const told: string[] = [];
  picks.show(ROWS);
  picks.pressed('b', SHIFT);
  picks.pressed('c', CTRL);
  expect(picks.takesKey({ ...SHIFT, key: 'ArrowDown' }, PAGE)).toBe(true);
  expect(picks.takesKey({ ...CTRL, key: 'ArrowDown' }, PAGE)).toBe(false);
  expect(told).toEqual(['b', 'c', 'd']);
});

it('where keys only go to rows, clicks select them, and modified arrows are another’s', () => {
  const { press, click, picks } = listOf(ROWS, { keysOnlyFocus: true });
  expect(click('b')).toBe('only b');
  expect(press('ArrowDown')).toBe('focus c');
  expect([press('ArrowDown', SHIFT), press('ArrowDown', CTRL), press(' ', CTRL), press('a', CTRL)]).toEqual([
    '-',
    '-',
    '-',
    '-',
  ]);
  expect(picks.focused).toBe('c');
  expect(click('d', SHIFT)).toBe('range bcd to d');
});

it('pages are the owner’s if it says so, keys with Alt always, and ⌘ is no Ctrl here', () => {
  const { press } = listOf();
  expect(listOf().picks.takesKey({ ...NONE, key: 'PageDown' }, undefined)).toBe(false);
  expect(listOf().picks.takesKey({ ...NONE, key: 'End' }, undefined)).toBe(true);
  expect([
    press('ArrowUp', { ...NONE, altKey: true }),
    press('ArrowUp', { ...NONE, metaKey: true }),
    press('x'),
  ]).toEqual(['-', '-', '-']);
});

it('what was told may make another row of it, and the row that was clicked has the keyboard', () => {
  const { picks, press } = listOf(ROWS, {
    selectOnly: () => {
      picks.focusedKey = picks.anchor = 'a';
    },
  });
  picks.pressed('d', NONE);
  expect(picks.focused).toBe('d');
  expect(press('ArrowDown', SHIFT)).toBe('range de to e');
});
