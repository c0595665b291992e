/** Contents of a zip, for page and command alike. */
import { unzip, ZipRefusal } from '../formats/unzip.ts';

/** Most files of one opening. What more files hold would keep the page busy for seconds at a time. */
export const MAX_FILES = 10_000;

/** A file in a zip. */
export interface ZippedFile {
  /** In a folder named after the zip, since files packed together belong together: `pack.zip/hero/hero.skel`. */
  readonly path: string;
  readonly bytes: Uint8Array<ArrayBuffer>;
}

/** The files taken out of a zip. */
export interface ZipContent {
  readonly files: readonly ZippedFile[];
  /** Paths of files of kinds that nobody asked for. */
  readonly passedOver: readonly string[];
}

/**
 * Takes the wanted files out of a zip.
 * @param path of the zip
 * @param isWanted by its name
 * @param maxBytes of all that is wanted, unpacked; default: as `unzip`
 * @throws Error as `unzip`; a `ZipRefusal`, too, if there are too many files
 */
export function zipContent(
  path: string,
  bytes: Uint8Array,
  isWanted: (name: string) => boolean,
  { maxFiles = MAX_FILES, maxBytes }: { readonly maxFiles?: number; readonly maxBytes?: number } = {},
): ZipContent {
  let count = 0;
  const wanted = (name: string) => {
    if (!isWanted(within(name))) return false;
    // Before any is unpacked.
    if (++count > maxFiles) throw new ZipRefusal(`it holds too many files; ${tooManyFiles(maxFiles)}`);
    return true;
  };
  const { entries, passedOver } = unzip(bytes, wanted, maxBytes);
  const inside = (name: string) => `${path}/${within(name)}`;
  return {
    files: entries.map((entry) => ({ path: inside(entry.path), bytes: entry.bytes })),
    passedOver: passedOver.map(inside),
  };
}

/** A path in a zip, which never leads out of it: `../a.skel` is `a.skel`. Some programs of Windows write backslashes. */
function within(name: string): string {
  const steps = name.split(/[/\\]/);
  return steps.filter((step) => step !== '' && step !== '.' && step !== '..').join('/');
}

/** The message about more files than can be opened at once. */
export function tooManyFiles(maxFiles: number): string {
  return `at most ${maxFiles.toLocaleString('en')} can be opened at once; try one folder at a time`;
}

/** Whether a file is a zip by its name, in upper or lower case. */
export function isZip(name: string): boolean {
  return name.toLowerCase().endsWith('.zip');
}
