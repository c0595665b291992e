/**
 * Lines of the `?` page: an action with its keys. Single keys can be remapped; changed ones are marked and can be
 * reset.
 */

import { actionLabel, actionsOf } from '../../state/actions/action.ts';
import { isSingleKey, shortcutsOf, shortcutText, withShortcut } from '../../state/shortcuts.ts';
import type { Action, Uses } from '../../state/workbench.ts';
import { button, element, write } from '../../widgets/dom.ts';
import { isMac } from '../../widgets/focus/keyboard.ts';
import { icon } from '../../widgets/icons.ts';

/** Draws the page again, with a sentence about the last change. */
export type Refresh = (news?: string) => void;

/** A name, and what does it at the right. */
export function shortcutLine(what: string, how: Node): HTMLElement {
  return element('div', { class: 'shortcut-line' }, element('span', {}, what), how);
}

/** An action with all its keys. */
export function actionLine(wb: Uses<'actions' | 'settings'>, action: Action, refresh: Refresh): HTMLElement {
  const { keys } = wb.settings.get();
  const label = nameOf(wb, action);
  const cell = keysOf(wb, action, refresh);
  if (action.id in keys) {
    const back = button(`Reset ${label} to default`, { class: 'tool small' }, icon('close'), () => {
      const news = give(wb, action, action.shortcuts ?? []);
      wb.settings.update((s) => ({ ...s, keys: without(s.keys, action.id) }));
      refresh(news);
    });
    cell.append(back);
  }
  return shortcutLine(label, cell);
}

/** On the page: its name, where its label depends on what is selected. */
export function nameOf(wb: Uses<'actions'>, action: Action): string {
  return action.name ?? actionLabel(wb, action);
}

/** @param most how many of its keys */
export function keysOf(
  wb: Uses<'actions' | 'settings'>,
  action: Action,
  refresh: Refresh,
  most = Number.POSITIVE_INFINITY,
): HTMLElement {
  const { keys, singleKeys } = wb.settings.get();
  const now = (keys[action.id] ?? action.shortcuts ?? []).slice(0, most);
  const cell = element('span', { class: 'shortcut-keys' });
  for (const shortcut of now) {
    const text = shortcutText(shortcut, isMac);
    if (isSingleKey(shortcut)) cell.append(changeable(wb, action, shortcut, text, singleKeys, refresh));
    else cell.append(element('kbd', {}, text));
  }
  if (!now.length) cell.append(changeable(wb, action, undefined, 'none', singleKeys, refresh));
  return cell;
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
  write(key, 'disabled', !enabled);
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
  const lost = losers.map((loser) => {
    const had = loser.shortcuts?.find((key) => own.includes(key)) ?? own[0];
    const left = keys[loser.id].length ? '' : ', which now has no shortcut';
    return `${shortcutText(had, isMac)} was removed from “${nameOf(wb, loser)}”${left}.`;
  });
  return lost.join(' ');
}

function without<T>(record: Readonly<Record<string, T>>, key: string): Record<string, T> {
  return Object.fromEntries(Object.entries(record).filter(([k]) => k !== key));
}
