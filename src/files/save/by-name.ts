/** The file that a script asks for by its name. */
import type { Character } from '../../model/document.ts';
import { formatKindOf, isSaved, WRITABLE_EXTENSIONS } from '../kinds.ts';
import { saveCharacter } from './saving.ts';

/**
 * The text of the file of that name, of the first of these characters that has one; else the first one's first of that
 * kind. A take with layers has a file for each of them, besides its own.
 * @param characters at least one
 * @throws Error for a name of no kind that is written, or one that the character has nothing of
 */
export function savedByName(characters: readonly Character[], name: string): string {
  const kind = formatKindOf(name);
  if (!kind || !isSaved(kind)) {
    throw new Error(`"${name}" must end in one of ${WRITABLE_EXTENSIONS.map((e) => `.${e}`).join(' ')}.`);
  }
  for (const character of characters) {
    const files = [...saveCharacter(character, kind), ...saveCharacter(character, 'layers')];
    const file = files.find((f) => f.name.toLowerCase() === name.toLowerCase());
    if (file) return file.text;
  }
  const [preferred] = characters;
  const [first] = saveCharacter(preferred, kind);
  if (!first) throw new Error(`${preferred.name} has nothing to save as .${kind}.`);
  return first.text;
}
