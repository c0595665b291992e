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

/** What listens to the canvas besides the tool. */
export interface CanvasListeners {
  /** A click that the tool didn't use. */
  pick(at: CanvasPointer): void;
  /** Called with whether the tool has the pointer, over a handle or in a drag: nothing else is highlighted then. */
  claim?(isTools: boolean): void;
  /** Opens the menu of what is there. */
  menu?(at: CanvasPointer): void;
}

/**
 * @param canvas the camera listens on it
 * @param tool returns the mode's tool; called each time
 */
export function listenToCanvas(
  canvas: HTMLCanvasElement,
  tool: () => CanvasTool | undefined,
  listeners: CanvasListeners,
  signal: AbortSignal,
): void {
  new CanvasHand(canvas, tool, listeners).listen(signal);
}

class CanvasHand {
  private drag: Dragging | undefined;
  /** Fingers put down during a drag. They are nothing to the camera, even once the drag is over. */
  private readonly others = new Set<number>();
  private isHandingOver = false;
  private down: PointerEvent | undefined;
  /** A press that opens the menu on release, unless it moves. */
  private menuDown: PointerEvent | undefined;
  /** A finger that opens the menu if it stays for long. */
  private holding: { readonly from: PointerEvent; readonly timer: ReturnType<typeof setTimeout> } | undefined;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly tool: () => CanvasTool | undefined,
    private readonly listeners: CanvasListeners,
  ) {}

  listen(signal: AbortSignal): void {
    const { canvas } = this;
    // In the window's capture phase: before the camera's own listener on the canvas, whenever that was added.
    window.addEventListener(
      'pointerdown',
      (event) => {
        if (event.target === canvas && !this.isHandingOver) this.press(event);
      },
      { capture: true, signal },
    );
    canvas.addEventListener('pointermove', (event) => this.hover(event), { signal });
    canvas.addEventListener('pointerup', (event) => this.release(event), { signal });
    for (const type of ['pointercancel', 'lostpointercapture'] as const) {
      canvas.addEventListener(type, (event) => this.lose(event), { signal });
    }
    const leave = () => {
      if (!this.drag) this.show(undefined);
    };
    canvas.addEventListener('pointerleave', leave, { signal });
    // The page has a menu of its own here, which a right drag must not open.
    canvas.addEventListener('contextmenu', (event) => event.preventDefault(), { signal });
    signal.addEventListener('abort', () => {
      this.stopHolding();
      this.finish()?.cancel();
    });
  }

  private press(event: PointerEvent): void {
    const { canvas, drag } = this;
    canvas.focus({ preventScroll: true });
    this.down = this.menuDown = undefined;
    this.stopHolding();
    if (drag) {
      this.pressMore(drag, event);
      return;
    }
    if (event.isPrimary && asksForMenu(event)) this.menuDown = event;
    const isMacMenu = this.menuDown !== undefined && event.button === 0;
    const of = event.isPrimary && !isMacMenu ? this.tool()?.press(event) : undefined;
    if (!of) {
      this.down = event.button === 0 && event.isPrimary && !isMacMenu ? event : undefined;
      if (event.pointerType === 'touch' && this.down) this.hold(event);
      return;
    }
    event.stopPropagation();
    const now: Dragging = { of, pointerId: event.pointerId, at: event, waiting: undefined };
    if (event.pointerType === 'touch') now.waiting = setTimeout(() => this.catchUp(now), PINCH_MS);
    this.drag = now;
    canvas.setPointerCapture(event.pointerId);
    window.addEventListener('keydown', this.onKey, { capture: true });
    this.listeners.claim?.(true);
    if (event.pointerType === 'touch' && !of.ownsLongPress) this.hold(event);
  }

  /** Another button or finger during a drag. */
  private pressMore(drag: Dragging, event: PointerEvent): void {
    const { of, at, waiting, pointerId } = drag;
    const isFinger = event.pointerType === 'touch' && event.pointerId !== pointerId;
    if (isFinger && at.pointerType === 'touch' && (waiting !== undefined || !of.hasBegun)) {
      this.handOver(drag);
      return;
    }
    // Other buttons or fingers during a drag don't reach the camera.
    event.stopPropagation();
    if (!isFinger) return;
    this.others.add(event.pointerId);
    of.fingers?.(1 + this.others.size);
  }

  private hover(event: PointerEvent): void {
    const { menuDown, holding, drag } = this;
    if (menuDown && !isNear(event, menuDown)) this.menuDown = undefined;
    if (holding && !isNear(event, holding.from)) this.stopHolding();
    if (this.others.has(event.pointerId)) event.stopPropagation();
    else if (drag) {
      if (event.pointerId !== drag.pointerId) return;
      drag.at = event;
      if (drag.waiting === undefined) this.move(drag);
    } else if (event.buttons === 0) {
      const cursor = this.show(event);
      // While dragging or placing something, don't highlight what is below.
      this.listeners.claim?.(cursor === 'grab' || cursor === 'crosshair');
    }
  }

  private show(at: PointerEvent | undefined): string {
    this.canvas.style.cursor = this.tool()?.hover?.(at) ?? '';
    return this.canvas.style.cursor;
  }

  private release(event: PointerEvent): void {
    this.stopHolding();
    const { menuDown, drag } = this;
    const asked = menuDown?.pointerId === event.pointerId && isNear(event, menuDown);
    this.lift(event);
    if (drag) {
      if (event.pointerId !== drag.pointerId) return;
      this.catchUp(drag);
      this.finish()?.end(event);
    } else {
      const from = this.down;
      this.down = undefined;
      if (from && isNear(event, from) && !this.tool()?.click?.(event)) this.listeners.pick(event);
    }
    if (!asked) return;
    this.menuDown = undefined;
    this.listeners.menu?.(event);
  }

  private lose(event: PointerEvent): void {
    this.stopHolding();
    if (event.pointerId === this.drag?.pointerId) this.finish()?.cancel();
    else this.lift(event);
  }

  private lift(event: PointerEvent): void {
    if (this.others.delete(event.pointerId)) this.drag?.of.fingers?.(1 + this.others.size);
  }

  private hold(from: PointerEvent): void {
    const open = () => {
      this.holding = this.down = undefined;
      this.finish()?.cancel();
      this.listeners.menu?.(from);
    };
    this.holding = { from, timer: setTimeout(open, LONG_PRESS_MS) };
  }

  private stopHolding(): void {
    clearTimeout(this.holding?.timer);
    this.holding = undefined;
  }

  private move({ of, at }: Dragging): void {
    of.move(at);
    if (of.hasBegun) this.stopHolding();
  }

  /** What the drag has waited with. */
  private catchUp(now: Dragging): void {
    const { waiting } = now;
    clearTimeout(waiting);
    now.waiting = undefined;
    if (waiting !== undefined && now.at.type === 'pointermove') this.move(now);
  }

  /** A pinch that begins on something that a tool drags: nothing has changed, and the camera gets both fingers. */
  private handOver({ at }: Dragging): void {
    this.finish()?.cancel();
    this.isHandingOver = true;
    this.canvas.dispatchEvent(new PointerEvent('pointerdown', at));
    this.isHandingOver = false;
  }

  private readonly onKey = (event: KeyboardEvent): void => {
    if (event.key !== 'Escape') {
      waitOutDrag(event);
      return;
    }
    event.preventDefault();
    event.stopPropagation();
    this.finish()?.cancel();
  };

  private finish(): CanvasDrag | undefined {
    const { drag, canvas } = this;
    if (drag && canvas.hasPointerCapture(drag.pointerId)) canvas.releasePointerCapture(drag.pointerId);
    clearTimeout(drag?.waiting);
    this.drag = undefined;
    window.removeEventListener('keydown', this.onKey, { capture: true });
    if (drag) this.listeners.claim?.(false);
    return drag?.of;
  }
}

function asksForMenu(event: PointerEvent): boolean {
  return event.pointerType !== 'touch' && buttonMeant(event, isMac) === 2;
}

function isNear(at: CanvasPointer, from: CanvasPointer): boolean {
  return Math.hypot(at.clientX - from.clientX, at.clientY - from.clientY) <= CLICK_PIXELS;
}
