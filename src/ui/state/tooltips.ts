/** Tooltips that name the key of what a button does, and go on doing so when the key is changed. */
import { isMac } from '../kit/keyboard.ts';
import { findAction } from './action.ts';
import { shortcutsFor, shortcutText } from './shortcuts.ts';
import type { Action, Uses } from './workbench.ts';

/** `Play (Space)`; the text alone where the action has no key. */
export function withKey(wb: Uses<'settings'>, action: Action | undefined, text: string): string {
  const [shortcut] = action ? shortcutsFor(action, wb.settings.get()) : [];
  return shortcut ? `${text} (${shortcutText(shortcut, isMac)})` : text;
}

/**
 * Keeps a control's tooltip as its text and the key of an action, now and after every change of the keys. Gives what
 * does it again, for a text that depends on something else.
 */
export function keepTooltip(
  wb: Uses<'actions' | 'settings'>,
  target: HTMLElement,
  actionId: string,
  text: () => string,
): () => void {
  const action = findAction(wb, actionId);
  const show = () => {
    target.title = withKey(wb, action, text());
  };
  wb.settings.subscribe((now, before) => {
    if (now.keys !== before.keys || now.singleKeys !== before.singleKeys) show();
  });
  show();
  return show;
}
