/** The platform's keyboard, and how it waits for the pointer. */

export const isMac = /mac|iphone|ipad/i.test(globalThis.navigator?.userAgent ?? '');

/**
 * For a listener in the capture phase while something is dragged: the keyboard waits, for what is deleted or undone under
 * the hand can't be dragged on. Escape and what is only held go on.
 */
export function waitOutDrag(event: KeyboardEvent): void {
  if (event.key === 'Escape') return;
  // Alt would open the browser's menu.
  event.preventDefault();
  if (!MODIFIERS.includes(event.key)) event.stopPropagation();
}

const MODIFIERS = ['Alt', 'Control', 'Shift', 'Meta'];
