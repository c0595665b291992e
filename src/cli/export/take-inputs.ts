/**
 * The takes among files, folders and zips: motion capture and other files with whole characters, each by itself, and
 * animations with the skeleton that they belong to.
 *
 * A list is the same wherever it is made of the same arguments: sorted, with the names of the outputs decided for all,
 * so that several processes can share it.
 */
import { dirname, extname, relative, resolve, sep } from 'node:path';
import { isBesideTakes, isBuffer, openingOf } from '../../files/kinds.ts';
import { formatOf } from '../../files/readers.ts';
import { findGiven, type GivenPath, isFolder, namedPaths } from '../paths.ts';
import { groupsIn, isNamedTable, isWhole } from '../together.ts';
import { UsageError } from '../usage-error.ts';
import { unpackedPath, withZipsUnpacked } from '../zips.ts';
import { besidePlain } from './beside-plain.ts';

/** A file with a take, or with several. */
export interface TakeInput extends GivenPath {
  /** Skeleton of an animation. */
  readonly skeleton?: GivenPath;
  /** Of one that can't be read: a sentence. */
  readonly why?: string;
  /** Its output below the output folder, without the ending. */
  readonly stem: string;
}

export interface TakeInputs {
  /** Sorted by path. */
  readonly inputs: readonly TakeInput[];
  /** Files of archives that others may name, such as the buffers of a `.gltf`. */
  readonly parts: readonly GivenPath[];
}

/**
 * @param args files, folders and zips, relative to `folder`; those that are missing, and zips that can't be unpacked, are
 *   inputs too, which then fail
 * @throws UsageError if two would have one output
 */
export function takeInputs(args: readonly string[], folder: string): TakeInputs {
  const { files: given, missing } = findGiven(args, folder);
  const { files: found, problems } = withZipsUnpacked(given);
  const files = found.map((file) => (file.bytes ? { ...file, bytes: sharedAmongThreads(file.bytes) } : file));
  const named = namedPaths(args, folder);
  const parts = besidePlain(files);
  const takes = files.filter((file) => !parts.has(file));
  const whole = takes.filter((file) => isWhole(file.path) || isNamedTable(file, named));
  const animations = animationsIn(
    takes.filter(({ path }) => {
      const format = formatOf(path);
      const as = format && openingOf(format.kind).as;
      return as === 'characters' || as === 'rig' || format?.kind === 'anim';
    }),
  );
  const absent = missing.map(({ path, code, why }) => ({
    ...{ path, absolute: resolve(folder, path) },
    // The manifest is the same wherever it is made.
    why: code === 'file-missing' ? 'There is no file of this name.' : why,
  }));
  const damaged = problems
    .filter(({ severity }) => severity === 'error')
    .map(({ file: path, message: why }) => ({ path, absolute: resolve(folder, path), why }));
  const all = [...whole, ...animations, ...damaged, ...absent].sort((a, b) => compareBytes(a.path, b.path));
  const folders = args.map((arg) => resolve(folder, arg)).filter(isFolder);
  const others = files.filter(({ path, bytes }) => bytes && (isBuffer(path) || isPartOfOthers(path)));
  return { inputs: withStems(all, folders, folder), parts: others };
}

/** Whether other files are read with files of that name: textures, and skeletons of takes. */
function isPartOfOthers(path: string): boolean {
  return formatOf(path)?.kind === 'texture' || isBesideTakes(path);
}

/** The same bytes in memory that threads share instead of each getting a copy. */
function sharedAmongThreads(bytes: Uint8Array): Uint8Array {
  const shared = new Uint8Array(new SharedArrayBuffer(bytes.length));
  shared.set(bytes);
  return shared;
}

/** By their bytes in UTF-8, as `LC_ALL=C sort` does. */
export function compareBytes(a: string, b: string): number {
  return Buffer.compare(Buffer.from(a), Buffer.from(b));
}

/** Animations with their skeletons, told by rigs, folders and names as when they are opened. */
function animationsIn(files: readonly GivenPath[]): Omit<TakeInput, 'stem'>[] {
  const byPath = new Map(files.map((file) => [file.path, file]));
  const skeletons = new Map(
    groupsIn(files).flatMap(({ skeleton, parts }) => parts.map((part) => [part.source.path, skeleton?.source.path])),
  );
  return files.flatMap((file) => {
    if (formatOf(file.path)?.kind !== 'anim') return [];
    const skeleton = byPath.get(skeletons.get(file.path) ?? '');
    return [{ ...file, ...(skeleton && { skeleton }) }];
  });
}

/**
 * Names the outputs after the inputs: the path below the folder that was named; of a file that was named itself, below
 * the caller's, or, outside it, below the folder that all such files share. A zip is a folder with its name. Where two
 * would be the same, all are named by their paths below the folder that all inputs share: `day1/walk.npz`,
 * `day2/walk.npz`. Where two differ only in their endings, these are kept: `walk.bvh.npz`, `walk.anim.npz`.
 */
function withStems(
  inputs: readonly Omit<TakeInput, 'stem'>[],
  folders: readonly string[],
  callers: string,
): readonly TakeInput[] {
  const isIn = (folder: string, path: string) => path.startsWith(folder.endsWith(sep) ? folder : folder + sep);
  const homes = [...folders, callers];
  const unpacked = inputs.map(unpackedPath);
  // A zip next to what was unpacked from it keeps its ending.
  const paths = new Set(unpacked).size === inputs.length ? unpacked : inputs.map(({ absolute }) => absolute);
  const strays = paths.filter((path) => !homes.some((folder) => isIn(folder, path)));
  if (strays.length > 0) homes.push(sharedFolder(strays));
  const belowHomes = paths.map((path) => pathBelow(homes.find((folder) => isIn(folder, path)) ?? dirname(path), path));
  const areDistinct = new Set(belowHomes).size === paths.length;
  const shared = areDistinct ? '' : sharedFolder(paths);
  const below = areDistinct ? belowHomes : paths.map((path) => pathBelow(shared, path));
  const short = below.map((path) => path.slice(0, path.length - extname(path).length));
  const counts = new Map<string, number>();
  for (const stem of short) counts.set(stem, (counts.get(stem) ?? 0) + 1);
  // `walk.1` is also what the first of several takes of `walk` would be called.
  const isNumbered = (stem: string) => counts.has(stem.replace(/\.\d+$/, '')) && /\.\d+$/.test(stem);
  const seen = new Map<string, string>();
  return inputs.map((input, i) => {
    const stem = (counts.get(short[i]) ?? 0) > 1 || isNumbered(short[i]) ? below[i] : short[i];
    const other = seen.get(stem);
    if (other !== undefined) {
      throw new UsageError(
        `${other} and ${input.path} would have the same output, ${stem}. ` +
          'Name the folder above both, or export them to different folders.',
      );
    }
    seen.set(stem, input.path);
    return { ...input, stem };
  });
}

function pathBelow(folder: string, path: string): string {
  return relative(folder, path).split(sep).join('/');
}

/** The deepest folder that all these files are below. */
function sharedFolder([first, ...others]: readonly string[]): string {
  let folder = dirname(first);
  while (dirname(folder) !== folder && !others.every((path) => path.startsWith(folder + sep))) folder = dirname(folder);
  return folder;
}
