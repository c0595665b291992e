/**
 * The `?` page: every action by group, with its shortcuts. Single keys can be remapped or switched off, one by one or
 * all at once; changed ones are marked and can be reset.
 */

import { actionLabel, actionsOf } from '../../state/actions/action.ts';
import { GROUPS } from '../../state/menus.ts';
import { isSingleKey, shortcutsOf, shortcutText, withShortcut } from '../../state/shortcuts.ts';
import type { Action, Uses } from '../../state/workbench.ts';
import type { DialogContent } from '../../widgets/dialog.ts';
import { button, element } from '../../widgets/dom.ts';
import { isMac } from '../../widgets/focus/keyboard.ts';
import { icon } from '../../widgets/icons.ts';
import { MOUSE_GESTURES, macText } from './mouse-gestures.ts';

/** Rebuilds the page, with a sentence about the last change. */
type Refresh = (news?: string) => void;

export function shortcutsPage(wb: Uses<'actions' | 'settings'>): DialogContent {
  const body = element('div', { class: 'shortcuts' });
  const said = element('p', { class: 'shortcut-said', role: 'status' });
  const show = (news = '') => {
    said.textContent = news;
    body.replaceChildren(switches(wb, said, show), ...groups(wb, show), ...mouseGroups());
  };
  show();
  return { title: 'Shortcuts', body, kind: 'shortcuts-dialog' };
}

function switches(wb: Uses<'settings'>, said: HTMLElement, refresh: Refresh): HTMLElement {
  const box = element('input', { type: 'checkbox' });
  box.checked = wb.settings.get().singleKeys;
  box.addEventListener('change', () => {
    wb.settings.update((s) => ({ ...s, singleKeys: box.checked }));
    refresh();
  });
  const reset = button(
    'Reset all to default',
    { class: 'link', tooltip: 'Reset all shortcuts to default' },
    'Reset all to default',
    () => {
      wb.settings.update((s) => ({ ...s, keys: {}, singleKeys: true }));
      refresh();
    },
  );
  reset.disabled = Object.keys(wb.settings.get().keys).length === 0 && wb.settings.get().singleKeys;
  const hint = 'Click a single-key shortcut below and press a new key. Delete removes it.';
  return element(
    'div',
    { class: 'shortcut-switches' },
    element('label', {}, box, 'Single-key shortcuts'),
    element('span', { class: 'faint' }, hint),
    reset,
    said,
  );
}

/** A section per group; shortcuts of a single panel are listed under its name. */
function groups(wb: Uses<'actions' | 'settings'>, refresh: Refresh): HTMLElement[] {
  const actions = actionsOf(wb).filter((action) => action.shortcuts?.length);
  return GROUPS.flatMap((group) => {
    const own = actions.filter((action) => action.group === group);
    const section = element('section', {}, element('h3', {}, group));
    for (const panel of new Set([undefined, ...own.map((action) => action.panel)])) {
      const held = own.filter((action) => action.panel === panel);
      if (panel !== undefined) section.append(element('h4', {}, `In the ${panel}`));
      section.append(...held.map((action) => line(wb, action, refresh)));
    }
    return own.length > 0 ? [section] : [];
  });
}

function line(wb: Uses<'actions' | 'settings'>, action: Action, refresh: Refresh): HTMLElement {
  const { keys, singleKeys } = wb.settings.get();
  const now = keys[action.id] ?? action.shortcuts ?? [];
  const label = action.name ?? actionLabel(wb, action);
  const cell = element('span', { class: 'shortcut-keys' });
  for (const shortcut of now) {
    const text = shortcutText(shortcut, isMac);
    if (isSingleKey(shortcut)) cell.append(changeable(wb, action, shortcut, text, singleKeys, refresh));
    else cell.append(element('kbd', {}, text));
  }
  if (!now.length) cell.append(changeable(wb, action, undefined, 'none', singleKeys, refresh));
  if (action.id in keys) {
    const back = button(`Reset ${label} to default`, { class: 'tool small' }, icon('close'), () => {
      const news = give(wb, action, action.shortcuts ?? []);
      wb.settings.update((s) => ({ ...s, keys: without(s.keys, action.id) }));
      refresh(news);
    });
    cell.append(back);
  }
  return element('div', { class: 'shortcut-line' }, element('span', {}, label), cell);
}

/** A button that waits for the new key once pressed. */
function changeable(
  wb: Uses<'actions' | 'settings'>,
  action: Action,
  shortcut: string | undefined,
  text: string,
  enabled: boolean,
  refresh: Refresh,
): HTMLElement {
  const key = element('button', { type: 'button', class: 'key', 'aria-label': `${text}: press to change` }, text);
  key.disabled = !enabled;
  const replaceBy = (next: string | undefined) => {
    const own = wb.settings.get().keys[action.id] ?? action.shortcuts ?? [];
    const kept = own.filter((k) => k !== shortcut && k !== next);
    refresh(give(wb, action, next ? [next, ...kept] : kept));
  };
  key.addEventListener('click', () => {
    // A second click while it waits would have it told twice that the key is left.
    if (key.classList.contains('waiting')) return;
    key.textContent = 'press a key';
    key.classList.add('waiting');
    const wait = new AbortController();
    const leave = () => {
      wait.abort();
      refresh();
    };
    key.addEventListener('blur', leave, { signal: wait.signal });
    key.addEventListener(
      'keydown',
      (event) => {
        if (/^(Shift|Control|Alt|Meta)$/.test(event.key)) return;
        event.preventDefault();
        event.stopPropagation();
        if (event.key === 'Escape' || event.key === 'Tab') return leave();
        wait.abort();
        if (event.key === 'Delete' || event.key === 'Backspace') return replaceBy(undefined);
        const next = shortcutsOf(event, isMac).find(isSingleKey);
        if (next) replaceBy(next);
        else refresh('Only a single key can be used here: a letter, digit or symbol, with or without Shift.');
      },
      { signal: wait.signal },
    );
  });
  return key;
}

/** Assigns keys to an action; reports which action has lost them. */
function give(wb: Uses<'actions' | 'settings'>, action: Action, own: readonly string[]): string {
  const { keys, losers } = withShortcut(actionsOf(wb), wb.settings.get().keys, action, own);
  wb.settings.update((s) => ({ ...s, keys }));
  const name = (a: Action) => `“${a.name ?? actionLabel(wb, a)}”`;
  const lost = losers.map((loser) => {
    const had = loser.shortcuts?.find((key) => own.includes(key)) ?? own[0];
    const left = keys[loser.id].length ? '' : ', which now has no shortcut';
    return `${shortcutText(had, isMac)} was removed from ${name(loser)}${left}.`;
  });
  return lost.join(' ');
}

function without<T>(record: Readonly<Record<string, T>>, key: string): Record<string, T> {
  return Object.fromEntries(Object.entries(record).filter(([k]) => k !== key));
}

function mouseGroups(): HTMLElement[] {
  return MOUSE_GESTURES.map(({ where, lines }) =>
    element(
      'section',
      {},
      element('h3', {}, where),
      ...lines.map(([what, how]) => {
        const keys = element('span', { class: 'faint' }, isMac ? macText(how) : how);
        return element('div', { class: 'shortcut-line' }, element('span', {}, what), keys);
      }),
    ),
  );
}
