/**
 * Files on disk, through the File System Access API if the browser has it: picked with a handle, saved in place, read
 * again. Otherwise a file input opens, a download saves, and a changed file has to be given again.
 *
 * All failures are `DiskError`s: a sentence that says what to do. Cancelling a dialog is no failure, but returns
 * undefined.
 */

import { sentenceOf } from '../model/failure.ts';
import { UserError } from '../model/user-error.ts';
import { fromFileList, fromHandles, type GivenFile, givenFile, inFolder, inNaturalOrder, versionOf } from './given.ts';

/*
 * The parts of the API used here, which TypeScript's DOM library omits because not every browser has them. Those for
 * drops are in `given.ts`.
 */
declare global {
  interface Window {
    showOpenFilePicker?(options: { readonly multiple: boolean }): Promise<FileSystemFileHandle[]>;
    showDirectoryPicker?(options: { readonly mode: FileAccess }): Promise<FileSystemDirectoryHandle>;
    showSaveFilePicker?(options: { readonly suggestedName: string }): Promise<FileSystemFileHandle>;
  }
  interface DataTransferItem {
    getAsFileSystemHandle?(): Promise<FileSystemFileHandle | FileSystemDirectoryHandle | null>;
  }
  interface FileSystemHandle {
    queryPermission?(access: { readonly mode: FileAccess }): Promise<PermissionState>;
    requestPermission?(access: { readonly mode: FileAccess }): Promise<PermissionState>;
  }
}

type FileAccess = 'read' | 'readwrite';

/** A failure of the disk or the browser. The sentence does not contain the file's name. */
export class DiskError extends UserError {
  override readonly name = 'DiskError';

  constructor(
    message: string,
    /** The file no longer exists: retrying won't help. */
    readonly isGone = false,
  ) {
    super(message);
  }
}

/** The browser can't show its dialog now: each needs a click or key press of its own. */
export class NotNowError extends DiskError {}

/**
 * Location of a file that was opened or saved, as far as the browser knows. Plain data that can be stored between
 * visits.
 */
export interface DiskFile {
  /** As opened: with folders, separated by `/`. */
  readonly path: string;
  readonly handle?: FileSystemFileHandle;
  /** The given file, without a handle: readable as long as it does not change. */
  readonly file?: File;
  readonly address?: string;
  /** Version of the content that is open; see `GivenFile`. */
  readonly version?: string;
}

/** Undefined for content without a file: from a script, or part of a zip. */
export function diskFileOf({ path, blob, handle, address, version }: GivenFile): DiskFile | undefined {
  const known = { path, ...(version !== undefined && { version }) };
  if (handle) return { ...known, handle };
  if (address !== undefined) return { ...known, address };
  return blob instanceof File ? { ...known, file: blob } : undefined;
}

/** The browser's dialog for opening. Empty or never resolved if cancelled. */
export async function pickFiles(): Promise<readonly GivenFile[]> {
  const handles = await picked(() => window.showOpenFilePicker?.({ multiple: true }));
  if (handles === 'cancelled') return [];
  if (!handles) return pickByInput(false);
  return fromHandles(handles);
}

export async function pickFolder(): Promise<readonly GivenFile[]> {
  const folder = await picked(() => window.showDirectoryPicker?.({ mode: 'read' }));
  if (folder === 'cancelled') return [];
  return folder ? inNaturalOrder(await inFolder(folder)) : pickByInput(true);
}

/** Whether this browser asks where to save; otherwise it downloads. */
export function asksWhereToSave(): boolean {
  return window.showSaveFilePicker !== undefined;
}

/** Asks where to save; undefined if cancelled. Throws a `NotNowError` if the browser can't ask now. */
export async function pickTarget(suggestedName: string): Promise<FileSystemFileHandle | undefined> {
  try {
    return await window.showSaveFilePicker?.({ suggestedName });
  } catch (error) {
    if (isNamed(error, 'AbortError')) return undefined;
    if (isNamed(error, 'SecurityError') || isNamed(error, 'NotAllowedError'))
      throw new NotNowError('Save again to choose where to save it.');
    throw asDiskError(error);
  }
}

/**
 * Writes a file in place; it is only replaced once everything is written. Returns its new version. Throws a
 * `NotNowError` if the browser would have to ask for permission, but can't now.
 */
export async function writeTo(handle: FileSystemFileHandle, content: Blob): Promise<string> {
  try {
    await allow(handle, 'readwrite');
    const stream = await handle.createWritable();
    try {
      await stream.write(content);
      await stream.close();
    } catch (error) {
      // Otherwise what was written so far stays beside the file.
      await stream.abort().catch(() => undefined);
      throw error;
    }
    return versionOf(await handle.getFile());
  } catch (error) {
    if (isNamed(error, 'SecurityError')) throw new NotNowError('Save again to allow writing to it.');
    throw asDiskError(error);
  }
}

/** The current version of a file; undefined if that would need permission. */
export async function versionOnDisk(handle: FileSystemFileHandle): Promise<string | undefined> {
  try {
    return versionOf(await handle.getFile());
  } catch {
    return undefined;
  }
}

/** Reads the file again. Throws a `DiskError`, or a `FetchError` for an address. */
export async function readAgain(file: DiskFile, page: string, signal?: AbortSignal): Promise<GivenFile> {
  const { path, handle, address } = file;
  if (handle) {
    try {
      await allow(handle, 'read');
      return givenFile(path, await handle.getFile(), handle);
    } catch (error) {
      throw asDiskError(error);
    }
  }
  if (address !== undefined) {
    const { fetchFiles } = await import('./fetch-files.ts');
    const [again] = await fetchFiles([address], page, signal, 'no-cache');
    return { ...again, path };
  }
  const own = file.file;
  if (!own) throw new DiskError('Its location is not known. Open it again.');
  try {
    await own.slice(0, 1).arrayBuffer();
  } catch {
    throw new DiskError('It has changed on disk. Drop it again, since this browser can’t reread it.');
  }
  return givenFile(path, own);
}

/** Asks for permission if needed; throws if it is denied. */
async function allow(handle: FileSystemFileHandle, mode: FileAccess): Promise<void> {
  if (((await handle.queryPermission?.({ mode })) ?? 'granted') === 'granted') return;
  if ((await handle.requestPermission?.({ mode })) === 'granted') return;
  throw new DOMException('', 'NotAllowedError');
}

/** Runs a dialog. Undefined if there is none, or the page may not open it (in a frame of another page). */
async function picked<T>(ask: () => Promise<T> | undefined): Promise<T | 'cancelled' | undefined> {
  try {
    return await ask();
  } catch (error) {
    return isNamed(error, 'AbortError') ? 'cancelled' : undefined;
  }
}

/** The input of the last dialog: outside of the document, one that nothing refers to may be collected before it answers. */
let asking: HTMLInputElement | undefined;

/** Never resolves if the dialog is cancelled: Firefox, when automated, says so before it has the files. */
function pickByInput(folder: boolean): Promise<readonly GivenFile[]> {
  const input = document.createElement('input');
  input.type = 'file';
  input.multiple = true;
  input.webkitdirectory = folder;
  asking = input;
  return new Promise((resolve) => {
    input.addEventListener('change', () => {
      if (asking === input) asking = undefined;
      resolve(fromFileList(input.files ?? []));
    });
    input.click();
  });
}

function asDiskError(error: unknown): DiskError {
  return error instanceof DiskError ? error : new DiskError(sentence(error), isNamed(error, 'NotFoundError'));
}

/** https://fs.spec.whatwg.org/ and https://wicg.github.io/file-system-access/ name these. */
function sentence(error: unknown): string {
  if (isNamed(error, 'NotFoundError')) return 'It was moved, renamed or deleted.';
  if (isNamed(error, 'NotAllowedError') || isNamed(error, 'SecurityError')) return 'The browser has no permission.';
  if (isNamed(error, 'NoModificationAllowedError')) return 'Another program or tab is writing to it.';
  if (isNamed(error, 'QuotaExceededError')) return 'There is not enough space.';
  if (isNamed(error, 'NotReadableError')) return 'The system denied access to it.';
  if (isNamed(error, 'TypeMismatchError')) return 'A folder has that name.';
  if (isNamed(error, 'InvalidStateError')) return 'It changed in the meantime. Try again.';
  if (isNamed(error, 'AbortError'))
    return 'The browser or a virus scanner stopped it. Try again, or choose another location.';
  return sentenceOf(error);
}

function isNamed(error: unknown, name: string): boolean {
  return error instanceof Error && error.name === name;
}
