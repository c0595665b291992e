/**
 * While a mouse button is down on an element, touches of it go nowhere, and the reverse: a screen with both sends both.
 * OrbitControls takes what is down for fingers, whose places it knows, and fails on a mouse among them. It also waits
 * for the release of a mouse, which may happen where no page hears of it: under a system's dialog, or on another
 * desktop.
 */
export function keepToOneKindOfPointer(element: HTMLElement, signal: AbortSignal): void {
  /** Types of what is down, by id. */
  const down = new Map<number, string>();
  /** Of what the controls take to be down: tools may keep the end of a press from them. */
  const held = new Map<number, string>();
  element.addEventListener(
    'pointerdown',
    (event) => {
      const { pointerId, pointerType } = event;
      if ([...down].some(([id, type]) => id !== pointerId && type !== pointerType)) {
        event.stopImmediatePropagation();
        return;
      }
      if (pointerType === 'touch') {
        for (const [id, type] of [...held]) {
          if (type !== 'touch') element.dispatchEvent(new PointerEvent('pointercancel', { pointerId: id }));
        }
      }
      down.set(pointerId, pointerType);
      held.set(pointerId, pointerType);
    },
    { capture: true, signal },
  );
  const isUp = ({ pointerId }: PointerEvent) => void down.delete(pointerId);
  const isLet = (event: PointerEvent) => {
    // The end of another press, elsewhere on the page: they take any for the end of one of theirs.
    if (!held.delete(event.pointerId) && held.size > 0) event.stopImmediatePropagation();
  };
  /** The browser has found the mouse without a button down. */
  const isMissed = ({ pointerId, pointerType, buttons }: PointerEvent) => {
    if (pointerType !== 'mouse' || buttons !== 0 || !held.has(pointerId)) return;
    down.delete(pointerId);
    element.dispatchEvent(new PointerEvent('pointercancel', { pointerId }));
  };
  element.addEventListener('lostpointercapture', isMissed, { signal });
  window.addEventListener('pointerup', isUp, { capture: true, signal });
  window.addEventListener('pointercancel', isUp, { capture: true, signal });
  element.ownerDocument.addEventListener('pointerup', isLet, { signal });
  element.addEventListener('pointercancel', isLet, { signal });
}
