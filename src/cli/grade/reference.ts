/** The teacher's files: what is right. */

import { isBesideTakes } from '../../files/kinds.ts';
import { outputOf, savedFileOf } from '../../files/save/output.ts';
import type { Beside } from '../../import/imported.ts';
import type { Diagnostic } from '../../model/diagnostic.ts';
import { type Character, shownTake } from '../../model/document.ts';
import type { ParsedFile } from '../../model/files.ts';
import { joinedCharacters } from '../../teaching/dump/joined-characters.ts';
import { loadInside, openLoaded } from '../load.ts';
import { report } from '../report.ts';
import { UsageError } from '../usage-error.ts';
import { type RightDump, rightDumps } from './right-dumps.ts';

export interface Reference {
  readonly characters: readonly Character[];
  /** For each motion capture file with several roots, all of them as one. */
  readonly joined: readonly Character[];
  /** With paths relative to the reference folder. */
  readonly files: readonly ParsedFile[];
  readonly dumps: readonly RightDump[];
  /** Skeletons that motions without one of their own are read with. */
  readonly skeletons: readonly Beside[];
}

/** Broken files; all are told in full behind them. */
const MAX_NAMED = 10;

/**
 * @param folder of the reference, or a zip, absolute
 * @param path as given, for messages
 * @param tolerance of its dumps
 * @throws UsageError if a file has errors, or if there is nothing to judge by
 */
export async function loadReference(
  folder: string,
  path: string,
  tolerance: number,
  err: (text: string) => void,
): Promise<Reference> {
  const loaded = await loadInside(folder);
  const { document, diagnostics } = openLoaded(loaded);
  const told = (found: readonly Diagnostic[]) =>
    report(
      found.map((diagnostic) => ({ ...diagnostic, file: `${path}/${diagnostic.file}` })),
      { err },
    );
  const errors = diagnostics.filter(({ severity }) => severity === 'error');
  if (errors.length > 0) {
    const broken = [...new Set(errors.map(({ file }) => `${path}/${file}`))];
    const more = broken.length - MAX_NAMED;
    err(`Broken in ${path}: ${broken.slice(0, MAX_NAMED).join(', ')}${more > 0 ? ` and ${more} more` : ''}.\n`);
    told(errors);
    const files = broken.length === 1 ? '1 file' : `${broken.length} files`;
    throw new UsageError(
      `The reference ${path} has errors in ${files} and can't be used for grading. Correct or remove them.`,
    );
  }
  const { characters } = document;
  const contradicting: Diagnostic[] = [];
  const joined = joinedCharacters(characters);
  const dumps = rightDumps(loaded.files, [...characters, ...joined], tolerance, contradicting);
  told(contradicting);
  if (characters.length === 0 && dumps.length === 0) {
    throw new UsageError(`The reference ${path} has no skeleton, skin, animation or dump to grade against.`);
  }
  return { characters, joined, files: loaded.files, dumps, skeletons: skeletonsIn(loaded.files) };
}

function skeletonsIn(files: readonly ParsedFile[]): readonly Beside[] {
  return files.flatMap((file): readonly Beside[] => {
    const { source } = file;
    if (!isBesideTakes(source.name)) return [];
    const { text } = savedFileOf(outputOf({ name: source.name, content: () => file }));
    return [{ source, bytes: new TextEncoder().encode(text) }];
  });
}

/** Parts of a take at which it is compared if no times are given: within, and before and after it. */
const SHARES = [-0.62, 0, 0.13, 0.5, 0.87, 1, 1.73];

/** Undefined is the file pose. @param asked on the command line */
export function timesFor(character: Character, asked: readonly number[] | undefined): readonly (number | undefined)[] {
  const take = shownTake(character);
  if (!take) return [undefined];
  if (asked) return asked;
  const [start, end] = take.range;
  const length = end > start ? end - start : 1;
  // Samples have no extrapolation to be right about.
  const shares = take.samples ? SHARES.filter((share) => share >= 0 && share <= 1) : SHARES;
  return shares.map((share) => start + share * length);
}
