/**
 * Where the files that are open lie: what saving in place and *Reload from disk* go by. Beside the document, for a
 * handle is no data of a character's, and undo does not move files.
 */
import { type DiskFile, diskFileOf } from '../io/disk-files.ts';
import type { GivenFile } from '../io/given.ts';
import type { Character } from '../model/document.ts';
import { fileNameOf, type Part, partsOf, sourceOf } from './parts.ts';

/** One entry, plain: handles and files survive a structured clone. */
export type KeptDiskFile = readonly [key: string, file: DiskFile];

export class DiskHandles {
  private readonly files = new Map<string, DiskFile>();

  /** Takes down what was opened. A file of a path that came from elsewhere this time is not what it was. */
  note(given: readonly GivenFile[]): void {
    for (const one of given) {
      const file = diskFileOf(one);
      if (file) this.files.set(one.path, file);
      else this.files.delete(one.path);
    }
  }

  /** Whether a file of that path is known. */
  has(path: string): boolean {
    return this.files.has(path);
  }

  /** Where a part lies. */
  ofPart(character: Character, part: Part): DiskFile | undefined {
    return this.files.get(keyOf(character, part));
  }

  /** A part has been saved there. */
  setPart(character: Character, part: Part, file: DiskFile): void {
    this.files.set(keyOf(character, part), file);
  }

  /**
   * Another character has that id from now on.
   * @param paths of files that were the former one's
   */
  forget(characterId: string, paths: readonly string[]): void {
    for (const path of paths) this.files.delete(path);
    for (const key of [...this.files.keys()]) if (key.startsWith(`${characterId}:`)) this.files.delete(key);
  }

  /** Every file that a character came from or was saved to, each once; a zip stands for what is in it. */
  ofCharacter(character: Character): readonly DiskFile[] {
    const found = new Set<DiskFile>();
    const take = (file: DiskFile | undefined) => file && found.add(file);
    for (const { path } of character.sources) take(this.files.get(path) ?? this.zipOf(path));
    for (const part of partsOf(character)) take(this.ofPart(character, part));
    return [...found];
  }

  entries(): readonly KeptDiskFile[] {
    return [...this.files];
  }

  restore(entries: readonly KeptDiskFile[]): void {
    this.files.clear();
    for (const [key, file] of entries) this.files.set(key, file);
  }

  /** `heroes.zip/hero/hero.skel` is in `heroes.zip`. */
  private zipOf(path: string): DiskFile | undefined {
    const end = path.toLowerCase().lastIndexOf('.zip/');
    return end < 0 ? undefined : this.files.get(path.slice(0, end + '.zip'.length));
  }
}

/** The path of its file; what has none goes by its character, for names repeat. */
function keyOf(character: Character, part: Part): string {
  return sourceOf(character, part)?.path ?? `${character.id}:${fileNameOf(character, part)}`;
}
