/** The platform's keyboard, and blocking it during drags. */

export const isMac = /mac|iphone|ipad/i.test(globalThis.navigator?.userAgent ?? '');

/**
 * For a capturing listener during drags: blocks the keyboard, since what is deleted or undone can't be dragged on.
 * Escape and modifiers pass.
 */
export function waitOutDrag(event: KeyboardEvent): void {
  if (event.key === 'Escape') return;
  // Alt would open the browser's menu.
  event.preventDefault();
  if (!MODIFIERS.includes(event.key)) event.stopPropagation();
}

const MODIFIERS = ['Alt', 'Control', 'Shift', 'Meta'];

/** The effective button: on a Mac, Ctrl+click is a right click. */
export function buttonMeant({ button, ctrlKey }: Pick<MouseEvent, 'button' | 'ctrlKey'>, mac: boolean): number {
  return mac && button === 0 && ctrlKey ? 2 : button;
}
