/** Tooltips with the current shortcut of a button's action. */
import { isMac } from '../../widgets/focus/keyboard.ts';
import { setTooltip, type TooltipText } from '../../widgets/tooltip.ts';
import { shortcutsFor, shortcutText } from '../shortcuts.ts';
import type { Uses } from '../workbench.ts';
import { findAction } from './action.ts';

/** The first key of an action as text; undefined if it has none. */
export function keyNameOf(wb: Uses<'actions' | 'settings'>, actionId: string): string | undefined {
  const action = findAction(wb, actionId);
  const [shortcut] = action ? shortcutsFor(action, wb.settings.get()) : [];
  return shortcut && shortcutText(shortcut, isMac);
}

/** A text and the key of an action. */
export function setActionTooltip(
  wb: Uses<'actions' | 'settings'>,
  target: HTMLElement,
  actionId: string,
  text: TooltipText,
): void {
  setTooltip(target, text, () => keyNameOf(wb, actionId));
}
