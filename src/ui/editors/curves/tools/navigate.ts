/** Navigation: panning, zooming by drag, and the wheel. It doesn't change the document, so there is nothing to undo. */
import { pan, zoom } from '../scene/space.ts';
import { type Drag, NOTHING_TO_UNDO, type PlotAccess, type PointerAt } from './tool.ts';

export function panDrag(plot: PlotAccess, from: PointerAt): Drag {
  let last = from;
  return {
    cursor: () => 'grabbing',
    move(at) {
      const scene = plot.scene();
      if (scene) plot.look(pan(scene.space, at.x - last.x, at.y - last.y));
      last = at;
    },
    end: NOTHING_TO_UNDO,
    cancel: NOTHING_TO_UNDO,
  };
}

/** Pixels of dragging that zoom by a factor of e. */
const ZOOM_PIXELS = 150;

/** Right and up zooms in; Shift constrains it to the dominant direction. */
export function zoomDrag(plot: PlotAccess, from: PointerAt): Drag {
  let last = from;
  return {
    cursor: () => 'zoom-in',
    move(at) {
      const scene = plot.scene();
      const sideways = Math.abs(at.x - from.x) >= Math.abs(at.y - from.y);
      const dx = at.shift && !sideways ? 0 : at.x - last.x;
      const dy = at.shift && sideways ? 0 : at.y - last.y;
      last = at;
      if (!scene) return;
      plot.look(zoom(scene.space, from.x, from.y, Math.exp(-dx / ZOOM_PIXELS), Math.exp(dy / ZOOM_PIXELS)));
    },
    end: NOTHING_TO_UNDO,
    cancel: NOTHING_TO_UNDO,
  };
}

const ZOOM_STEP = 1.15;
/** Pixels per line, for wheels that count in lines. */
const LINE_PIXELS = 16;
/** A typical wheel notch in pixels: one zoom step. */
const STEP_PIXELS = 60;

export interface Wheel
  extends Pick<WheelEvent, 'deltaX' | 'deltaY' | 'deltaMode' | 'shiftKey' | 'ctrlKey' | 'altKey'> {}

/** What a wheel event does: a pan in pixels, or factors above 1 that zoom out. */
export function wheelMeans(
  wheel: Wheel,
): { readonly panX: number } | { readonly time: number; readonly value: number } {
  const unit = wheel.deltaMode === 1 ? LINE_PIXELS : 1;
  const sideways = Math.abs(wheel.deltaX) > Math.abs(wheel.deltaY);
  if (sideways && !wheel.shiftKey) return { panX: -wheel.deltaX * unit };
  // With Shift, some systems already scroll horizontally.
  const factor = ZOOM_STEP ** (((sideways ? wheel.deltaX : wheel.deltaY) * unit) / STEP_PIXELS);
  const valuesOnly = !wheel.shiftKey && (wheel.ctrlKey || wheel.altKey);
  return { time: valuesOnly ? 1 : factor, value: wheel.shiftKey ? 1 : factor };
}
