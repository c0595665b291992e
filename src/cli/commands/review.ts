/**
 * `marrow review`: takes as a list, with what looks wrong in them; the same list as the page's *Review* tab saves.
 * Motion capture is read one file at a time, so that memory is bounded by the largest take.
 */
import { resolve } from 'node:path';
import { refusal } from '../../files/save/conversion.ts';
import type { Diagnostic } from '../../model/diagnostic.ts';
import { hasErrors } from '../../model/diagnostic.ts';
import { NO_REVIEW } from '../../model/takes/review.ts';
import { type ListedTake, listedTake, type TakeFacts } from '../../review/list.ts';
import { matchPaths } from '../../review/match-paths.ts';
import { takeFacts } from '../../review/take-facts.ts';
import { listAsCsv, listAsJson } from '../../review/write-list.ts';
import type { CommandIo } from '../io.ts';
import { findFiles, loadFound, openLoaded } from '../load.ts';
import { ANY_FILE, files } from '../options/inputs.ts';
import { type Kind, text } from '../options/kinds.ts';
import { flag, option } from '../options/option.ts';
import { shellCommand } from '../options/shell-command.ts';
import { namedPaths } from '../paths.ts';
import { report } from '../report.ts';
import { takeListOf } from '../take-list.ts';
import { openedTogether } from '../together.ts';
import { writeOutput } from '../write-output.ts';

/** The name of a list to be written. */
const LIST_NAME: Kind<string> = {
  placeholder: 'LIST.csv|LIST.json',
  what: 'a name that ends in .csv or .json',
  read: (name, misfit) => (/\.(csv|json)$/i.test(name) ? name : misfit()),
};

export const review = shellCommand({
  name: 'review',
  summary: 'Lists takes and what looks wrong in them, as CSV.',
  inputs: files('FILE…', { FILE: ANY_FILE }),
  options: {
    list: option(text('LIST', 'a file'), 'Keeps verdicts, stars, tags and notes from this list, CSV or JSON.'),
    out: option(LIST_NAME, 'Writes the list to this file instead of printing it.'),
    json: flag('Writes the list as JSON, whatever the file is called.'),
  },
  examples: ['marrow review takes/ --out list.csv'],
  exits: {
    0: 'all files were read',
    1: 'a file has errors or is missing',
    2: 'wrong usage',
    3: 'the list could not be written',
  },
  async run({ inputs, options: { list, out, json } }, io) {
    const before = list === undefined ? [] : takeListOf(list, 'list', io);
    const { takes, diagnostics } = await takesIn(inputs, io);
    const known = matchPaths(
      before,
      takes.map(({ path }) => path),
    ).found;
    const listed = takes.map((take): ListedTake => {
      const { verdict, stars, tags, notes } = known.get(take.path) ?? NO_REVIEW;
      return { ...take, verdict, stars, tags, notes };
    });
    const asJson = json || out?.toLowerCase().endsWith('.json');
    const content = asJson ? listAsJson(listed) : listAsCsv(listed);
    if (out === undefined) await io.out(content);
    else {
      const written = writeOutput(resolve(io.folder, out), [content]);
      if ('failure' in written) {
        io.err(`marrow: ${out} could not be written: ${written.failure}.\n`);
        return 3;
      }
    }
    return hasErrors(diagnostics) ? 1 : 0;
  },
});

async function takesIn(args: readonly string[], io: CommandIo) {
  const { files, problems } = findFiles(args, io.folder);
  const diagnostics: Diagnostic[] = [];
  const tell = (told: readonly Diagnostic[]) => {
    report(told, io);
    diagnostics.push(...told);
  };
  if (problems.length > 0) tell(problems);
  const takes: ListedTake[] = [];
  for (const group of openedTogether(files, namedPaths(args, io.folder))) {
    const opened = openLoaded(await loadFound(group, io.folder, files));
    tell(opened.diagnostics);
    takes.push(...takesOf(opened.document.characters));
  }
  if (takes.length === 0 && problems.length === 0) {
    tell([refusal('nothing-to-review', 'There are no takes here.', args.join(' '))]);
  }
  return { takes, diagnostics };
}

/** A row for each file with takes: characters and takes of one file are one row, as the command takes whole files. */
function takesOf(characters: ReturnType<typeof openLoaded>['document']['characters']): readonly ListedTake[] {
  const rows = new Map<string, TakeFacts>();
  for (const { skeleton, takes, parts, space, sources } of characters) {
    if (!skeleton) continue;
    takes.forEach((take, c) => {
      const path = parts?.takes[c]?.file?.source.path ?? sources[0]?.path;
      if (path === undefined) return;
      const facts = takeFacts(skeleton, take, space);
      const known = rows.get(path);
      rows.set(path, known ? { ...known, flags: [...known.flags, ...facts.flags] } : facts);
    });
  }
  return [...rows].map(([path, facts]) => listedTake(path, NO_REVIEW, facts));
}
