/** Files as a person gives them: dropped, pasted, picked, or named in the address. All become paths with bytes. */
import type { GivenBlob } from '../worker/protocol.ts';

/** By name, numbers by value (`head2.morph` before `head10.morph`): the order that decides between alternatives. */
const byPath = new Intl.Collator('en', { numeric: true });

export function inNaturalOrder(files: readonly GivenBlob[]): readonly GivenBlob[] {
  return [...files].sort((a, b) => byPath.compare(a.path, b.path));
}

/** From a file input, with folders where a folder was picked. */
export function fromFileList(list: Iterable<File>): readonly GivenBlob[] {
  return inNaturalOrder([...list].map((file) => ({ path: file.webkitRelativePath || file.name, blob: file })));
}

/**
 * From a drop or a paste, folders included. What the browser hands over is gone when the event is over, so the entries
 * are taken at once and only their content is waited for.
 */
export async function fromDataTransfer(data: DataTransfer): Promise<readonly GivenBlob[]> {
  const entries: FileSystemEntry[] = [];
  const files: File[] = [];
  for (const item of data.items) {
    if (item.kind !== 'file') continue;
    const entry = item.webkitGetAsEntry();
    const file = item.getAsFile();
    if (entry?.isDirectory) entries.push(entry);
    else if (file) files.push(file);
  }
  const found: GivenBlob[] = files.map((file) => ({ path: file.name, blob: file }));
  for (const entry of entries) await walk(entry, found);
  return inNaturalOrder(found);
}

async function walk(entry: FileSystemEntry, found: GivenBlob[]): Promise<void> {
  if (isFile(entry)) {
    const file = await new Promise<File>((resolve, reject) => entry.file(resolve, reject));
    // `.DS_Store` and its like are no one's character.
    if (!file.name.startsWith('.')) found.push({ path: entry.fullPath.replace(/^\//, ''), blob: file });
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

function isFile(entry: FileSystemEntry): entry is FileSystemFileEntry {
  return entry.isFile;
}

function isFolder(entry: FileSystemEntry): entry is FileSystemDirectoryEntry {
  return entry.isDirectory;
}
