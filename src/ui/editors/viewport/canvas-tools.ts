/**
 * Routes pointer events in the viewport. The mode's tool comes first; what it doesn't use goes to the camera, which
 * listens on the canvas itself:
 *
 *     press     the tool starts a drag until the release; or the camera orbits
 *     click     a press without motion that the tool didn't take: the tool's, or it picks
 *     hover     the tool may highlight something and set the cursor
 *     menu      the right button without motion, or a finger held still that no tool has taken
 */
import { CLICK_PIXELS } from '../../../view/camera-travel.ts';
import { buttonMeant, isMac, waitOutDrag } from '../../kit/keyboard.ts';

/** A press that moved further was a drag: for tools as for the camera. */
export { CLICK_PIXELS };

/** Milliseconds of a long press. */
export const LONG_PRESS_MS = 500;

/** The fields of a pointer event used; positions are client coordinates. */
export type CanvasPointer = Pick<
  PointerEvent,
  'clientX' | 'clientY' | 'button' | 'altKey' | 'shiftKey' | 'ctrlKey' | 'metaKey' | 'pointerType'
>;

export interface CanvasDrag {
  /** Every move. */
  move(at: CanvasPointer): void;
  /** Whether a finger held still means something to the drag; otherwise it cancels the drag and opens the menu. */
  readonly ownsLongPress?: boolean;
  /** Touch: number of fingers down, including the dragging one. */
  fingers?(count: number): void;
  /** The release. */
  end(at: CanvasPointer): void;
  /** Escape, or the browser cancelled the pointer: restores everything. */
  cancel(): void;
}

export interface CanvasTool {
  /** Starts a drag if the tool has something there; undefined leaves the press to the camera. */
  press(at: CanvasPointer): CanvasDrag | undefined;
  /** Whether the tool has used the click; otherwise it picks. */
  click?(at: CanvasPointer): boolean;
  /** A menu is about to open: whether something of the tool's own is there, which it has selected; otherwise it picks. */
  menu?(at: CanvasPointer): boolean;
  /**
   * Undefined: the pointer has left. Returns the CSS cursor; undefined: the default. `grab` means that it is over one
   * of the tool's handles.
   */
  hover?(at: CanvasPointer | undefined): string | undefined;
}

/**
 * @param canvas the camera listens on it
 * @param tool returns the mode's tool; called each time
 * @param pick a click that the tool didn't use
 * @param claim called with whether the tool has the pointer, over a handle or in a drag: nothing else is highlighted
 *   then
 * @param menu opens the menu of what is there
 */
export function listenToCanvas(
  canvas: HTMLCanvasElement,
  tool: () => CanvasTool | undefined,
  pick: (at: CanvasPointer) => void,
  signal: AbortSignal,
  claim: (isTools: boolean) => void = () => {},
  menu: (at: CanvasPointer) => void = () => {},
): void {
  let drag: { readonly of: CanvasDrag; readonly pointerId: number; readonly others: Set<number> } | undefined;
  let down: PointerEvent | undefined;
  /** A press that opens the menu on release, unless it moves. */
  let menuDown: PointerEvent | undefined;
  /** A finger that opens the menu if it stays for long. */
  let holding: { readonly from: PointerEvent; readonly timer: ReturnType<typeof setTimeout> } | undefined;

  const hold = (from: PointerEvent) => {
    const open = () => {
      holding = down = undefined;
      finish()?.cancel();
      menu(from);
    };
    holding = { from, timer: setTimeout(open, LONG_PRESS_MS) };
  };
  const stopHolding = () => {
    clearTimeout(holding?.timer);
    holding = undefined;
  };
  const onKey = (event: KeyboardEvent) => {
    if (event.key !== 'Escape') return waitOutDrag(event);
    event.preventDefault();
    event.stopPropagation();
    finish()?.cancel();
  };
  const finish = (): CanvasDrag | undefined => {
    const of = drag?.of;
    if (drag && canvas.hasPointerCapture(drag.pointerId)) canvas.releasePointerCapture(drag.pointerId);
    drag = undefined;
    window.removeEventListener('keydown', onKey, { capture: true });
    if (of) claim(false);
    return of;
  };

  // In the window's capture phase: before the camera's own listener on the canvas, whenever that was added.
  window.addEventListener(
    'pointerdown',
    (event) => {
      if (event.target !== canvas) return;
      canvas.focus({ preventScroll: true });
      down = menuDown = undefined;
      stopHolding();
      if (drag) {
        // Other buttons or fingers during a drag don't reach the camera.
        event.stopPropagation();
        if (event.pointerType === 'touch' && event.pointerId !== drag.pointerId) {
          drag.others.add(event.pointerId);
          drag.of.fingers?.(1 + drag.others.size);
        }
        return;
      }
      if (event.isPrimary && asksForMenu(event)) menuDown = event;
      const isMacMenu = menuDown !== undefined && event.button === 0;
      const of = event.isPrimary && !isMacMenu ? tool()?.press(event) : undefined;
      if (!of) {
        down = event.button === 0 && event.isPrimary && !isMacMenu ? event : undefined;
        if (event.pointerType === 'touch' && down) hold(event);
        return;
      }
      event.stopPropagation();
      drag = { of, pointerId: event.pointerId, others: new Set() };
      canvas.setPointerCapture(event.pointerId);
      window.addEventListener('keydown', onKey, { capture: true });
      claim(true);
      if (event.pointerType === 'touch' && !of.ownsLongPress) hold(event);
    },
    { capture: true, signal },
  );
  canvas.addEventListener(
    'pointermove',
    (event) => {
      if (menuDown && !isNear(event, menuDown)) menuDown = undefined;
      if (holding && !isNear(event, holding.from)) stopHolding();
      if (drag) {
        if (event.pointerId === drag.pointerId) drag.of.move(event);
      } else if (event.buttons === 0) {
        canvas.style.cursor = tool()?.hover?.(event) ?? '';
        // While dragging or placing something, don't highlight what is below.
        claim(canvas.style.cursor === 'grab' || canvas.style.cursor === 'crosshair');
      }
    },
    { signal },
  );
  const lift = (event: PointerEvent) => {
    if (drag?.others.delete(event.pointerId)) drag.of.fingers?.(1 + drag.others.size);
  };
  canvas.addEventListener(
    'pointerup',
    (event) => {
      stopHolding();
      const asked = menuDown?.pointerId === event.pointerId && isNear(event, menuDown);
      if (drag) {
        if (event.pointerId === drag.pointerId) finish()?.end(event);
        else lift(event);
      } else {
        const from = down;
        down = undefined;
        if (from && isNear(event, from) && !tool()?.click?.(event)) pick(event);
      }
      if (!asked) return;
      menuDown = undefined;
      menu(event);
    },
    { signal },
  );
  const lost = (event: PointerEvent) => {
    stopHolding();
    if (event.pointerId === drag?.pointerId) finish()?.cancel();
    else lift(event);
  };
  canvas.addEventListener('pointercancel', lost, { signal });
  canvas.addEventListener('lostpointercapture', lost, { signal });
  canvas.addEventListener(
    'pointerleave',
    () => {
      if (!drag) canvas.style.cursor = tool()?.hover?.(undefined) ?? '';
    },
    { signal },
  );
  signal.addEventListener('abort', () => {
    stopHolding();
    finish()?.cancel();
  });
  // The page has a menu of its own here, which a right drag must not open.
  canvas.addEventListener('contextmenu', (event) => event.preventDefault(), { signal });
}

function asksForMenu(event: PointerEvent): boolean {
  return event.pointerType !== 'touch' && buttonMeant(event, isMac) === 2;
}

function isNear(at: CanvasPointer, from: CanvasPointer): boolean {
  return Math.hypot(at.clientX - from.clientX, at.clientY - from.clientY) <= CLICK_PIXELS;
}
