/**
 * Saving: what changed, in place where the browser lets us, else where the person says, else as a download. What could
 * not be saved stays marked, and a message says why.
 */
import type { Store } from '../edit/store.ts';
import { DiskError, type DiskFile } from '../io/disk-files.ts';
import { type Diagnostic, withoutPlace } from '../model/diagnostic.ts';
import { type Character, type Document, findCharacter } from '../model/document.ts';
import type { Messages } from '../ui/messages.ts';
import type { SaveKind, UnsavedPart } from '../ui/workbench.ts';
import type { DiskHandles } from './disk-handles.ts';
import { fileNameOf, isExport, jointPose, type Part, partKindOf, partsOf, poseToSave, sourceOf } from './parts.ts';
import {
  exportCharacter,
  type FilePiece,
  type LongFile,
  type SavedFile,
  saveCharacter,
  savePart,
  saveSkeletons,
  saveTakes,
} from './saving.ts';
import type { Unsaved } from './unsaved.ts';

/** What of `io` it takes, so that a test can stand in for browser and disk. */
export interface Disk {
  asksWhereToSave(): boolean;
  pickTarget(suggestedName: string): Promise<FileSystemFileHandle | undefined>;
  writeTo(handle: FileSystemFileHandle, content: Content): Promise<string>;
  versionOnDisk(handle: FileSystemFileHandle): Promise<string | undefined>;
  download(name: string, content: Content): void;
}

/** Of a file: a text, the bytes of a zip, or a file of any length that was put together from pieces. */
type Content = string | Uint8Array<ArrayBuffer> | Blob;

export interface SaverParts {
  readonly store: Store;
  readonly messages: Pick<Messages, 'note' | 'report'>;
  readonly unsaved: Unsaved;
  readonly handles: DiskHandles;
  readonly disk: Disk;
  /** At which keys are sampled for motion capture; absent: 30. */
  readonly framesPerSecond?: () => number;
}

/** A part with whose it is, and the pose that goes into a skeleton's file. */
interface Owned {
  readonly character: Character;
  readonly part: Part;
  readonly pose: readonly number[];
}

/** One file to be written. */
interface Job {
  readonly name: string;
  /** What it holds: several skeletons where a `.skel` has several roots, otherwise one part; none for a `.rig`. */
  readonly holds: readonly Owned[];
  readonly target: DiskFile | undefined;
  write(): Omit<SavedFile, 'name'> | Omit<LongFile, 'name'> | { readonly bytes: Uint8Array<ArrayBuffer> };
}

/** For this long a long file is written at a stretch; milliseconds. */
const STRETCH = 12;

export class Saver {
  private last: Promise<unknown> = Promise.resolve();
  /** Versions on disk that the person was told of: saving again means it. */
  private readonly warnedOf = new Map<string, string>();

  constructor(private readonly parts: SaverParts) {}

  /** Saves all that changed. Never rejects: what goes wrong is a message. */
  saveChanged(): Promise<void> {
    return this.inTurn(async () => {
      const jobs = this.changedFiles();
      if (jobs.length === 0) this.parts.messages.note('Everything is saved. Save as… writes copies.');
      // Dialogs last: each needs the key that was pressed to be fresh, and writing in place may ask once itself.
      const [inPlace, others] = [jobs.filter((j) => j.target?.handle), jobs.filter((j) => !j.target?.handle)];
      await this.run([...inPlace, ...others], (job) => job.target);
    });
  }

  /** Saves a character's parts of one kind as the files that the person chooses. */
  saveAs(characterId: string, kind: SaveKind): Promise<void> {
    return this.inTurn(async () => {
      const character = findCharacter(this.parts.store.document, characterId);
      const jobs = character ? this.filesOf(character, kind) : [];
      if (jobs.length === 0) {
        const who = character?.name ?? 'The character';
        this.parts.messages.note(`${who} has nothing that could be saved as .${kind}.`, 'warning');
      }
      // One dialog is a choice, ten are a nuisance.
      await this.run(jobs, () => undefined, jobs.length === 1);
    });
  }

  /** Saves a whole character as one zip. */
  saveAll(characterId: string): Promise<void> {
    return this.inTurn(async () => {
      const character = findCharacter(this.parts.store.document, characterId);
      if (!character) return;
      const { zipCharacter } = await import('./zip-character.ts');
      const { name, bytes } = zipCharacter(character);
      const holds = partsOf(character).map((part) => ({ character, part, pose: jointPose(character) }));
      await this.run([{ name, holds, target: undefined, write: () => ({ bytes }) }], () => undefined);
    });
  }

  private inTurn(work: () => Promise<void>): Promise<void> {
    const turn = this.last.then(work);
    this.last = turn.catch(() => undefined);
    return turn;
  }

  private async run(jobs: readonly Job[], targetOf: (job: Job) => DiskFile | undefined, asks = true): Promise<void> {
    const { messages } = this.parts;
    const names: string[] = [];
    const diagnostics: Diagnostic[] = [];
    const well: string[] = [];
    for (const job of jobs) {
      try {
        const written = job.write();
        const make = async () =>
          'bytes' in written ? written.bytes : 'text' in written ? written.text : await blobOf(written.pieces);
        const saved = await this.put(job, make, targetOf(job), asks);
        if (saved === undefined) continue;
        names.push(saved);
        well.push(job.name);
        if ('text' in written) diagnostics.push(...written.diagnostics);
        else if ('pieces' in written) diagnostics.push(...written.diagnostics());
      } catch (error) {
        const why = error instanceof Error ? error.message : String(error);
        diagnostics.push(withoutPlace('error', 'save-failed', `Not saved. ${why}`, job.name));
      }
    }
    messages.report(diagnostics, well);
    if (names.length) messages.note(`Saved ${names.join(', ')}.`);
  }

  /** Gives the name under which it was saved; undefined where the person gave up. */
  private async put(
    job: Job,
    make: () => Promise<Content>,
    target: DiskFile | undefined,
    asks: boolean,
  ): Promise<string | undefined> {
    const { disk, handles, unsaved } = this.parts;
    let savedAs = job.name;
    if (target?.handle) await this.putInPlace(job, await make(), target, target.handle);
    else if (asks && disk.asksWhereToSave()) {
      const handle = await disk.pickTarget(job.name);
      if (!handle) return undefined;
      // After the dialog, which wants the key that was pressed to be fresh: a long file takes a while.
      const content = await make();
      const version = await disk.writeTo(handle, content);
      savedAs = handle.name;
      if (!(content instanceof Uint8Array)) {
        for (const { character, part } of job.holds) {
          handles.setPart(character, part, { path: target?.path ?? job.name, handle, version });
        }
      }
    } else disk.download(job.name, await make());
    for (const { character, part, pose } of job.holds) unsaved.saved(character.id, part, pose);
    return savedAs;
  }

  private async putInPlace(
    { holds, name }: Job,
    content: Content,
    target: DiskFile,
    handle: FileSystemFileHandle,
  ): Promise<void> {
    const { disk, handles } = this.parts;
    const onDisk = await disk.versionOnDisk(handle);
    if (onDisk !== undefined && target.version !== undefined && onDisk !== target.version) {
      if (this.warnedOf.get(target.path) !== onDisk) {
        this.warnedOf.set(target.path, onDisk);
        throw new DiskError(
          `${name} was changed on disk since it was opened here. Reload it from disk, or save again to overwrite it.`,
        );
      }
    }
    try {
      const version = await disk.writeTo(handle, content);
      for (const { character, part } of holds) handles.setPart(character, part, { ...target, version });
    } catch (error) {
      if (!(error instanceof DiskError) || !error.isGone) throw error;
      // Asking the same place again would fail for ever.
      const { handle: _gone, version: _old, ...rest } = target;
      for (const { character, part } of holds) handles.setPart(character, part, rest);
      throw new DiskError(`${error.message} Save again to choose another place.`);
    }
  }

  private changedFiles(): readonly Job[] {
    const { store, unsaved } = this.parts;
    const jobs: Job[] = [];
    for (const changed of unsaved.current()) {
      const owned = find(store.document, changed);
      if (!owned || jobs.some((job) => job.holds.some((h) => h.part.part === owned.part.part))) continue;
      jobs.push(this.fileOf(owned.character, owned.part, (c) => poseToSave(c, unsaved.poseInFile(c))));
    }
    return jobs;
  }

  private filesOf(character: Character, kind: SaveKind): readonly Job[] {
    if (kind === 'rig') {
      return saveCharacter(character, kind).map((file) => {
        return { name: file.name, holds: [], target: undefined, write: () => file };
      });
    }
    if (isExport(character, kind)) {
      const { framesPerSecond } = this.parts;
      return exportCharacter(character, kind, framesPerSecond && { framesPerSecond: framesPerSecond() }).map((file) => {
        return { name: file.name, holds: [], target: undefined, write: () => file };
      });
    }
    const parts = partsOf(character).filter((part) => part.kind === partKindOf(kind));
    return parts.map((part) => this.fileOf(character, part, jointPose));
  }

  /** The file that a part is in, with whatever else has to be written for it to stay whole. */
  private fileOf(character: Character, part: Part, poseOf: (c: Character) => readonly number[]): Job {
    const { store, handles } = this.parts;
    const name = fileNameOf(character, part);
    const target = handles.ofPart(character, part);
    if (part.kind === 'bvh') {
      const roots = takesBeside(store.document, character, part);
      return {
        name,
        holds: roots.map(({ character: c, take }) => ({ character: c, part: { kind: 'bvh', part: take }, pose: [] })),
        target,
        write: () => saveTakes(name, roots),
      };
    }
    if (part.kind !== 'skel') {
      const holds = [{ character, part, pose: [] }];
      return { name, holds, target, write: () => savePart(part, name, []) };
    }
    const roots = rootsBeside(store.document, character, part).map((root) => ({
      ...root,
      pose: poseOf(root.character),
    }));
    return {
      name,
      holds: roots.map(({ character: c, skeleton, pose }) => ({
        character: c,
        part: { kind: 'skel', part: skeleton },
        pose,
      })),
      target,
      write: () => saveSkeletons(name, roots),
    };
  }
}

function find(document: Document, { characterId, kind, index }: UnsavedPart) {
  const character = findCharacter(document, characterId);
  const part = character && partsOf(character).filter((p) => p.kind === kind)[index];
  return character && part && { character, part };
}

/**
 * A long file as a Blob, made in stretches between which the page lives on. The browser keeps it, not the script: what is
 * in the script's memory at any time are some hundred pieces.
 */
async function blobOf(pieces: Iterable<FilePiece>): Promise<Blob> {
  const parts: Blob[] = [];
  let batch: FilePiece[] = [];
  let begun = performance.now();
  for (const piece of pieces) {
    batch.push(piece);
    if (performance.now() - begun < STRETCH) continue;
    parts.push(new Blob(batch));
    batch = [];
    await new Promise((resolve) => setTimeout(resolve));
    begun = performance.now();
  }
  return new Blob([...parts, ...batch], { type: 'text/plain' });
}

/** The takes of one `.bvh`, in their order: one character each. */
function takesBeside(document: Document, character: Character, part: Extract<Part, { kind: 'bvh' }>) {
  const path = sourceOf(character, part)?.path;
  const roots: { readonly character: Character; readonly take: typeof part.part }[] = [];
  for (const other of document.characters) {
    for (const own of partsOf(other)) {
      if (own.kind !== 'bvh') continue;
      const isBeside = path !== undefined && other !== character && sourceOf(other, own)?.path === path;
      if (own.part === part.part || isBeside) roots.push({ character: other, take: own.part });
    }
  }
  return roots;
}

/** The skeletons of one `.skel`, in their order: one character each. */
function rootsBeside(document: Document, character: Character, part: Part) {
  const path = sourceOf(character, part)?.path;
  const roots: { readonly character: Character; readonly skeleton: NonNullable<Character['skeleton']> }[] = [];
  for (const other of document.characters) {
    const { skeleton } = other;
    if (!skeleton) continue;
    const isBeside = path !== undefined && sourceOf(other, { kind: 'skel', part: skeleton })?.path === path;
    if (other === character || isBeside) roots.push({ character: other, skeleton });
  }
  return roots;
}
