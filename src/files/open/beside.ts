/** JSON beside a plain file: what opening makes of it. */
import type { Diagnostic } from '../../model/diagnostic.ts';
import type { Character } from '../../model/document.ts';
import type { SourceFile } from '../../model/files.ts';

/**
 * JSON beside a plain file (`Kind.beside`), opened after all characters and parts, which it is found for by its name.
 * A new one of these takes:
 *
 * 1. `formats/NAME/read.ts` on `jsonReader`, and `write.ts` on `writeJson` (`formats/json/`): they give fields their
 * paths in messages, and tell, keep and write those that are not known. It names joints as `joint-reference.ts` does;
 * 2. its record in `KINDS` with `beside`, its `Opening` with `as: 'beside'`, and what the recipe of a format says;
 * 3. if it is a part of the character, with a revision and a file of its own, a field of the character, a mark in
 * `PartMarks`, and its line in `partsOf` after all plain files: what is unsaved, saving in place after them, zips, reload
 * and autosave follow from there (`sets`). Otherwise it is a part of its take, as markers are.
 */
export interface BesideOpening<C> {
  readonly as: 'beside';
  /**
   * Gives it to a character; `take` is the index of the take that it is beside, or -1. The messages name no file yet.
   */
  give(character: Character, take: number, content: C, source: SourceFile): Given;
}

/** A character with what it was given, and what is said about that. */
export interface Given {
  readonly character: Character;
  /** Makes them of the name of the file. */
  readonly diagnostics?: (called: string) => readonly Diagnostic[];
}
