/** Grades as lines: a table for people, and CSV for spreadsheets. */
import { causesText, errorText, firstWrongText, type Grade, placeOf, wrongPart } from './grade.ts';

const COLUMNS = [
  'submission',
  'verdict',
  'loads',
  'joints',
  'joint error',
  'vertex error',
  'channels right',
  'first wrong',
  'cause',
  'problems',
] as const;

function cellsOf(grade: Grade): readonly string[] {
  const { name, verdict, loads, joints, jointError, vertexError, channels, problems } = grade;
  const wrong = wrongPart(grade);
  return [
    name,
    verdict,
    loads ? 'yes' : 'no',
    joints > 0 ? String(joints) : '',
    errorText(jointError),
    errorText(vertexError),
    channels ? `${channels.right} of ${channels.of}` : '',
    wrong ? firstWrongText(wrong) : '',
    wrong ? causesText(wrong) || 'unknown' : '',
    problems
      .filter(({ severity }) => severity !== 'info')
      .map((problem) => `${placeOf(problem)} ${problem.code}`)
      .join('; '),
  ];
}

export function asTable(grades: readonly Grade[]): string {
  const rows = [COLUMNS, ...grades.map(cellsOf)].map((row) => row.map(plain));
  const widths = COLUMNS.map((_, c) => Math.max(...rows.map((row) => row[c].length)));
  return rows
    .map((row) => row.map((cell, c) => cell.padEnd(widths[c])).join('  '))
    .map((line) => `${line.trimEnd()}\n`)
    .join('');
}

/** RFC 4180. */
export function asCsv(grades: readonly Grade[]): string {
  return [COLUMNS, ...grades.map(cellsOf)].map((row) => `${row.map(quoted).join(',')}\r\n`).join('');
}

/** Names of files are free text: control characters would move the cursor. */
function plain(text: string): string {
  return text.replace(/\p{Cc}/gu, '\ufffd');
}

/** A spreadsheet takes a cell that begins with one of = + - @ for a formula, and a name may do so. */
function quoted(cell: string): string {
  const text = /^[=+\-@\t\r]/.test(cell) ? `'${cell}` : cell;
  return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}
