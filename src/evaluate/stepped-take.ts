/**
 * Stepped preview: each keyed channel holds the value of its last key at or before a time, and before the first key
 * that of the first; curves of goals and all layers, too, and what it follows. Animators block poses so. It is a take
 * like any other, which is evaluated as ever.
 */
import { type Character, type Driver, shownTake } from '../model/document.ts';
import { perObject } from '../model/per-object.ts';
import { withChannelsOf } from '../model/takes/channels-with-goals.ts';
import { layerCode, withCurvesOfGoals } from '../model/takes/layer-code.ts';
import { type Channel, type KeyedChannel, NO_EXTRAPOLATION, type Take } from '../model/takes/take.ts';
import { FLAT } from '../model/takes/tangent-kinds.ts';

/** A take in which every key holds its value up to the next one; samples and resting channels are as they were; cached. */
export const steppedTake = perObject((take: Take): Take => {
  const { length } = take.channels;
  const stepped = withChannelsOf(take, withCurvesOfGoals(take, length).channels.map(steppedIfKeyed), length);
  if (!take.layers) return stepped;
  // Whichever of them is active.
  return layerCode(take).withMotions(stepped, (motion, layer) =>
    layer === take.layers?.active ? motion : { ...motion, channels: motion.channels.map(steppedIfKeyed) },
  );
});

/** The character with its shown take stepped, and what else moves it; the same object without a take; cached. */
export const steppedCharacter = perObject((character: Character): Character => {
  const { driver, leaders } = character;
  const take = shownTake(character);
  if (!take && !driver) return character;
  const takes = character.takes.map((each) => (each === take ? steppedTake(take) : each));
  return { ...character, takes, ...(driver && { driver: steppedDriver(driver) }), ...steppedLeaders(leaders) };
});

const steppedDriver = perObject((driver: Driver): Driver => {
  const { source } = driver;
  const { take, leaders } = source;
  return { ...driver, source: { ...source, take: steppedTake(take), ...steppedLeaders(leaders) } };
});

function steppedLeaders(leaders: Character['leaders']): Pick<Character, 'leaders'> {
  return leaders ? { leaders: leaders.map(steppedCharacter) } : {};
}

const steppedIfKeyed = (channel: Channel) => (channel.kind === 'keys' ? steppedChannel(channel) : channel);

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
