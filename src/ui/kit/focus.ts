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
function focusRegion(region: HTMLElement, from?: HTMLElement): void {
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

/** Focuses a part of the page, as `focusNextRegion` does. Escape there leads back, once. */
export function enterRegion(name: string): void {
  // Tests of actions have no page.
  if (typeof document === 'undefined') return;
  const region = regionOf(name);
  const stop = region && firstStop(region);
  if (!stop) return;
  const { activeElement } = document;
  // Its keys are those of someone who came by keyboard, also after a click.
  if (activeElement === stop) stop.blur();
  if (!region.contains(activeElement)) enteredFrom = activeElement;
  stop.focus();
  const until = new AbortController();
  const { signal } = until;
  const back = (event: KeyboardEvent) => {
    if (event.key !== 'Escape' || event.defaultPrevented) return;
    event.preventDefault();
    returnFocus();
  };
  const left = ({ relatedTarget }: FocusEvent) => {
    if (!(relatedTarget instanceof Node && region.contains(relatedTarget))) until.abort();
  };
  region.addEventListener('keydown', back, { signal });
  region.addEventListener('focusout', left, { signal });
}

/** The part of the page that had the focus is left or closed: back to where it was entered from, else to the viewport. */
export function returnFocus(): void {
  const from = enteredFrom;
  enteredFrom = null;
  const isThere = from instanceof HTMLElement && from !== document.body && canHaveFocus(from);
  (isThere ? from : firstStopOf('stage'))?.focus({ preventScroll: true });
}

function canHaveFocus(element: Element): boolean {
  return (
    element.checkVisibility({ visibilityProperty: true }) &&
    !element.closest('[inert]') &&
    !element.matches(':disabled')
  );
}

/**
 * Until aborted, the focus of an element that vanishes, by whatever removes, hides or disables it, goes to the rest of
 * its panel, or of its part of the page; if that is hidden too, back to where it was entered from, else to the viewport.
 * Keys would otherwise be for whatever the mouse rests on.
 */
export function rescueFocus(signal: AbortSignal): void {
  const options = { capture: true, signal };
  /** What had the focus last, and all around it; a removed element doesn't know that any more. */
  let around: readonly Element[] = [];
  const rescue = () => {
    const { activeElement } = document;
    if ((activeElement !== null && activeElement !== document.body) || around.length === 0) return;
    const [lost, ...outer] = around;
    around = [];
    if (lost.isConnected && canHaveFocus(lost)) return;
    const region = outer.find((one) => one.hasAttribute(REGION));
    // Menus and dialogs return the focus themselves.
    if (!(region instanceof HTMLElement)) return;
    if (!canHaveFocus(region)) return returnFocus();
    const panel = outer.find((one) => one.hasAttribute('data-panel') && canHaveFocus(one));
    if (!panel || !focusPanel(panel)) focusRegion(region);
  };
  window.addEventListener(
    'focusin',
    ({ target }) => {
      const found: Element[] = [];
      for (let one = target instanceof Element ? target : null; one; one = one.parentElement) found.push(one);
      around = found;
    },
    options,
  );
  // Whoever has removed the element may focus another one.
  window.addEventListener('focusout', ({ relatedTarget }) => relatedTarget ?? queueMicrotask(rescue), options);
  // Not every browser tells that an element was removed or hidden.
  window.addEventListener('keydown', rescue, options);
}

function regionOf(name: string): HTMLElement | null {
  return document.querySelector<HTMLElement>(`[${REGION}="${name}"]`);
}

function firstStopOf(name: string): HTMLElement | undefined {
  const region = regionOf(name);
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

/** Characters typed within this time of each other belong together; milliseconds. */
const TYPING_MS = 1000;
/** When the last character was typed into a field or a list; milliseconds. */
let typedAt = Number.NEGATIVE_INFINITY;

/** Tracks typing in fields until aborted. */
export function watchTyping(signal: AbortSignal): void {
  const options = { capture: true, signal };
  window.addEventListener('focusin', () => (typedIn = undefined), options);
  window.addEventListener('input', (event) => (typedIn = event.target), options);
  window.addEventListener(
    'keydown',
    (event) => {
      // Enter, Escape and Tab end a word; a modifier alone doesn't.
      if (!isCharacter(event)) typedAt = MODIFIER.test(event.key) ? typedAt : Number.NEGATIVE_INFINITY;
      else if (event.target instanceof Element && isTextField(event.target)) noteTyped(event);
    },
    options,
  );
  window.addEventListener('pointerdown', () => (typedAt = Number.NEGATIVE_INFINITY), options);
}
const MODIFIER = /^(Shift|AltGraph|Alt|Control|Meta|CapsLock|Dead)$/;

/** A list goes to its rows by what is typed: until a pause, characters are text. */
export function noteTyped({ timeStamp }: Pick<Event, 'timeStamp'>): void {
  typedAt = timeStamp;
}

/**
 * Whether a key types on what was begun in a field or a list. While that has the focus it uses the key itself; if it has
 * vanished meanwhile, the rest of a word would run commands.
 */
export function continuesTyping(event: TypedKey): boolean {
  const continues = isCharacter(event) && event.timeStamp - typedAt <= TYPING_MS;
  if (continues) noteTyped(event);
  return continues;
}

type TypedKey = Pick<KeyboardEvent, 'key' | 'ctrlKey' | 'metaKey' | 'altKey' | 'timeStamp'>;

/** Whether it types a character. */
export function isCharacter({ key, ctrlKey, metaKey, altKey }: TypedKey): boolean {
  // AltGr types characters, and browsers report it as Ctrl+Alt.
  return [...key].length === 1 && !metaKey && ctrlKey === altKey;
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
