/**
 * Saves what changed: in place if the browser allows it, else to a location the user picks, else as a download. What
 * could not be saved stays marked, with a message saying why.
 *
 * Browsers open one dialog per click or key. So of several files without a location, each save asks about one and says
 * which ones are left; cancelling the dialog cancels the others too.
 */

import type { Store } from '../edit/store.ts';
import { formatKindOf, KINDS, type SavedKind } from '../files/kinds.ts';
import { changedFiles, distinctJobs, type Job, savedFilesOf } from '../files/save/jobs.ts';
import type { FilePiece } from '../files/save/output.ts';
import { jointPose, poseToSave } from '../files/save/saved-poses.ts';
import { DiskError, NotNowError } from '../io/disk-access.ts';
import type { DiskFile } from '../io/disk-files.ts';
import { partsOf } from '../model/character-parts.ts';
import { type Diagnostic, withoutPlace } from '../model/diagnostic.ts';
import { findCharacter } from '../model/document.ts';
import { sentenceOf } from '../model/failure.ts';
import { type SourceFile, stemOf } from '../model/files.ts';
import { fileNameOf, isNamedApart, isSkeletonKind, type Part } from '../model/part.ts';
import type { Messages } from '../ui/state/messages.ts';
import type { DiskHandles } from './disk-handles.ts';
import type { Unsaved } from './unsaved.ts';
import type { CharactersZip } from './zip-character.ts';

/** The part of `io` that saving needs, replaceable in tests. */
export interface Disk {
  asksWhereToSave(): boolean;
  pickTarget(suggestedName: string): Promise<FileSystemFileHandle | undefined>;
  writeTo(handle: FileSystemFileHandle, content: Blob): Promise<string>;
  versionOnDisk(handle: FileSystemFileHandle): Promise<string | undefined>;
  download(name: string, content: Blob): void;
}

interface DiskJob extends Job {
  /** A zip contains the parts, so it isn't their file. */
  readonly isZip?: true;
  /** Absent: text. */
  readonly mime?: string;
}

export interface SaverParts {
  readonly store: Store;
  readonly unsaved: Unsaved;
  readonly handles: DiskHandles;
  /** Frame rate at which keys are sampled for motion capture; absent: 30. */
  readonly framesPerSecond?: () => number;
  readonly messages: Pick<Messages, 'note' | 'report' | 'confirm'>;
  readonly disk: Disk;
  /** A file was written, in place of what was read from it. */
  onWritten?(path: string, content: Blob): void;
}

/** Milliseconds of writing between two yields. */
const STRETCH = 12;

export class Saver {
  private last: Promise<void> = Promise.resolve();
  /** Versions on disk that the user was warned about: saving again overwrites them. */
  private readonly warnedOf = new Map<string, string>();

  constructor(private readonly parts: SaverParts) {}

  /** Saves everything that changed. Never rejects: failures are messages. */
  saveChanged(): Promise<void> {
    return this.inTurn(async () => {
      const { store, unsaved, handles, messages } = this.parts;
      const jobs = changedFiles(store.document, unsaved.current(), (c) => poseToSave(c, unsaved.poseInFile(c)));
      if (jobs.length === 0) messages.note('Everything is saved. Use Save as to write copies.');
      // All parts of a file have the same location.
      await this.run(jobs, ({ holds: [first], isBeside, withOthers }) => {
        if (withOthers) return withOthers.path === undefined ? undefined : handles.of(withOthers.path);
        return isBeside ? undefined : first && handles.ofPart(first.part);
      });
    });
  }

  /** Saves a character's parts of one kind as files that the user picks. Never rejects. */
  saveAs(characterId: string, kind: SavedKind): Promise<void> {
    return this.inTurn(async () => {
      const { store, messages, framesPerSecond } = this.parts;
      const character = findCharacter(store.document, characterId);
      const options = framesPerSecond && { framesPerSecond: framesPerSecond() };
      const jobs = character ? savedFilesOf(store.document, character, kind, options) : [];
      if (jobs.length === 0) {
        const who = character?.name ?? 'The character';
        messages.note(`${who} has nothing to save as .${kind}.`, 'warning');
      }
      // One dialog is fine, ten are not.
      await this.run(jobs, () => undefined, jobs.length === 1);
    });
  }

  /** Saves a whole character as one zip. Never rejects. */
  saveAll(characterId: string): Promise<void> {
    return this.inTurn(async () => {
      const character = findCharacter(this.parts.store.document, characterId);
      if (!character) return;
      const { zipCharacter } = await import('./zip-character.ts');
      await this.runZip(zipCharacter(character));
    });
  }

  /**
   * Downloads all characters as one zip, without those that can't be written: messages name them. Asks nothing, so that
   * it also works on a page that has failed. Never rejects.
   */
  saveEverything(): Promise<void> {
    return this.inTurn(async () => {
      const { zipDocument } = await import('./zip-character.ts');
      await this.runZip(zipDocument(this.parts.store.document), false);
    });
  }

  private runZip({ name, bytes, characters, diagnostics }: CharactersZip, asks = true): Promise<void> {
    const holds = characters.flatMap((character) =>
      partsOf(character).map((part) => ({ character, part, pose: jointPose(character) })),
    );
    const write = () => ({ pieces: () => [bytes], diagnostics: () => diagnostics });
    return this.run([{ name, holds, isZip: true, mime: 'application/zip', write }], () => undefined, asks);
  }

  /** Saves a file made elsewhere, which is none of the document's. Never rejects. */
  saveBytes(name: string, bytes: Uint8Array<ArrayBuffer>, mime: string): Promise<void> {
    const write = () => ({ pieces: () => [bytes], diagnostics: () => [] });
    return this.inTurn(() => this.run([{ name, holds: [], mime, write }], () => undefined));
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
    const inPlace: string[] = [];
    const downloaded: string[] = [];
    const diagnostics: Diagnostic[] = [];
    const well: string[] = [];
    const left: string[] = [];
    let dialogs: 'open' | 'cancelled' | 'used up' = 'open';
    let hadDialog = false;
    let remedy = '';
    for (const job of distinctJobs(jobs, (job) => targetOf(job)?.handle !== undefined)) {
      const hasFile = targetOf(job)?.handle !== undefined;
      // A dialog for each of the files that are written together would be too many.
      const wantsDialog = asks && !hasFile && !job.withOthers && disk.asksWhereToSave();
      if (wantsDialog && dialogs !== 'open') {
        left.push(job.name);
        continue;
      }
      try {
        const written = job.write(job.name);
        const make = () => blobOf(written.pieces(), job.mime ?? 'text/plain');
        const saved = await this.put(job, make, targetOf(job), wantsDialog);
        if (saved === undefined) {
          dialogs = 'cancelled';
          left.push(job.name);
          continue;
        }
        (hasFile || wantsDialog ? inPlace : downloaded).push(saved);
        well.push(job.name);
        diagnostics.push(...written.diagnostics());
      } catch (error) {
        // A previous dialog or a long wait used up the click.
        if (error instanceof NotNowError) {
          dialogs = 'used up';
          remedy = hadDialog ? 'The browser saves one file at a time. Save again for the next.' : error.message;
          left.push(job.name);
          continue;
        }
        diagnostics.push(notSaved(error, job.name));
      } finally {
        hadDialog ||= wantsDialog;
      }
    }
    messages.report(diagnostics, well);
    const said = [
      ...(inPlace.length ? [`Saved ${inPlace.join(', ')}.`] : []),
      ...(downloaded.length ? [`Downloaded ${downloaded.join(', ')}.`] : []),
    ];
    // Cancelling the only dialog needs no message.
    if (left.length && (jobs.length > 1 || dialogs === 'used up')) said.push(`Not saved: ${left.join(', ')}.`);
    if (dialogs === 'used up') said.push(remedy);
    // If no dialog appeared, the user can't know that one was needed.
    const severity = dialogs === 'used up' && inPlace.length + downloaded.length === 0 ? 'warning' : 'info';
    const [first] = jobs.flatMap(({ holds, isZip }) => (isZip ? [] : holds));
    // The other files of the example are nowhere on disk, and without them the take opens alone.
    if (first && this.parts.store.document.isOpeningSample && well.length > 0 && severity === 'info') {
      const zip = { label: 'Save all as .zip', run: () => void this.saveAll(first.character.id) };
      messages.confirm(`${said.join(' ')} It opens with ${first.character.name}’s other files.`, zip);
    } else if (said.length) messages.note(said.join(' '), severity);
  }

  /** Returns the name it was saved as; undefined if cancelled. */
  private async put(
    job: DiskJob,
    make: () => Promise<Blob>,
    target: DiskFile | undefined,
    wantsDialog: boolean,
  ): Promise<string | undefined> {
    const { disk, handles, unsaved, store, onWritten } = this.parts;
    let savedAs = job.name;
    let content: Blob;
    let file: Omit<DiskFile, 'path'> | undefined;
    if (target?.handle) {
      content = await make();
      file = { ...target, version: await this.overwrite(job, content, target, target.handle) };
    } else if (wantsDialog) {
      const handle = await disk.pickTarget(job.name);
      if (!handle) return undefined;
      // After the dialog, which needs a recent click or key: writing a long file takes a while.
      content = await make();
      file = { handle, version: await disk.writeTo(handle, content) };
      savedAs = handle.name;
    } else {
      content = await make();
      disk.download(job.name, content);
    }
    const { path } = job.withOthers ?? {};
    if (path !== undefined && file) {
      handles.set(path, { ...file, path });
      onWritten?.(path, content);
    }
    for (const { character, part, pose } of job.holds) {
      unsaved.written(part, pose);
      if (job.isZip || job.isBeside || !findCharacter(store.document, character.id)) continue;
      const own = part.file ?? this.newFile(character.id, part, savedAs, content.size);
      if (!part.file) unsaved.setFile(character.id, part, own);
      else if (own.name === savedAs) unsaved.setBytes(character.id, part, content.size);
      if (!file) continue;
      handles.set(own.path, { ...file, path: own.path });
      onWritten?.(own.path, content);
    }
    return savedAs;
  }

  /** A source for a part created here, so that it is listed and reloaded like one from a file. */
  private newFile(characterId: string, part: Part, savedAs: string, bytes: number): SourceFile {
    const { store, handles } = this.parts;
    const format = formatKindOf(savedAs);
    const isKind = format !== undefined && KINDS[format].content === part.kind;
    const source = { name: savedAs, path: savedAs, bytes };
    // Most parts are named after their file: under another name it would be read as another part.
    const isOwn = isKind && (isSkeletonKind(part.kind) || isNamedApart(part.kind) || stemOf(source) === part.name);
    const name = isOwn ? savedAs : fileNameOf(part);
    // Files are identified by path: keep two of one name apart if their locations are unknown.
    const isOpen = store.document.characters.some(({ sources }) => sources.some(({ path }) => path === name));
    return { name, path: isOpen || handles.has(name) ? `${characterId}/${name}` : name, bytes };
  }

  /** Returns the file's new version. */
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
      // That handle would fail again.
      const { handle: _gone, version: _old, ...rest } = target;
      for (const { part } of holds) if (part.file) handles.set(part.file.path, rest);
      throw new DiskError(`${error.message} Save again to choose another location.`);
    }
  }
}

function notSaved(error: unknown, name: string): Diagnostic {
  const why = sentenceOf(error);
  return withoutPlace('error', 'save-failed', `Not saved. ${why}`, name);
}

/**
 * A long file as a Blob, made in slices so that the page stays responsive. The browser stores it: the script holds only
 * some hundred pieces at a time.
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
