/** Steps of goals' curves that a change of tangents leaves: without them feet slide for the whole take. */
import { dofCountOf } from '../../evaluate/pose.ts';
import { type Character, shownTake } from '../../model/document.ts';
import type { ChannelKeys } from '../../model/session.ts';
import { GOAL_CHANNELS, type KeyedChannel } from '../../model/takes/take.ts';
import { isStepped } from '../keys/steps.ts';

/** The steps that stay in a channel of a goal. */
export interface StepsKept {
  /** Whether the key at an index stays as it is: it is a switch between FK and IK, or of the side, and a step. */
  stays(channel: KeyedChannel, key: number): boolean;
  /** Times at which the goal's space changes: a step there stays, whatever the tangents beside it. */
  readonly spaceTimes: readonly number[];
}

/**
 * The steps that stay in each channel among the keys; undefined for any that is no goal's. Switches change only where no
 * other keys are among them.
 */
export function stepsKept(
  character: Character,
  keys: readonly ChannelKeys[],
): (channel: number) => StepsKept | undefined {
  const count = dofCountOf(character);
  const nameOf = (channel: number) => GOAL_CHANNELS[(channel - count) % GOAL_CHANNELS.length];
  const isSwitch = (channel: number) => channel >= count && (nameOf(channel) === 'blend' || nameOf(channel) === 'bend');
  const isAlone = keys.every(({ channel }) => isSwitch(channel));
  return (channel) => {
    const goal = shownTake(character)?.goals?.list[Math.floor((channel - count) / GOAL_CHANNELS.length)];
    if (!goal) return undefined;
    const { space } = goal;
    return {
      stays: (curve, key) => !isAlone && isSwitch(channel) && isStep(curve, key),
      spaceTimes: typeof space === 'string' ? [] : space.map(([time]) => time),
    };
  };
}

function isStep(channel: KeyedChannel, k: number): boolean {
  const { times } = channel;
  return times[k - 1] === times[k] || times[k + 1] === times[k] || isStepped(channel, k);
}
