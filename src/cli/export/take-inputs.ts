/**
 * The takes among files and folders: motion capture and other files with whole characters, each by itself, and
 * animations with the skeleton that they belong to.
 *
 * A list is the same wherever it is made of the same arguments: sorted, with the names of the outputs decided for all,
 * so that several processes can share it.
 */
import { dirname, extname, relative, resolve, sep } from 'node:path';
import { openingOf } from '../../project/kinds.ts';
import { formatOf } from '../../project/readers.ts';
import { isZip } from '../../project/zip-content.ts';
import { UsageError } from '../arguments.ts';
import { findGiven, type GivenPath, isFolder } from '../paths.ts';
import { groupsIn, isWhole } from '../together.ts';

/** A file with a take, or with several. */
export interface TakeInput {
  /** Relative to the caller's folder. */
  readonly path: string;
  readonly absolute: string;
  /** Of an animation. */
  readonly skeleton?: Pick<GivenPath, 'path' | 'absolute'>;
  /** Of one that can't be read: a sentence. */
  readonly why?: string;
  /** Its output below the output folder, without the ending. */
  readonly stem: string;
}

/**
 * @param args files and folders, relative to `folder`; those that are missing are inputs too, which then fail
 * @returns sorted by path
 * @throws UsageError if two would have one output
 */
export function takeInputs(args: readonly string[], folder: string): readonly TakeInput[] {
  const { files, missing } = findGiven(args, folder);
  const whole = files.filter(({ path }) => isWhole(path));
  const animations = animationsIn(
    files.filter(({ path }) => {
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
  const zips = files
    .filter(({ path }) => isZip(path))
    .map((file) => ({ ...file, why: 'Takes in zips are not read here. Unpack it, and give its folder.' }));
  const all = [...whole, ...animations, ...zips, ...absent].sort((a, b) => compareBytes(a.path, b.path));
  const folders = args.map((arg) => resolve(folder, arg)).filter(isFolder);
  return withStems(all, folders, folder);
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
    return [{ path: file.path, absolute: file.absolute, ...(skeleton && { skeleton }) }];
  });
}

/**
 * Names the outputs after the inputs: the path below the folder that was named; of a file that was named itself, below
 * the caller's, or, outside it, below the folder that all such files share. Where two would be the same, all are named by
 * their paths below the folder that all inputs share: `day1/walk.npz`, `day2/walk.npz`. Where two differ only in their
 * endings, these are kept: `walk.bvh.npz`, `walk.anim.npz`.
 */
function withStems(
  inputs: readonly Omit<TakeInput, 'stem'>[],
  folders: readonly string[],
  callers: string,
): readonly TakeInput[] {
  const isIn = (folder: string, path: string) => path.startsWith(folder.endsWith(sep) ? folder : folder + sep);
  const homes = [...folders, callers];
  const strays = inputs.map(({ absolute }) => absolute).filter((path) => !homes.some((folder) => isIn(folder, path)));
  if (strays.length > 0) homes.push(sharedFolder(strays));
  const paths = inputs.map(({ absolute }) => absolute);
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
