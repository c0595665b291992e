/**
 * Files on disk, saved in place and read again, if the browser has the File System Access API. Otherwise a download
 * saves, and a changed file has to be given again.
 *
 * All failures are `DiskError`s: a sentence that says what to do. Cancelling a dialog is no failure, but returns
 * undefined.
 */
import { sentenceOf } from '../model/failure.ts';
import { UserError } from '../model/user-error.ts';
import { type DiskFile, type FileAccess, isNamed } from './disk-files.ts';
import { type GivenFile, givenFile, versionOf } from './given.ts';

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
