/** Which files are opened together, decided by their names and by rigs before any other is read. */

import { openingOf } from '../files/kinds.ts';
import { type FileGroup, groupFiles, type ReadFile } from '../files/open/grouping.ts';
import { formatOf } from '../files/readers.ts';
import { baseName } from '../model/files.ts';
import { loadGiven } from './load.ts';
import type { GivenPath } from './paths.ts';

/** The skeletons among the files with what belongs to each, as opening would decide it. */
export function groupsIn(files: readonly GivenPath[]): readonly FileGroup[] {
  const rigs = loadGiven(files.filter(({ path }) => formatOf(path)?.kind === 'rig')).files;
  const read = new Map(rigs.map((rig) => [rig.source.path, rig]));
  const given = files.flatMap(({ path }): ReadFile[] => {
    const kind = formatOf(path)?.kind;
    const rig = read.get(path);
    return rig ? [rig] : kind ? [{ kind, source: { name: baseName(path), path, bytes: 0 }, broken: true }] : [];
  });
  return groupFiles(given, ({ path }) => path).groups;
}

/**
 * Files with takes and characters in lists to be opened one after another, so that memory is bounded by the largest.
 * Those that are complete, as motion capture is, come by themselves; skeletons and parts of others together.
 * @param named from `namedPaths`
 */
export function openedTogether(
  files: readonly GivenPath[],
  named: ReadonlySet<string>,
): readonly (readonly GivenPath[])[] {
  const tables = files.filter((file) => isNamedTable(file, named));
  const opened = files.filter(({ path }) => {
    const format = formatOf(path);
    const as = format && openingOf(format.kind).as;
    // Folders also hold readmes and pictures, which are left out.
    return as !== undefined && as !== 'texture' && as !== 'dump';
  });
  const groups = groupsIn(opened);
  const withParts = new Set(groups.flatMap((group) => (group.parts.length > 0 ? [group.skeleton?.source.path] : [])));
  const isAlone = ({ path }: GivenPath) => isWhole(path) && !withParts.has(path);
  // A skeleton with its takes, which come with it: those of one at a time.
  const byPath = new Map(opened.map((file) => [file.path, file]));
  const sessions = groups.flatMap(({ skeleton, parts }) =>
    skeleton && parts.length > 0 && parts.every((part) => isWhole(part.source.path))
      ? [[skeleton, ...parts].flatMap(({ source }) => byPath.get(source.path) ?? [])]
      : [],
  );
  const inSession = new Set(sessions.flat());
  const others = opened.filter((file) => !isAlone(file) && !inSession.has(file));
  const alone = opened.filter((file) => isAlone(file) && !inSession.has(file));
  return [...[...alone, ...tables].map((file) => [file]), ...sessions, ...(others.length > 0 ? [others] : [])];
}

/** Whether a file may have points in its rows: one that was named is a take, then; in folders most are something else. */
export function isNamedTable({ path, absolute }: GivenPath, named: ReadonlySet<string>): boolean {
  return named.has(absolute) && formatOf(path)?.format === 'table';
}

/** Whether files of that name take no parts, as a rule, and are none: a take that comes with its skeleton is whole. */
export function isWhole(path: string): boolean {
  const format = formatOf(path);
  const opening = format && openingOf(format.kind);
  if (opening?.as === 'part') return opening.skeletonFile !== undefined;
  return opening?.as === 'characters' && !opening.takesParts;
}
