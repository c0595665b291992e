/**
 * The focus between the parts of the page: F6, keys that lead into a part and back, and what becomes of the focus of an
 * element that vanishes.
 */
import { focusPanel, focusRegion, HAS_KEYS, REGION } from './focus.ts';

/**
 * Focuses the next or previous part of the page that is shown: the element that handles its keys, else its first tab
 * stop. In document order, with the first after the last.
 */
export function focusNextRegion(step: 1 | -1): void {
  // Tests of actions have no page.
  if (typeof document === 'undefined') return;
  const regions = [...document.querySelectorAll<HTMLElement>(`[${REGION}]`)].filter((region) => firstStop(region));
  // The innermost: notes are in the viewport.
  const from = regions.findLastIndex((region) => region.contains(document.activeElement));
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
 * its panel, or of its part of the page; if that is hidden too, back to where it was entered from, else to the
 * viewport. Keys would otherwise be for whatever the mouse rests on.
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

/** Focuses a field of the page and selects its text, to be typed over. @param selector of the field */
export function focusField(selector: string): void {
  // Tests of actions have no page.
  if (typeof document === 'undefined') return;
  const field = document.querySelector<HTMLInputElement>(selector);
  field?.focus();
  field?.select();
}

function firstStop(region: HTMLElement): HTMLElement | undefined {
  if (region.closest('[inert]')) return undefined;
  const stops = [...region.querySelectorAll<HTMLElement>(STOPS)].filter(
    (one) => one.tabIndex >= 0 && one.checkVisibility({ visibilityProperty: true }),
  );
  return stops.find((one) => one.hasAttribute(HAS_KEYS)) ?? stops[0];
}
const STOPS = 'button:not(:disabled),input:not(:disabled),select:not(:disabled),[tabindex]';
