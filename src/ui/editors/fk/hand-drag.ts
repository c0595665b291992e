/**
 * A drag of a handle or a bone, from the press to the release. Nothing happens until the pointer has moved: then what
 * plays stands still, and the pose at that moment is the one that is changed. One undo step; Escape gives it up.
 */
import { setDofs } from '../../../edit/commands/pose.ts';
import { findCharacter } from '../../../model/document.ts';
import { HandEdit } from '../../state/hand-edit.ts';
import { standStill } from '../../state/stand-still.ts';
import type { Workbench } from '../../state/workbench.ts';
import { autoKey } from '../posing/pose-edits.ts';
import { tellFollows } from '../posing/tell-follows.ts';
import type { CanvasDrag, CanvasPointer } from '../viewport/canvas-tools.ts';
import type { DragResult, Mover } from './movers.ts';

export interface HandDragEvents {
  /** Makes the mover, in the pose as it stands. Undefined: nothing can be dragged after all. */
  begin(): Mover | undefined;
  /** After each move, with the document as it was left. */
  moved(moved: DragResult, at: CanvasPointer): void;
  /** The release, or Escape. @param wentNowhere it was a click, so to say */
  ended(at: CanvasPointer | undefined, wentNowhere: boolean): void;
}

export function handDrag(
  wb: Workbench,
  characterId: string,
  from: CanvasPointer,
  threshold: number,
  events: HandDragEvents,
): CanvasDrag {
  const edit = new HandEdit(wb.store, wb.messages);
  let mover: Mover | undefined;
  let hasBegun = false;
  /** What has stood still in the picture for the drag goes on. */
  let rest = () => {};
  return {
    move(at) {
      if (!hasBegun) {
        if (Math.hypot(at.clientX - from.clientX, at.clientY - from.clientY) < threshold) return;
        hasBegun = true;
        standStill(wb);
        rest = wb.viewport.holdTravel(characterId);
        mover = events.begin();
      }
      if (!mover) return;
      const moved = mover(at);
      const { timeSeconds } = wb.transport.get();
      edit.preview(setDofs, { characterId, dofs: moved.dofs, timeSeconds, key: autoKey(wb) });
      // After it has begun: what was said before a step is left behind by it.
      const character = findCharacter(wb.store.document, characterId);
      if (character)
        tellFollows(
          wb,
          character,
          moved.dofs.map(({ index }) => index),
        );
      events.moved(moved, at);
    },
    end(at) {
      edit.commit();
      rest();
      events.ended(at, !hasBegun);
    },
    cancel() {
      edit.cancel();
      rest();
      events.ended(undefined, false);
    },
  };
}
