/**
 * A drag of a handle or a bone, from press to release. Nothing happens until the pointer has moved: then playback
 * stops, and the pose at that time is edited. One undo step; Escape cancels it.
 */
import { jointIn } from '../../../edit/step-names.ts';
import { type Character, findCharacter } from '../../../model/document.ts';
import { characterDofs } from '../../../model/skeleton/dofs.ts';
import { HandEdit } from '../../state/actions/hand-edit.ts';
import { addKeyed } from '../../state/add-keys.ts';
import { jointsText } from '../../state/joints/selected-joint.ts';
import { pausePlayback } from '../../state/pause-playback.ts';
import type { BesideDofs } from '../../state/posing.ts';
import type { Uses, Workbench } from '../../state/workbench.ts';
import { autoKey, posingCommand } from '../posing/pose-edits.ts';
import { tellFollows } from '../posing/tell-follows.ts';
import type { CanvasDrag, CanvasPointer } from '../viewport/canvas-tools.ts';
import type { DragResult, Mover } from './movers.ts';

export interface DraggedJoint {
  readonly characterId: string;
  /** Index. */
  readonly joint: number;
}

export interface HandDragEvents {
  /** Creates the mover for the current pose. Undefined: nothing can be dragged after all. */
  begin(): Mover | undefined;
  /** After each move, with the updated document. */
  moved(moved: DragResult, at: CanvasPointer): void;
  /** The release, or Escape. @param isUnmoved it was in effect a click */
  ended(at: CanvasPointer | undefined, isUnmoved: boolean): void;
}

export function handDrag(
  wb: Workbench,
  { characterId, joint }: DraggedJoint,
  from: CanvasPointer,
  threshold: number,
  events: HandDragEvents,
): CanvasDrag {
  const skeletonNow = () => findCharacter(wb.store.document, characterId)?.skeleton;
  const skeleton = skeletonNow();
  // The mover knows DOFs by index, and counts from the press.
  const edit = new HandEdit(wb.store, wb.messages, () => skeletonNow() === skeleton);
  let mover: Mover | undefined;
  /** While pins hold. */
  let beside: BesideDofs | undefined;
  let hasBegun = false;
  /** Resumes following and *in place*, which the drag has paused. */
  let rest = () => {};
  return {
    get hasBegun() {
      return hasBegun;
    },
    move(at) {
      if (!hasBegun) {
        if (Math.hypot(at.clientX - from.clientX, at.clientY - from.clientY) < threshold) return;
        hasBegun = true;
        pausePlayback(wb);
        rest = wb.viewport.freezeRootMotion(characterId);
        mover = events.begin();
      }
      if (!mover || edit.cancelled) return;
      const moved = mover(at);
      beside ??= wb.posing.beside?.(characterId, constrainedDofs(wb, { characterId, joint }, moved), joint);
      const own = [...moved.dofs, ...moved.others];
      const dofs = beside?.at(own) ?? own;
      const { timeSeconds } = wb.transport.get();
      const label = () => dragLabel(findCharacter(wb.store.document, characterId), joint, moved);
      const command = { ...posingCommand(wb), label };
      const args = { characterId, dofs, timeSeconds, key: autoKey(wb) };
      edit.preview(command, args, () => addKeyed(wb, command, args));
      beside?.shown();
      // After the edit has begun, since messages are cleared by a new step.
      const character = findCharacter(wb.store.document, characterId);
      if (character)
        tellFollows(
          wb,
          character,
          dofs.map(({ index }) => index),
        );
      events.moved(moved, at);
    },
    end(at) {
      edit.commit();
      beside?.over();
      rest();
      events.ended(at, !hasBegun);
    },
    cancel() {
      edit.cancel();
      beside?.over();
      rest();
      events.ended(undefined, false);
    },
  };
}

/** What the drag sets, while pins adapt the rest: a rotation as a whole, or the joint would tilt about its other axes. */
function constrainedDofs(
  { store }: Uses<'store'>,
  { characterId, joint }: DraggedJoint,
  { verb, dofs, others }: DragResult,
): readonly number[] {
  const own = [...dofs, ...others].map(({ index }) => index);
  const skeleton = findCharacter(store.document, characterId)?.skeleton;
  if (verb !== 'Rotate' || !skeleton) return own;
  const all = characterDofs(skeleton, []);
  const joints = new Set([joint, ...others.map(({ index }) => all[index].joint)]);
  const angles = all.flatMap((dof, index) => (joints.has(dof.joint) && dof.unit === 'angle' ? [index] : []));
  return [...new Set([...own, ...angles])];
}

/** `Rotate leg_l`, `Rotate 3 joints`. */
function dragLabel(character: Character | undefined, joint: number, { verb, others }: DragResult): string {
  const all = characterDofs(character?.skeleton, []);
  const joints = new Set([joint, ...others.map(({ index }) => all[index].joint)]);
  const what =
    joints.size > 1 ? jointsText(character?.skeleton, [...joints]) : jointIn({ skeleton: character?.skeleton }, joint);
  return `${verb} ${what}`;
}
