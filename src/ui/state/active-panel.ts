/**
 * The panel that the keyboard acts in: the one with the focus, unless the mouse has moved into another since. Whoever has
 * edited a curve and points at the viewport means the viewport; Delete would delete keys there that nobody looks at.
 * Moving the focus by keyboard overrides where the mouse rests. The panel is marked with `data-active`.
 */

/** Panels with keys of their own that change something. */
const POINTED = '[data-panel=viewport],[data-panel=outliner],[data-panel=timeline]';

/** Entered by the mouse, or pressed with anything, since the focus moved last. */
let pointed: HTMLElement | undefined;

/** The panel around an element. */
export function panelOf(target: Element | null): HTMLElement | undefined {
  return target?.closest<HTMLElement>('[data-panel]') ?? undefined;
}

/** The panel whose keys apply while `target` has the focus; undefined if it is in none, wherever the mouse is. */
export function activePanel(target: Element | null): HTMLElement | undefined {
  const focused = panelOf(target);
  if (!focused || !pointed?.isConnected) return focused;
  const isSame = pointed.contains(focused) || focused.contains(pointed);
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
    active?.setAttribute('data-active', '');
    marked = active;
  };
  const moved = () => {
    pointed = undefined;
    mark();
  };
  window.addEventListener('focusin', moved, options);
  // The element that gets the focus isn't known yet.
  window.addEventListener('focusout', () => queueMicrotask(mark), options);
  const point = (target: EventTarget | null) => {
    pointed = target instanceof Element ? (target.closest<HTMLElement>(POINTED) ?? undefined) : undefined;
    mark();
  };
  // A finger or a pen takes over from a mouse that rests elsewhere, also where the focus is already.
  window.addEventListener('pointerdown', ({ target }) => point(target), options);
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
