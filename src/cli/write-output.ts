/**
 * Writes output files atomically: to a temporary file on the same disk, then renamed. A file may replace its own
 * source, and is never half written.
 */
import { randomBytes } from 'node:crypto';
import { closeSync, fstatSync, openSync, renameSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { basename, dirname, join } from 'node:path';

/** Bytes written; or the reason for a failure, which leaves an existing file unchanged. */
export type Written = { readonly bytes: number } | { readonly failure: string };

/**
 * @param path absolute
 * @param pieces written one after the other, so that a file may be of any size
 * @param folder for the temporary file, on the same disk; default: next to the target
 */
export function writeOutput(path: string, pieces: Iterable<string | Uint8Array>, folder = dirname(path)): Written {
  // Of all that write here, from other machines too.
  const scratch = join(folder, `${basename(path)}.${process.pid}-${randomBytes(4).toString('hex')}.tmp`);
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
