import { describe, expect, it } from 'vitest';
import {
  actionFor,
  ariaShortcut,
  isSingleKey,
  type KeyLike,
  shortcutsFor,
  shortcutsOf,
  shortcutText,
  swallows,
  withShortcut,
} from '../../../src/ui/state/shortcuts.ts';

const NO_MODIFIERS = { ctrlKey: false, metaKey: false, altKey: false, shiftKey: false };

function press(key: string, change: Partial<KeyLike> = {}): KeyLike {
  return { key, code: '', ...NO_MODIFIERS, ...change };
}

describe('shortcutsOf', () => {
  it.each<[KeyLike, string]>([
    [press('f'), 'F'],
    [press('F', { shiftKey: true }), 'Shift+F'],
    [press('z', { ctrlKey: true }), 'Ctrl+Z'],
    [press('Z', { ctrlKey: true, shiftKey: true }), 'Ctrl+Shift+Z'],
    [press(' '), 'Space'],
    [press('ArrowLeft'), 'Left'],
    [press('Home'), 'Home'],
    [press('.'), '.'],
    [press('F1'), 'F1'],
  ])('%o is %s', (event, shortcut) => {
    expect(shortcutsOf(event, false)).toContain(shortcut);
  });

  it('knows a sign by what it is, not by how a keyboard types it', () => {
    expect(shortcutsOf(press('?', { shiftKey: true }), false)).toContain('?');
  });

  it('finds Shift with a digit though another sign is typed', () => {
    expect(shortcutsOf(press('!', { shiftKey: true, code: 'Digit1' }), false)).toContain('Shift+1');
    expect(shortcutsOf(press('1', { code: 'Numpad1' }), false)).toEqual(['1']);
  });

  it('takes Cmd for Ctrl on a Mac, and nothing of the other', () => {
    expect(shortcutsOf(press('z', { metaKey: true }), true)).toContain('Ctrl+Z');
    expect(shortcutsOf(press('z', { ctrlKey: true }), true)).toEqual([]);
    expect(shortcutsOf(press('z', { metaKey: true }), false)).toEqual([]);
  });

  it('finds a letter under Alt on a Mac, which types another one', () => {
    expect(shortcutsOf(press('†', { altKey: true, code: 'KeyT' }), true)).toContain('Alt+T');
  });
});

it('writes shortcuts as each platform does', () => {
  expect(shortcutText('Ctrl+Shift+Z', false)).toBe('Ctrl+Shift+Z');
  expect(shortcutText('Ctrl+Shift+Z', true)).toBe('⇧⌘Z');
  expect(shortcutText('Left', false)).toBe('←');
  expect(ariaShortcut('Ctrl+Left', true)).toBe('Meta+ArrowLeft');
});

it('tells single keys from others', () => {
  for (const key of ['F', 'Shift+F', '.', '?', 'Space']) expect(isSingleKey(key)).toBe(true);
  for (const key of ['Ctrl+F', 'Alt+F', 'F1', 'Home', 'Delete', 'Left']) expect(isSingleKey(key)).toBe(false);
});

describe('actionFor', () => {
  const frame = { id: 'frame', shortcuts: ['F'] };
  const remove = { id: 'remove', shortcuts: ['Delete'], panel: 'outliner' };
  const removeKeys = { id: 'removeKeys', shortcuts: ['Delete'], panel: 'curves' };
  const fit = { id: 'fit', shortcuts: ['F'], panel: 'curves' };
  const actions = [frame, remove, removeKeys, fit];
  const asIs = { keys: {}, singleKeys: true };

  it('asks the focused panel before the page', () => {
    expect(actionFor(['F'], actions, 'curves', asIs)).toBe(fit);
    expect(actionFor(['F'], actions, 'outliner', asIs)).toBe(frame);
    expect(actionFor(['F'], actions, undefined, asIs)).toBe(frame);
  });

  it('leaves a panel’s keys alone elsewhere', () => {
    expect(actionFor(['Delete'], actions, undefined, asIs)).toBeUndefined();
    expect(actionFor(['Delete'], actions, 'curves', asIs)).toBe(removeKeys);
  });

  it('gives a key to the action that someone gave it to', () => {
    const settings = { keys: { remove: ['F'] }, singleKeys: true };
    expect(actionFor(['F'], [frame, { id: 'remove', shortcuts: ['Delete'] }], undefined, settings)?.id).toBe('remove');
    expect(shortcutsFor(remove, settings)).toEqual(['F']);
  });

  it('knows no single key once they are off', () => {
    const off = { keys: {}, singleKeys: false };
    expect(actionFor(['F'], actions, 'curves', off)).toBeUndefined();
    expect(actionFor(['Delete'], actions, 'outliner', off)).toBe(remove);
  });

  it('knows no key of an action whose keys were taken away', () => {
    expect(actionFor(['F'], [frame], undefined, { keys: { frame: [] }, singleKeys: true })).toBeUndefined();
  });
});

describe('swallows', () => {
  it('leaves all typing to a text field', () => {
    for (const key of ['f', '?', ' ', 'ArrowLeft', 'Delete', 'Escape', 'Home']) {
      expect(swallows('text', press(key), false)).toBe(true);
    }
  });

  it('leaves a text field its own commands, and takes the page’s', () => {
    for (const key of ['z', 'a', 'c', 'v']) expect(swallows('text', press(key, { ctrlKey: true }), false)).toBe(true);
    for (const key of ['o', 's', 'k']) expect(swallows('text', press(key, { ctrlKey: true }), false)).toBe(false);
    expect(swallows('text', press('F1'), false)).toBe(false);
  });

  it('takes undo and redo of a text field in which nothing was typed, and leaves it the rest', () => {
    for (const key of ['z', 'Z', 'y']) expect(swallows('untyped', press(key, { ctrlKey: true }), false)).toBe(false);
    expect(swallows('untyped', press('z', { metaKey: true }), true)).toBe(false);
    expect(swallows('untyped', press('z'), false)).toBe(true);
    for (const key of ['a', 'c', 'v']) expect(swallows('untyped', press(key, { ctrlKey: true }), false)).toBe(true);
  });

  it('leaves AltGr, which types, to a text field', () => {
    expect(swallows('text', press('@', { ctrlKey: true, altKey: true }), false)).toBe(true);
  });

  it('leaves a slider what moves it, and takes Space and all commands', () => {
    for (const key of ['ArrowLeft', 'PageUp', 'Home']) expect(swallows('range', press(key), false)).toBe(true);
    for (const key of [' ', 'Enter', 'f']) expect(swallows('range', press(key), false)).toBe(false);
    for (const key of ['c', 'V']) expect(swallows('range', press(key, { ctrlKey: true }), false)).toBe(false);
  });

  it('leaves a list of choices its typing, and takes copy, paste and undo', () => {
    for (const key of [' ', 'a', 'ArrowDown']) expect(swallows('select', press(key), false)).toBe(true);
    for (const key of ['c', 'v', 'z']) expect(swallows('select', press(key, { ctrlKey: true }), false)).toBe(false);
  });

  it('leaves a button its Space and Enter only', () => {
    expect(swallows('press', press(' '), false)).toBe(true);
    expect(swallows('press', press('f'), false)).toBe(false);
  });
});

describe('withKeys', () => {
  const bones = { id: 'bones', shortcuts: ['B'] };
  const names = { id: 'names', shortcuts: ['N', 'M'] };
  const remove = { id: 'remove', shortcuts: ['B'], panel: 'outliner' };
  const all = [bones, names, remove];

  it('takes a key from the action that has it in the same scope, and says from which', () => {
    const { keys, losers } = withShortcut(all, {}, names, ['B', 'M']);
    expect(keys).toEqual({ names: ['B', 'M'], bones: [] });
    expect(losers).toEqual([bones]);
  });

  it('leaves the loser its other keys', () => {
    expect(withShortcut(all, {}, bones, ['M']).keys).toEqual({ bones: ['M'], names: ['N'] });
  });

  it('takes nothing where nobody has the key', () => {
    expect(withShortcut(all, { names: ['Q'] }, bones, ['N'])).toEqual({
      keys: { names: ['Q'], bones: ['N'] },
      losers: [],
    });
  });
});
