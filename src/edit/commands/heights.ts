/** Commands that show characters of very different sizes equally tall, and each in its own size again. */

import type { Character, Document } from '../../model/document.ts';
import { requireCharacter } from '../characters.ts';
import { command } from '../command.ts';
import { CommandError } from '../command-error.ts';
import { withOwnHeights, withSameHeight, withSameUnit } from '../same-height.ts';
import { text } from '../schema/shape.ts';
import { CHARACTERS } from '../schema/shared-shapes.ts';
import { characterIn } from '../step-names.ts';

const noHeight = ({ name }: Character) =>
  `${name} has no height. Select a character with more than one joint, or a skin.`;

/** Scales characters to the height of `like` as placed, side by side. */
export const sameHeight = command({
  id: 'characters.sameHeight',
  args: { ...CHARACTERS, like: text },
  label: (document, { like }) => `Same height as ${characterIn(document, like)}`,
  run(document, { characterIds, like }) {
    const these = listed(document, characterIds);
    const reference = requireCharacter(document, like);
    const characters = withSameHeight(document.characters, these, reference);
    if (characters) return placed(document, characters);
    throw new CommandError(noHeight(reference));
  },
});

/** Scales characters by powers of ten to about the height of `like` as placed, side by side. */
export const sameUnit = command({
  id: 'characters.sameUnit',
  args: { ...CHARACTERS, like: text },
  label: (document, { like }) => `Same unit as ${characterIn(document, like)}`,
  run(document, { characterIds, like }) {
    const these = listed(document, characterIds);
    const reference = requireCharacter(document, like);
    const characters = withSameUnit(document.characters, these, reference);
    if (characters) return placed(document, characters);
    throw new CommandError(noHeight(reference));
  },
});

/** Shows characters in the size that their files give, side by side. */
export const ownHeights = command({
  id: 'characters.ownHeights',
  args: CHARACTERS,
  label: (document, { characterIds }) =>
    `Own height of ${characterIds.length === 1 ? characterIn(document, characterIds[0]) : `${characterIds.length} characters`}`,
  run: (document, { characterIds }) =>
    placed(document, withOwnHeights(document.characters, listed(document, characterIds))),
});

function listed(document: Document, ids: readonly string[]): readonly Character[] {
  return ids.map((id) => requireCharacter(document, id));
}

function placed(document: Document, characters: readonly Character[]): Document {
  return characters === document.characters ? document : { ...document, characters };
}
