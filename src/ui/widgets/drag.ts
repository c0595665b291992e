/** Follows a pointer from the press on an element to its release, wherever it moves in between. */

export interface PointerDrag {
  move?(at: PointerEvent): void;
  /** Keys during the drag, before any other listener (see `waitOutDrag`). */
  key?(event: KeyboardEvent): void;
  /** The end of the drag. @param release absent if the browser cancelled the pointer */
  over(lost: PointerEvent, release: PointerEvent | undefined): void;
}

/**
 * Captures the pointer that has just been pressed. Other pointers, such as a second finger, are not followed.
 *
 * @returns ends the capture before the release; `over` is then not called
 */
export function followPointer(target: HTMLElement, press: PointerEvent, drag: PointerDrag): () => void {
  const listening = new AbortController();
  const isFollowed = (event: PointerEvent) => event.pointerId === press.pointerId;
  const { signal } = listening;
  let release: PointerEvent | undefined;
  target.setPointerCapture(press.pointerId);
  if (drag.move) target.addEventListener('pointermove', (event) => isFollowed(event) && drag.move?.(event), { signal });
  if (drag.key) window.addEventListener('keydown', (event) => drag.key?.(event), { signal, capture: true });
  target.addEventListener(
    'pointerup',
    (event) => {
      if (isFollowed(event)) release = event;
    },
    { signal },
  );
  target.addEventListener(
    'lostpointercapture',
    (event) => {
      if (!isFollowed(event)) return;
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
