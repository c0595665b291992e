/** The class by which a DOF has its colour (`base.css`): one for turning, another for moving along the same axis. */

import { axisOfDof } from '../../../model/skeleton/dof-axis.ts';
import type { CharacterDof } from '../../../model/skeleton/dofs.ts';
import type { Skeleton } from '../../../model/skeleton/skeleton.ts';

/** `axis-x` of a rotation or a scale, `move-x` of a translation; `axis-other` if it has no main axis. */
export function dofClass(skeleton: Skeleton | undefined, dof: Pick<CharacterDof, 'joint' | 'name' | 'unit'>): string {
  const axis = axisOfDof(skeleton, dof);
  return axis ? `${dof.unit === 'length' ? 'move' : 'axis'}-${axis}` : 'axis-other';
}
