/**
 * The reference files that the project is checked against: they lie beside the checkout, in `../shared`, and are no
 * part of it. On a clone without them the tests that need them are skipped, with a line that says so.
 */
import { existsSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { describe, it } from 'vitest';

const ROOT = fileURLToPath(new URL('../../../shared/', import.meta.url));

export const hasShared = existsSync(ROOT);

/** A `describe` that runs only where the reference files are. */
export function describeShared(name: string, body: () => void): void {
  if (hasShared) describe(name, body);
  // Not `body`: it is run even when skipped, to list its tests, and would read the files.
  else describe.skip(`${name} (skipped: the reference files in ../shared are not here)`, () => it('needs them'));
}

/** Absolute path of a reference file: `data/cse169/wasp.skel`. */
export function sharedPath(path: string): string {
  return `${ROOT}${path}`;
}

export function sharedBytes(path: string): Uint8Array {
  return new Uint8Array(readFileSync(sharedPath(path)));
}

/** A file of expected numbers. The caller names the shape it reads. */
export function conformance<T>(name: string): T {
  // The files are the contract's own; their shape is checked by the tests that read them.
  return JSON.parse(readFileSync(sharedPath(`conformance/${name}`), 'utf8')) as T;
}
