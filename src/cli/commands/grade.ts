/** `marrow grade`: a class's submissions against the teacher's files. */
import { resolve } from 'node:path';
import { DEFAULT_TOLERANCE } from '../../lesson/errors.ts';
import { type Diagnostic, withoutPlace } from '../../model/diagnostic.ts';
import { isZip } from '../../project/zip-content.ts';
import { type Arguments, numberOf, numbersOf, parseArguments, UsageError } from '../arguments.ts';
import { countsText, type Grade } from '../grade/grade.ts';
import { asHtml } from '../grade/html.ts';
import { needsOf } from '../grade/needs.ts';
import { loadReference } from '../grade/reference.ts';
import { type ClassFolder, classIn } from '../grade/submissions.ts';
import { asCsv, asTable } from '../grade/table.ts';
import { judgeAll } from '../grade/threads.ts';
import type { CliCommand } from '../io.ts';
import { isFile, isFolder } from '../paths.ts';
import { printJson, report } from '../report.ts';

export const grade: CliCommand = {
  name: 'grade',
  usage: 'CLASS --reference REF [--times T,T,…] [--tolerance X] [--needs PART,…] [--csv | --json | --html]',
  summary: 'each folder and zip of CLASS compared with the files and characters of REF: a line each, or a report',
  details: `a submission is a folder or a zip in CLASS, with any folders and zips in it:
  files with the names of those in REF (.skel, .skin, .morph, .anim, .bvh) are compared by what they evaluate to, and
    take the place of REF's own; where there is none, REF's own stays
  texts with numbers of joints, vertices or channels are compared with the file of the same name in REF, or else with
    the character in REF that they fit; they state their time (world@1.3.txt, "time 1.3"), or are of --times
  programs, pictures and notes are left alone

verdicts
  right        everything agrees
  wrong        something that was compared differs
  incomplete   what was compared agrees, but a file or numbers could not be read, or are missing
  not judged   nothing could be compared

options
  --reference REF        the folder or zip with what is right: files, and numbers in files of the names that are expected
  --times T,T,…          seconds at which joints, vertices and channels are compared; default: seven over the take
  --tolerance X          how far numbers may be off: lengths as a part of the character's size; default ${DEFAULT_TOLERANCE}
  --needs PART,…         what each submission must have: world, local, positions, vertices, normals, channels (numbers
                         of that kind), skel, skin, morph, anim, bvh (a file of that kind), or names such as curves.txt
  --csv, --json, --html  as a spreadsheet, as data, or as a report with a page for each submission

examples
  marrow grade class --reference solution --times 0.5,1.3 --html > report.html
  marrow grade class --reference solution --times 1.3 --needs world@1.3.txt,channels --csv > grades.csv
`,
  exits: {
    0: 'all submissions were judged',
    1: 'a submission could not be judged, or only in part',
    2: 'wrong usage, or REF has errors',
  },
  async run(args, io) {
    const given = parseArguments(args, {
      reference: 'value',
      times: 'value',
      tolerance: 'value',
      needs: 'value',
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
    const needsText = given.value('needs');
    const needs = needsText === undefined ? [] : needsOf(needsText);
    const referenceFolder = resolve(io.folder, referencePath);
    if (!isFolder(referenceFolder) && !(isZip(referencePath) && isFile(referenceFolder))) {
      throw new UsageError(`There is no folder or zip "${referencePath}" in ${io.folder}.`);
    }
    const { submissions, loose } = submissionsIn(folder, io.folder, referenceFolder);
    const reference = loadReference(referenceFolder, referencePath, tolerance, io.err);
    const skipped = loose.map((name) => `${folder.replace(/[/\\]+$/, '')}/${name}`);
    report(skipped.map(looseFile), io);
    const options = { folder: io.folder, times, tolerance, needs };
    const task = { submissions, reference, referenceFolder, options };
    const grades = await judgeAll(task, io.program, (done, path) =>
      io.progress?.(`${done} of ${submissions.length}: ${path}`),
    );
    io.progress?.('');
    if (given.flag('json')) await printJson({ ...(times && { times }), tolerance, submissions: grades, skipped }, io);
    else if (given.flag('csv')) await io.out(asCsv(grades));
    else if (given.flag('html')) {
      const facts = { folder, reference: referencePath, tolerance, skipped, date: new Date() };
      await io.out(asHtml(grades, facts));
    } else await io.out(`${asTable(grades)}${summaryOf(grades)}`);
    return grades.every(({ verdict }) => verdict === 'right' || verdict === 'wrong') ? 0 : 1;
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
  if (isZip(path) && isFile(absolute)) {
    throw new UsageError(
      `"${path}" is one zip. Unpack it: each submission is a folder or a zip in the folder of a class.`,
    );
  }
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
  return `\n${grades.length === 1 ? '1 submission' : `${grades.length} submissions`}: ${countsText(grades)}.\n`;
}
