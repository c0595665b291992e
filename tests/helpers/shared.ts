/**
 * The project's reference files: next to the checkout, in `../shared`, and not part of it. Without them, tests that
 * need them are skipped, with a line that says so.
 */
import { existsSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { describe, it } from 'vitest';

const ROOT = fileURLToPath(new URL('../../../shared/', import.meta.url));

export const hasShared = existsSync(ROOT);

/** A `describe` that runs only with the reference files. */
export function describeShared(name: string, body: () => void): void {
  if (hasShared) describe(name, body);
  // Not `body`: vitest runs it to collect tests even when skipped, and it would read the files.
  else describe.skip(`${name} (skipped: the reference files in ../shared are not here)`, () => it('needs them'));
}

/** Absolute path of a reference file: `data/cse169/wasp.skel`. */
export function sharedPath(path: string): string {
  return `${ROOT}${path}`;
}

export function sharedBytes(path: string): Uint8Array {
  return new Uint8Array(readFileSync(sharedPath(path)));
}

/** A file of expected numbers. The caller states its shape. */
export function conformance<T>(name: string): T {
  // The files are fixed; their shape is checked by the tests that read them.
  return JSON.parse(readFileSync(sharedPath(`conformance/${name}`), 'utf8')) as T;
}
