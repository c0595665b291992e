/** A pointer that is followed from the press on an element to its release, wherever it goes in between. */

export interface PointerDrag {
  move?(at: PointerEvent): void;
  /** Keys while it lasts, before anyone else has them (see `waitOutDrag`). */
  key?(event: KeyboardEvent): void;
  /** The end, whichever comes to it. @param release absent where the browser took the pointer away */
  over(lost: PointerEvent, release: PointerEvent | undefined): void;
}

/**
 * Captures the pointer that has just been pressed.
 * @returns gives it up before the release: `over` is not called any more
 */
export function followPointer(target: HTMLElement, press: PointerEvent, drag: PointerDrag): () => void {
  const listening = new AbortController();
  const { signal } = listening;
  let release: PointerEvent | undefined;
  target.setPointerCapture(press.pointerId);
  if (drag.move) target.addEventListener('pointermove', (event) => drag.move?.(event), { signal });
  if (drag.key) window.addEventListener('keydown', (event) => drag.key?.(event), { signal, capture: true });
  target.addEventListener(
    'pointerup',
    (event) => {
      release = event;
    },
    { signal },
  );
  target.addEventListener(
    'lostpointercapture',
    (event) => {
      listening.abort();
      drag.over(event, release);
    },
    { signal },
  );
  return () => {
    listening.abort();
    if (target.hasPointerCapture(press.pointerId)) target.releasePointerCapture(press.pointerId);
  };
}
