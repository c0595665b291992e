/** Tooltips that name the key of what a button does, and go on doing so when the key is changed. */

import { actionsOf } from '../shell/actions.ts';
import { isMac } from '../shell/keys.ts';
import type { Action } from './action.ts';
import { shortcutsFor, shortcutText } from './shortcuts.ts';
import type { Workbench } from './workbench.ts';

/** `Play (Space)`; the text alone where the action has no key. */
export function withKey(wb: Workbench, action: Action | undefined, text: string): string {
  const [shortcut] = action ? shortcutsFor(action, wb.settings.get()) : [];
  return shortcut ? `${text} (${shortcutText(shortcut, isMac)})` : text;
}

/**
 * Keeps a control's tooltip as its text and the key of an action, now and after every change of the keys. Gives what
 * does it again, for a text that depends on something else.
 */
export function keepTooltip(wb: Workbench, target: HTMLElement, actionId: string, text: () => string): () => void {
  const action = actionsOf(wb).find((a) => a.id === actionId);
  const show = () => {
    target.title = withKey(wb, action, text());
  };
  wb.settings.subscribe((now, before) => {
    if (now.keys !== before.keys || now.singleKeys !== before.singleKeys) show();
  });
  show();
  return show;
}
