/**
 * The files that parts made here were saved as. From then on such a part came from its file, as one that was opened
 * did: it is listed, and reading it again puts it in its own place. That is no step of anyone's, and undoing what was
 * done before the saving does not take the file off the disk: it stays the part's.
 */
import type { Store } from '../edit/store.ts';
import { type Character, type Document, findCharacter } from '../model/document.ts';
import type { SourceFile } from '../model/files.ts';
import { fileNameOf, type Part, partsOf, sourceOf } from './parts.ts';

/** A part with whose it is. */
export interface OwnedPart {
  readonly character: Character;
  readonly part: Part;
}

interface Made {
  readonly characterId: string;
  readonly part: Part;
  readonly source: SourceFile;
}

export class SavedSources {
  private made: readonly Made[] = [];
  private isStale = false;

  /** @param isTaken whether a path is known as that of another file */
  constructor(
    private readonly store: Store,
    private readonly isTaken: (path: string) => boolean,
  ) {
    store.subscribe((now, before) => {
      if (now.document === before.document || this.made.length === 0 || this.isStale) return;
      this.isStale = true;
      queueMicrotask(() => this.follow());
    });
  }

  /**
   * These parts were written as one file.
   * @param name of the file
   * @returns the same parts, of the characters as they are now; without those of characters that are gone
   */
  written(parts: readonly OwnedPart[], name: string, bytes: number): readonly OwnedPart[] {
    let { document } = this.store;
    for (const { character, part } of parts) {
      const now = findCharacter(document, character.id);
      if (now) document = withCharacter(document, now, this.savedAs(now, part, name, bytes));
    }
    if (document !== this.store.document) this.store.amend(document);
    return parts.flatMap(({ character, part }) => {
      const now = findCharacter(document, character.id);
      return now ? { character: now, part } : [];
    });
  }

  /**
   * Another character has that id from now on: what undo takes back leaves its id to the next one that is made.
   * @returns paths of the files that were the former one's, and are nobody's now
   */
  forget(characterId: string): readonly string[] {
    const former = this.made.filter((m) => m.characterId === characterId);
    if (former.length === 0) return [];
    this.made = this.made.filter((m) => m.characterId !== characterId);
    return former.map(({ source }) => source.path).filter((path) => !this.isOpen(path));
  }

  private savedAs(character: Character, part: Part, name: string, bytes: number): Character {
    const own = sourceOf(character, part);
    if (own) {
      // Saved elsewhere: what it came from is what it was.
      if (own.name !== name || own.bytes === bytes) return character;
      return { ...character, sources: character.sources.map((s) => (s === own ? { ...own, bytes } : s)) };
    }
    // Most parts are called after their file: under another name they would not be known as what it holds.
    for (const called of [name, fileNameOf(character, part)]) {
      const source = { name: called, path: this.freePath(character, called), bytes };
      const next = withSource(character, part, source);
      if (next === character) continue;
      this.made = [
        ...this.made.filter((m) => m.source.path !== source.path),
        { characterId: character.id, part, source },
      ];
      return next;
    }
    return character;
  }

  /** By its path a file is known: two of one name, of which nobody knows where they lie, are kept apart. */
  private freePath({ id }: Character, name: string): string {
    return this.isOpen(name) || this.isTaken(name) ? `${id}/${name}` : name;
  }

  /** Whether a character has come from the file of that path. */
  private isOpen(path: string): boolean {
    return this.store.document.characters.some(({ sources }) => sources.some((source) => source.path === path));
  }

  /** Gives back what undo took, where the part is still there. */
  private follow(): void {
    this.isStale = false;
    let { document } = this.store;
    for (const { characterId, part, source } of this.made) {
      const character = findCharacter(document, characterId);
      if (!character || sourceOf(character, part)) continue;
      const isThere = partsOf(character).some((own) => own.kind === part.kind && own.part.name === part.part.name);
      if (isThere) document = withCharacter(document, character, withSource(character, part, source));
    }
    if (document !== this.store.document) this.store.amend(document);
  }
}

/** The character with that file, where the part would be known as what it holds; else the same. */
function withSource(character: Character, part: Part, source: SourceFile): Character {
  const next = { ...character, sources: [...character.sources, source] };
  return sourceOf(next, part) === source ? next : character;
}

function withCharacter(document: Document, before: Character, after: Character): Document {
  if (before === after) return document;
  return { ...document, characters: document.characters.map((c) => (c === before ? after : c)) };
}
