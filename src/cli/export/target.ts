/** What exports share besides their options: the skeleton to retarget to, with its map, and the space of a skeleton. */
import { existsSync } from 'node:fs';
import { resolve } from 'node:path';
import { type JointMap, readJointMap } from '../../dataset/joint-map.ts';
import type { RetargetTarget } from '../../dataset/take.ts';
import { CommandError } from '../../edit/command-error.ts';
import type { Character } from '../../model/document.ts';
import { skeletonKey } from '../../model/skeleton/skeleton-key.ts';
import type { Space } from '../../model/space.ts';
import { loadAny, openLoaded } from '../load.ts';
import { isFile } from '../paths.ts';
import { fileText } from '../read-file.ts';
import { reasonOf } from '../reason.ts';
import { describe } from '../report.ts';
import { UsageError } from '../usage-error.ts';

/** As written on the command line. */
export interface TargetFiles {
  /** The files of one character: `.skel`, `.skin` and so on, or a folder or a zip of them. */
  readonly retarget?: readonly string[];
  readonly map?: string;
  readonly space?: string;
}

/** By `skeletonKey`. */
export type Spaces = ReadonlyMap<string, Space>;

export interface Target {
  /** What a take is retargeted to: of several characters of one file the one with its skeleton. @throws CommandError if none has */
  readonly retargetOf?: (take: Character) => RetargetTarget;
  readonly spaces: Spaces;
}

/** @throws UsageError if a file can't be read, or is not what it should be; if there are several characters to retarget to */
export async function loadTarget({ retarget, map, space }: TargetFiles, folder: string): Promise<Target> {
  const spaces = new Map<string, Space>();
  for (const { skeleton, space: own } of space === undefined ? [] : await charactersIn([space], folder, '--space')) {
    if (skeleton && own) spaces.set(skeletonKey(skeleton), own);
  }
  if (space !== undefined && spaces.size === 0) {
    throw new UsageError(
      `--space takes a file whose unit is stated or guessed: FBX, glTF or motion capture; found ${space}.`,
    );
  }
  if (retarget === undefined) return { spaces };
  const characters = (await charactersIn(retarget, folder, '--retarget')).map((c) => inSpaceOf(c, spaces));
  const [first] = characters;
  if (!first) throw new UsageError(`--retarget takes a file with a skeleton; ${retarget.join(', ')} has none.`);
  const names = characters.map(({ name }) => name).join(', ');
  const isOne = new Set(characters.map(keyOf)).size === 1;
  // A file may hold several, such as the people of one capture.
  if (!isOne && new Set(characters.map(({ sources }) => sources[0]?.path)).size > 1) {
    throw new UsageError(
      `--retarget takes one character, found ${characters.length} (${names}). Name the files of one of them.`,
    );
  }
  const read = map === undefined ? undefined : readMap(map, folder);
  return {
    retargetOf(take) {
      const character = isOne ? first : characters.find((one) => keyOf(one) === keyOf(take));
      if (character) return { character, ...(read && { map: read }) };
      throw new CommandError(
        `${retarget.join(', ')} holds ${characters.length} characters (${names}), none with the joints of this take: name a file of one character for --retarget.`,
      );
    },
    spaces,
  };
}

function keyOf({ skeleton }: Character): string | undefined {
  return skeleton && skeletonKey(skeleton);
}

/** The character in the space that was given for its skeleton, if one was; else the same object. */
export function inSpaceOf(character: Character, spaces: Spaces): Character {
  const space = character.skeleton && spaces.get(skeletonKey(character.skeleton));
  return space ? { ...character, space } : character;
}

async function charactersIn(paths: readonly string[], folder: string, option: string): Promise<readonly Character[]> {
  const { document, diagnostics } = openLoaded(await loadAny(paths, folder));
  const error = diagnostics.find(({ severity }) => severity === 'error');
  if (error) throw new UsageError(`${option}: ${describe(error)}`);
  return document.characters.filter(({ skeleton }) => skeleton);
}

function readMap(path: string, folder: string): JointMap {
  const absolute = resolve(folder, path);
  if (existsSync(absolute) && !isFile(absolute)) throw new UsageError(`--map takes a file; ${path} is not one.`);
  try {
    return readJointMap(fileText(absolute), path);
  } catch (error) {
    if (error instanceof CommandError) throw new UsageError(`--map: ${error.message}`);
    throw new UsageError(`--map: ${path} could not be read: ${reasonOf(error)}.`);
  }
}
