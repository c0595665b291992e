/** A fake disk and browser, and a page with files open, for the tests of saving and reloading. */
import { DiskHandles } from '../../src/app/disk-handles.ts';
import { type Disk, Saver } from '../../src/app/saver.ts';
import { Unsaved } from '../../src/app/unsaved.ts';
import { Store } from '../../src/edit/store.ts';
import { openFiles } from '../../src/files/open/open-files.ts';
import { DiskError, NotNowError } from '../../src/io/disk-access.ts';
import type { GivenFile } from '../../src/io/given.ts';
import type { Character } from '../../src/model/document.ts';
import type { ParsedFile } from '../../src/model/files.ts';
import { Messages } from '../../src/ui/state/messages.ts';
import { parse } from '../../src/worker/parse.ts';

/** The part of a handle that the fake disk uses. */
export function handleOf(name: string): FileSystemFileHandle {
  // Only the fake disk uses it.
  return { kind: 'file', name } as FileSystemFileHandle;
}

/** Files by handle; a version is the content itself. */
export class FakeDisk implements Disk {
  readonly files = new Map<FileSystemFileHandle, string>();
  readonly downloads: string[] = [];
  /** Names that the user was asked about. */
  readonly asked: string[] = [];
  /** The user's answer; undefined downloads, `give up` cancels the dialog. */
  picks: FileSystemFileHandle | 'as suggested' | 'give up' | undefined;
  /** Number of dialogs that the browser still allows. */
  dialogs = Number.POSITIVE_INFINITY;
  /** If false, the browser would have to ask first, and doesn't. */
  mayWrite = true;

  put(name: string, text: string): FileSystemFileHandle {
    const handle = handleOf(name);
    this.files.set(handle, text);
    return handle;
  }
  asksWhereToSave = () => this.picks !== undefined;
  pickTarget = async (name: string) => {
    if (this.dialogs-- <= 0) throw new NotNowError('Save again to choose where to save it.');
    this.asked.push(name);
    if (this.picks === 'as suggested') return this.put(name, '');
    return this.picks === 'give up' ? undefined : this.picks;
  };
  writeTo = async (handle: FileSystemFileHandle, content: Blob) => {
    if (!this.mayWrite) throw new NotNowError('Save again to allow writing to it.');
    if (!this.files.has(handle)) throw new DiskError('It is gone.', true);
    const text = await content.text();
    this.files.set(handle, text);
    return text;
  };
  versionOnDisk = async (handle: FileSystemFileHandle) => this.files.get(handle);
  download = (name: string) => void this.downloads.push(name);
}

/** Opens texts as the opener does, each with a handle on the disk if `onDisk`. */
export async function pageWith(texts: Readonly<Record<string, string>>, onDisk = true) {
  const disk = new FakeDisk();
  const store = new Store();
  const messages = new Messages();
  const unsaved = new Unsaved(store);
  const handles = new DiskHandles();
  const open = async (given: readonly GivenFile[]): Promise<readonly ParsedFile[]> => {
    const { files, broken } = await parse({ files: given }, () => undefined);
    const result = openFiles(store.document, files, broken, store.selection.characterId);
    store.replace(result.label, result.document);
    handles.note(given);
    unsaved.opened(files);
    return files;
  };
  await open(
    Object.entries(texts).map(([path, text]): GivenFile => {
      const given = { path, blob: new Blob([text]) };
      if (!onDisk) return given;
      return { ...given, handle: disk.put(path.slice(path.lastIndexOf('/') + 1), text), version: text };
    }),
  );
  const change = (edit: (character: Character) => Character, index = 0) =>
    store.replace('Change', {
      document: {
        ...store.document,
        characters: store.document.characters.map((c, i) => (i === index ? edit(c) : c)),
      },
    });
  const written: { readonly path: string; readonly content: Blob }[] = [];
  const onWritten = (path: string, content: Blob) => void written.push({ path, content });
  const saver = new Saver({ store, messages, unsaved, handles, disk, onWritten });
  return {
    disk,
    store,
    messages,
    unsaved,
    handles,
    saver,
    written,
    open,
    change,
    names: () => unsaved.current().map(({ name }) => name),
    /** The text of the first file of that name. */
    text: (name: string) => [...disk.files].find(([handle]) => handle.name === name)?.[1],
    handle: (name: string) => [...disk.files.keys()].find((handle) => handle.name === name),
  };
}
