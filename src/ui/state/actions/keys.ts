/** Keyboard listener of the page; `shortcuts.ts` decides what keys mean. */
import { elementWithKeys, focusedWithin, isTextField, letGoOfClicked } from '../../widgets/focus/focus.ts';
import { rescueFocus } from '../../widgets/focus/focus-regions.ts';
import { isMac } from '../../widgets/focus/keyboard.ts';
import { continuesTyping, isTypedIn, passes, watchTyping } from '../../widgets/focus/typing.ts';
import { activePanel, isNowhere, panelOf, watchActivePanel } from '../panels/active-panel.ts';
import { actionFor, type FocusKind, shortcutsOf, swallows } from '../shortcuts.ts';
import type { Action, Uses } from '../workbench.ts';
import { actionLabel, actionsOf, isEnabled, tryAction } from './action.ts';

/** Listens until aborted. */
export function listenToKeys(wb: Uses<'actions' | 'settings' | 'dialog' | 'messages'>, signal: AbortSignal): void {
  rescueFocus(signal);
  watchTyping(signal);
  watchActivePanel(signal);
  letGoOfClicked(signal);
  window.addEventListener('keydown', (event) => handleKey(wb, event), { signal });
}

/** Runs the key's action, unless the focused control, a panel or a dialog uses the key. */
export function handleKey(wb: Uses<'actions' | 'settings' | 'dialog' | 'messages'>, event: KeyboardEvent): void {
  if (event.defaultPrevented || event.isComposing) return;
  const target = event.target instanceof Element ? event.target : document.body;
  if (wb.dialog.get() !== undefined || target.closest('[role=menu],dialog')) {
    handleKeyOfDialog(wb, event);
    return;
  }
  if (isNowhere(target) && isUsedUnderPointer(event)) return;
  const focusedIn = focusedWithin(target);
  if (!passes(focusedIn, event) && swallows(focusKind(focusedIn), event, isMac)) return;
  // The rest of a word isn't a row of shortcuts.
  if (continuesTyping(event)) {
    event.preventDefault();
    return;
  }
  const focused = panelOf(target)?.dataset.panel;
  const panel = activePanel(target)?.dataset.panel;
  const pressed = shortcutsOf(event, isMac);
  const meant = (by: string | undefined) => actionFor(pressed, actionsOf(wb), by, wb.settings.get());
  const action = meant(panel);
  const left = focused === panel ? undefined : meant(focused);
  if (left && left !== action && isEnabled(wb, left) && !(action && isEnabled(wb, action))) {
    event.preventDefault();
    tellElsewhere(wb, left);
    return;
  }
  if (!action) {
    const other = event.key.length === 1 && !event.repeat ? ofAnotherPanel(wb, meant) : undefined;
    if (other) tellElsewhere(wb, other);
    // The browser would select the whole page; allowed only in text meant to be copied.
    if (pressed.includes('Ctrl+A') && !isInCopiedText(target)) event.preventDefault();
    return;
  }
  // Also if disabled: Ctrl+S never opens the browser's dialog.
  event.preventDefault();
  if (event.repeat && !action.repeats) return;
  tryAction(wb, action, 'key');
}

/** A dialog or a menu has all keys but those of actions about it. */
function handleKeyOfDialog(wb: Uses<'actions' | 'settings'>, event: KeyboardEvent): void {
  const all = actionsOf(wb).filter((action) => action.inDialogs);
  const action = actionFor(shortcutsOf(event, isMac), all, undefined, wb.settings.get());
  if (!action) return;
  event.preventDefault();
  if (!event.repeat) tryAction(wb, action, 'key');
}

/** With the focus nowhere, a key is given to the panel under the pointer as if that had the focus. */
function isUsedUnderPointer(event: KeyboardEvent): boolean {
  const panel = activePanel(null);
  const element = panel && elementWithKeys(panel);
  // A text field without the focus gets no text by events.
  const isText: boolean = isTextField(element ?? null);
  if (!element || isText) return false;
  // It bubbles, and comes back as a key of that element.
  if (!element.dispatchEvent(new KeyboardEvent(event.type, event))) event.preventDefault();
  return true;
}

/** What a key would do in a panel that isn't the active one. */
function ofAnotherPanel(
  wb: Uses<'actions'>,
  meant: (panel: string | undefined) => Action | undefined,
): Action | undefined {
  const panels = new Set(actionsOf(wb).map(({ panel }) => panel));
  for (const panel of panels) {
    const action = meant(panel);
    if (action && isEnabled(wb, action)) return action;
  }
  return undefined;
}

/** A key of a panel that isn't the active one does nothing there unseen. */
function tellElsewhere(wb: Uses<'actions' | 'messages'>, action: Action): void {
  const name = action.panel === 'viewport' ? 'viewport' : action.panel === 'outliner' ? 'outliner' : 'timeline';
  const how = `point at the ${name}, or press F6 until it has the focus, to use this key.`;
  wb.messages.note(`${actionLabel(wb, action)}: ${how}`);
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
