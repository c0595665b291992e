/** A drag on a card of the library, which blends to its pose. */
import { applyPose } from '../../../edit/commands/poses.ts';
import { followPointer } from '../../kit/drag.ts';
import { HandEdit } from '../../state/hand-edit.ts';
import type { Uses } from '../../state/workbench.ts';
import { moment } from './pose-edits.ts';

/** A drag of that many CSS pixels to the right is the whole pose. */
const WHOLE_DRAG = 160;

export interface Blended {
  readonly characterId: string;
  readonly pose: number;
  readonly joint: number | undefined;
}

/**
 * As much of the pose as the hand has moved to the right; one undo step.
 * @param grid holds the pointer
 * @param show is told how much; undefined: it is over
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
      hand.preview(applyPose, { characterId, pose, share, joint, ...at });
      show(share);
    },
    over: (_, release) => {
      if (!release) hand.cancel();
      hand.commit();
      show(undefined);
    },
  });
}
