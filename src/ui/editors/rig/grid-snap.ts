/** Snapping to the grid on the ground, in rig mode. */
import type { Uses } from '../../state/workbench.ts';
import type { CanvasPointer } from '../viewport/canvas-tools.ts';

/** Minimum size of a snapping step in pixels. */
export const SNAP_PIXELS = 8;

/** World spacing that a click or a drag snaps to: that of the visible lines, unless Shift is held. Undefined: none. */
export function gridSnap(
  { settings, viewport }: Uses<'settings' | 'viewport'>,
  { shiftKey }: Pick<CanvasPointer, 'shiftKey'>,
): number | undefined {
  return settings.get().snapsToGrid && !shiftKey ? viewport.gridStep : undefined;
}
