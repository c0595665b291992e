/** Which reach of IK is chosen, in words: shared by the bar, the menu and the search. */
import type { Character } from '../../../model/document.ts';
import { jointName } from '../../../model/skeleton/joint-name.ts';
import type { Skeleton } from '../../../model/skeleton/skeleton.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import type { Uses } from '../../state/workbench.ts';

export const CHOSEN_REACHES = ['limb', 'body', 'chain'] as const;
export type ChosenReach = (typeof CHOSEN_REACHES)[number];

export const REACH_NAMES: Readonly<Record<ChosenReach, string>> = { limb: 'Limb', body: 'Full body', chain: 'Chain' };

/** A sentence each. */
export const REACH_MEANINGS: Readonly<Record<ChosenReach, string>> = {
  limb: 'A dragged joint bends its own limb: a hand its arm, a foot its leg, a head its neck',
  body: 'A dragged joint moves the whole character while planted feet are held',
  chain: 'A dragged joint bends all joints up to a chosen one: select it, then choose this',
};

/** The reach that a drag has. Pose mode is by limbs, until another reach was chosen. */
export function reachShown(
  wb: Uses<'settings' | 'posing'>,
  character: Pick<Character, 'skeleton'> | undefined,
): ChosenReach {
  const { ikReach } = wb.settings.get();
  if (ikReach !== 'usual') return ikReach;
  return isWholeChain(wb, character?.skeleton) ? 'chain' : 'limb';
}

/** Whether a drag bends all up to the root, as long as nothing was chosen. */
export function isWholeChain(
  { settings, posing }: Uses<'settings' | 'posing'>,
  skeleton: Skeleton | undefined,
): boolean {
  return settings.get().ikReach === 'usual' && skeleton?.form === 'axis-angle' && posing.mode.get() !== 'pose';
}

/** The joint where chains of the character end; undefined: at the root. */
export function chainTopOf({ posing }: Uses<'posing'>, { id, skeleton }: Character): number | undefined {
  const top = posing.ik.chainTop;
  return top?.characterId === id && skeleton && top.joint < skeleton.joints.length ? top.joint : undefined;
}

/** `Chain up to spine`: where chains end now. */
export function chainText(wb: Uses<'store' | 'posing'>): string {
  const character = currentCharacter(wb);
  const top = character && chainTopOf(wb, character);
  return `Chain up to ${character && top !== undefined ? jointName(character.skeleton, top) : 'the root'}`;
}
