/** Unsaved parts (`files/save/saved-parts.ts`) as observable state that follows the store. */
import type { Store } from '../edit/store.ts';
import { type SavedCharacter, SavedParts, type UnsavedPart } from '../files/save/saved-parts.ts';
import type { Character, Document } from '../model/document.ts';
import { type ParsedFile, type SourceFile, sameName } from '../model/files.ts';
import { mapMarks, NO_MARKS, type Part, type PartFile } from '../model/part.ts';
import { type Observable, observable } from '../ui/widgets/observable.ts';

export class Unsaved {
  /** Updated at the end of the task that changed the document; `current` is always up to date. */
  readonly parts: Observable<readonly UnsavedPart[]> = observable<readonly UnsavedPart[]>([]);
  private readonly saved = new SavedParts();
  private isStale = false;

  constructor(private readonly store: Store) {
    store.subscribe((now, before) => {
      if (now.document !== before.document) this.refreshSoon();
    });
    this.refreshSoon();
  }

  current(): readonly UnsavedPart[] {
    this.refresh();
    return this.parts.get();
  }

  /**
   * These files were just read into the document: their content counts as saved.
   *
   * @returns names of those that replaced something unsaved
   */
  opened(files: readonly ParsedFile[]): readonly string[] {
    // Still the previous list: it is updated at the end of the task.
    const unsavedBefore = this.parts.get();
    const replaced = files.filter(({ source }) => unsavedBefore.some((part) => sameName(part.name, source.name)));
    this.saved.opened(this.store.document, files);
    this.refreshSoon();
    return replaced.map(({ source }) => source.name);
  }

  /**
   * A part was written in this state.
   *
   * @param pose of the joints, as written; only for a skeleton
   */
  written(part: Part, pose: readonly number[] = []): void {
    this.saved.mark(part, pose);
    this.refreshSoon();
  }

  /**
   * Assigns a file to a part that was created here. Not an undo step: undoing earlier edits doesn't remove the file
   * from disk, so the part keeps it.
   */
  setFile(characterId: string, { id, kind, name }: Part, source: SourceFile): void {
    const file = { kind, source, holds: name };
    this.saved.setFile(id, file);
    this.change(characterId, (c) => withFile(c, id, file));
  }

  /** The file has that length now. */
  setBytes(characterId: string, { id, file }: Part, bytes: number): void {
    if (!file || file.bytes === bytes) return;
    this.change(characterId, (c) => {
      const source = { ...file, bytes };
      const sources = c.sources.map((s) => (s.path === file.path ? source : s));
      const parts = mapMarks(c.parts ?? NO_MARKS, (mark) =>
        mark.id === id && mark.file ? { ...mark, file: { ...mark.file, source } } : mark,
      );
      return { ...c, sources, parts };
    });
  }

  /** The pose in a character's skeleton file. */
  poseInFile(character: Character): readonly number[] {
    return this.saved.poseInFile(character);
  }

  snapshot(document: Document): readonly SavedCharacter[] {
    return this.saved.snapshot(document);
  }

  /** Restores the marks of the document that the store has just taken over. */
  restore(characters: readonly SavedCharacter[]): void {
    this.saved.restore(this.store.document, characters);
    this.refreshSoon();
  }

  private refreshSoon(): void {
    if (this.isStale) return;
    this.isStale = true;
    queueMicrotask(() => this.refresh());
  }

  private refresh(): void {
    if (!this.isStale) return;
    this.isStale = false;
    this.giveFilesBack();
    const now = this.saved.unsavedIn(this.store.document);
    const before = this.parts.get();
    if (now.length !== before.length || !now.every((part, i) => isSame(part, before[i]))) this.parts.set(now);
  }

  /** Undo may have restored a part from before it was first saved. */
  private giveFilesBack(): void {
    for (const { id, parts = NO_MARKS } of this.store.document.characters) {
      mapMarks(parts, (mark) => {
        const isOwn = mark.file !== undefined && mark.file.kind !== 'character';
        const file = isOwn ? undefined : this.saved.fileOf(mark.id);
        if (file) this.change(id, (c) => withFile(c, mark.id, file));
        return mark;
      });
    }
  }

  /** Changes a character without an undo step. */
  private change(characterId: string, edit: (character: Character) => Character): void {
    const { document } = this.store;
    this.store.amend({
      ...document,
      characters: document.characters.map((c) => (c.id === characterId ? edit(c) : c)),
    });
  }
}

function withFile(character: Character, id: number, file: PartFile): Character {
  const { sources, parts = NO_MARKS } = character;
  const isListed = sources.some(({ path }) => path === file.source.path);
  return {
    ...character,
    sources: isListed ? sources : [...sources, file.source],
    parts: mapMarks(parts, (mark) => (mark.id === id ? { ...mark, file } : mark)),
  };
}

function isSame(a: UnsavedPart, b: UnsavedPart): boolean {
  return a.characterId === b.characterId && a.kind === b.kind && a.index === b.index && a.name === b.name;
}
