/** Dragging on a card of the library blends to its pose. */
import { applyPose } from '../../../edit/commands/poses.ts';
import { followPointer } from '../../kit/drag.ts';
import { addKeyed } from '../../state/add-keys.ts';
import { HandEdit } from '../../state/hand-edit.ts';
import type { Uses } from '../../state/workbench.ts';
import { moment } from './pose-edits.ts';

/** Pixels to the right that apply the whole pose. */
const WHOLE_DRAG = 160;

export interface Blended {
  readonly characterId: string;
  readonly pose: number;
  readonly joint: number | undefined;
}

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
  { characterId, pose, joint }: Blended,
  show: (share: number | undefined) => void,
): void {
  const hand = new HandEdit(wb.store, wb.messages);
  const at = moment(wb);
  const giveUp = followPointer(grid, down, {
    move: (event) => {
      if (hand.cancelled) {
        giveUp();
        return show(undefined);
      }
      const share = Math.min(1, Math.max(0, (event.clientX - down.clientX) / WHOLE_DRAG));
      const args = { characterId, pose, share, joint, ...at };
      hand.preview(applyPose, args, () => addKeyed(wb, applyPose, args));
      show(share);
    },
    over: (_, release) => {
      if (!release) hand.cancel();
      hand.commit();
      show(undefined);
    },
  });
}
