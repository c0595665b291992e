/**
 * Stepped preview: each keyed channel holds the value of its last key at or before a time, and before the first key
 * that of the first; curves of goals, too. Animators block poses so. It is a take like any other, which is evaluated as
 * ever.
 */
import { type Character, shownTake } from '../model/document.ts';
import { perObject } from '../model/per-object.ts';
import { withChannelsOf } from '../model/takes/channels-with-goals.ts';
import { withCurvesOfGoals } from '../model/takes/layer-code.ts';
import { type KeyedChannel, NO_EXTRAPOLATION, type Take } from '../model/takes/take.ts';
import { FLAT } from '../model/takes/tangent-kinds.ts';

/** A take in which every key holds its value up to the next one; samples and resting channels are as they were; cached. */
export const steppedTake = perObject((take: Take): Take => {
  const { length } = take.channels;
  const all = withCurvesOfGoals(take, length).channels;
  const channels = all.map((channel) => (channel.kind === 'keys' ? steppedChannel(channel) : channel));
  return withChannelsOf(take, channels, length);
});

/** The character with its shown take stepped; the same object without a take; cached. */
export const steppedCharacter = perObject((character: Character): Character => {
  const take = shownTake(character);
  if (!take) return character;
  const takes = character.takes.map((each) => (each === take ? steppedTake(take) : each));
  return { ...character, takes };
});

/** Two keys per key: where it begins, and where the next one ends it. */
function steppedChannel({ times, values }: KeyedChannel): KeyedChannel {
  const count = 2 * times.length - 1;
  const held = { times: new Float64Array(count), values: new Float64Array(count) };
  for (let k = 0; k < times.length; k++) {
    held.times[2 * k] = times[k];
    held.values[2 * k] = values[k];
    if (k + 1 === times.length) break;
    held.times[2 * k + 1] = times[k + 1];
    held.values[2 * k + 1] = values[k];
  }
  const flat = { kinds: new Uint8Array(count).fill(FLAT), slopes: new Float64Array(count) };
  return { kind: 'keys', ...NO_EXTRAPOLATION, ...held, tangentsIn: flat, tangentsOut: flat };
}
