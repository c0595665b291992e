/** Changing one character of a document; all others keep their identity. */
import type { Character, Document } from '../model/document.ts';
import { findCharacter } from '../model/document.ts';
import { CommandError } from './command-error.ts';

/** Throws a `CommandError` if the character doesn't exist. */
export function requireCharacter(document: Document, id: string): Character {
  const character = findCharacter(document, id);
  if (!character) throw new CommandError(`There is no character "${id}" in the document.`);
  return character;
}

/** The document with the character replaced by the result of `change`; the same object if it did not change. */
export function changeCharacter(document: Document, id: string, change: (c: Character) => Character): Document {
  const before = requireCharacter(document, id);
  const after = change(before);
  if (after === before) return document;
  return { ...document, characters: document.characters.map((c) => (c === before ? after : c)) };
}
