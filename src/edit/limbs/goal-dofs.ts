/** Values of goals among those of DOFs: by the indices of their channels, after all DOFs (`withGoalChannels`). */
import { compileChannels } from '../../evaluate/compiled-take.ts';
import { evaluateChannel } from '../../evaluate/curves.ts';
import { channelOf, dofCountOf, shownUnkeyed } from '../../evaluate/pose.ts';
import { type Character, shownTake } from '../../model/document.ts';
import { layerCode } from '../../model/takes/layer-code.ts';
import { GOAL_CHANNELS } from '../../model/takes/take.ts';

/** Number of a character's DOFs and of the curves of its goals. */
export function controlCountOf(character: Character): number {
  return dofCountOf(character) + GOAL_CHANNELS.length * (shownTake(character)?.goals?.list.length ?? 0);
}

/**
 * The values with which the pose is shown as wanted: those of limbs in IK are their goals'.
 * @param keys whether the pose is as displayed, and goals are given as they are, to be keyed
 */
export function withGoalsPosed(
  character: Character,
  values: ReadonlyMap<number, number>,
  timeSeconds: number,
  keys: boolean,
): ReadonlyMap<number, number> {
  const take = shownTake(character);
  return take?.goals ? layerCode(take).posedByGoals(character, values, timeSeconds, keys) : values;
}

/** The value of a goal's curve at a time of the transport. */
export function goalValueAt(character: Character, index: number, timeSeconds: number): number {
  const byHand = shownUnkeyed(character, timeSeconds);
  const own = byHand?.values[byHand.dofs.indexOf(index)];
  const channel = channelOf(character, index);
  if (own !== undefined || !channel) return own ?? 0;
  return evaluateChannel(compileChannels([channel]), 0, timeSeconds + character.timeOffsetSeconds);
}
