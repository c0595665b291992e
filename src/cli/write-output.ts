/**
 * Files that the command writes: beside their place and moved there whole, so that one may be written over what was
 * read, and there is never half a file.
 */
import { closeSync, fstatSync, openSync, renameSync, rmSync, statSync, writeFileSync } from 'node:fs';

/** How many bytes were written; or why none were: then what was there is as it was. */
export type Written = { readonly bytes: number } | { readonly failure: string };

/**
 * @param path absolute
 * @param pieces one after the other, a file of any size
 */
export function writeOutput(path: string, pieces: Iterable<string | Uint8Array>): Written {
  const scratch = `${path}.${process.pid}.tmp`;
  try {
    const there = statSync(path, { throwIfNoEntry: false });
    if (there && !there.isFile()) return { failure: 'something other than a file has this name' };
    const file = openSync(scratch, 'wx', there?.mode);
    let bytes = 0;
    try {
      for (const piece of pieces) writeFileSync(file, piece);
      bytes = fstatSync(file).size;
    } finally {
      closeSync(file);
    }
    renameSync(scratch, path);
    return { bytes };
  } catch (error) {
    rmSync(scratch, { force: true });
    return { failure: error instanceof Error ? error.message : String(error) };
  }
}
