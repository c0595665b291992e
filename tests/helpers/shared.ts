/**
 * The reference files: next to the checkout, in `../shared`, and not part of it. They add to the tests: what needs them
 * is declared only where they are. Files all of whose tests need them are named `*.shared.test.ts`.
 */
import { existsSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { describe } from 'vitest';

const ROOT = fileURLToPath(new URL('../../../shared/', import.meta.url));

export const hasShared = existsSync(ROOT);

/** A `describe` that there is only with the reference files. */
export function describeShared(name: string, body: () => void): void {
  if (hasShared) describe(name, body);
}

/** Absolute path of a reference file: `data/cse169/wasp.skel`. */
export function sharedPath(path: string): string {
  return `${ROOT}${path}`;
}

export function sharedBytes(path: string): Uint8Array<ArrayBuffer> {
  return new Uint8Array(readFileSync(sharedPath(path)));
}

/** A file of expected numbers. The caller states its shape. */
export function conformance<T>(name: string): T {
  // The files are fixed; their shape is checked by the tests that read them.
  return JSON.parse(readFileSync(sharedPath(`conformance/${name}`), 'utf8')) as T;
}
