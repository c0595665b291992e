/**
 * Saving: what changed, in place where the browser lets us, else where the person says, else as a download. What could
 * not be saved stays marked, and a message says why.
 *
 * A browser opens one dialog for a click or a key. So of several files without a place each save asks about one, and
 * says which ones wait; giving up a dialog gives up the others too.
 */
import type { Store } from '../edit/store.ts';
import { DiskError, type DiskFile, NotNowError } from '../io/disk-files.ts';
import { partsOf } from '../model/character-parts.ts';
import { type Diagnostic, withoutPlace } from '../model/diagnostic.ts';
import { findCharacter } from '../model/document.ts';
import { type SourceFile, stemOf } from '../model/files.ts';
import { fileNameOf, type Part } from '../model/part.ts';
import { type FormatKind, formatKindOf, KINDS } from '../project/kinds.ts';
import { changedFiles, distinctJobs, type Job, savedFilesOf } from '../project/save/jobs.ts';
import type { FilePiece } from '../project/save/output.ts';
import { jointPose, poseToSave } from '../project/save/own-formats.ts';
import type { Messages } from '../ui/state/messages.ts';
import type { DiskHandles } from './disk-handles.ts';
import type { Unsaved } from './unsaved.ts';

/** What of `io` it takes, so that a test can stand in for browser and disk. */
export interface Disk {
  asksWhereToSave(): boolean;
  pickTarget(suggestedName: string): Promise<FileSystemFileHandle | undefined>;
  writeTo(handle: FileSystemFileHandle, content: Blob): Promise<string>;
  versionOnDisk(handle: FileSystemFileHandle): Promise<string | undefined>;
  download(name: string, content: Blob): void;
}

interface DiskJob extends Job {
  /** It holds parts, and is no file of theirs. */
  readonly isZip?: true;
}

export interface SaverParts {
  readonly store: Store;
  readonly unsaved: Unsaved;
  readonly handles: DiskHandles;
  /** At which keys are sampled for motion capture; absent: 30. */
  readonly framesPerSecond?: () => number;
  readonly messages: Pick<Messages, 'note' | 'report'>;
  readonly disk: Disk;
}

/** For this long a long file is written at a stretch; milliseconds. */
const STRETCH = 12;

export class Saver {
  private last: Promise<void> = Promise.resolve();
  /** Versions on disk that the person was told of: saving again means it. */
  private readonly warnedOf = new Map<string, string>();

  constructor(private readonly parts: SaverParts) {}

  /** Saves all that changed. Never rejects: what goes wrong is a message. */
  saveChanged(): Promise<void> {
    return this.inTurn(async () => {
      const { store, unsaved, handles, messages } = this.parts;
      const jobs = changedFiles(store.document, unsaved.current(), (c) => poseToSave(c, unsaved.poseInFile(c)));
      if (jobs.length === 0) messages.note('Everything is saved. Use Save as to write copies.');
      // All parts that a file holds lie in the same one.
      await this.run(jobs, ({ holds: [first] }) => first && handles.ofPart(first.part));
    });
  }

  /** Saves a character's parts of one kind as the files that the person chooses. Never rejects. */
  saveAs(characterId: string, kind: FormatKind): Promise<void> {
    return this.inTurn(async () => {
      const { store, messages, framesPerSecond } = this.parts;
      const character = findCharacter(store.document, characterId);
      const options = framesPerSecond && { framesPerSecond: framesPerSecond() };
      const jobs = character ? savedFilesOf(store.document, character, kind, options) : [];
      if (jobs.length === 0) {
        const who = character?.name ?? 'The character';
        messages.note(`${who} has nothing to save as .${kind}.`, 'warning');
      }
      // One dialog is a choice, ten are a nuisance.
      await this.run(jobs, () => undefined, jobs.length === 1);
    });
  }

  /** Saves a whole character as one zip. Never rejects. */
  saveAll(characterId: string): Promise<void> {
    return this.inTurn(async () => {
      const character = findCharacter(this.parts.store.document, characterId);
      if (!character) return;
      const { zipCharacter } = await import('./zip-character.ts');
      const { name, bytes } = zipCharacter(character);
      const holds = partsOf(character).map((part) => ({ character, part, pose: jointPose(character) }));
      await this.run(
        [{ name, holds, isZip: true, write: () => ({ pieces: () => [bytes], diagnostics: () => [] }) }],
        () => undefined,
      );
    });
  }

  private inTurn(work: () => Promise<void>): Promise<void> {
    const turn = this.last.then(work).catch((error) => {
      // What can't be converted says so before there is a file to name.
      this.parts.messages.report([notSaved(error, '')]);
    });
    this.last = turn;
    return turn;
  }

  private async run(
    jobs: readonly DiskJob[],
    targetOf: (job: Job) => DiskFile | undefined,
    asks = true,
  ): Promise<void> {
    const { disk, messages } = this.parts;
    const names: string[] = [];
    const diagnostics: Diagnostic[] = [];
    const well: string[] = [];
    const left: string[] = [];
    let dialogs: 'open' | 'cancelled' | 'used up' = 'open';
    let hadDialog = false;
    let remedy = '';
    for (const job of distinctJobs(jobs, (job) => targetOf(job)?.handle !== undefined)) {
      const wantsDialog = asks && !targetOf(job)?.handle && disk.asksWhereToSave();
      if (wantsDialog && dialogs !== 'open') {
        left.push(job.name);
        continue;
      }
      try {
        const written = job.write(job.name);
        const make = () => blobOf(written.pieces(), job.isZip ? 'application/zip' : 'text/plain');
        const saved = await this.put(job, make, targetOf(job), wantsDialog);
        if (saved === undefined) {
          dialogs = 'cancelled';
          left.push(job.name);
          continue;
        }
        names.push(saved);
        well.push(job.name);
        diagnostics.push(...written.diagnostics());
      } catch (error) {
        // A dialog before it, or a long time, has used up the click: that is no fault of anyone's.
        if (error instanceof NotNowError) {
          dialogs = 'used up';
          remedy = hadDialog ? 'The browser asks for one file at a time. Save again.' : error.message;
          left.push(job.name);
          continue;
        }
        diagnostics.push(notSaved(error, job.name));
      } finally {
        hadDialog ||= wantsDialog;
      }
    }
    messages.report(diagnostics, well);
    const said = names.length ? [`Saved ${names.join(', ')}.`] : [];
    // Who gives up the only one knows it.
    if (left.length && (jobs.length > 1 || dialogs === 'used up')) said.push(`Not saved: ${left.join(', ')}.`);
    if (dialogs === 'used up') said.push(remedy);
    // Where it did not ask at all, nobody has seen that anything was meant to happen.
    const severity = dialogs === 'used up' && names.length === 0 ? 'warning' : 'info';
    if (said.length) messages.note(said.join(' '), severity);
  }

  /** Gives the name under which it was saved; undefined where the person gave up. */
  private async put(
    job: DiskJob,
    make: () => Promise<Blob>,
    target: DiskFile | undefined,
    wantsDialog: boolean,
  ): Promise<string | undefined> {
    const { disk, handles, unsaved, store } = this.parts;
    let savedAs = job.name;
    let content: Blob;
    let file: Omit<DiskFile, 'path'> | undefined;
    if (target?.handle) {
      content = await make();
      file = { ...target, version: await this.overwrite(job, content, target, target.handle) };
    } else if (wantsDialog) {
      const handle = await disk.pickTarget(job.name);
      if (!handle) return undefined;
      // After the dialog, which wants the key that was pressed to be fresh: a long file takes a while.
      content = await make();
      file = { handle, version: await disk.writeTo(handle, content) };
      savedAs = handle.name;
    } else {
      content = await make();
      disk.download(job.name, content);
    }
    for (const { character, part, pose } of job.holds) {
      unsaved.written(part, pose);
      if (job.isZip || !findCharacter(store.document, character.id)) continue;
      const own = part.file ?? this.newFile(character.id, part, savedAs, content.size);
      if (!part.file) unsaved.setFile(character.id, part, own);
      else if (own.name === savedAs) unsaved.setBytes(character.id, part, content.size);
      if (file) handles.set(own.path, { ...file, path: own.path });
    }
    return savedAs;
  }

  /** Of a part that was made here, which is listed and read again as what came from a file is. */
  private newFile(characterId: string, part: Part, savedAs: string, bytes: number): SourceFile {
    const { store, handles } = this.parts;
    const format = formatKindOf(savedAs);
    const isKind = format !== undefined && KINDS[format].content === part.kind;
    const source = { name: savedAs, path: savedAs, bytes };
    // Most parts are called after their file: one of another name would be read as another part.
    const isOwn = isKind && (part.kind === 'skel' || part.kind === 'pose' || stemOf(source) === part.name);
    const name = isOwn ? savedAs : fileNameOf(part);
    // By its path a file is known: two of one name, of which nobody knows where they lie, are kept apart.
    const isOpen = store.document.characters.some(({ sources }) => sources.some(({ path }) => path === name));
    return { name, path: isOpen || handles.has(name) ? `${characterId}/${name}` : name, bytes };
  }

  /** Gives the file's new version. */
  private async overwrite(
    { holds, name }: Job,
    content: Blob,
    target: DiskFile,
    handle: FileSystemFileHandle,
  ): Promise<string> {
    const { disk, handles } = this.parts;
    const onDisk = await disk.versionOnDisk(handle);
    if (onDisk !== undefined && target.version !== undefined && onDisk !== target.version) {
      if (this.warnedOf.get(target.path) !== onDisk) {
        this.warnedOf.set(target.path, onDisk);
        throw new DiskError(
          `${name} has changed on disk since it was opened. Reload it from disk, or save again to overwrite it.`,
        );
      }
    }
    try {
      return await disk.writeTo(handle, content);
    } catch (error) {
      if (!(error instanceof DiskError) || !error.isGone) throw error;
      // Asking the same place again would fail for ever.
      const { handle: _gone, version: _old, ...rest } = target;
      for (const { part } of holds) if (part.file) handles.set(part.file.path, rest);
      throw new DiskError(`${error.message} Save again to choose another place.`);
    }
  }
}

function notSaved(error: unknown, name: string): Diagnostic {
  const why = error instanceof Error ? error.message : String(error);
  return withoutPlace('error', 'save-failed', `Not saved. ${why}`, name);
}

/**
 * A long file as a Blob, made in stretches between which the page lives on. The browser keeps it, not the script: what is
 * in the script's memory at any time are some hundred pieces.
 */
async function blobOf(pieces: Iterable<FilePiece>, type: string): Promise<Blob> {
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
  return new Blob([...parts, ...batch], { type });
}
