/**
 * Keyboard shortcuts, written as people say them, with the platform's command key always as `Ctrl`:
 *
 *     shortcut = { "Ctrl+" | "Alt+" | "Shift+" } key          on a Mac, Ctrl is Cmd
 *     key      = letter | digit | sign | "Space" | "Left" | "Home" | "F2" | …
 *
 * A key is handled by the focused control first, then by the focused panel, then by the page, and never by two of them.
 * Controls and panels that use a key call `preventDefault`; `swallows` lists what the browser handles.
 */
import type { Settings } from './settings.ts';

/** The part of a KeyboardEvent that is needed. */
export interface KeyLike {
  readonly key: string;
  readonly code: string;
  readonly ctrlKey: boolean;
  readonly metaKey: boolean;
  readonly altKey: boolean;
  readonly shiftKey: boolean;
}

const NAMES: Readonly<Record<string, string>> = {
  ' ': 'Space',
  ArrowLeft: 'Left',
  ArrowRight: 'Right',
  ArrowUp: 'Up',
  ArrowDown: 'Down',
};

/**
 * The pressed key as possible shortcuts, most likely first. A sign such as `?` omits Shift, since keyboards differ in
 * how it is typed; a digit is also found by its physical key, since Shift makes it a sign.
 */
export function shortcutsOf(event: KeyLike, mac: boolean): string[] {
  if (mac ? event.ctrlKey : event.metaKey) return [];
  const mod = (mac ? event.metaKey : event.ctrlKey) ? 'Ctrl+' : '';
  const alt = event.altKey ? 'Alt+' : '';
  const shift = event.shiftKey ? 'Shift+' : '';
  const found: string[] = [];
  const key = NAMES[event.key] ?? event.key;
  const isLetter = key.length === 1 && key.toLowerCase() !== key.toUpperCase();
  const isSign = key.length === 1 && !isLetter;
  if (key !== 'Dead' && key !== 'Unidentified') {
    found.push(isSign ? mod + alt + key : mod + alt + shift + (isLetter ? key.toUpperCase() : key));
  }
  const digit = /^(?:Digit|Numpad)(\d)$/.exec(event.code)?.[1];
  if (digit) found.push(mod + alt + shift + digit);
  // On a Mac, Alt turns a letter into another character.
  const letter = /^Key([A-Z])$/.exec(event.code)?.[1];
  if (letter && event.altKey) found.push(mod + alt + shift + letter);
  return [...new Set(found)];
}

/** Whether it is a single character, which can be remapped and switched off. */
export function isSingleKey(shortcut: string): boolean {
  return !/Ctrl\+|Alt\+/.test(shortcut) && /^(Shift\+)?(.|Space)$/u.test(shortcut);
}

/** Text for menus: `Ctrl+Shift+Z`, or `⇧⌘Z` on a Mac. */
export function shortcutText(shortcut: string, mac: boolean): string {
  const parts = shortcut.split(/\+(?=.)/);
  const words = parts.map((part) => KEY_TEXT[part] ?? part);
  if (!mac) return words.join('+');
  const order = ['Ctrl', 'Alt', 'Shift'];
  const modifiers = order.filter((m) => parts.includes(m)).map((m) => MAC_TEXT[m]);
  return [...modifiers.reverse(), words.at(-1)].join('');
}

const KEY_TEXT: Readonly<Record<string, string>> = { Left: '←', Right: '→', Up: '↑', Down: '↓', Delete: 'Del' };
const MAC_TEXT: Readonly<Record<string, string>> = { Ctrl: '⌘', Alt: '⌥', Shift: '⇧' };

/** Format of `aria-keyshortcuts`. */
export function ariaShortcut(shortcut: string, mac: boolean): string {
  const names: Record<string, string> = {
    Ctrl: mac ? 'Meta' : 'Control',
    Left: 'ArrowLeft',
    Right: 'ArrowRight',
    Up: 'ArrowUp',
    Down: 'ArrowDown',
  };
  return shortcut
    .split(/\+(?=.)/)
    .map((part) => names[part] ?? part)
    .join('+');
}

/** Something with shortcuts. */
export interface Bindable {
  readonly id: string;
  readonly shortcuts?: readonly string[];
  /** Only while this panel has the focus; otherwise everywhere. */
  readonly panel?: string;
}

/** The current shortcuts of an action, including the user's changes. */
export function shortcutsFor(action: Bindable, settings: Pick<Settings, 'keys' | 'singleKeys'>): readonly string[] {
  const keys = settings.keys[action.id] ?? action.shortcuts ?? [];
  return settings.singleKeys ? keys : keys.filter((key) => !isSingleKey(key));
}

/**
 * The action of a key: the focused panel's before the page's. If two have the same key the remapped one wins, as the
 * user intended.
 */
export function actionFor<A extends Bindable>(
  pressed: readonly string[],
  actions: readonly A[],
  panel: string | undefined,
  settings: Pick<Settings, 'keys' | 'singleKeys'>,
): A | undefined {
  for (const shortcut of pressed) {
    const having = actions.filter((a) => shortcutsFor(a, settings).includes(shortcut));
    for (const scope of panel === undefined ? [undefined] : [panel, undefined]) {
      const inScope = having.filter((a) => a.panel === scope);
      const found = inScope.find((a) => a.id in settings.keys) ?? inScope[0];
      if (found) return found;
    }
  }
  return undefined;
}

/**
 * Assigns shortcuts to an action, and removes them from others in the same scope: one key does one thing.
 *
 * @returns all changed shortcuts, and which action has lost one
 */
export function withShortcut<A extends Bindable>(
  actions: readonly A[],
  keys: Settings['keys'],
  action: A,
  own: readonly string[],
): { readonly keys: Settings['keys']; readonly losers: readonly A[] } {
  const given = { ...keys, [action.id]: own };
  const losers = actions.filter((other) => {
    if (other.id === action.id || other.panel !== action.panel) return false;
    const has = keys[other.id] ?? other.shortcuts ?? [];
    const left = has.filter((key) => !own.includes(key));
    if (left.length < has.length) given[other.id] = left;
    return left.length < has.length;
  });
  return { keys: given, losers };
}

/** Kind of the focused control, as far as keys matter; `untyped` is a text field in which nothing was typed yet. */
export type FocusKind = 'text' | 'untyped' | 'select' | 'range' | 'press' | 'none';

/** Commands that a text field handles itself, with Ctrl. */
const TEXT_COMMANDS = new Set(['A', 'C', 'V', 'X', 'Z', 'Y', 'Left', 'Right', 'Up', 'Down', 'Home', 'End']);

/** Keys that move a slider. */
const RANGE_KEYS = new Set(['Left', 'Right', 'Up', 'Down', 'Home', 'End', 'PageUp', 'PageDown']);

/** Whether the focused control uses the key itself. */
export function swallows(focus: FocusKind, event: KeyLike, mac: boolean): boolean {
  if (focus === 'none') return false;
  const key = NAMES[event.key] ?? event.key;
  if (focus === 'range') return RANGE_KEYS.has(key) && !event.ctrlKey && !event.metaKey && !event.altKey;
  if (focus === 'press') return key === 'Space' || key === 'Enter';
  if (/^F\d+$/.test(key)) return false;
  const command = mac ? event.metaKey : event.ctrlKey;
  // AltGr types characters, and browsers report it as Ctrl+Alt.
  if (!command || event.altKey) return true;
  // A select has nothing to copy, paste or undo.
  if (focus === 'select') return RANGE_KEYS.has(key);
  const name = key.length === 1 ? key.toUpperCase() : key;
  // Nothing typed, so nothing to undo in the field: undo the last step.
  if (focus === 'untyped' && (name === 'Z' || name === 'Y')) return false;
  return TEXT_COMMANDS.has(name) || key === 'Backspace' || key === 'Delete';
}
