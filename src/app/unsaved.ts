/**
 * What is not saved: each part of each character against what was last read from, or written to, its file. By identity
 * first and by content where that differs, so that undoing back to what was saved is as good as saved.
 *
 * A skeleton's file holds the pose of its joints too, which the document keeps beside the skeleton; see `poseToSave`.
 */
import { addPoses } from '../edit/pose/library.ts';
import type { Store } from '../edit/store.ts';
import type { Character } from '../model/document.ts';
import { findCharacter } from '../model/document.ts';
import { filePose, rootDofCount } from '../model/dofs.ts';
import { type ParsedFile, sameName } from '../model/files.ts';
import { type Observable, observable } from '../ui/kit/observable.ts';
import type { PartKind, UnsavedPart } from '../ui/state/workbench.ts';
import { fileNameOf, type Part, partsOf, posesByNames, poseToSave } from './parts.ts';
import { sameData } from './same-data.ts';

/** What of a character is in files. Parts are those of documents, by identity, so keeping them costs nothing more. */
export interface SavedCharacter {
  readonly characterId: string;
  readonly parts: readonly Part[];
  /** In the skeleton's file: one value for each DOF of its joints. */
  readonly pose: readonly number[];
}

/** All there is to know of what is saved: plain data, to be kept with a session and given back with it. */
export interface SavedMarks {
  readonly characters: readonly SavedCharacter[];
}

/** With the verdicts on parts that were compared with it already. */
interface Baseline extends SavedCharacter {
  readonly isSaved: WeakMap<object, boolean>;
}

export class Unsaved {
  /** Follows the document at the end of the task that changed it; `current` is up to date at any time. */
  readonly parts: Observable<readonly UnsavedPart[]> = observable<readonly UnsavedPart[]>([]);
  /** By character, those that are gone too: undo brings them back. */
  private readonly baselines = new Map<string, Baseline>();
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
      const read = partsOf(character).filter((part) =>
        part.kind === 'pose' ? isLibraryOf(character, given) : piecesOf(part).every((piece) => fresh.has(piece)),
      );
      if (read.length) this.mark(character, read, filePoseOfJoints(character));
    }
    this.waiting = this.store.document.unused.map(({ file }) => file);
    return replaced.map(({ source }) => source.name);
  }

  /**
   * A part was written as it was then.
   * @param pose of the joints, as written; only for a skeleton
   */
  saved(characterId: string, part: Part, pose: readonly number[] = []): void {
    const character = findCharacter(this.store.document, characterId);
    if (character) this.mark(character, [part], pose);
  }

  /** Another character has that id from now on: nothing of it is in a file yet. */
  forget(characterId: string): void {
    if (!this.baselines.delete(characterId)) return;
    this.lists = new WeakMap();
    this.refreshSoon();
  }

  /** The pose that the file of a character's skeleton has. */
  poseInFile(character: Character): readonly number[] {
    const baseline = this.baselines.get(character.id);
    const own = filePoseOfJoints(character);
    return baseline && baseline.pose.length === own.length ? baseline.pose : own;
  }

  snapshot(): SavedMarks {
    return { characters: [...this.baselines.values()].map(({ isSaved: _, ...saved }) => saved) };
  }

  /** Instead of all marks so far; the parts have to be those of the document for the marks to be cheap. */
  restore({ characters }: SavedMarks): void {
    this.baselines.clear();
    for (const saved of characters) this.baselines.set(saved.characterId, { ...saved, isSaved: new WeakMap() });
    this.waiting = this.store.document.unused.map(({ file }) => file);
    this.lists = new WeakMap();
    this.refreshSoon();
  }

  private mark(character: Character, now: readonly Part[], pose: readonly number[]): void {
    const before = this.baselines.get(character.id);
    const present = new Set<object>(partsOf(character).map(({ part }) => part));
    // What these take the place of goes; two parts of one name are both kept while both are there.
    const others = (before?.parts ?? []).filter(
      (old) =>
        !now.some((n) => n.part === old.part) &&
        (present.has(old.part) || !now.some((n) => n.kind === old.kind && n.part.name === old.part.name)),
    );
    this.baselines.set(character.id, {
      characterId: character.id,
      parts: [...others, ...now],
      pose: now.some(({ kind }) => kind === 'skel') ? pose : (before?.pose ?? []),
      isSaved: new WeakMap(),
    });
    this.lists = new WeakMap();
    this.refreshSoon();
  }

  /**
   * Not at once: an opening changes the document first and tells of its files then, and comparing the old file of a
   * million vertices with the new one would be for nothing.
   */
  private refreshSoon(): void {
    if (this.isStale) return;
    this.isStale = true;
    queueMicrotask(() => this.refresh());
  }

  private refresh(): void {
    if (!this.isStale) return;
    this.isStale = false;
    const now = this.store.document.characters.flatMap((character) => this.listOf(character));
    const before = this.parts.get();
    if (now.length !== before.length || !now.every((part, i) => sameData(part, before[i]))) this.parts.set(now);
  }

  private listOf(character: Character): readonly UnsavedPart[] {
    const known = this.lists.get(character);
    if (known) return known;
    const baseline = this.baselines.get(character.id);
    const counts: Record<PartKind, number> = { skel: 0, skin: 0, morph: 0, anim: 0, bvh: 0, pose: 0 };
    const list: UnsavedPart[] = [];
    for (const part of partsOf(character)) {
      const index = counts[part.kind]++;
      if (baseline && this.isSaved(baseline, part) && (part.kind !== 'skel' || this.isPoseSaved(character))) continue;
      list.push({ characterId: character.id, kind: part.kind, index, name: fileNameOf(character, part) });
    }
    this.lists.set(character, list);
    return list;
  }

  private isSaved({ parts, isSaved }: Baseline, own: Part): boolean {
    const { kind, part } = own;
    let saved = isSaved.get(part);
    if (saved === undefined) {
      const alike = parts.filter((p) => p.kind === kind && p.part.name === part.name);
      saved = alike.some((p) => p.part === part) || alike.some((p) => sameData(contentInFile(p), contentInFile(own)));
      isSaved.set(part, saved);
    }
    return saved;
  }

  private isPoseSaved(character: Character): boolean {
    const inFile = this.poseInFile(character);
    return poseToSave(character, inFile) === inFile;
  }
}

/** What of a part was read from files, as the very objects. */
function piecesOf({ kind, part }: Part): readonly object[] {
  if (kind !== 'bvh') return [part];
  return part.clip ? [part.skeleton, part.clip] : [part.skeleton];
}

/** What the file of a part holds: a `.bvh` says neither what of it is played nor how between its frames. */
function contentInFile({ kind, part }: Part): unknown {
  if (kind === 'pose') return posesByNames(part);
  if (kind !== 'bvh' || !part.clip?.samples) return part;
  const { interpolation: _, ...samples } = part.clip.samples;
  return { ...part, clip: { ...part.clip, range: [], samples } };
}

/** Whether a character's poses are those of one of these files that it has, and no others. */
function isLibraryOf(character: Character, files: readonly ParsedFile[]): boolean {
  const { poses: _, ...without } = character;
  return files.some(
    (file) =>
      file.kind === 'pose' &&
      character.sources.includes(file.source) &&
      sameData(addPoses(without, file.poses).poses, character.poses),
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
