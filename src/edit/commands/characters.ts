/** Commands on whole characters: which exist, which skin and take are shown, and their placements. */

import type { Character, Placement } from '../../model/document.ts';
import { indexIn } from '../arguments.ts';
import { changeCharacter, requireCharacter } from '../characters.ts';
import { command } from '../command.ts';
import { CommandError } from '../command-error.ts';
import { cutName, SHORT_NAME } from '../cut-name.ts';
import { sameValue } from '../delta.ts';
import { withoutDriver } from '../drivers.ts';
import { filledText, index, number, whole } from '../schema/shape.ts';
import { CHARACTER, placement } from '../schema/shared-shapes.ts';
import { characterIn } from '../step-names.ts';
import { withoutUnkeyed } from '../unkeyed.ts';

/** Removes a character with all its takes. */
export const removeCharacter = command({
  id: 'character.remove',
  args: CHARACTER,
  label: (document, { characterId }) => `Remove ${characterIn(document, characterId)}`,
  run(document, { characterId }) {
    const gone = requireCharacter(document, characterId);
    return { ...document, characters: document.characters.filter((c) => c !== gone) };
  },
});

/** Renames a character; its files keep their names. */
export const renameCharacter = command({
  id: 'character.rename',
  args: { ...CHARACTER, name: filledText },
  label: (document, { characterId, name }) =>
    `Rename ${characterIn(document, characterId, SHORT_NAME)} to ${cutName(name, SHORT_NAME)}`,
  run: (document, { characterId, name }) =>
    changeCharacter(document, characterId, (c) => (c.name === name ? c : { ...c, name })),
});

/** Shows another of a character's alternative skins. */
export const showSkin = command({
  id: 'character.showSkin',
  args: { ...CHARACTER, skin: index },
  label: (document, { characterId, skin }) =>
    `Show skin ${cutName(requireCharacter(document, characterId).skins[skin]?.name ?? String(skin))}`,
  run: (document, { characterId, skin }) =>
    changeCharacter(document, characterId, (c) => {
      indexIn(skin, 0, c.skins.length, 'skin');
      return c.shownSkin === skin ? c : { ...c, shownSkin: skin };
    }),
});

/** Plays another take; -1 for none. */
export const showTake = command({
  id: 'character.showTake',
  args: { ...CHARACTER, take: whole(-1) },
  label: (document, { characterId, take }) =>
    take < 0
      ? `Show ${characterIn(document, characterId)} without a take`
      : `Show take ${cutName(requireCharacter(document, characterId).takes[take]?.name ?? String(take))}`,
  run: (document, { characterId, take }) =>
    changeCharacter(document, characterId, (c) => {
      indexIn(take, -1, c.takes.length, 'take');
      // Showing a take of its own ends retargeting.
      return c.shownTake === take ? withoutDriver(c) : { ...withoutDriver(withoutUnkeyed(c)), shownTake: take };
    }),
});

/** Sets how many seconds are added to the transport's time for a character. */
export const setTimeOffset = command({
  id: 'character.setTimeOffset',
  args: { ...CHARACTER, seconds: number },
  label: (document, { characterId }) => `Set start time of ${characterIn(document, characterId)}`,
  run(document, { characterId, seconds }) {
    return changeCharacter(document, characterId, (c) =>
      c.timeOffsetSeconds === seconds ? c : { ...c, timeOffsetSeconds: seconds },
    );
  },
});

/** Moves, rotates or scales one instance of a character. */
export const placeCharacter = command({
  id: 'character.place',
  args: { ...CHARACTER, index, placement },
  label: (document, { characterId }) => `Move ${characterIn(document, characterId)}`,
  run: (document, { characterId, index, placement }) =>
    changeCharacter(document, characterId, (c) => {
      indexIn(index, 0, c.placements.length, 'placement');
      checkPlacement(placement);
      if (sameValue(placement, c.placements[index])) return c;
      return { ...c, placements: c.placements.map((p, i) => (i === index ? placement : p)) };
    }),
});

/** Adds an instance of a character, sharing its data. */
export const addCopy = command({
  id: 'character.addCopy',
  args: { ...CHARACTER, placement },
  label: (document, { characterId }) => `Duplicate instance of ${characterIn(document, characterId)}`,
  run: (document, { characterId, placement }) =>
    changeCharacter(document, characterId, (c) => {
      checkPlacement(placement);
      return { ...c, placements: [...c.placements, placement] };
    }),
});

/** Removes an instance of a character. Refuses the last one. */
export const removeCopy = command({
  id: 'character.removeCopy',
  args: { ...CHARACTER, index },
  label: (document, { characterId }) => `Remove instance of ${characterIn(document, characterId)}`,
  run: (document, { characterId, index }) =>
    changeCharacter(document, characterId, (c: Character) => {
      indexIn(index, 0, c.placements.length, 'placement');
      if (c.placements.length === 1)
        throw new CommandError('The last instance can’t be removed. Remove the character instead.');
      return { ...c, placements: c.placements.filter((_, i) => i !== index) };
    }),
});

function checkPlacement({ scale }: Placement): void {
  if (scale <= 0) throw new CommandError(`The scale must be greater than 0, found ${scale}.`);
}
