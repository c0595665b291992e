/**
 * What bends when a joint is dragged: as chosen in the bar, or what is usual for the skeleton. Skeletons in the
 * axis-angle form bend in IK mode as in the program that form comes from, from the root on; others, and in Pose mode
 * all, by limbs.
 */
import { type DragReach, dragReach, WHOLE } from '../../../evaluate/ik/drag/drag-reach.ts';
import type { IkReach } from '../../../evaluate/ik/limb.ts';
import { type Character, findCharacter } from '../../../model/document.ts';
import { jointName } from '../../../model/skeleton/joint-name.ts';
import type { Skeleton } from '../../../model/skeleton/skeleton.ts';
import type { Uses } from '../../state/workbench.ts';
import { plural } from '../../widgets/numbers/number-text.ts';
import { chainTopOf, isWholeChain, reachShown } from './reach-choice.ts';

/** @param placement from the character's space to the scene's */
export function reachOfDrag(
  wb: Uses<'settings' | 'posing'>,
  character: Character,
  skeleton: Skeleton,
  world: Float64Array,
  placement: Float64Array,
  joint: number,
): DragReach {
  if (isWholeChain(wb, skeleton)) return WHOLE;
  return dragReach(character, skeleton, world, placement, joint, chosenReach(wb, character));
}

function chosenReach(wb: Uses<'settings' | 'posing'>, character: Character): IkReach {
  const reach = reachShown(wb, character);
  return reach === 'chain' ? { top: chainTopOf(wb, character) ?? 0 } : reach;
}

/**
 * `Bend upper_arm_l to hand_l`, `Move the body while 2 feet hold`: for the status bar, while the pose and the placement
 * shown are those where a drag would begin. Undefined if there is nothing to move.
 */
export function whatMoves(
  wb: Uses<'store' | 'viewport' | 'settings' | 'posing'>,
  characterId: string,
  joint: number,
): string | undefined {
  const character = findCharacter(wb.store.document, characterId);
  const skeleton = character?.skeleton;
  const world = wb.viewport.character(characterId)?.worlds;
  const placement = character && wb.viewport.placementOf(characterId, wb.viewport.pickedCopy(character));
  if (!skeleton || !world || !placement || placement.length < 16) return undefined;
  const reach = reachOfDrag(wb, character, skeleton, world, placement, joint);
  if (reach === WHOLE) return 'Bend all up to the root';
  const { bending, standing } = reach;
  if (bending === 'body') {
    if (standing.length === 0) return 'Move the body';
    return `Move the body while ${plural(standing.length, 'foot', 'feet')} ${standing.length === 1 ? 'holds' : 'hold'}`;
  }
  const [first] = bending;
  const name = jointName(skeleton, joint);
  if (bending.length === 1) return `Bend ${name} alone`;
  return `Bend ${jointName(skeleton, first)} to ${name}`;
}
