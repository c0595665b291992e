/**
 * Tracks what of a document is saved: parts whose revision is the one last read from or written to their file. Undoing
 * back to a saved state restores that revision.
 *
 * A skeleton's file also holds the pose of its joints, which the document stores beside the skeleton; see `poseToSave`.
 */
import { addPoses } from '../../edit/pose/library.ts';
import { partsOf } from '../../model/character-parts.ts';
import type { Character, Document } from '../../model/document.ts';
import type { ParsedFile, PartKind, SourceFile } from '../../model/files.ts';
import { fileNameOf, isTakeKind, ownRevision, type Part, type PartFile } from '../../model/part.ts';
import { filePose, rootDofCount } from '../../model/skeleton/dofs.ts';
import { MARKERS_EXTENSION } from '../../model/takes/markers.ts';
import { partOpening } from '../open/contents.ts';
import { poseToSave } from './saved-poses.ts';

/** A part of a character that changed since it was opened or saved. */
export interface UnsavedPart {
  readonly characterId: string;
  readonly kind: PartKind;
  /** Index into the character's skins, morphs or takes; 0 for its skeleton and pose library. */
  readonly index: number;
  /** Name of its file: `wasp_walk.anim`. */
  readonly name: string;
  /** Only its markers differ from their file, which is beside its own. */
  readonly isMarkers?: true;
}

/** The saved parts of a character: plain data, stored with and restored from a session. */
export interface SavedCharacter {
  readonly characterId: string;
  /** Whether each of its parts is saved, in the order of `partsOf`; or all of it but its markers. */
  readonly parts: readonly (boolean | 'but markers')[];
  /** The pose in the skeleton's file: one value per DOF of its joints. */
  readonly pose: readonly number[];
}

/** The state of a part on disk. */
interface SavedPart {
  readonly revision: number;
  /** `ownRevision` then. */
  readonly own: number;
  /** Pose of the joints, for a skeleton. */
  readonly pose: readonly number[];
  /** The file it was saved as, for a part created here. */
  readonly file?: PartFile;
}

/** Saved state by part id; removed parts included, since undo restores them. */
export class SavedParts {
  private readonly saved = new Map<number, SavedPart>();
  private lists = new WeakMap<Character, readonly UnsavedPart[]>();
  /** Files that an earlier opening left unused; a later one may use them. */
  private waiting: readonly ParsedFile[] = [];

  /** Marks the content of files that were just read as saved. */
  opened(document: Document, files: readonly ParsedFile[]): void {
    const given = [...files, ...this.waiting];
    const sources = new Set<SourceFile | undefined>(given.flatMap(sourcesOf));
    for (const character of document.characters) {
      for (const part of partsOf(character)) {
        const isRead =
          part.kind === 'pose' ? isLibraryOf(character, given) : part.readFrom && sources.has(part.readFrom);
        if (isRead) this.mark(part, filePoseOfJoints(character));
      }
    }
    for (const { kind, source } of given) if (kind === 'markers') this.markMarkers(document, source);
    this.wait(document);
  }

  /** A take whose markers were just read is saved if all else of it is. */
  private markMarkers(document: Document, source: SourceFile): void {
    const stem = source.name.slice(0, -`.${MARKERS_EXTENSION}`.length);
    for (const part of document.characters.flatMap(partsOf)) {
      if (part.name === stem && this.isOwnSaved(part)) this.mark(part);
    }
  }

  /**
   * Marks a part as read or written in its current state.
   * @param pose of the joints, as in the file; only for a skeleton
   */
  mark(part: Part, pose: readonly number[] = []): void {
    const { id, revision, kind } = part;
    const file = this.saved.get(id)?.file;
    this.saved.set(id, { revision, own: ownRevision(part), pose: kind === 'skel' ? pose : [], ...(file && { file }) });
    this.lists = new WeakMap();
  }

  /** The file that a part created here was saved as. */
  fileOf(id: number): PartFile | undefined {
    return this.saved.get(id)?.file;
  }

  /**
   * Names the file of a part; whether the part is saved stays as it was.
   * @param id of the part
   */
  setFile(id: number, file: PartFile): void {
    this.saved.set(id, { revision: 0, own: 0, pose: [], ...this.saved.get(id), file });
  }

  /** The pose in the file of a character's skeleton. */
  poseInFile(character: Character): readonly number[] {
    const pose = this.saved.get(character.parts?.skeleton?.id ?? 0)?.pose;
    const own = filePoseOfJoints(character);
    return pose?.length === own.length ? pose : own;
  }

  /** All unsaved parts, in document order. */
  unsavedIn(document: Document): readonly UnsavedPart[] {
    return document.characters.flatMap((character) => this.listOf(character));
  }

  /** The saved parts of each character, in plain data; a session keeps it across visits. */
  snapshot(document: Document): readonly SavedCharacter[] {
    return document.characters.map((character) => ({
      characterId: character.id,
      parts: partsOf(character).map((part) => this.isSaved(part) || (this.isOwnSaved(part) && 'but markers')),
      pose: this.poseInFile(character),
    }));
  }

  /** Restores the state of a document taken over from another page. */
  restore(document: Document, characters: readonly SavedCharacter[]): void {
    for (const character of document.characters) {
      const kept = characters.find(({ characterId }) => characterId === character.id);
      partsOf(character).forEach((part, i) => {
        const saved = kept?.parts[i];
        if (saved === 'but markers') this.saved.set(part.id, { revision: 0, own: ownRevision(part), pose: [] });
        else if (saved) this.mark(part, kept.pose);
        else if (kept && part.kind === 'skel') this.saved.set(part.id, { revision: 0, own: 0, pose: kept.pose });
      });
    }
    this.lists = new WeakMap();
    this.wait(document);
  }

  private wait({ unused }: Document): void {
    this.waiting = unused.map(({ file }) => file);
  }

  private isSaved({ id, revision }: Part): boolean {
    return this.saved.get(id)?.revision === revision;
  }

  private isOwnSaved(part: Part): boolean {
    return this.saved.get(part.id)?.own === ownRevision(part);
  }

  private listOf(character: Character): readonly UnsavedPart[] {
    const known = this.lists.get(character);
    if (known) return known;
    const counts = new Map<PartKind, number>();
    const list: UnsavedPart[] = [];
    for (const part of partsOf(character)) {
      const index = counts.get(part.kind) ?? 0;
      counts.set(part.kind, index + 1);
      if (this.isSaved(part) && (part.kind !== 'skel' || this.isPoseSaved(character))) continue;
      const isMarkers = isTakeKind(part.kind) && this.isOwnSaved(part);
      const name = isMarkers ? `${part.name}.${MARKERS_EXTENSION}` : fileNameOf(part);
      list.push({ characterId: character.id, kind: part.kind, index, name, ...(isMarkers && { isMarkers }) });
    }
    this.lists.set(character, list);
    return list;
  }

  private isPoseSaved(character: Character): boolean {
    const inFile = this.poseInFile(character);
    return poseToSave(character, inFile) === inFile;
  }
}

/** Whether a character's poses are exactly those of one of these files. */
function isLibraryOf(character: Character, files: readonly ParsedFile[]): boolean {
  const { poses: library, ...without } = character;
  return files.some(
    (file) =>
      file.kind === 'pose' &&
      character.parts?.poses?.file?.source === file.source &&
      addPoses(without, file.poses).poses?.length === library?.length,
  );
}

/** One value per DOF of the joints. */
function filePoseOfJoints({ skeleton }: Character): readonly number[] {
  return filePose(skeleton, 0).slice(rootDofCount(skeleton));
}

/** A take may come before the file of its skeleton, which it was read with. */
function sourcesOf(file: ParsedFile): readonly (SourceFile | undefined)[] {
  return [file.source, partOpening(file)?.skeletonFile?.(file)];
}
