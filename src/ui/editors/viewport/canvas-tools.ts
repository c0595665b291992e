/**
 * Routes pointer events in the viewport. The mode's tool comes first; what it doesn't use goes to the camera, which
 * listens on the canvas itself:
 *
 *     press     the tool starts a drag until the release; or the camera orbits
 *     click     a press without motion that the tool didn't take: the tool's, or it picks
 *     hover     the tool may highlight something and set the cursor
 *     menu      the right button without motion, or a finger held still that no tool has taken
 *     pinch     a second finger at once, or before the drag has begun, gives both fingers to the camera
 */
import { CLICK_PIXELS } from '../../../view/camera/camera-travel.ts';
import { buttonMeant, isMac, waitOutDrag } from '../../widgets/focus/keyboard.ts';

/** A press that moved further was a drag: for tools as for the camera. */
export { CLICK_PIXELS };

/** Milliseconds of a long press. */
export const LONG_PRESS_MS = 500;

/** Milliseconds in which a second finger makes a pinch of any press: until then the drag waits. */
export const PINCH_MS = 150;

/** The fields of a pointer event used; positions are client coordinates. */
export type CanvasPointer = Pick<
  PointerEvent,
  'clientX' | 'clientY' | 'button' | 'altKey' | 'shiftKey' | 'ctrlKey' | 'metaKey' | 'pointerType'
>;

export interface CanvasDrag {
  /** Every move; of a finger only once it can't be a pinch any more. */
  move(at: CanvasPointer): void;
  /** Whether it has moved far enough to change something. */
  readonly hasBegun: boolean;
  /** Whether a finger held still means something to the drag; otherwise it cancels the drag and opens the menu. */
  readonly ownsLongPress?: boolean;
  /** Touch: number of fingers down, including the dragging one. */
  fingers?(count: number): void;
  /** The release. */
  end(at: CanvasPointer): void;
  /** Escape, or the browser cancelled the pointer: restores everything. */
  cancel(): void;
}

/** A drag that something else has begun. */
export type BegunDrag = Omit<CanvasDrag, 'hasBegun'>;

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

interface Dragging {
  readonly of: CanvasDrag;
  readonly pointerId: number;
  /** Where the pointer is. */
  at: PointerEvent;
  /** Runs while a second finger would make it a pinch. */
  waiting: ReturnType<typeof setTimeout> | undefined;
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
  let drag: Dragging | undefined;
  /** Fingers put down during a drag. They are nothing to the camera, even once the drag is over. */
  const others = new Set<number>();
  let isHandingOver = false;
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
    clearTimeout(drag?.waiting);
    drag = undefined;
    window.removeEventListener('keydown', onKey, { capture: true });
    if (of) claim(false);
    return of;
  };
  const move = ({ of, at }: Dragging) => {
    of.move(at);
    if (of.hasBegun) stopHolding();
  };
  /** What the drag has waited with. */
  const catchUp = (now: Dragging) => {
    const { waiting } = now;
    clearTimeout(waiting);
    now.waiting = undefined;
    if (waiting !== undefined && now.at.type === 'pointermove') move(now);
  };
  /** A pinch that begins on something that a tool drags: nothing has changed, and the camera gets both fingers. */
  const handOver = ({ at }: Dragging) => {
    finish()?.cancel();
    isHandingOver = true;
    canvas.dispatchEvent(new PointerEvent('pointerdown', at));
    isHandingOver = false;
  };

  // In the window's capture phase: before the camera's own listener on the canvas, whenever that was added.
  window.addEventListener(
    'pointerdown',
    (event) => {
      if (event.target !== canvas || isHandingOver) return;
      canvas.focus({ preventScroll: true });
      down = menuDown = undefined;
      stopHolding();
      if (drag) {
        const { of, at, waiting, pointerId } = drag;
        const isFinger = event.pointerType === 'touch' && event.pointerId !== pointerId;
        if (isFinger && at.pointerType === 'touch' && (waiting !== undefined || !of.hasBegun)) return handOver(drag);
        // Other buttons or fingers during a drag don't reach the camera.
        event.stopPropagation();
        if (isFinger) {
          others.add(event.pointerId);
          of.fingers?.(1 + others.size);
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
      const now: Dragging = { of, pointerId: event.pointerId, at: event, waiting: undefined };
      if (event.pointerType === 'touch') now.waiting = setTimeout(() => catchUp(now), PINCH_MS);
      drag = now;
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
      if (others.has(event.pointerId)) {
        event.stopPropagation();
      } else if (drag) {
        if (event.pointerId !== drag.pointerId) return;
        drag.at = event;
        if (drag.waiting === undefined) move(drag);
      } else if (event.buttons === 0) {
        canvas.style.cursor = tool()?.hover?.(event) ?? '';
        // While dragging or placing something, don't highlight what is below.
        claim(canvas.style.cursor === 'grab' || canvas.style.cursor === 'crosshair');
      }
    },
    { signal },
  );
  const lift = (event: PointerEvent) => {
    if (others.delete(event.pointerId)) drag?.of.fingers?.(1 + others.size);
  };
  canvas.addEventListener(
    'pointerup',
    (event) => {
      stopHolding();
      const asked = menuDown?.pointerId === event.pointerId && isNear(event, menuDown);
      lift(event);
      if (drag) {
        if (event.pointerId !== drag.pointerId) return;
        catchUp(drag);
        finish()?.end(event);
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
