/** Lists of takes named on the command line. */
import { resolve } from 'node:path';
import { hasErrors } from '../model/diagnostic.ts';
import type { ListedTake } from '../review/list.ts';
import { readList } from '../review/read-list.ts';
import type { CommandIo } from './io.ts';
import { fileText } from './read-file.ts';
import { reasonOf } from './reason.ts';
import { report } from './report.ts';
import { UsageError } from './usage-error.ts';

/**
 * @param option its name, for messages
 * @throws UsageError if the list can't be read
 */
export function takeListOf(path: string, option: string, io: CommandIo): readonly ListedTake[] {
  let text: string;
  try {
    text = fileText(resolve(io.folder, path));
  } catch (error) {
    throw new UsageError(`--${option}: ${path} could not be read: ${reasonOf(error)}.`);
  }
  const { takes, diagnostics } = readList(text, path);
  report(diagnostics, io);
  if (hasErrors(diagnostics)) throw new UsageError(`--${option} takes a list of takes; ${path} has errors.`);
  return takes;
}
