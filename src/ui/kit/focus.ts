/**
 * Where the focus goes when a text field is done with. A field that kept it would take the next K, Space or Ctrl+Z for
 * itself; so it lets go: to the element that has its panel's keys, or to the page.
 *
 * The browser remembers where the focus was, so that Tab goes on from the field all the same.
 */

/** Marks the element that has a panel's keys: the plot of the curves, the dope sheet. */
export const HAS_KEYS = 'data-has-keys';

/** Whether it takes typed characters. */
export function isTextField(target: Element | null): target is HTMLElement {
  if (target instanceof HTMLTextAreaElement) return true;
  if (target instanceof HTMLInputElement) return !NO_TEXT.test(target.type);
  return target instanceof HTMLElement && target.isContentEditable;
}
const NO_TEXT = /^(checkbox|radio|button|submit|reset|color|file|range|image)$/;

/** Takes the focus from a field, which takes what was typed in it, for the panel that `near` is in. */
export function leaveField(field: HTMLElement, near: Element = field): void {
  field.blur();
  focusPanel(near);
}

/** Gives the focus to whatever has the keys of the panel around `near`; false where that is the page. */
export function focusPanel(near: Element): boolean {
  const all = near.closest('[data-panel]')?.querySelectorAll<HTMLElement>(`[${HAS_KEYS}]`) ?? [];
  // One for each tab, of which one is seen.
  const shown = [...all].find((one) => one.getClientRects().length > 0);
  shown?.focus({ preventScroll: true });
  return shown !== undefined;
}

let typedIn: EventTarget | null | undefined;

/** Notices what is typed, until the signal says otherwise. */
export function watchTyping(signal: AbortSignal): void {
  const options = { capture: true, signal };
  window.addEventListener('focusin', () => (typedIn = undefined), options);
  window.addEventListener('input', (event) => (typedIn = event.target), options);
}

/** Whether something was typed in this field since it got the focus. */
export function isTypedIn(field: Element): boolean {
  return typedIn === field;
}

/**
 * A button or a box that was clicked with the mouse does not keep the focus, until the signal says otherwise: the next
 * Space is meant for what one works at, and plays. What the click has given the focus to, or what stands in a dialog,
 * keeps it, and so does whatever was gone to with Tab.
 */
export function letGoOfClicked(signal: AbortSignal): void {
  window.addEventListener(
    'click',
    ({ target, detail }) => {
      const { activeElement } = document;
      // Keys click too, with a detail of 0.
      if (detail === 0 || !(activeElement instanceof HTMLElement) || !(target instanceof Element)) return;
      if (!activeElement.matches(CLICKED) || activeElement.closest('dialog,[role=menu]')) return;
      // A label's click is its box's.
      if (activeElement.contains(target) || target.closest('label')?.contains(activeElement)) leaveField(activeElement);
    },
    { signal },
  );
}
const CLICKED = 'button,summary,[role=button],input[type=checkbox],input[type=radio]';
