/** The limbs that the selected joints belong to. */
import type { Character } from '../../../model/document.ts';
import type { Limb } from '../../../model/limbs.ts';
import { selectedJoints } from '../../state/joints/selected-joint.ts';
import type { Uses } from '../../state/workbench.ts';

export interface SelectedLimbs {
  readonly character: Character;
  /** By their indices, ascending; at least one. */
  readonly limbs: readonly { readonly index: number; readonly limb: Limb }[];
}

/** Undefined if no selected joint belongs to one. */
export function selectedLimbs(wb: Uses<'store'>): SelectedLimbs | undefined {
  const selected = selectedJoints(wb);
  if (!selected) return undefined;
  const { character, joints } = selected;
  const limbs = (character.limbs?.list ?? []).flatMap((limb, index) =>
    limb.joints.some((joint) => joints.includes(joint)) ? [{ index, limb }] : [],
  );
  return limbs.length > 0 ? { character, limbs } : undefined;
}
