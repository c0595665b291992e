/**
 * What is not saved: each part whose revision is not the one that was last read from, or written to, its file. Undoing
 * back to what was saved brings that revision back.
 *
 * A skeleton's file holds the pose of its joints too, which the document keeps beside the skeleton; see `poseToSave`.
 */
import { addPoses } from '../edit/pose/library.ts';
import type { Store } from '../edit/store.ts';
import { partsOf } from '../model/character-parts.ts';
import type { Character } from '../model/document.ts';
import { filePose, rootDofCount } from '../model/dofs.ts';
import { type ParsedFile, type SourceFile, sameName } from '../model/files.ts';
import { fileNameOf, mapMarks, NO_MARKS, type Part, type PartFile, type PartKind } from '../model/part.ts';
import type { UnsavedPart } from '../project/save/jobs.ts';
import { poseToSave } from '../project/save/own-formats.ts';
import { type Observable, observable } from '../ui/kit/observable.ts';

/** What of a character is in files: plain data, to be kept with a session and given back with it. */
export interface SavedCharacter {
  readonly characterId: string;
  /** Whether each of its parts is saved, in the order of `partsOf`. */
  readonly parts: readonly boolean[];
  /** In the skeleton's file: one value for each DOF of its joints. */
  readonly pose: readonly number[];
}

/** What of a part is on disk. */
interface SavedPart {
  readonly revision: number;
  /** Of the joints, where it is a skeleton. */
  readonly pose: readonly number[];
  /** That a part which was made here was saved as. */
  readonly file?: PartFile;
}

export class Unsaved {
  /** Follows the document at the end of the task that changed it; `current` is up to date at any time. */
  readonly parts: Observable<readonly UnsavedPart[]> = observable<readonly UnsavedPart[]>([]);
  /** By a part's id; of those that are gone too: undo brings them back. */
  private readonly saved = new Map<number, SavedPart>();
  private lists = new WeakMap<Character, readonly UnsavedPart[]>();
  /** Files that an earlier opening had no use for: a later one may. */
  private waiting: readonly ParsedFile[] = [];
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
    const given = [...files, ...this.waiting];
    const fresh = new Set<object>(given.flatMap(contentOf));
    for (const character of this.store.document.characters) {
      for (const part of partsOf(character)) {
        const isRead =
          part.kind === 'pose' ? isLibraryOf(character, given) : piecesOf(part).every((piece) => fresh.has(piece));
        if (isRead) this.mark(part, filePoseOfJoints(character));
      }
    }
    this.waiting = this.store.document.unused.map(({ file }) => file);
    return replaced.map(({ source }) => source.name);
  }

  /**
   * A part was written as it was then.
   * @param pose of the joints, as written; only for a skeleton
   */
  written(part: Part, pose: readonly number[] = []): void {
    this.mark(part, pose);
  }

  /**
   * A part that was made here is that file's from now on. That is no step of anyone's, and undoing what was done before
   * the saving does not take the file off the disk: it stays the part's.
   */
  setFile(characterId: string, part: Part, source: SourceFile): void {
    const known = this.saved.get(part.id);
    const file = { kind: part.kind, source, holds: part.name };
    this.saved.set(part.id, { revision: 0, pose: [], ...known, file });
    this.change(characterId, (c) => withFile(c, part.id, file));
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
    const pose = this.saved.get(character.parts?.skeleton?.id ?? 0)?.pose;
    const own = filePoseOfJoints(character);
    return pose?.length === own.length ? pose : own;
  }

  snapshot(): readonly SavedCharacter[] {
    return this.store.document.characters.map((character) => ({
      characterId: character.id,
      parts: partsOf(character).map((part) => this.isSaved(part)),
      pose: this.poseInFile(character),
    }));
  }

  /** The marks of the document that the store has just taken over. */
  restore(characters: readonly SavedCharacter[]): void {
    for (const character of this.store.document.characters) {
      const kept = characters.find(({ characterId }) => characterId === character.id);
      partsOf(character).forEach((part, i) => {
        if (kept?.parts[i]) this.mark(part, kept.pose);
        else if (kept && part.kind === 'skel') this.saved.set(part.id, { revision: 0, pose: kept.pose });
      });
    }
    this.waiting = this.store.document.unused.map(({ file }) => file);
    this.lists = new WeakMap();
    this.refreshSoon();
  }

  private mark({ id, revision, kind }: Part, pose: readonly number[]): void {
    const file = this.saved.get(id)?.file;
    this.saved.set(id, { revision, pose: kind === 'skel' ? pose : [], ...(file && { file }) });
    this.lists = new WeakMap();
    this.refreshSoon();
  }

  private isSaved({ id, revision }: Part): boolean {
    return this.saved.get(id)?.revision === revision;
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
    const now = this.store.document.characters.flatMap((character) => this.listOf(character));
    const before = this.parts.get();
    if (now.length !== before.length || !now.every((part, i) => isSame(part, before[i]))) this.parts.set(now);
  }

  /** Undo may have led to before a part was saved first. */
  private giveFilesBack(): void {
    for (const { id, parts = NO_MARKS } of this.store.document.characters) {
      mapMarks(parts, (mark) => {
        const file = mark.file ? undefined : this.saved.get(mark.id)?.file;
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

  private listOf(character: Character): readonly UnsavedPart[] {
    const known = this.lists.get(character);
    if (known) return known;
    const counts: Record<PartKind, number> = { skel: 0, skin: 0, morph: 0, anim: 0, bvh: 0, pose: 0 };
    const list: UnsavedPart[] = [];
    for (const part of partsOf(character)) {
      const index = counts[part.kind]++;
      if (this.isSaved(part) && (part.kind !== 'skel' || this.isPoseSaved(character))) continue;
      list.push({ characterId: character.id, kind: part.kind, index, name: fileNameOf(part) });
    }
    this.lists.set(character, list);
    return list;
  }

  private isPoseSaved(character: Character): boolean {
    const inFile = this.poseInFile(character);
    return poseToSave(character, inFile) === inFile;
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

/** What of a part was read from files, as the very objects. */
function piecesOf({ kind, content }: Part): readonly object[] {
  if (kind !== 'bvh') return [content];
  return content.clip ? [content.skeleton, content.clip] : [content.skeleton];
}

/** Whether a character's poses are those of one of these files that it has, and no others. */
function isLibraryOf(character: Character, files: readonly ParsedFile[]): boolean {
  const { poses: library, ...without } = character;
  return files.some(
    (file) =>
      file.kind === 'pose' &&
      character.parts?.poses?.file?.source === file.source &&
      addPoses(without, file.poses).poses?.length === library?.length,
  );
}

/** One value for each DOF of the joints. */
function filePoseOfJoints({ skeleton }: Character): readonly number[] {
  return filePose(skeleton, 0).slice(rootDofCount(skeleton));
}

/** What a file brings into a character, as the very objects. */
function contentOf(file: ParsedFile): readonly object[] {
  switch (file.kind) {
    case 'skel':
      return file.skeletons;
    case 'skin':
      return [file.skin];
    case 'morph':
      return [file.morph];
    case 'anim':
      return [file.clip];
    case 'bvh':
      return file.figures.flatMap(({ skeleton, clip }) => (clip ? [skeleton, clip] : [skeleton]));
    case 'rig':
    case 'pose':
    case 'texture':
      return [];
  }
}
