/** The teacher's files: what is right. */
import { hasErrors } from '../../model/diagnostic.ts';
import { type Character, shownClip } from '../../model/document.ts';
import type { ParsedFile } from '../../model/files.ts';
import { UsageError } from '../arguments.ts';
import { loadFiles, openLoaded } from '../load.ts';
import { report } from '../report.ts';

export interface Reference {
  readonly characters: readonly Character[];
  /** With paths relative to the reference folder. */
  readonly files: readonly ParsedFile[];
}

/**
 * @param folder of the reference, absolute
 * @param path as given, for messages
 * @throws UsageError if a file has errors, or if there is no character
 */
export function loadReference(folder: string, path: string, err: (text: string) => void): Reference {
  const loaded = loadFiles(['.'], folder);
  const { document, diagnostics } = openLoaded(loaded);
  const errors = diagnostics.filter(({ severity }) => severity === 'error');
  report(
    errors.map((diagnostic) => ({ ...diagnostic, file: `${path}/${diagnostic.file}` })),
    { err },
  );
  if (hasErrors(diagnostics)) throw new UsageError(`The reference ${path} has errors; nothing can be judged by it.`);
  if (document.characters.length === 0) {
    throw new UsageError(`The reference ${path} has no skeleton, skin or animation to judge by.`);
  }
  return { characters: document.characters, files: loaded.files };
}

/** Parts of a take at which it is compared if no times are given: within, and before and after it. */
const SHARES = [-0.62, 0, 0.13, 0.5, 0.87, 1, 1.73];

/** Undefined is the file pose. @param asked on the command line */
export function timesFor(character: Character, asked: readonly number[] | undefined): readonly (number | undefined)[] {
  const clip = shownClip(character);
  if (!clip) return [undefined];
  if (asked) return asked;
  const [start, end] = clip.range;
  const length = end > start ? end - start : 1;
  // Samples have no extrapolation to be right about.
  const shares = clip.samples ? SHARES.filter((share) => share >= 0 && share <= 1) : SHARES;
  return shares.map((share) => start + share * length);
}
