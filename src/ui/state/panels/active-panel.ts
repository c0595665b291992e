/**
 * The panel that the keyboard acts in: the one with the focus, unless the mouse has moved into another since. Whoever
 * has edited a curve and points at the viewport means the viewport; Delete would delete keys there that nobody looks
 * at. Moving the focus by keyboard overrides where the mouse rests. With the focus nowhere it is the panel under the
 * mouse, as in Maya and Blender. The panel is marked with `data-active`; the mark is drawn once a key has moved the
 * focus, until the next press, while the root has `data-by-key`: whoever works by mouse sees no frames.
 */

import { setAttribute } from '../../widgets/dom.ts';

/** Panels with keys of their own that change something; those in them too. */
const POINTED = '[data-panel=viewport],[data-panel=outliner],[data-panel=timeline]';

/** Entered by the mouse, or pressed with anything, since the focus moved last. */
let pointed: HTMLElement | undefined;

/** The panel around an element. */
export function panelOf(target: Element | null): HTMLElement | undefined {
  return target?.closest<HTMLElement>('[data-panel]') ?? undefined;
}

/** Whether keys pressed there were meant for no element: nothing has the focus. */
export function isNowhere(target: Element | null): boolean {
  return target === null || target === document.body || target === document.documentElement;
}

/** The panel whose keys apply while `target` has the focus; undefined for the page's own. */
export function activePanel(target: Element | null): HTMLElement | undefined {
  // The innermost is the last.
  if (isNowhere(target)) return [...document.querySelectorAll<HTMLElement>('[data-panel]:hover')].at(-1);
  const focused = panelOf(target);
  if (!pointed?.isConnected) return focused;
  const isSame = focused !== undefined && (pointed.contains(focused) || focused.contains(pointed));
  return isSame ? focused : pointed;
}

/** Follows focus and mouse, and marks the active panel, until aborted. */
export function watchActivePanel(signal: AbortSignal): void {
  const options = { capture: true, signal };
  let marked: HTMLElement | undefined;
  let [x, y] = [Number.NaN, Number.NaN];
  const mark = () => {
    const active = activePanel(document.activeElement);
    if (active === marked) return;
    marked?.removeAttribute('data-active');
    if (active) setAttribute(active, 'data-active', '');
    marked = active;
  };
  const { dataset } = document.documentElement;
  let isByKey = false;
  const moved = () => {
    pointed = undefined;
    if (isByKey) dataset.byKey = '';
    mark();
  };
  window.addEventListener('focusin', moved, options);
  // The element that gets the focus isn't known yet.
  window.addEventListener('focusout', () => queueMicrotask(mark), options);
  const point = (target: EventTarget | null) => {
    const panel = target instanceof Element ? panelOf(target) : undefined;
    pointed = panel?.closest(POINTED) ? panel : undefined;
    mark();
  };
  // What is under a resting mouse may have been opened or closed.
  window.addEventListener(
    'keydown',
    () => {
      isByKey = true;
      mark();
    },
    options,
  );
  // A finger or a pen takes over from a mouse that rests elsewhere, also where the focus is already.
  window.addEventListener(
    'pointerdown',
    ({ target }) => {
      isByKey = false;
      delete dataset.byKey;
      point(target);
    },
    options,
  );
  window.addEventListener(
    // Not `pointerover`, whose first after a drag says in Firefox that the button is still pressed.
    'mouseover',
    (event) => {
      // A layout that changes below a resting mouse is no movement, and a drag belongs to where it began.
      const rests = event.clientX === x && event.clientY === y;
      [x, y] = [event.clientX, event.clientY];
      if (!rests && event.buttons === 0) point(event.target);
    },
    options,
  );
}
