/** `marrow grade`: a class's submissions against the teacher's files. */
import { resolve } from 'node:path';
import { isZip } from '../../files/zip-content.ts';
import { type Diagnostic, withoutPlace } from '../../model/diagnostic.ts';
import { DEFAULT_TOLERANCE } from '../../teaching/compare/errors.ts';
import { countsText, type Grade } from '../grade/grade.ts';
import { asHtml } from '../grade/html.ts';
import { NEEDS } from '../grade/needs.ts';
import { loadReference } from '../grade/reference.ts';
import { type ClassFolder, classIn } from '../grade/submissions.ts';
import { asCsv, asTable } from '../grade/table.ts';
import { judgeAll } from '../grade/threads.ts';
import { oneFolder } from '../options/inputs.ts';
import { numbers, positive, text } from '../options/kinds.ts';
import { flag, option } from '../options/option.ts';
import { shellCommand } from '../options/shell-command.ts';
import { isFile, isFolder } from '../paths.ts';
import { printJson, report } from '../report.ts';
import { UsageError } from '../usage-error.ts';

export const grade = shellCommand({
  name: 'grade',
  summary: 'Compares each submission in CLASS with the right files; prints a line for each, or a report.',
  inputs: oneFolder('CLASS', 'folder of submissions', 'The folder with all submissions.'),
  options: {
    reference: option(
      text('REF', 'the folder or zip with the right files'),
      'Compares with the files in this folder or zip, and with the numbers in files of the expected names.',
      { isRequired: true },
    ),
    times: option(
      numbers('T,T,…', 1),
      'Compares joints, vertices and channels at these times, in seconds, instead of at seven over the take.',
    ),
    tolerance: option(
      positive('X'),
      "Allows numbers to be off by this much, lengths as a fraction of the character's size.",
      { default: DEFAULT_TOLERANCE },
    ),
    needs: option(NEEDS, `Requires these numbers or files in each submission: ${NEEDS.what}.`),
    csv: flag('Prints a spreadsheet.'),
    json: flag('Prints all results as JSON.'),
    html: flag('Prints a report with a page for each submission.'),
  },
  exclusive: [['csv', 'json', 'html']],
  about: [
    'In CLASS, a submission is a folder or a zip, with any folders and zips in it.',
    {
      heading: 'In a submission',
      terms: {
        files:
          "Named like those in REF (`.skel`, `.skin`, `.morph`, `.anim`, `.bvh`, `.asf`, `.amc`), and compared by what they evaluate to; if one is missing, REF's own is used.",
        texts:
          'With numbers of joints, vertices or channels, compared with the file of the same name in REF or, if none, with the character in REF that they fit. They state their time (`world@1.3.txt`, `time 1.3`), or have that of `--times`.',
        others: 'Programs, pictures and notes are left alone.',
      },
    },
    {
      heading: 'Verdicts',
      terms: {
        right: 'Everything agrees.',
        wrong: 'Something that was compared differs.',
        incomplete: 'What was compared agrees, but a file or numbers could not be read, or are missing.',
        'not judged': 'Nothing could be compared.',
      },
    },
  ],
  examples: [
    'marrow grade class --reference solution --times 0.5,1.3 --html > report.html',
    'marrow grade class --reference solution --times 1.3 --needs world@1.3.txt,channels --csv > grades.csv',
  ],
  exits: {
    0: 'all submissions were judged',
    1: 'a submission could not be judged, or only in part',
    2: 'wrong usage, or REF has errors',
  },
  async run(
    { inputs: folder, options: { reference: referencePath, times, tolerance, needs = [], csv, json, html } },
    io,
  ) {
    const referenceFolder = resolve(io.folder, referencePath);
    if (!isFolder(referenceFolder) && !(isZip(referencePath) && isFile(referenceFolder))) {
      throw new UsageError(`There is no folder or zip "${referencePath}" in ${io.folder}.`);
    }
    const { submissions, loose } = submissionsIn(folder, io.folder, referenceFolder);
    const reference = await loadReference(referenceFolder, referencePath, tolerance, io.err);
    const skipped = loose.map((name) => `${folder.replace(/[/\\]+$/, '')}/${name}`);
    report(skipped.map(looseFile), io);
    const options = { folder: io.folder, times, tolerance, needs };
    const task = { submissions, reference, referenceFolder, options };
    const grades = await judgeAll(task, io.program, (done, path) =>
      io.progress?.(`${done} of ${submissions.length}: ${path}`),
    );
    io.progress?.('');
    if (json) await printJson({ ...(times && { times }), tolerance, submissions: grades, skipped }, io);
    else if (csv) await io.out(asCsv(grades));
    else if (html) {
      const facts = { folder, reference: referencePath, tolerance, skipped, date: new Date() };
      await io.out(asHtml(grades, facts));
    } else await io.out(`${asTable(grades)}${summaryOf(grades)}`);
    return grades.every(({ verdict }) => verdict === 'right' || verdict === 'wrong') ? 0 : 1;
  },
});

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
    throw new UsageError(`There are no folders or zips in "${path}"; put each submission in one of its own.`);
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
