/** Which takes are meant: by arguments, by `--files-from`, and by `--only`. */
import { resolve } from 'node:path';
import type { ListedTake } from '../../review/list.ts';
import { matchPaths } from '../../review/match-paths.ts';
import type { CommandIo } from '../io.ts';
import type { OptionValues } from '../options/option.ts';
import { fileText } from '../read-file.ts';
import { reasonOf } from '../reason.ts';
import { takeListOf } from '../take-list.ts';
import { UsageError } from '../usage-error.ts';
import { zipOf } from '../zips.ts';
import type { SHARING } from './switches.ts';
import { type TakeInput, type TakeInputs, takeInputs } from './take-inputs.ts';

/** @param given files and folders, as arguments @throws UsageError if there are none */
export async function inputsOf(
  given: readonly string[],
  { only, 'files-from': from }: OptionValues<typeof SHARING>,
  io: CommandIo,
): Promise<TakeInputs> {
  const list = only === undefined ? undefined : takeListOf(only, 'only', io);
  const wanted = list?.filter(isWanted);
  if (wanted?.length === 0) throw new UsageError(`--only: every take in ${only} has the verdict bad.`);
  const named = await pathsOf(given, from, io);
  const listed = wanted && new Set(wanted.map(({ path }) => zipOf(path, io.folder)));
  const paths = named.length === 0 && listed ? [...listed] : named;
  if (paths.length === 0) throw new UsageError('Give files or folders with takes, --files-from or --only.');
  const { inputs, parts } = takeInputs(paths, io.folder);
  if (inputs.length === 0) throw new UsageError(`There are no takes in ${paths.join(' ')}.`);
  return { inputs: list ? listedIn(inputs, list, only ?? '', io) : inputs, parts };
}

function isWanted({ verdict }: ListedTake): boolean {
  return verdict !== 'bad';
}

/** Those of the list that are not bad; says which of the list no file is. */
function listedIn(inputs: readonly TakeInput[], list: readonly ListedTake[], name: string, io: CommandIo) {
  const { found, missing } = matchPaths(
    list,
    inputs.map(({ path }) => path),
  );
  const kept = inputs.filter(({ path }) => {
    const take = found.get(path);
    return take !== undefined && isWanted(take);
  });
  const absent = missing.filter(isWanted);
  if (kept.length === 0) throw new UsageError(`--only: none of the takes in ${name} is among these files.`);
  if (absent.length > 0) {
    const some = absent.length === 1 ? '' : ` and ${absent.length - 1} more`;
    io.err(
      `marrow: ${name} lists ${absent[0].path}${some}, which ${absent.length === 1 ? 'is' : 'are'} not among the files.\n`,
    );
  }
  return kept;
}

/** The paths given as arguments and by `--files-from`: lines of a file, or of the standard input for `-`. */
async function pathsOf(given: readonly string[], from: string | undefined, io: CommandIo): Promise<readonly string[]> {
  if (from === undefined) return given;
  const listed = from === '-' ? await io.input?.() : textOf(resolve(io.folder, from), from);
  // `find -print0` separates names by zeros, since they may contain line ends.
  const names = (listed ?? '').split(listed?.includes('\0') ? '\0' : /\r?\n/).filter((name) => name !== '');
  if (names.length === 0) throw new UsageError(`--files-from ${from}: expected one path per line, found none.`);
  return [...given, ...names];
}

function textOf(path: string, name: string): string {
  try {
    return fileText(path);
  } catch (error) {
    throw new UsageError(`--files-from: ${name} could not be read: ${reasonOf(error)}.`);
  }
}
