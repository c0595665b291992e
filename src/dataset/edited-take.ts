/** A take with the options applied, as a take again: for files of motion rather than of numbers. */
import { bakeRetarget } from '../edit/commands/retarget.ts';
import { withoutDriver } from '../edit/drivers.ts';
import { type Character, EMPTY_DOCUMENT, shownClip } from '../model/document.ts';
import type { ChannelClip } from '../model/takes/clip.ts';
import { type TakeOptions, takeOf } from './take.ts';

/**
 * The character that plays the takes of another one as edited: itself, or the target of retargeting. Frames that are only
 * cropped or mirrored keep the numbers of the file.
 * @param options their `fps` is left to whoever samples the result
 * @throws CommandError, in a sentence, if nothing is left
 */
export function withEditedTakes(source: Character, options: Omit<TakeOptions, 'fps' | 'isRaw'>): Character {
  const edited = source.clips.map((_, i) => editedTake({ ...source, shownClip: i }, options));
  const [first] = edited;
  if (!first) return options.target ? editedTake(source, options) : source;
  const { id, sources, parts } = source;
  const clips = edited.flatMap((character) => shownClip(character) ?? []);
  const whose = withoutDriver({ ...first, id, sources, clips, shownClip: source.shownClip });
  return parts ? { ...whose, parts } : whose;
}

/** With the edited take as the one that is shown. */
function editedTake(source: Character, options: TakeOptions): Character {
  const { character, first, count, frames } = takeOf(source, options);
  const name = shownClip(source)?.name ?? source.name;
  const played = character.driver ? baked(character, name) : character;
  const clip = shownClip(played);
  if (!clip || count === frames.frameCount) return played;
  return { ...played, clips: [cropped(clip, first, count, frames)], shownClip: 0 };
}

/** With the baked take alone: the target's own only told its reference pose. */
function baked(character: Character, name: string): Character {
  const { characters } = bakeRetarget.run(
    { ...EMPTY_DOCUMENT, characters: [character] },
    { characterId: character.id },
  );
  const clip = shownClip(characters[0]);
  return { ...characters[0], clips: clip ? [{ ...clip, name }] : [], shownClip: 0 };
}

/** Crops a take: samples to the frames alone, from second 0; keys to the range. */
function cropped(
  clip: ChannelClip,
  first: number,
  count: number,
  frames: { readonly startSeconds: number; readonly frameSeconds: number },
): ChannelClip {
  const { startSeconds, frameSeconds } = frames;
  const { samples } = clip;
  const from = startSeconds + first * frameSeconds;
  if (!samples) return { ...clip, range: [from, from + (count - 1) * frameSeconds] };
  const width = samples.scales.length;
  const values = samples.values.subarray(first * width, (first + count) * width);
  return {
    ...clip,
    range: [0, (count - 1) * frameSeconds],
    samples: { ...samples, values, frameCount: count, startSeconds: 0 },
  };
}
