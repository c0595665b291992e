/** What is not saved (`project/save/saved-parts.ts`), as the page shows it: it follows the store. */
import type { Store } from '../edit/store.ts';
import type { Character } from '../model/document.ts';
import { type ParsedFile, type SourceFile, sameName } from '../model/files.ts';
import { mapMarks, NO_MARKS, type Part, type PartFile } from '../model/part.ts';
import { type SavedCharacter, SavedParts, type UnsavedPart } from '../project/save/saved-parts.ts';
import { type Observable, observable } from '../ui/kit/observable.ts';

export class Unsaved {
  /** Follows the document at the end of the task that changed it; `current` is up to date at any time. */
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
   * These files were read into the document just now: what they hold is saved.
   * @returns names of those that took the place of something unsaved
   */
  opened(files: readonly ParsedFile[]): readonly string[] {
    // The list is that of before still: it follows at the end of the task.
    const unsavedBefore = this.parts.get();
    const replaced = files.filter(({ source }) => unsavedBefore.some((part) => sameName(part.name, source.name)));
    this.saved.opened(this.store.document, files);
    this.refreshSoon();
    return replaced.map(({ source }) => source.name);
  }

  /**
   * A part was written as it was then.
   * @param pose of the joints, as written; only for a skeleton
   */
  written(part: Part, pose: readonly number[] = []): void {
    this.saved.mark(part, pose);
    this.refreshSoon();
  }

  /**
   * A part that was made here is that file's from now on. That is no step of anyone's, and undoing what was done before
   * the saving does not take the file off the disk: it stays the part's.
   */
  setFile(characterId: string, { id, kind, name }: Part, source: SourceFile): void {
    const file = { kind, source, holds: name };
    this.saved.setFile(id, file);
    this.change(characterId, (c) => withFile(c, id, file));
  }

  /** Its file is of that length now. */
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

  /** The pose that the file of a character's skeleton has. */
  poseInFile(character: Character): readonly number[] {
    return this.saved.poseInFile(character);
  }

  snapshot(): readonly SavedCharacter[] {
    return this.saved.snapshot(this.store.document);
  }

  /** The marks of the document that the store has just taken over. */
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

  /** Undo may have led to before a part was saved first. */
  private giveFilesBack(): void {
    for (const { id, parts = NO_MARKS } of this.store.document.characters) {
      mapMarks(parts, (mark) => {
        const file = mark.file ? undefined : this.saved.fileOf(mark.id);
        if (file) this.change(id, (c) => withFile(c, mark.id, file));
        return mark;
      });
    }
  }

  /** Changes a character without a step. */
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
