/** Dragging on a card of the library blends to its pose. */

import type { Uses } from '../../state/workbench.ts';
import { followPointer } from '../../widgets/drag.ts';
import { type Blended, PoseBlend } from './pose-blend.ts';

/** Pixels to the right that apply the whole pose. */
const WHOLE_DRAG = 160;

/**
 * Blends the pose by how far the pointer has moved to the right; one undo step.
 *
 * @param grid captures the pointer
 * @param show shows the share; undefined: the drag has ended
 */
export function blendByDrag(
  wb: Uses<'store' | 'transport' | 'timeline' | 'settings' | 'messages'>,
  grid: HTMLElement,
  down: PointerEvent,
  blended: Blended,
  show: (share: number | undefined) => void,
): void {
  const blend = new PoseBlend(wb, blended);
  const giveUp = followPointer(grid, down, {
    move: (event) => {
      if (blend.cancelled) {
        giveUp();
        return show(undefined);
      }
      const share = Math.min(1, Math.max(0, (event.clientX - down.clientX) / WHOLE_DRAG));
      blend.to(share);
      show(share);
    },
    over: (_, release) => {
      if (!release) blend.cancel();
      blend.commit();
      show(undefined);
    },
  });
}
