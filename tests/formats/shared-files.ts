/** The reference files of all formats that are read and written. */
import { readdirSync } from 'node:fs';
import { formatKindOf, isSaved } from '../../src/files/kinds.ts';
import { hasShared, sharedPath } from '../helpers/shared.ts';

function filesIn(folder: string): string[] {
  if (!hasShared) return [];
  return readdirSync(sharedPath(folder))
    .filter((name) => {
      const kind = formatKindOf(name);
      return kind !== undefined && isSaved(kind);
    })
    .map((name) => `${folder}/${name}`);
}

export const GOOD_FILES = [...filesIn('data/cse169'), ...filesIn('data/synthetic'), ...filesIn('data/axis-skel')];
export const ALL_FILES = [...GOOD_FILES, ...filesIn('data/malformed'), ...filesIn('data/axis-skel/malformed')];
