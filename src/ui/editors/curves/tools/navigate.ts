/** Navigation: panning and zooming by drag. It doesn't change the document, so there is nothing to undo. */
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
