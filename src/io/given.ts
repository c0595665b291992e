/**
 * Files from the user: dropped, pasted, picked, or named in the address. All become paths with bytes, and with what is
 * needed to read them again: a handle if the browser provides one, or their address.
 */
import type { GivenBlob } from '../worker/protocol.ts';

/* Missing in TypeScript's DOM library, as not every browser has it. */
declare global {
  interface DataTransferItem {
    getAsFileSystemHandle?(): Promise<FileSystemFileHandle | FileSystemDirectoryHandle | null>;
  }
}

/** A file with its origin. Only path and blob are sent to the worker. */
export interface GivenFile extends GivenBlob {
  /** Refers to the file on disk: it can be read again, and saved in place. */
  readonly handle?: FileSystemFileHandle;
  /** Address of a fetched file. */
  readonly address?: string;
  /** Changes with the content, as far as browser or server report it. */
  readonly version?: string;
}

/** By name, numbers by value (`head2.morph` before `head10.morph`): the order that decides between alternatives. */
const byPath = new Intl.Collator('en', { numeric: true });

export function inNaturalOrder(files: readonly GivenFile[]): readonly GivenFile[] {
  return [...files].sort((a, b) => byPath.compare(a.path, b.path));
}

/** The file as it is now, with its handle if there is one. */
export function givenFile(path: string, file: File, handle?: FileSystemFileHandle): GivenFile {
  return { path, blob: file, version: versionOf(file), ...(handle && { handle }) };
}

/** Equal for the same content, judging by date and size. */
export function versionOf({ lastModified, size }: File): string {
  return `${lastModified} ${size}`;
}

/** Files, and everything in folders. */
export async function fromHandles(
  handles: readonly (FileSystemFileHandle | FileSystemDirectoryHandle)[],
): Promise<readonly GivenFile[]> {
  const found = handles.map(async (handle) =>
    handle.kind === 'directory' ? inFolder(handle) : [givenFile(handle.name, await handle.getFile(), handle)],
  );
  return inNaturalOrder((await Promise.all(found)).flat());
}

/** From a file input, with folders if a folder was picked. */
export function fromFileList(list: Iterable<File>): readonly GivenFile[] {
  return inNaturalOrder([...list].map((file) => givenFile(file.webkitRelativePath || file.name, file)));
}

/** A dropped item, in every form that the browser provides. */
interface Dropped {
  readonly handle: Promise<FileSystemFileHandle | FileSystemDirectoryHandle | null> | undefined;
  readonly entry: FileSystemEntry | null;
  readonly file: File | null;
}

/**
 * Items whose entries are taken beside their handles, for folders that the browser gives no handle of. An entry takes a
 * question to the system each, while everything waits: those of thousands held up the page.
 */
const MAX_ENTRIES = 100;
/** Dates and sizes take a question to the system each, too: the page continues after so many milliseconds. */
const SLICE_MS = 12;

/**
 * From a drop or paste, including folders. The data is only accessible during the event, so handles and entries are
 * taken at once and only their content is awaited.
 */
export async function fromDataTransfer(data: DataTransfer): Promise<readonly GivenFile[]> {
  const dropped: Dropped[] = [];
  for (const item of data.items) {
    if (item.kind !== 'file') continue;
    // Items copied from a page, or made by a script, have no handle: browsers return null, or reject.
    const handle = item.getAsFileSystemHandle?.().catch(() => null);
    const entry = handle === undefined || dropped.length < MAX_ENTRIES ? item.webkitGetAsEntry() : null;
    dropped.push({ handle, entry, file: item.getAsFile() });
  }
  const found: GivenFile[] = [];
  let until = performance.now() + SLICE_MS;
  for (const { handle, entry, file } of dropped) {
    const own = (await handle) ?? undefined;
    if (own?.kind === 'directory') found.push(...(await inFolder(own)));
    else if (entry?.isDirectory) await walk(entry, found);
    else if (file) found.push(givenFile(file.name, file, own));
    if (performance.now() < until) continue;
    await new Promise((resolve) => setTimeout(resolve));
    until = performance.now() + SLICE_MS;
  }
  return inNaturalOrder(found);
}

/** Files that the system is asked for at once: each answer takes a millisecond or two. */
const AT_ONCE = 8;

/** Every file in a folder and its subfolders, with the folder's own name in the path. */
export async function inFolder(folder: FileSystemDirectoryHandle, path = folder.name): Promise<readonly GivenFile[]> {
  const inside: (FileSystemFileHandle | FileSystemDirectoryHandle)[] = [];
  for await (const handle of folder.values()) inside.push(handle);
  const found: GivenFile[] = [];
  for (let i = 0; i < inside.length; i += AT_ONCE) {
    const some = inside.slice(i, i + AT_ONCE).map(async (handle) => {
      const its = `${path}/${handle.name}`;
      if (handle.kind === 'directory') return inFolder(handle, its);
      return isHidden(handle.name) ? [] : [givenFile(its, await handle.getFile(), handle)];
    });
    found.push(...(await Promise.all(some)).flat());
  }
  return found;
}

async function walk(entry: FileSystemEntry, found: GivenFile[]): Promise<void> {
  if (isFile(entry)) {
    const file = await new Promise<File>((resolve, reject) => entry.file(resolve, reject));
    if (!isHidden(file.name)) found.push(givenFile(entry.fullPath.replace(/^\//, ''), file));
    return;
  }
  if (!isFolder(entry)) return;
  const reader = entry.createReader();
  // A folder is listed in pieces of at most 100; an empty piece is the end.
  for (;;) {
    const piece = await new Promise<FileSystemEntry[]>((resolve, reject) => reader.readEntries(resolve, reject));
    if (piece.length === 0) return;
    for (const inside of piece) await walk(inside, found);
  }
}

/** Ignores `.DS_Store` and the like. */
function isHidden(name: string): boolean {
  return name.startsWith('.');
}

function isFile(entry: FileSystemEntry): entry is FileSystemFileEntry {
  return entry.isFile;
}

function isFolder(entry: FileSystemEntry): entry is FileSystemDirectoryEntry {
  return entry.isDirectory;
}
