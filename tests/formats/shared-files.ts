/** The reference files that these formats read. */
import { readdirSync } from 'node:fs';
import { formatOf } from '../../src/project/codecs.ts';
import { hasShared, sharedPath } from '../helpers/shared.ts';

function filesIn(folder: string): string[] {
  if (!hasShared) return [];
  return readdirSync(sharedPath(folder))
    .filter((name) => formatOf(name) !== undefined)
    .map((name) => `${folder}/${name}`);
}

export const GOOD_FILES = [...filesIn('data/cse169'), ...filesIn('data/synthetic'), ...filesIn('data/axis-skel')];
export const ALL_FILES = [...GOOD_FILES, ...filesIn('data/malformed'), ...filesIn('data/axis-skel/malformed')];
