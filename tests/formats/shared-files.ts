/** The files at hand of all formats that are read and written: our own, and those of the reference. */
import { readdirSync } from 'node:fs';
import { formatKindOf, isSaved } from '../../src/files/kinds.ts';
import { OWN_FILES } from '../helpers/own-files.ts';
import { hasShared, sharedBytes, sharedPath } from '../helpers/shared.ts';

function filesIn(folder: string): string[] {
  if (!hasShared) return [];
  return readdirSync(sharedPath(folder))
    .filter((name) => {
      const kind = formatKindOf(name);
      return kind !== undefined && isSaved(kind);
    })
    .map((name) => `${folder}/${name}`);
}

export const GOOD_FILES = [
  ...OWN_FILES.keys(),
  ...filesIn('data/cse169'),
  ...filesIn('data/synthetic'),
  ...filesIn('data/axis-skel'),
];
export const ALL_FILES = [...GOOD_FILES, ...filesIn('data/malformed'), ...filesIn('data/axis-skel/malformed')];

export function fileBytes(path: string): Uint8Array {
  return OWN_FILES.get(path) ?? sharedBytes(path);
}
