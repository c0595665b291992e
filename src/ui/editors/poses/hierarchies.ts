import type { Character } from '../../../model/document.ts';
import { selectedJointsOf } from '../../state/joints/selected-joint.ts';
import type { Uses } from '../../state/workbench.ts';

/**
 * The joints whose hierarchies a pose is applied to: the selected ones. Undefined: the whole character, as without a
 * selected joint.
 */
export function hierarchiesMeant(
  wb: Uses<'store'>,
  { id }: Character,
  isBranch: boolean,
): readonly number[] | undefined {
  const joints = isBranch ? selectedJointsOf(wb, id) : [];
  return joints.length > 0 ? joints : undefined;
}
