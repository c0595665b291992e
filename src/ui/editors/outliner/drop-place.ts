/** Where a drop on the tree puts a joint. */
import { branchEnd, canHangOn } from '../../../edit/rig/parents.ts';
import type { Joint } from '../../../model/skeleton/skeleton.ts';

/** Why a joint can't be dropped on a row; undefined if nothing has to be said. */
export function whyNoDrop(
  joints: readonly Pick<Joint, 'parent' | 'name'>[],
  joint: number,
  row: number,
): string | undefined {
  if (row === joint || joint <= 0 || row < joint || row >= branchEnd(joints, joint)) return undefined;
  const called = (j: number) => joints[j].name || `joint ${j}`;
  return `${called(joint)} can’t be parented to its descendant ${called(row)}.`;
}

/** The part of a row that the pointer is in. */
export type RowPart = 'above' | 'on' | 'below';

/** @param at 0 at the row's top, 1 at its bottom */
export function rowPart(at: number): RowPart {
  return at < 0.25 ? 'above' : at > 0.75 ? 'below' : 'on';
}

export interface NewPlace {
  readonly parent: number;
  /** Inserted before this child of the parent; absent: last. */
  readonly before?: number;
}

/**
 * New parent and position of a joint dropped on a row. Undefined if impossible, or unchanged.
 *
 * @param isOpen whether the row's children are shown below it: "below" then means before the first child
 */
export function dropPlace(
  joints: readonly Pick<Joint, 'parent'>[],
  joint: number,
  row: number,
  part: RowPart,
  isOpen: boolean,
): NewPlace | undefined {
  const place = placeAt(joints, row, part, isOpen);
  if (!place || !canHangOn(joints, joint, place.parent)) return undefined;
  const next = nextSibling(joints, joint);
  // Before itself means its present position.
  const before = place.before === joint ? next : place.before;
  if (joints[joint].parent === place.parent && before === next) return undefined;
  return before === undefined ? { parent: place.parent } : { parent: place.parent, before };
}

function placeAt(
  joints: readonly Pick<Joint, 'parent'>[],
  row: number,
  part: RowPart,
  isOpen: boolean,
): NewPlace | undefined {
  const { parent } = joints[row];
  // The root has no siblings.
  if (part === 'on' || parent < 0) return part === 'below' && isOpen ? firstOf(joints, row) : { parent: row };
  if (part === 'above') return { parent, before: row };
  if (isOpen) return firstOf(joints, row);
  const before = nextSibling(joints, row);
  return before === undefined ? { parent } : { parent, before };
}

/** A first child directly follows its parent. */
function firstOf(joints: readonly Pick<Joint, 'parent'>[], parent: number): NewPlace {
  return joints[parent + 1]?.parent === parent ? { parent, before: parent + 1 } : { parent };
}

function nextSibling(joints: readonly Pick<Joint, 'parent'>[], joint: number): number | undefined {
  const end = branchEnd(joints, joint);
  return joints[end]?.parent === joints[joint].parent ? end : undefined;
}
