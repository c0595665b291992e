/** Keyboard listener of the page; `shortcuts.ts` decides what keys mean. */
import { isTextField, isTypedIn, letGoOfClicked, watchTyping } from '../kit/focus.ts';
import { isMac } from '../kit/keyboard.ts';
import { actionsOf, tryAction } from './action.ts';
import { actionFor, type FocusKind, shortcutsOf, swallows } from './shortcuts.ts';
import type { Uses } from './workbench.ts';

/** Listens until aborted. */
export function listenToKeys(wb: Uses<'actions' | 'settings' | 'dialog'>, signal: AbortSignal): void {
  watchTyping(signal);
  letGoOfClicked(signal);
  window.addEventListener('keydown', (event) => handleKey(wb, event), { signal });
}

/** Runs the key's action, unless the focused control, a panel or a dialog uses the key. */
export function handleKey(wb: Uses<'actions' | 'settings' | 'dialog'>, event: KeyboardEvent): void {
  if (event.defaultPrevented || event.isComposing || wb.dialog.get() !== undefined) return;
  const target = event.target instanceof Element ? event.target : document.body;
  if (target.closest('[role=menu],dialog')) return;
  if (swallows(focusKind(target), event, isMac)) return;
  const panel = target.closest<HTMLElement>('[data-panel]')?.dataset.panel;
  const pressed = shortcutsOf(event, isMac);
  const action = actionFor(pressed, actionsOf(wb), panel, wb.settings.get());
  if (!action) {
    // The browser would select the whole page; allowed only in text meant to be copied.
    if (pressed.includes('Ctrl+A') && !isInCopiedText(target)) event.preventDefault();
    return;
  }
  // Also if disabled: Ctrl+S never opens the browser's dialog.
  event.preventDefault();
  if (event.repeat && !action.repeats) return;
  tryAction(wb, action);
}

/** Whether the focus is in text meant to be copied, or some of it is selected. */
function isInCopiedText(target: Element): boolean {
  const { anchorNode = null } = document.getSelection() ?? {};
  const selected = anchorNode instanceof Element ? anchorNode : anchorNode?.parentElement;
  return [target, selected].some((one) => one?.closest(COPIED_TEXT));
}
const COPIED_TEXT = '.messages-list,.facts';

function focusKind(target: Element): FocusKind {
  if (isTextField(target)) return isTypedIn(target) ? 'text' : 'untyped';
  if (target instanceof HTMLSelectElement) return 'select';
  if (target instanceof HTMLInputElement && target.type === 'range') return 'range';
  return target.matches('input,button,a[href],summary,[role=button]') ? 'press' : 'none';
}
