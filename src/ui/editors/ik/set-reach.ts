/** Chooses the reach of IK: by menu, or by a script with the arguments of `ik.setReach`. No undo step. */
import { CommandError } from '../../../edit/command-error.ts';
import { index, oneOf, optional, record } from '../../../edit/schema/shape.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import { selectedJoint } from '../../state/joints/selected-joint.ts';
import type { Uses } from '../../state/workbench.ts';
import { CHOSEN_REACHES, chainText, REACH_NAMES, reachShown } from './reach-choice.ts';

const ARGS = record({
  reach: oneOf(CHOSEN_REACHES),
  /** For `chain`: index of the joint that it ends with; default: the selected one, else the root. */
  top: optional(index),
});

/**
 * @param given without arguments: from full body to limb, and from others to full body
 * @throws CommandError for arguments of another shape, or a joint that the character doesn't have
 */
export function setReach(wb: Uses<'store' | 'posing' | 'settings' | 'messages'>, given: unknown): void {
  const isAsked = typeof given === 'object' && given !== null && Object.keys(given).length > 0;
  const next = reachShown(wb, currentCharacter(wb)) === 'body' ? 'limb' : 'body';
  const { reach, top } = isAsked ? ARGS.read(given, '') : ({ reach: next, top: undefined } as const);
  if (reach === 'chain') chooseTop(wb, top);
  wb.settings.update((now) => ({ ...now, ikReach: reach }));
  // In Pose and IK modes the bar shows it.
  if (wb.posing.mode.get() !== 'ik' && wb.posing.mode.get() !== 'pose')
    wb.messages.note(`IK reach: ${reach === 'chain' ? chainText(wb) : REACH_NAMES[reach]}.`);
}

function chooseTop(wb: Uses<'store' | 'posing'>, top: number | undefined): void {
  const character = currentCharacter(wb);
  const count = character?.skeleton?.joints.length ?? 0;
  if (top !== undefined && top >= count) {
    throw new CommandError(`"top" must be the index of a joint: there are ${count} joints, found ${top}.`);
  }
  const joint = top ?? selectedJoint(wb)?.joint;
  wb.posing.ik.chainTop = character && joint !== undefined ? { characterId: character.id, joint } : undefined;
}
