/** Texts of the question about keys outside a cycle. */

import { CommandError } from '../../../edit/command-error.ts';
import { type OutsideCycle, placeOf, withRepeatsBaked } from '../../../edit/keys/cycle.ts';
import { sameTime } from '../../../edit/keys/same-time.ts';
import type { KeyedChannel } from '../../../model/takes/take.ts';
import type { CycleQuestion } from '../../state/cycle-question.ts';
import { plural, shown } from '../../widgets/numbers/number-text.ts';
import { channelName, namedChannel, takeInTimeline } from './channels.ts';

export const OUTSIDE_LABELS: Readonly<Record<OutsideCycle, string>> = {
  bake: 'Bake the repeats, then key',
  inside: 'Key inside the cycle',
  lengthen: 'Lengthen the cycle',
};

export interface CycleText {
  /** What the key would do: `left_arm rx repeats every 0.8 s. A key at 2 s would make it repeat every 2 s.` */
  readonly about: string;
  /** The effect of each answer; absent if it isn't possible. */
  readonly answers: Readonly<Partial<Record<OutsideCycle, string>>>;
}

/** @param range playback range, in seconds of the transport */
export function cycleText(
  { character, changed }: Pick<CycleQuestion, 'character' | 'changed'>,
  range: readonly [number, number],
): CycleText {
  const [{ channel: index, from, to, timeSeconds }] = changed;
  const offset = character.timeOffsetSeconds;
  const channel = takeInTimeline(character)?.channels[index];
  const name = channelName(namedChannel(character, index));
  const time = seconds(timeSeconds - offset);
  const isOne = changed.length === 1;
  const alike = changed.every((one) => sameTime(one.from, from) && sameTime(one.to, to));
  const many = isOne ? name : `${name} and ${plural(changed.length - 1, 'more channel')}`;
  const about = alike
    ? `${many} ${isOne ? 'repeats' : 'repeat'} every ${seconds(from)}. A key at ${time} would make ${isOne ? 'it' : 'them'} repeat every ${seconds(to)}.`
    : `${plural(changed.length, 'channel')} repeat, such as ${name} every ${seconds(from)}. A key at ${time} would make each repeat over a longer time, ${name} every ${seconds(to)}.`;
  if (channel?.kind !== 'keys') return { about, answers: {} };
  const placing = { bakedRange: [range[0] + offset, range[1] + offset] as const };
  const [start, end] = [Math.min(timeSeconds, placing.bakedRange[0]), Math.max(timeSeconds, placing.bakedRange[1])];
  const baked = bakedRange(channel, start, end);
  const inside = placeOf(channel, timeSeconds, { ...placing, outsideCycle: 'inside' });
  return {
    about,
    answers: {
      ...(baked && {
        bake: `Repeats from ${shown(baked[0] - offset)} to ${seconds(baked[1] - offset)} become keys, and nothing is eased: the motion changes from the key before ${time} to the one after.`,
      }),
      ...(inside.isFolded && {
        inside: `The key is set at ${seconds(inside.time - offset)} instead, and every repeat shows it.`,
      }),
      lengthen: 'All keys repeat together, the new one included: the motion changes at other times too.',
    },
  };
}

/** What keying for a moment does: `Eased in and out around 2 s. …`, and how it repeats. */
export function momentText(
  { character, changed, timeSeconds }: Pick<CycleQuestion, 'character' | 'changed' | 'timeSeconds'>,
  range: readonly [number, number],
): string {
  const eased = `Eased in and out around ${seconds(timeSeconds)}; before and after, the take is as it was.`;
  if (changed.length === 0) return eased;
  const offset = character.timeOffsetSeconds;
  const channel = takeInTimeline(character)?.channels[changed[0].channel];
  const at = timeSeconds + offset;
  const [start, end] = [Math.min(at, range[0] + offset), Math.max(at, range[1] + offset)];
  const baked = channel?.kind === 'keys' ? bakedRange(channel, start, end) : undefined;
  if (!baked) return eased;
  return `${eased} Repeats from ${shown(baked[0] - offset)} to ${seconds(baked[1] - offset)} become keys, so it comes once every ${seconds(baked[1] - baked[0])}.`;
}

/** From which to which time keys would be; undefined if there would be too many. */
function bakedRange(channel: KeyedChannel, start: number, end: number): readonly [number, number] | undefined {
  try {
    const { times } = withRepeatsBaked(channel, start, end);
    return [times[0], times[times.length - 1]];
  } catch (error) {
    if (error instanceof CommandError) return undefined;
    throw error;
  }
}

/** A number never ends a line without its unit. */
function seconds(value: number): string {
  return `${shown(value)}\u00a0s`;
}
