/**
 * The `?` page: the essential shortcuts first, then all by group, found by name or by pressing a key. All single keys
 * can be switched off.
 */

import { actionsOf } from '../../state/actions/action.ts';
import { GROUPS } from '../../state/menus.ts';
import { shortcutsFor, shortcutsOf, shortcutText } from '../../state/shortcuts.ts';
import type { Action, Uses } from '../../state/workbench.ts';
import type { DialogContent } from '../../widgets/dialog.ts';
import { button, element, uniqueId, write } from '../../widgets/dom.ts';
import { isMac } from '../../widgets/focus/keyboard.ts';
import { findActions } from './command-search.ts';
import { ESSENTIALS } from './essential-shortcuts.ts';
import { MOUSE_GESTURES, macText } from './mouse-gestures.ts';
import { actionLine, keysOf, nameOf, type Refresh, shortcutLine } from './shortcut-lines.ts';

type Parts = Uses<'actions' | 'settings'>;

/** An entry of the list at the left, and what is beside it. */
interface Chapter {
  readonly name: string;
  readonly count: number;
  sections(): readonly HTMLElement[];
}

/** What is looked for; nothing: the chosen chapter is shown. */
interface Search {
  readonly text: string;
  /** A pressed key, as possible shortcuts. */
  readonly pressed?: readonly string[];
}

export function shortcutsPage(wb: Parts): DialogContent {
  const said = element('p', { class: 'shortcut-said', role: 'status' });
  const foot = element('div', { class: 'shortcut-foot' });
  const list = element('div', { class: 'shortcut-chapters', role: 'tablist', 'aria-orientation': 'vertical' });
  const sections = element('div', { class: 'shortcut-sections' });
  const shown = element('div', { class: 'shortcut-shown scrolls', role: 'tabpanel', tabindex: 0 }, sections);
  shown.id = uniqueId('shortcuts');
  let chosen = 0;
  let search: Search = { text: '' };
  const chapters = () => chaptersOf(wb, show);
  const show = (news = '') => {
    said.textContent = news;
    foot.replaceChildren(...footOf(wb, show), said);
    const all = chapters();
    const isSearching = search.text !== '';
    const tabs = all.map(({ name, count }, i) => tabOf(name, count, !isSearching && i === chosen, shown.id));
    tabs.forEach((tab, i) => {
      write(tab, 'tabIndex', i === chosen ? 0 : -1);
      tab.addEventListener('click', () => choose(i));
    });
    list.replaceChildren(...tabs);
    shown.ariaLabel = isSearching ? 'Found shortcuts' : all[chosen].name;
    sections.replaceChildren(...(isSearching ? foundSections(wb, search, show) : all[chosen].sections()));
  };
  const choose = (index: number) => {
    const count = list.children.length;
    chosen = (index + count) % count;
    field.value = '';
    search = { text: '' };
    show();
    shown.scrollTop = 0;
    // All were made again.
    list.querySelectorAll<HTMLElement>('[role=tab]')[chosen]?.focus();
  };
  list.addEventListener('keydown', (event) => {
    const step = event.key === 'ArrowDown' ? 1 : event.key === 'ArrowUp' ? -1 : 0;
    if (!step) return;
    event.preventDefault();
    choose(chosen + step);
  });
  const field = searchField((next) => {
    search = next;
    show();
    shown.scrollTop = 0;
  });
  show();
  const body = element('div', { class: 'shortcuts' }, field, list, shown, foot);
  return { title: 'Shortcuts', body, kind: 'shortcuts-dialog' };
}

function tabOf(name: string, count: number, isChosen: boolean, controls: string): HTMLElement {
  return element(
    'button',
    { type: 'button', role: 'tab', 'aria-selected': String(isChosen), 'aria-controls': controls },
    name,
    ' ',
    element('span', { class: 'faint' }, String(count)),
  );
}

/** Typed text is a name; keys that type nothing, and the first character, are also looked for as keys. */
function searchField(found: (search: Search) => void): HTMLInputElement {
  const field = element('input', {
    type: 'search',
    'aria-label': 'Search shortcuts by name or press a key',
    placeholder: 'Search by name or press a key',
    spellcheck: 'false',
    autocomplete: 'off',
    autofocus: true,
  });
  /** The field has a key, not a name that is typed. */
  let pressed: readonly string[] | undefined;
  const look = () => found({ text: field.value, ...(pressed && { pressed }) });
  field.addEventListener('keydown', (event) => {
    const { key, ctrlKey, altKey, metaKey } = event;
    if (event.isComposing || UNSOUGHT.test(key)) return;
    // In a name they edit it.
    if (field.value !== '' && !pressed) return;
    const isTyped = key.length === 1 && key !== ' ' && !ctrlKey && !altKey && !metaKey;
    if (isTyped && field.value.length === 1) {
      // After a single character, another one: both begin a name.
      pressed = undefined;
      return;
    }
    if (key === 'Backspace' && field.value !== '') {
      pressed = undefined;
      field.value = '';
    } else {
      pressed = shortcutsOf(event, isMac);
      field.value = isTyped ? '' : shortcutText(pressed[0] ?? '', isMac);
    }
    if (isTyped) return;
    event.preventDefault();
    look();
  });
  field.addEventListener('input', () => {
    if (field.value === '') pressed = undefined;
    look();
  });
  return field;
}

/** Keys that lead out of the field, or are only held. */
const UNSOUGHT = /^(Shift|Control|Alt|AltGraph|Meta|CapsLock|Dead|Tab|Escape|Enter)$/;

function chaptersOf(wb: Parts, refresh: Refresh): readonly Chapter[] {
  const actions = actionsOf(wb).filter((action) => action.shortcuts?.length);
  const groups = GROUPS.flatMap((group): Chapter[] => {
    const own = actions.filter((action) => action.group === group);
    if (own.length === 0) return [];
    return [{ name: group, count: own.length, sections: () => panelSections(wb, own, refresh) }];
  });
  const gestures = MOUSE_GESTURES.reduce((sum, { lines }) => sum + lines.length, 0);
  const essentials = ESSENTIALS.reduce((sum, { lines }) => sum + lines.length, 0);
  return [
    { name: 'Essentials', count: essentials, sections: () => essentialSections(wb, refresh) },
    ...groups,
    { name: 'Mouse and touch', count: gestures, sections: () => MOUSE_GESTURES.map(mouseSection) },
  ];
}

function essentialSections(wb: Parts, refresh: Refresh): HTMLElement[] {
  const actions = actionsOf(wb);
  const keys = (id: string) => {
    const action = actions.find((one) => one.id === id);
    return action ? [...keysOf(wb, action, refresh, 1).children] : [];
  };
  return ESSENTIALS.map(({ where, lines }) =>
    sectionOf(
      where,
      lines.map(({ what, ids = [], how }) =>
        shortcutLine(
          what,
          how === undefined ? element('span', { class: 'shortcut-keys' }, ...ids.flatMap(keys)) : gestureText(how),
        ),
      ),
    ),
  );
}

/** Shortcuts of a single panel are listed under its name. */
function panelSections(wb: Parts, actions: readonly Action[], refresh: Refresh): HTMLElement[] {
  return [...new Set(actions.map(({ panel }) => panel))].map((panel) =>
    sectionOf(
      panel === undefined ? 'Anywhere' : `In the ${panel}`,
      actions.filter((action) => action.panel === panel).map((action) => actionLine(wb, action, refresh)),
    ),
  );
}

function foundSections(wb: Parts, search: Search, refresh: Refresh): HTMLElement[] {
  const { actions, gestures } = foundShortcuts(wb, search);
  const groups = GROUPS.map((group) => ({ group, own: actions.filter((action) => action.group === group) }));
  const made = groups.flatMap(({ group, own }) =>
    own.length > 0
      ? [
          sectionOf(
            group,
            own.map((action) => actionLine(wb, action, refresh)),
          ),
        ]
      : [],
  );
  const mouse = gestures.map(mouseSection);
  if (made.length + mouse.length > 0) return [...made, ...mouse];
  return [element('p', { class: 'empty' }, search.pressed ? 'This key does nothing yet' : 'No shortcut has this name')];
}

/** Actions and gestures by a pressed key, which nothing else is asked, or by the words of a name. */
export function foundShortcuts(wb: Parts, { text, pressed }: Search) {
  if (pressed) {
    const settings = wb.settings.get();
    const has = (action: Action) => shortcutsFor(action, settings).some((key) => pressed.includes(key));
    return { actions: actionsOf(wb).filter(has), gestures: [] };
  }
  const actions = actionsOf(wb).filter((action) => action.shortcuts?.length);
  const found = findActions(
    actions,
    text,
    (action) => `${nameOf(wb, action)} ${action.group}`,
    () => false,
    ({ also = '' }) => also,
  );
  const gestures = MOUSE_GESTURES.flatMap(({ where, lines }) => {
    const own = findActions(lines, text, ([what, how]) => `${what} ${how}`);
    return own.length > 0 ? [{ where, lines: own }] : [];
  });
  return { actions: found, gestures };
}

function sectionOf(title: string, lines: readonly HTMLElement[]): HTMLElement {
  return element('section', {}, element('h3', {}, title), ...lines);
}

function mouseSection({ where, lines }: (typeof MOUSE_GESTURES)[number]): HTMLElement {
  return sectionOf(
    where,
    lines.map(([what, how]) => shortcutLine(what, gestureText(how))),
  );
}

function gestureText(how: string): HTMLElement {
  return element('span', { class: 'faint' }, isMac ? macText(how) : how);
}

function footOf(wb: Uses<'settings'>, refresh: Refresh): HTMLElement[] {
  const box = element('input', { type: 'checkbox' });
  box.checked = wb.settings.get().singleKeys;
  box.addEventListener('change', () => {
    wb.settings.update((s) => ({ ...s, singleKeys: box.checked }));
    refresh();
  });
  const reset = button('Reset all', { class: 'link', tooltip: 'Reset all shortcuts to default' }, 'Reset all', () => {
    wb.settings.update((s) => ({ ...s, keys: {}, singleKeys: true }));
    refresh();
  });
  write(reset, 'disabled', Object.keys(wb.settings.get().keys).length === 0 && wb.settings.get().singleKeys);
  return [
    element('label', {}, box, 'Single-key shortcuts'),
    element('span', { class: 'faint' }, 'Click a single-key shortcut and press a new key. Delete removes it.'),
    reset,
  ];
}
