/**
 * Who gets what the pointer does in the viewport. The tool of the mode is asked first; what it has no use for is the
 * camera's, which listens on the canvas itself:
 *
 *     press     the tool takes it, and everything up to the release is its drag; or the camera orbits
 *     click     a press that was the camera's and went nowhere: the tool's, or it picks
 *     hover     the tool may light something up, and say which cursor
 */
import { CLICK_PIXELS } from '../../../view/camera-travel.ts';
import { waitOutDrag } from '../../kit/keyboard.ts';

/** A press that moved further was a drag: for tools as for the camera. */
export { CLICK_PIXELS };

/** What is asked of a pointer event: places are client coordinates. */
export type CanvasPointer = Pick<
  PointerEvent,
  'clientX' | 'clientY' | 'button' | 'altKey' | 'shiftKey' | 'ctrlKey' | 'metaKey' | 'pointerType'
>;

export interface CanvasDrag {
  /** Every move. */
  move(at: CanvasPointer): void;
  /** Of touch: so many fingers are down now, that of the drag among them. */
  fingers?(count: number): void;
  /** The release. */
  end(at: CanvasPointer): void;
  /** Escape, or the browser took the pointer away: everything as before. */
  cancel(): void;
}

export interface CanvasTool {
  /** A drag, where the tool has something at that place; undefined leaves the press to the camera. */
  press(at: CanvasPointer): CanvasDrag | undefined;
  /** Whether a click was the tool's own; otherwise it picks. */
  click?(at: CanvasPointer): boolean;
  /**
   * Undefined: the pointer has left. What comes back is the cursor, as CSS has it; undefined: the usual one. `grab` says
   * that it is over a handle of the tool's own.
   */
  hover?(at: CanvasPointer | undefined): string | undefined;
}

/**
 * @param canvas what the camera listens on
 * @param tool the one of the mode, asked anew each time
 * @param pick a click that no tool wanted
 * @param claim told whether the pointer is a tool's, over a handle or in a drag: nothing else lights up under it
 */
export function listenToCanvas(
  canvas: HTMLCanvasElement,
  tool: () => CanvasTool | undefined,
  pick: (at: CanvasPointer) => void,
  signal: AbortSignal,
  claim: (isTools: boolean) => void = () => {},
): void {
  let drag: { readonly of: CanvasDrag; readonly pointerId: number; readonly others: Set<number> } | undefined;
  let down: PointerEvent | undefined;

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

  // In the capture phase of the window: before the camera's own listener on the canvas, whenever that was added.
  window.addEventListener(
    'pointerdown',
    (event) => {
      if (event.target !== canvas) return;
      canvas.focus({ preventScroll: true });
      down = undefined;
      if (drag) {
        // Another button or finger while something is dragged is not the camera's.
        event.stopPropagation();
        if (event.pointerType === 'touch' && event.pointerId !== drag.pointerId) {
          drag.others.add(event.pointerId);
          drag.of.fingers?.(1 + drag.others.size);
        }
        return;
      }
      const of = event.isPrimary ? tool()?.press(event) : undefined;
      if (!of) {
        down = event.button === 0 && event.isPrimary ? event : undefined;
        return;
      }
      event.stopPropagation();
      drag = { of, pointerId: event.pointerId, others: new Set() };
      canvas.setPointerCapture(event.pointerId);
      window.addEventListener('keydown', onKey, { capture: true });
      claim(true);
    },
    { capture: true, signal },
  );
  canvas.addEventListener(
    'pointermove',
    (event) => {
      if (drag) {
        if (event.pointerId === drag.pointerId) drag.of.move(event);
      } else if (event.buttons === 0) {
        canvas.style.cursor = tool()?.hover?.(event) ?? '';
        // A hand that pulls, or a place that is looked for: what lies under it is not what is meant.
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
      if (drag) {
        if (event.pointerId === drag.pointerId) finish()?.end(event);
        else lift(event);
        return;
      }
      const from = down;
      down = undefined;
      if (!from || Math.hypot(event.clientX - from.clientX, event.clientY - from.clientY) > CLICK_PIXELS) return;
      if (!tool()?.click?.(event)) pick(event);
    },
    { signal },
  );
  const lost = (event: PointerEvent) => {
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
  signal.addEventListener('abort', () => finish()?.cancel());
  // A right drag that is a tool's must not end in the browser's menu; the camera's never does.
  canvas.addEventListener('contextmenu', (event) => event.preventDefault(), { signal });
}
