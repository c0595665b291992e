/**
 * Where the focus moves after a text field. A field that kept it would swallow the next K, Space or Ctrl+Z; so the
 * focus moves to the element that handles its panel's keys, else to its part of the page, from which F6 continues.
 *
 * Tab still continues from the field.
 */

/** Marks the element that handles a panel's keys: the plot of the curves, the dope sheet. */
export const HAS_KEYS = 'data-has-keys';

/** Whether it accepts typed characters, or in its shadow tree what has the focus, or would get it. */
export function isTextField(target: Element | null): target is HTMLElement {
  const tree = target?.shadowRoot;
  if (tree) return isTextField(tree.activeElement ?? tree.querySelector('[autofocus]'));
  if (target instanceof HTMLTextAreaElement) return true;
  if (target instanceof HTMLInputElement) return !NO_TEXT.test(target.type);
  return target instanceof HTMLElement && target.isContentEditable;
}
const NO_TEXT = /^(checkbox|radio|button|submit|reset|color|file|range|image)$/;

/** What has the focus inside an element's shadow tree; the element itself without one. */
export function focusedWithin(target: Element): Element {
  const inner = target.shadowRoot?.activeElement;
  return inner ? focusedWithin(inner) : target;
}

/** Moves the focus from a field, which commits what was typed, to the panel of `near`, or to the field's region. */
export function leaveField(field: HTMLElement, near: Element = field): void {
  // Committing may remove the field.
  const region = isTextField(field) && near === field && field.closest<HTMLElement>(`[${REGION}]`);
  field.blur();
  if (!focusPanel(near) && region) focusRegion(region, field);
}

/** Focuses a part of the page itself. @param from Tab continues there */
export function focusRegion(region: HTMLElement, from?: HTMLElement): void {
  const until = new AbortController();
  const { signal } = until;
  region.tabIndex = -1;
  region.focus({ preventScroll: true });
  // The browser moves on from what has the focus after the listeners.
  const back = ({ key, target }: KeyboardEvent) => {
    if (key === 'Tab' && target === region) from?.focus({ preventScroll: true });
  };
  region.addEventListener('keydown', back, { signal });
  const left = () => {
    // A dialog gives the focus back when it closes.
    if (document.querySelector(':modal')) return;
    until.abort();
    // A click on its empty parts would focus it.
    region.removeAttribute('tabindex');
  };
  region.addEventListener('blur', left, { signal });
}

/** Focuses the element that handles the keys of the panel around `near`; false if that is the page. */
export function focusPanel(near: Element): boolean {
  const panel = near.closest('[data-panel]');
  const shown = panel ? elementWithKeys(panel) : undefined;
  shown?.focus({ preventScroll: true });
  return shown !== undefined;
}

/** The element that handles the keys of a panel: itself or in it; one per tab, of which one is visible. */
export function elementWithKeys(panel: Element): HTMLElement | undefined {
  const all = [panel, ...panel.querySelectorAll(`[${HAS_KEYS}]`)];
  const isShown = (one: Element) => one.hasAttribute(HAS_KEYS) && one.getClientRects().length > 0;
  return all.find((one): one is HTMLElement => one instanceof HTMLElement && isShown(one));
}

/** Marks the parts of the page that F6 moves between. */
export const REGION = 'data-region';

/**
 * Until aborted, buttons and boxes clicked with the mouse lose the focus again: the next Space is meant to play. What
 * the click has focused, controls in dialogs, and anything reached by Tab keep it.
 */
export function letGoOfClicked(signal: AbortSignal): void {
  window.addEventListener(
    'click',
    ({ target, detail }) => {
      const { activeElement } = document;
      // Keys also click, with a detail of 0.
      if (detail === 0 || !(activeElement instanceof HTMLElement) || !(target instanceof Element)) return;
      if (!activeElement.matches(CLICKED) || activeElement.closest('dialog,[role=menu]')) return;
      // A click on a label clicks its box.
      if (activeElement.contains(target) || target.closest('label')?.contains(activeElement)) leaveField(activeElement);
    },
    { signal },
  );
}
const CLICKED = 'button,summary,[role=button],input[type=checkbox],input[type=radio]';
