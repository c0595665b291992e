/** Results of opening a file's content, by its kind. */
import type { Character } from '../../model/document.ts';
import type { FileContent, ParsedFile, WholeCharacter } from '../../model/files.ts';
import { openingOf, type PartOpening } from '../kinds.ts';
import { withSource } from './assemble.ts';

/** The characters in a file; none in one of parts. */
export function charactersIn(file: ParsedFile): readonly WholeCharacter[] {
  const opening = openingOf(file.kind);
  return opening.as === 'characters' ? opening.characters(file) : [];
}

/** How the content of a file becomes a part of a character; undefined for files that are no parts. */
export function partOpening({ kind }: ParsedFile): PartOpening<FileContent> | undefined {
  const opening = openingOf(kind);
  return opening.as === 'part' ? opening : undefined;
}

/**
 * Adds a file of a character: its name, and its content if it is a part.
 *
 * @param before the character before these files were opened, whose parts of the same name are replaced
 */
export function withFile(character: Character, file: ParsedFile, before: Character | undefined): Character {
  let next = character;
  for (const source of [...(file.beside ?? []), file.source]) next = withSource(next, source, before);
  return partOpening(file)?.add(next, file, { ...file, before }) ?? next;
}
