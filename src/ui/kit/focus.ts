/**
 * Where the focus moves after a text field. A field that kept it would swallow the next K, Space or Ctrl+Z; so the
 * focus moves to the element that handles its panel's keys, else to its part of the page, from which F6 continues.
 *
 * Tab still continues from the field.
 */

/** Marks the element that handles a panel's keys: the plot of the curves, the dope sheet. */
export const HAS_KEYS = 'data-has-keys';

/** Whether it accepts typed characters. */
export function isTextField(target: Element | null): target is HTMLElement {
  if (target instanceof HTMLTextAreaElement) return true;
  if (target instanceof HTMLInputElement) return !NO_TEXT.test(target.type);
  return target instanceof HTMLElement && target.isContentEditable;
}
const NO_TEXT = /^(checkbox|radio|button|submit|reset|color|file|range|image)$/;

/** Moves the focus from a field, which commits what was typed, to the panel of `near`, or to the field's region. */
export function leaveField(field: HTMLElement, near: Element = field): void {
  // Committing may remove the field.
  const region = isTextField(field) && near === field && field.closest<HTMLElement>(`[${REGION}]`);
  field.blur();
  if (!focusPanel(near) && region) focusRegion(region, field);
}

/** @param from Tab continues there */
function focusRegion(region: HTMLElement, from: HTMLElement): void {
  const until = new AbortController();
  const { signal } = until;
  region.tabIndex = -1;
  region.focus({ preventScroll: true });
  // The browser moves on from what has the focus after the listeners.
  const back = ({ key, target }: KeyboardEvent) => {
    if (key === 'Tab' && target === region) from.focus({ preventScroll: true });
  };
  region.addEventListener('keydown', back, { signal });
  const left = () => {
    until.abort();
    // A click on its empty parts would focus it.
    region.removeAttribute('tabindex');
  };
  region.addEventListener('blur', left, { signal });
}

/** Focuses the element that handles the keys of the panel around `near`; false if that is the page. */
export function focusPanel(near: Element): boolean {
  const all = near.closest('[data-panel]')?.querySelectorAll<HTMLElement>(`[${HAS_KEYS}]`) ?? [];
  // One per tab, of which one is visible.
  const shown = [...all].find((one) => one.getClientRects().length > 0);
  shown?.focus({ preventScroll: true });
  return shown !== undefined;
}

/** Marks the parts of the page that F6 moves between. */
export const REGION = 'data-region';

/**
 * Focuses the next or previous part of the page that is shown: the element that handles its keys, else its first tab
 * stop. In document order, with the first after the last.
 */
export function focusNextRegion(step: 1 | -1): void {
  // Tests of actions have no page.
  if (typeof document === 'undefined') return;
  const regions = [...document.querySelectorAll<HTMLElement>(`[${REGION}]`)].filter((region) => firstStop(region));
  const from = regions.findIndex((region) => region.contains(document.activeElement));
  const to = from < 0 ? (step > 0 ? 0 : -1) : (from + step) % regions.length;
  const region = regions.at(to);
  if (region) firstStop(region)?.focus();
}

/** Where the focus was before `enterRegion`. */
let enteredFrom: Element | null = null;

/** Focuses a part of the page, as `focusNextRegion` does, from where `returnFocus` leads back. */
export function enterRegion(name: string): void {
  // Tests of actions have no page.
  if (typeof document === 'undefined') return;
  const stop = firstStopOf(name);
  if (!stop) return;
  enteredFrom = document.activeElement;
  stop.focus();
}

/** The part of the page that had the focus is closed: back to where it was entered from, else to the viewport. */
export function returnFocus(): void {
  const from = enteredFrom;
  enteredFrom = null;
  const isThere =
    from instanceof HTMLElement && from !== document.body && from.checkVisibility() && !from.closest('[inert]');
  (isThere ? from : firstStopOf('stage'))?.focus({ preventScroll: true });
}

function firstStopOf(name: string): HTMLElement | undefined {
  const region = document.querySelector<HTMLElement>(`[${REGION}="${name}"]`);
  return region ? firstStop(region) : undefined;
}

/** Marks a section of a panel by a name, for `focusSection`. */
export const SECTION = 'data-section';

/** Scrolls to a section and focuses its first cell of a table, else its first tab stop after the title. */
export function focusSection(name: string): void {
  // Tests of actions have no page.
  if (typeof document === 'undefined') return;
  const section = document.querySelector<HTMLElement>(`[${SECTION}="${name}"]`);
  section?.scrollIntoView({ block: 'start' });
  const cell = section?.querySelector<HTMLElement>('[role=gridcell][tabindex="0"]');
  (cell ?? (section && firstStop(section)))?.focus({ preventScroll: true });
}

function firstStop(region: HTMLElement): HTMLElement | undefined {
  if (region.closest('[inert]')) return undefined;
  const stops = [...region.querySelectorAll<HTMLElement>(STOPS)].filter(
    (one) => one.tabIndex >= 0 && one.checkVisibility({ visibilityProperty: true }),
  );
  return stops.find((one) => one.hasAttribute(HAS_KEYS)) ?? stops[0];
}
const STOPS = 'button:not(:disabled),input:not(:disabled),select:not(:disabled),[tabindex]';

let typedIn: EventTarget | null | undefined;

/** Tracks typing in fields until aborted. */
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
