/**
 * Writes output files atomically: to a temporary file on the same disk, then renamed. A file may replace its own
 * source, and is never half written.
 */
import { closeSync, mkdirSync, openSync, renameSync, rmSync, statSync, writeSync, writevSync } from 'node:fs';
import { dirname } from 'node:path';
import { reasonOf } from './reason.ts';
import { holdSignals, removeStale, unfinishedName } from './unfinished-files.ts';

/** Bytes written; or the reason for a failure, which leaves an existing file unchanged. */
export type Written = { readonly bytes: number } | { readonly failure: string };

/**
 * @param path absolute
 * @param pieces written one after the other, so that a file may be of any size
 * @param folder for the temporary file, on the same disk; default: next to the target
 */
export function writeOutput(path: string, pieces: Iterable<string | Uint8Array>, folder = dirname(path)): Written {
  const scratch = unfinishedName(path, folder);
  holdSignals();
  try {
    const there = statSync(path, { throwIfNoEntry: false });
    if (there && !there.isFile()) return { failure: 'something other than a file has this name' };
    if (folder === dirname(path)) removeStale(folder);
    const file = openSync(scratch, 'wx', there?.mode);
    let bytes = 0;
    try {
      bytes = writePieces(file, pieces);
    } finally {
      closeSync(file);
    }
    renameSync(scratch, path);
    return { bytes };
  } catch (error) {
    rmSync(scratch, { force: true });
    return { failure: reasonOf(error) };
  }
}

/** `writeOutput`, with the folders that the path needs. @param folder as of `writeOutput` */
export function writeInFolder(path: string, pieces: Iterable<string | Uint8Array>, folder?: string): Written {
  try {
    mkdirSync(dirname(path), { recursive: true });
  } catch (error) {
    return { failure: `its folder could not be created: ${reasonOf(error)}` };
  }
  return writeOutput(path, pieces, folder);
}

/** Pieces are written together up to this size: a call for each small one takes longer than its bytes. */
const TOGETHER_BYTES = 8 << 20;
const TOGETHER = 256;

/** @returns bytes written */
function writePieces(file: number, pieces: Iterable<string | Uint8Array>): number {
  let waiting: Uint8Array[] = [];
  let size = 0;
  let bytes = 0;
  const write = () => {
    writeAll(file, waiting, size);
    bytes += size;
    waiting = [];
    size = 0;
  };
  for (const piece of pieces) {
    const own = typeof piece === 'string' ? Buffer.from(piece) : piece;
    waiting.push(own);
    size += own.length;
    if (size >= TOGETHER_BYTES || waiting.length === TOGETHER) write();
  }
  if (size > 0) write();
  return bytes;
}

function writeAll(file: number, pieces: readonly Uint8Array[], size: number): void {
  // A full disk takes a part, and tells why only when it is asked for the rest.
  let skipped = writevSync(file, pieces);
  if (skipped === size) return;
  for (const piece of pieces) {
    let at = Math.min(skipped, piece.length);
    skipped -= at;
    while (at < piece.length) at += writeSync(file, piece, at);
  }
}
