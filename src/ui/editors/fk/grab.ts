/** What a press grabs in FK; hovering lights up the same. */
import type { HandleHit } from '../../../view/gizmo/handle-at.ts';
import type { CanvasPointer } from '../viewport/canvas-tools.ts';

/** The joint under the pointer: the selected one, or another. */
export type UnderPointer = 'selected' | 'other' | undefined;

/** Undefined: nothing, so the press is the camera's. */
export type Grab = 'handle' | 'bone' | 'ball' | undefined;

/**
 * Handles come before bones unless they yield to them. Shift pans, since on a bone it only makes a running drag finer.
 * One finger orbits unless the joint was selected before: on a small screen there is little else to orbit with.
 *
 * @param under asked only if needed, since it takes a picking render
 */
export function grabOf(
  handle: HandleHit | undefined,
  under: () => UnderPointer,
  { shiftKey, pointerType }: Pick<CanvasPointer, 'shiftKey' | 'pointerType'>,
): Grab {
  const isBall = handle?.id.kind === 'ball';
  if (handle && !handle.yields) return 'handle';
  const joint = under();
  const isTouch = pointerType === 'touch';
  if (handle && !isBall && (joint !== 'other' || isTouch)) return 'handle';
  if (shiftKey || (joint === 'other' && isTouch)) return undefined;
  if (joint) return 'bone';
  return isBall ? 'ball' : undefined;
}
