/**
 * Files on disk, through the File System Access API if the browser has it: picked with a handle; otherwise a file input
 * opens. They are saved and read again by `disk-access.ts`, which the page's first script doesn't need.
 */

import { fromFileList, fromHandles, type GivenFile, inFolder, inNaturalOrder } from './given.ts';

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
  interface FileSystemHandle {
    queryPermission?(access: { readonly mode: FileAccess }): Promise<PermissionState>;
    requestPermission?(access: { readonly mode: FileAccess }): Promise<PermissionState>;
  }
}

/** What a page may do with a file. */
export type FileAccess = 'read' | 'readwrite';

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

/** Whether something is an error of that name, as the standards give them. */
export function isNamed(error: unknown, name: string): boolean {
  return error instanceof Error && error.name === name;
}
