/** Adding a finished character to an opening, or saying which of its files don't fit. */

import { withSourcePairs } from '../../edit/follow/code.ts';
import { sameJoints } from '../../edit/pose/same-joints.ts';
import type { Character } from '../../model/document.ts';
import { byPath, type ParsedFile } from '../../model/files.ts';
import { checkParts, withTextures } from './assemble.ts';
import { partOpening } from './contents.ts';
import type { Opening } from './opening.ts';

/**
 * Adds the finished character, unless a part does not fit.
 *
 * @param before the one that it replaces; undefined for a new one
 * @returns the files that don't fit, without which it may be tried again; empty if it was added, or can't be
 */
export function settle(
  opening: Opening,
  before: Character | undefined,
  after: Character,
  files: readonly ParsedFile[],
): readonly ParsedFile[] {
  const { characters, called } = opening;
  const dressed = withTextures(after, opening.textures);
  const found = checkParts(before, dressed, byPath);
  const named = new Map(dressed.sources.map((source) => [source.path, called(source)]));
  const errors = new Set(found.filter(({ severity }) => severity === 'error').map(({ file }) => file));
  const misfits = files.filter((file) => partOpening(file) && errors.has(file.source.path));
  const isWithout = misfits.length > 0 && misfits.length < files.length;
  const problems = isWithout ? found.filter(({ file }) => misfits.some(({ source }) => source.path === file)) : found;
  opening.diagnostics.push(
    ...problems.map((problem) => ({ ...problem, file: named.get(problem.file) ?? problem.file })),
  );
  if (isWithout) return misfits;
  const [error] = errors;
  if (error !== undefined) {
    const why = `It belongs with ${named.get(error) ?? error}, which does not fit.`;
    for (const { source } of files) {
      if (source.path !== error) opening.tell('info', 'held-back', `Not opened. ${why}`, source);
    }
    return [];
  }
  if (before) characters.replace(dressed);
  else characters.add(dressed);
  if (before?.skeleton && dressed.skeleton && before.skeleton !== dressed.skeleton) {
    const to = sameJoints(before.skeleton, dressed.skeleton);
    characters.replaceAll(withSourcePairs(characters.all, dressed.id, before.skeleton, to));
  }
  opening.opened.add(dressed.id);
  for (const file of files) opening.used.add(file);
  return [];
}
