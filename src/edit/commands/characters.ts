/** Commands on whole characters: which exist, which skin and take are shown, and their placements. */
import type { Character, Placement } from '../../model/document.ts';
import { finiteNumber, indexIn, listOf, text } from '../arguments.ts';
import { changeCharacter, requireCharacter } from '../characters.ts';
import { cutName, SHORT_NAME } from '../cut-name.ts';
import { sameValue } from '../delta.ts';
import { withoutDriver } from '../drivers.ts';
import { characterIn } from '../step-names.ts';
import { type Command, CommandError } from '../store.ts';
import { withoutUnkeyed } from '../unkeyed.ts';

interface OfCharacter {
  readonly characterId: string;
}

export const removeCharacter: Command<OfCharacter> = {
  id: 'character.remove',
  label: (document, { characterId }) => `Remove ${characterIn(document, characterId)}`,
  run(document, { characterId }) {
    const gone = requireCharacter(document, characterId);
    return { ...document, characters: document.characters.filter((c) => c !== gone) };
  },
};

export const renameCharacter: Command<OfCharacter & { readonly name: string }> = {
  id: 'character.rename',
  label: (document, { characterId, name }) =>
    `Rename ${characterIn(document, characterId, SHORT_NAME)} to ${cutName(name, SHORT_NAME)}`,
  run: (document, { characterId, name }) =>
    changeCharacter(document, characterId, (c) => (c.name === text(name, 'The name') ? c : { ...c, name })),
};

/** Shows another of a character's alternative skins. */
export const showSkin: Command<OfCharacter & { readonly skin: number }> = {
  id: 'character.showSkin',
  label: (document, { characterId, skin }) =>
    `Show skin ${cutName(requireCharacter(document, characterId).skins[skin]?.name ?? String(skin))}`,
  run: (document, { characterId, skin }) =>
    changeCharacter(document, characterId, (c) => {
      indexIn(skin, 0, c.skins.length, 'skin');
      return c.shownSkin === skin ? c : { ...c, shownSkin: skin };
    }),
};

/** Plays another take; -1 for none. */
export const showClip: Command<OfCharacter & { readonly clip: number }> = {
  id: 'character.showClip',
  label: (document, { characterId, clip }) =>
    clip < 0
      ? `Show ${characterIn(document, characterId)} without a take`
      : `Show take ${cutName(requireCharacter(document, characterId).clips[clip]?.name ?? String(clip))}`,
  run: (document, { characterId, clip }) =>
    changeCharacter(document, characterId, (c) => {
      indexIn(clip, -1, c.clips.length, 'take');
      // Showing a take of its own ends retargeting.
      return c.shownClip === clip ? withoutDriver(c) : { ...withoutDriver(withoutUnkeyed(c)), shownClip: clip };
    }),
};

export const setTimeOffset: Command<OfCharacter & { readonly seconds: number }> = {
  id: 'character.setTimeOffset',
  label: (document, { characterId }) => `Set start time of ${characterIn(document, characterId)}`,
  run(document, { characterId, seconds }) {
    finiteNumber(seconds, 'The start time');
    return changeCharacter(document, characterId, (c) =>
      c.timeOffsetSeconds === seconds ? c : { ...c, timeOffsetSeconds: seconds },
    );
  },
};

/** Moves, rotates or scales one instance of a character. */
export const placeCharacter: Command<OfCharacter & { readonly index: number; readonly placement: Placement }> = {
  id: 'character.place',
  label: (document, { characterId }) => `Move ${characterIn(document, characterId)}`,
  run: (document, { characterId, index, placement }) =>
    changeCharacter(document, characterId, (c) => {
      indexIn(index, 0, c.placements.length, 'placement');
      checkPlacement(placement);
      if (sameValue(placement, c.placements[index])) return c;
      return { ...c, placements: c.placements.map((p, i) => (i === index ? placement : p)) };
    }),
};

/** Adds an instance of a character, sharing its data. */
export const addCopy: Command<OfCharacter & { readonly placement: Placement }> = {
  id: 'character.addCopy',
  label: (document, { characterId }) => `Duplicate instance of ${characterIn(document, characterId)}`,
  run: (document, { characterId, placement }) =>
    changeCharacter(document, characterId, (c) => {
      checkPlacement(placement);
      return { ...c, placements: [...c.placements, placement] };
    }),
};

export const removeCopy: Command<OfCharacter & { readonly index: number }> = {
  id: 'character.removeCopy',
  label: (document, { characterId }) => `Remove instance of ${characterIn(document, characterId)}`,
  run: (document, { characterId, index }) =>
    changeCharacter(document, characterId, (c: Character) => {
      indexIn(index, 0, c.placements.length, 'placement');
      if (c.placements.length === 1)
        throw new CommandError('The last instance can’t be removed. Remove the character instead.');
      return { ...c, placements: c.placements.filter((_, i) => i !== index) };
    }),
};

function checkPlacement(placement: Placement): void {
  const { position, turn, scale } = placement ?? {};
  for (const [what, value] of [
    ['position', position],
    ['turn', turn],
  ] as const) {
    const numbers = listOf(value, `The ${what} of the instance`);
    for (let i = 0; i < 3; i++) finiteNumber(numbers[i], `The ${what} of the instance`);
  }
  if (finiteNumber(scale, 'The scale') <= 0)
    throw new CommandError(`The scale must be greater than 0, found ${scale}.`);
}
