/** `marrow grade`: a class's submissions against the teacher's files. */
import { resolve } from 'node:path';
import { DEFAULT_TOLERANCE } from '../../lesson/errors.ts';
import { type Diagnostic, withoutPlace } from '../../model/diagnostic.ts';
import { type Arguments, numberOf, numbersOf, parseArguments, UsageError } from '../arguments.ts';
import type { Grade } from '../grade/grade.ts';
import { asHtml } from '../grade/html.ts';
import { loadReference } from '../grade/reference.ts';
import { type ClassFolder, classIn } from '../grade/submissions.ts';
import { asCsv, asTable } from '../grade/table.ts';
import { judgeAll } from '../grade/threads.ts';
import type { CliCommand } from '../io.ts';
import { isFolder } from '../paths.ts';
import { printJson, report } from '../report.ts';

export const grade: CliCommand = {
  name: 'grade',
  usage: 'CLASS --reference REF [--times T,T,…] [--tolerance X] [--csv | --json | --html]',
  summary: 'each folder and zip of CLASS compared with the files and characters of REF: a line each, or a report',
  exits: {
    0: 'all submissions were judged',
    1: 'a submission could not be judged',
    2: 'wrong usage, or REF has errors',
  },
  async run(args, io) {
    const given = parseArguments(args, {
      reference: 'value',
      times: 'value',
      tolerance: 'value',
      csv: 'flag',
      json: 'flag',
      html: 'flag',
    });
    const [folder, ...others] = given.files;
    if (folder === undefined || others.length > 0) throw new UsageError('grade takes one folder of submissions.');
    const referencePath = given.value('reference');
    if (referencePath === undefined) throw new UsageError('--reference is missing: the folder with the right files.');
    if (['csv', 'json', 'html'].filter((name) => given.flag(name)).length > 1) {
      throw new UsageError('Give one of --csv, --json and --html.');
    }
    const { times, tolerance } = readNumbers(given);
    const referenceFolder = resolve(io.folder, referencePath);
    if (!isFolder(referenceFolder)) throw new UsageError(`There is no folder "${referencePath}" in ${io.folder}.`);
    const { submissions, loose } = submissionsIn(folder, io.folder, referenceFolder);
    const reference = loadReference(referenceFolder, referencePath, tolerance, io.err);
    const skipped = loose.map((name) => `${folder.replace(/[/\\]+$/, '')}/${name}`);
    report(skipped.map(looseFile), io);
    const options = { folder: io.folder, times, tolerance };
    const task = { submissions, reference, referenceFolder, options };
    const grades = await judgeAll(task, io.program, (done, path) =>
      io.progress?.(`${done} of ${submissions.length}: ${path}`),
    );
    io.progress?.('');
    if (given.flag('json')) await printJson({ ...(times && { times }), tolerance, submissions: grades, skipped }, io);
    else if (given.flag('csv')) await io.out(asCsv(grades));
    else if (given.flag('html')) await io.out(asHtml(grades, { folder, reference: referencePath, tolerance, skipped }));
    else await io.out(`${asTable(grades)}${summaryOf(grades)}`);
    return grades.every(({ verdict }) => verdict !== 'not judged') ? 0 : 1;
  },
};

function readNumbers(given: Arguments) {
  const timesText = given.value('times');
  const times = timesText === undefined ? undefined : numbersOf('times', timesText);
  if (times?.length === 0) throw new UsageError('--times takes at least one number; found none.');
  const toleranceText = given.value('tolerance');
  const tolerance = toleranceText === undefined ? DEFAULT_TOLERANCE : numberOf('tolerance', toleranceText);
  if (!(tolerance > 0)) throw new UsageError(`--tolerance takes a number above 0, not ${tolerance}.`);
  return { times, tolerance };
}

function submissionsIn(path: string, folder: string, referenceFolder: string): ClassFolder {
  const absolute = resolve(folder, path);
  if (!isFolder(absolute)) throw new UsageError(`There is no folder "${path}" in ${folder}.`);
  const found = classIn(absolute, referenceFolder);
  if (found.submissions.length === 0) {
    throw new UsageError(`There are no folders or zips in "${path}"; each submission is expected in one of its own.`);
  }
  return found;
}

function looseFile(path: string): Diagnostic {
  const message = 'Expected a folder or a zip for each submission, found a file.';
  return withoutPlace('warning', 'file-loose', message, path, 'skipped');
}

function summaryOf(grades: readonly Grade[]): string {
  const count = (verdict: Grade['verdict']) => grades.filter((one) => one.verdict === verdict).length;
  return `\n${grades.length} submissions: ${count('right')} right, ${count('wrong')} wrong, ${count('not judged')} not judged.\n`;
}
