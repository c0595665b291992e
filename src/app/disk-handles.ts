/**
 * Where open files are on disk, for saving in place and *Reload from disk*. Not part of the document: handles are no
 * data of a character, and undo doesn't move files.
 */
import { type DiskFile, diskFileOf } from '../io/disk-files.ts';
import type { GivenFile } from '../io/given.ts';
import { type Character, type Document, findCharacter } from '../model/document.ts';
import type { Part } from '../model/part.ts';

/** One entry as plain data: handles and files survive a structured clone. */
export type KeptDiskFile = readonly [path: string, file: DiskFile];

export class DiskHandles {
  private readonly files = new Map<string, DiskFile>();

  /** Registers opened files. A path opened from elsewhere replaces the old entry. */
  note(given: readonly GivenFile[]): void {
    for (const one of given) {
      const file = diskFileOf(one);
      if (file) this.files.set(one.path, file);
      else this.files.delete(one.path);
    }
  }

  /** Whether the file of that path is known. */
  has(path: string): boolean {
    return this.files.has(path);
  }

  /** The file of that path, not one in a zip. */
  of(path: string): DiskFile | undefined {
    return this.files.get(path);
  }

  /** The file of a part. */
  ofPart({ file }: Part): DiskFile | undefined {
    return file && this.files.get(file.path);
  }

  /** @param path of a part's file, which was saved there */
  set(path: string, file: DiskFile): void {
    this.files.set(path, file);
  }

  /**
   * Every file that a character was read from or saved to, and those of it that had errors, each once; a zip for what
   * it contains.
   */
  ofCharacter({ sources, unread = [] }: Character): readonly DiskFile[] {
    return [...new Set([...sources, ...unread].flatMap(({ path }) => this.at(path) ?? []))];
  }

  /** The file of a path, or the zip that contains it. */
  at(path: string): DiskFile | undefined {
    return this.files.get(path) ?? this.zipOf(path);
  }

  entries(): readonly KeptDiskFile[] {
    return [...this.files];
  }

  restore(entries: readonly KeptDiskFile[]): void {
    this.files.clear();
    for (const [path, file] of entries) this.files.set(path, file);
  }

  /** `heroes.zip/hero/hero.skel` is in `heroes.zip`. */
  private zipOf(path: string): DiskFile | undefined {
    const end = path.toLowerCase().lastIndexOf('.zip/');
    return end < 0 ? undefined : this.files.get(path.slice(0, end + '.zip'.length));
  }
}

/** Whether a character of a document has files that can be read again. The opening example has none. */
export function canReload(document: Document, handles: DiskHandles, characterId: string): boolean {
  const character = findCharacter(document, characterId);
  return character !== undefined && !document.isOpeningSample && handles.ofCharacter(character).length > 0;
}
