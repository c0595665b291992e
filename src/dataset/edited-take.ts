/** A take with the options applied, as a take again: for files of motion rather than of numbers. */
import { retargetBaked } from '../edit/commands/retarget.ts';
import { withoutDriver } from '../edit/drivers.ts';
import { withPlainTakes } from '../edit/limbs/plain-takes.ts';
import { type Character, shownTake } from '../model/document.ts';
import type { Take } from '../model/takes/take.ts';
import { type TakeOptions, takeOf } from './take.ts';

/**
 * The character that plays the takes of another one as edited: itself, or the target of retargeting. Frames that are
 * only cropped or mirrored keep the numbers of the file.
 * @param given layers, goals and attachments of its takes become part of them
 * @param options their `fps` is left to whoever samples the result
 * @throws CommandError, in a sentence, if nothing is left
 */
export function withEditedTakes(given: Character, options: Omit<TakeOptions, 'fps' | 'isRaw'>): Character {
  const source = withPlainTakes(given);
  const edited = source.takes.map((_, i) => editedTake({ ...source, shownTake: i }, options));
  const [first] = edited;
  if (!first) return options.target ? editedTake(source, options) : source;
  const { id, sources, parts } = source;
  const takes = edited.flatMap((character) => shownTake(character) ?? []);
  const whose = withoutDriver({ ...first, id, sources, takes, shownTake: source.shownTake });
  return parts ? { ...whose, parts } : whose;
}

/** With the edited take as the one that is shown. */
function editedTake(source: Character, options: TakeOptions): Character {
  const { character, first, count, frames } = takeOf(source, options);
  const name = shownTake(source)?.name ?? source.name;
  const played = character.driver ? baked(character, name) : character;
  const take = shownTake(played);
  if (!take || count === frames.frameCount) return played;
  return { ...played, takes: [cropped(take, first, count, frames)], shownTake: 0 };
}

/** With the baked take alone: the target's own only told its reference pose. */
function baked(character: Character, name: string): Character {
  const played = retargetBaked(character);
  const take = shownTake(played);
  return { ...played, takes: take ? [{ ...take, name }] : [], shownTake: 0 };
}

/** Crops a take: samples to the frames alone, from second 0; keys to the range. */
function cropped(
  take: Take,
  first: number,
  count: number,
  frames: { readonly startSeconds: number; readonly frameSeconds: number },
): Take {
  const { startSeconds, frameSeconds } = frames;
  const { samples } = take;
  const from = startSeconds + first * frameSeconds;
  if (!samples) return { ...take, range: [from, from + (count - 1) * frameSeconds] };
  const width = samples.scales.length;
  const values = samples.values.subarray(first * width, (first + count) * width);
  return {
    ...take,
    range: [0, (count - 1) * frameSeconds],
    samples: { ...samples, values, frameCount: count, startSeconds: 0 },
  };
}
