/**
 * Converts a tool dialog's answers to arguments of its command: seconds of the transport to the take's, displayed
 * degrees to radians. Units that were not asked for are left out.
 */
import type { ArgsOf } from '../../../../edit/command.ts';
import type { BakeExtrapolation, Resample, Simplify, Tolerances } from '../../../../edit/commands/channels.ts';
import type { scaleKeys } from '../../../../edit/commands/keys.ts';
import type { Character } from '../../../../model/document.ts';
import type { ChannelKeys } from '../../../../model/session.ts';
import { unitOfChannel } from '../../../../model/skeleton/dofs.ts';
import { DOF_UNITS, type DofUnit } from '../../../../model/skeleton/skeleton.ts';
import { shownPerUnit } from '../../../state/joints/angles.ts';
import type { Settings } from '../../../state/settings.ts';
import type { Answers } from '../../../widgets/form/form.ts';
import { dofsFor } from '../../timeline/channels.ts';

export const UNITS: readonly DofUnit[] = DOF_UNITS;

/** The units of a character's channels that a dialog has to ask for, in the order of `UNITS`. */
export function unitsOf(character: Character, channels: readonly number[]): DofUnit[] {
  const dofs = dofsFor(character);
  const found = new Set(channels.map((c) => unitOfChannel(dofs, c)));
  return UNITS.filter((unit) => found.has(unit));
}

/** From one number per unit, by the unit's name. */
export function simplifyArguments(
  character: Character,
  channels: readonly number[],
  answers: Answers,
  angles: Settings['angles'],
): Simplify {
  const tolerance: { -readonly [U in keyof Tolerances]: Tolerances[U] } = {};
  for (const unit of unitsOf(character, channels)) tolerance[unit] = answers.number(unit) / shownPerUnit(unit, angles);
  return { characterId: character.id, channels, tolerance };
}

/** From `rate`, `from`, `to` and `tangents`. Frames are those of the transport, as shown. */
export function resampleArguments(character: Character, channels: readonly number[], answers: Answers): Resample {
  return {
    characterId: character.id,
    channels,
    framesPerSecond: answers.number('rate'),
    offsetSeconds: character.timeOffsetSeconds,
    ...rangeOf(character, answers),
    tangents: answers.choice('tangents') === 'linear' ? 'linear' : 'smooth',
  };
}

/** From `from` and `to`. */
export function bakeArguments(character: Character, channels: readonly number[], answers: Answers): BakeExtrapolation {
  return { characterId: character.id, channels, ...rangeOf(character, answers) };
}

/** From `time`, `pivot`, `value` and one pivot value per unit, by the unit's name. */
export function scaleArguments(
  character: Character,
  keys: readonly ChannelKeys[],
  answers: Answers,
  angles: Settings['angles'],
): ArgsOf<typeof scaleKeys> {
  const dofs = dofsFor(character);
  return {
    characterId: character.id,
    keys,
    pivotSeconds: answers.number('pivot') + character.timeOffsetSeconds,
    timeFactor: answers.number('time'),
    valueFactor: answers.number('value'),
    pivotValues: keys.map(({ channel }) => {
      const unit = unitOfChannel(dofs, channel);
      return answers.number(unit) / shownPerUnit(unit, angles);
    }),
  };
}

/** In seconds of the take. */
function rangeOf({ timeOffsetSeconds }: Character, answers: Answers) {
  return { from: answers.number('from') + timeOffsetSeconds, to: answers.number('to') + timeOffsetSeconds };
}
