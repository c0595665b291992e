/** Lists of takes named on the command line. */
import { readFileSync } from 'node:fs';
import { resolve } from 'node:path';
import { hasErrors } from '../model/diagnostic.ts';
import type { ListedTake } from '../review/list.ts';
import { readList } from '../review/read-list.ts';
import { UsageError } from './arguments.ts';
import type { CommandIo } from './io.ts';
import { report } from './report.ts';

/**
 * @param option its name, for messages
 * @throws UsageError if the list can't be read
 */
export function takeListOf(path: string, option: string, io: CommandIo): readonly ListedTake[] {
  let text: string;
  try {
    text = readFileSync(resolve(io.folder, path), 'utf8');
  } catch (error) {
    throw new UsageError(`--${option} could not be read: ${error instanceof Error ? error.message : String(error)}.`);
  }
  const { takes, diagnostics } = readList(text, path);
  report(diagnostics, io);
  if (hasErrors(diagnostics)) throw new UsageError(`--${option} takes a list of takes; ${path} has errors.`);
  return takes;
}
