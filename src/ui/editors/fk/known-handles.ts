/**
 * The handles of the selected joint, requested before every frame and recomputed only if the pose, its placement or the
 * joint has changed: if only the camera or the pointer moved, the same object is returned.
 */

import { type JointHandles, jointHandles } from '../../../evaluate/handles/joint-handles.ts';
import { sameNumbers } from '../../../math/same-numbers.ts';
import type { Skeleton } from '../../../model/skeleton/skeleton.ts';

export class KnownHandles {
  private known: JointHandles | undefined;
  private skeleton: Skeleton | undefined;
  private joint = -1;
  private holds = false;
  private dofs = new Float64Array(0);
  private placement = new Float64Array(0);

  /**
   * As `jointHandles`, without those of locked DOFs: dragged they would do nothing.
   *
   * @param world belongs to the pose `dofs`
   * @param holds whether limits are enforced
   */
  of(
    skeleton: Skeleton,
    joint: number,
    dofs: Float64Array,
    world: Float64Array,
    placement: Float64Array,
    holds: boolean,
  ): JointHandles {
    const isSame =
      skeleton === this.skeleton &&
      joint === this.joint &&
      holds === this.holds &&
      sameNumbers(dofs, this.dofs) &&
      sameNumbers(placement, this.placement);
    if (this.known && isSame) return this.known;
    this.skeleton = skeleton;
    this.joint = joint;
    this.holds = holds;
    this.dofs = copied(dofs, this.dofs);
    this.placement = copied(placement, this.placement);
    const known = jointHandles(skeleton, joint, dofs, world, placement);
    const handles = holds ? known.handles.filter(({ range }) => range.min < range.max) : known.handles;
    this.known = { ...known, handles };
    return this.known;
  }
}

/** Reuses the target array if it fits. */
function copied(from: Float64Array, to: Float64Array<ArrayBuffer>): Float64Array<ArrayBuffer> {
  if (from.length !== to.length) return from.slice();
  to.set(from);
  return to;
}
