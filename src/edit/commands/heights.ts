/** Commands that show characters of very different sizes equally tall, and each in its own size again. */
import type { Character, Document } from '../../model/document.ts';
import { listOf } from '../arguments.ts';
import { requireCharacter } from '../characters.ts';
import { withOwnHeights, withSameHeight, withSameUnit } from '../same-height.ts';
import { characterIn } from '../step-names.ts';
import { type Command, CommandError } from '../store.ts';

const noHeight = ({ name }: Character) =>
  `${name} has no height. Select a character with more than one joint, or a skin.`;

interface OfCharacters {
  readonly characterIds: readonly string[];
}

/** Scales characters to the height of `like` as placed, side by side. */
export const sameHeight: Command<OfCharacters & { readonly like: string }> = {
  id: 'characters.sameHeight',
  label: (document, { like }) => `Same height as ${characterIn(document, like)}`,
  run(document, { characterIds, like }) {
    const these = listed(document, characterIds);
    const reference = requireCharacter(document, like);
    const characters = withSameHeight(document.characters, these, reference);
    if (characters) return placed(document, characters);
    throw new CommandError(noHeight(reference));
  },
};

/** Scales characters by powers of ten to about the height of `like` as placed, side by side. */
export const sameUnit: Command<OfCharacters & { readonly like: string }> = {
  id: 'characters.sameUnit',
  label: (document, { like }) => `Same unit as ${characterIn(document, like)}`,
  run(document, { characterIds, like }) {
    const these = listed(document, characterIds);
    const reference = requireCharacter(document, like);
    const characters = withSameUnit(document.characters, these, reference);
    if (characters) return placed(document, characters);
    throw new CommandError(noHeight(reference));
  },
};

/** Shows characters in the size that their files give, side by side. */
export const ownHeights: Command<OfCharacters> = {
  id: 'characters.ownHeights',
  label: (document, { characterIds }) =>
    `Own height of ${characterIds.length === 1 ? characterIn(document, characterIds[0]) : `${characterIds.length} characters`}`,
  run: (document, { characterIds }) =>
    placed(document, withOwnHeights(document.characters, listed(document, characterIds))),
};

function listed(document: Document, ids: readonly string[]): readonly Character[] {
  return listOf(ids, 'The characters').map((id) => requireCharacter(document, String(id)));
}

function placed(document: Document, characters: readonly Character[]): Document {
  return characters === document.characters ? document : { ...document, characters };
}
