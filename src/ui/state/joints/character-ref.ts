/** Characters as scripts name them. */
import { described } from '../../../edit/arguments.ts';
import { CommandError } from '../../../edit/command-error.ts';
import type { Store } from '../../../edit/store.ts';
import type { Character } from '../../../model/document.ts';
import { cutText } from '../../../model/names/cut-text.ts';

/** A character by id, name, index, or any object with an id (as in `marrow.characters()`). */
export type CharacterRef = string | number | { readonly id: string };

/** The character; without a reference the selected one, else the first. Throws if there is none. */
export function resolveCharacter(store: Store, ref: CharacterRef | undefined): Character {
  const { characters } = store.document;
  const id = typeof ref === 'object' ? ref.id : ref;
  const found =
    id === undefined
      ? (characters.find((c) => c.id === store.selection.characterId) ?? characters[0])
      : typeof id === 'number'
        ? characters[id]
        : (characters.find((c) => c.id === id) ?? characters.find((c) => c.name === id));
  if (found) return found;
  const there = characters.map((c) => `"${c.name}"`).join(', ') || 'none';
  throw new CommandError(
    `There is no character ${id === undefined ? 'yet' : described(id)}. Characters here: ${cutText(there)}.`,
  );
}
