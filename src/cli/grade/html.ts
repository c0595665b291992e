/**
 * Grades as one HTML file without anything outside it: an overview, and a page per submission that its address leads to
 * (`report.html#3`). Printed, all follow one another.
 */

import { VERSION } from '../../model/version.ts';
import type { FirstWrong } from '../../teaching/compare/compare.ts';
import { errorText as differenceText } from '../compare-text.ts';
import {
  countsText,
  equalCauses,
  errorText,
  firstWrongText,
  type Grade,
  gradedText,
  type PartGrade,
  placeOf,
  wrongPart,
} from './grade.ts';
import type { SideBySide } from './side-by-side.ts';
import { STYLE } from './style.ts';

export interface ReportFacts {
  /** As given. */
  readonly folder: string;
  readonly reference: string;
  readonly tolerance: number;
  /** Paths of files that belong to no submission. */
  readonly skipped: readonly string[];
  /** When it was made. */
  readonly date: Date;
}

export function asHtml(grades: readonly Grade[], { folder, reference, tolerance, skipped, date }: ReportFacts): string {
  const made = new Intl.DateTimeFormat('en-GB', { dateStyle: 'long', timeStyle: 'short' }).format(date);
  return `<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>${escaped(folder)} – Marrow</title>
<style>${STYLE}</style>
<main id="overview">
<header>
<h1>${escaped(folder)}</h1>
<p>${grades.length === 1 ? '1 submission' : `${grades.length} submissions`}: ${countsText(grades, (count) => `<b>${count}</b>`)}. Compared with <code>${escaped(reference)}</code> within ${tolerance}, by Marrow ${VERSION}, <time datetime="${date.toISOString()}">${made}</time>.</p>
<p class="faint">Errors of lengths are parts of the character’s size, the diagonal of its box; angles are in radians, times in seconds. <em>Incomplete</em>: what was compared is right, but something could not be read, or is missing.</p>
${skippedText(skipped)}</header>
<div class="wide"><table>
<thead><tr>${['Submission', 'Verdict', 'Joints', 'Joint error', 'Vertex error', 'Channels right', 'First wrong', 'Cause', 'Problems'].map((title) => `<th scope="col">${title}</th>`).join('')}</tr></thead>
<tbody>
${grades.map(rowOf).join('\n')}
</tbody>
</table></div>
</main>
${grades.map((grade, i) => pageOf(grade, i, grades)).join('\n')}
</html>
`;
}

function skippedText(skipped: readonly string[]): string {
  if (skipped.length === 0) return '';
  const are =
    skipped.length === 1 ? 'is neither a folder nor a zip, and was' : 'are neither folders nor zips, and were';
  return `<p class="warning">${skipped.map((path) => `<code>${escaped(path)}</code>`).join(', ')} ${are} skipped.</p>\n`;
}

function rowOf(grade: Grade, index: number): string {
  const { name, joints, jointError, vertexError, channels, problems } = grade;
  const wrong = wrongPart(grade);
  const cells = [
    `<th scope="row"><a href="#${index + 1}">${escaped(name)}</a></th>`,
    `<td>${badge(grade)}</td>`,
    number(joints > 0 ? String(joints) : ''),
    number(errorText(jointError)),
    number(errorText(vertexError)),
    number(channels ? `${channels.right} of ${channels.of}` : ''),
    `<td>${escaped(wrong ? firstWrongText(wrong) : '')}</td>`,
    `<td>${wrong ? causesOf(wrong) : ''}</td>`,
    number(String(problems.filter(({ severity }) => severity !== 'info').length || '')),
  ];
  return `<tr>${cells.join('')}</tr>`;
}

/** All that explain the first wrong part as well: of one its sentence, too. */
function causesOf(part: PartGrade): string {
  const equal = equalCauses(part);
  const codes = equal.map(({ code }) => `<code>${escaped(code)}</code>`).join(' or ');
  if (equal.length === 1) return `${escaped(equal[0].sentence)} <span class="faint">${codes}</span>`;
  return codes || '<span class="faint">unknown</span>';
}

function pageOf(grade: Grade, index: number, grades: readonly Grade[]): string {
  const to = (i: number, text: string) =>
    grades[i] ? `<a href="#${i + 1}">${text} ${escaped(grades[i].name)}</a>` : '';
  return `<section id="${index + 1}" class="page">
<nav><a href="#overview">All submissions</a>${to(index - 1, '←')}${to(index + 1, '→')}</nav>
<h2>${escaped(grade.name)} ${badge(grade)}</h2>
<p class="faint">${escaped(grade.path)}</p>
${grade.parts.map(partOf).join('\n')}
${problemsOf(grade)}
</section>`;
}

function partOf(part: PartGrade): string {
  const { files, agrees, jointError, vertexError, channels, own, inherited, causes, unexplained, mismatches, first } =
    part;
  const facts: (readonly [string, string])[] = [
    ['Compared', gradedText(part)],
    ['Largest joint error', errorText(jointError)],
    ['Largest vertex error', errorText(vertexError)],
    ['Channels right', channels ? `${channels.right} of ${channels.of}` : ''],
    ['Differs', mismatches.join('; ')],
    ['First wrong', first ? `${firstWrongText({ ...part, mismatches: [] })}, ${differenceText(first)}` : ''],
    ['Own errors', own.join(', ')],
    ['Inherited errors', inherited.join(', ')],
  ];
  const shown = facts
    .filter(([, value]) => value !== '')
    .map(([name, value]) => `<dt>${name}</dt><dd>${escaped(value)}</dd>`);
  const explained = causes.map(
    ({ code, detail, alternatives = [], about, sentence, formula, explains, of }) => `<div class="cause">
<p><code>${escaped(code)}</code>${detail && ` <span class="faint">${escaped(detail)}</span>`}</p>
<p>${escaped(sentence)}</p>${alternatives
      .map(
        (other) => `
<p class="faint">Equally: ${escaped(other)}.</p>`,
      )
      .join('')}
<p class="formula">${escaped(formula)}</p>
<p class="faint">Explains ${explains} of ${of}${about ? ` ${escaped(about)}` : ''}.</p>
</div>`,
  );
  const rest = unexplained.map((sentence) => `<p>${escaped(sentence)}</p>`).join('\n');
  return `<article>
<h3>${files.map((file) => escaped(file)).join('<br>')}</h3>
<p>${agrees ? 'Everything agrees.' : escaped(verdictText(part))}</p>
<dl>${shown.join('')}</dl>
${part.shown ? numbersOf(part.shown, part.first) : ''}
${explained.join('\n')}${rest}
</article>`;
}

/** `The first that is wrong is joint 1 "arm" at 0.7 s. You multiply…`. */
function verdictText(part: PartGrade): string {
  const { mismatches } = part;
  const where = firstWrongText({ ...part, mismatches: [] });
  const equal = equalCauses(part);
  const sentences = [
    ...(mismatches.length > 0 ? [`It does not fit: ${mismatches.join('; ')}.`] : []),
    ...(where ? [`First wrong: ${where}.`] : []),
    ...(equal.length === 1 ? [equal[0].sentence] : []),
  ];
  return sentences.join(' ');
}

/** The numbers of both, side by side. */
function numbersOf({ what, yours, marrows, times }: SideBySide, first: FirstWrong | undefined): string {
  const unit = first?.what === 'channel' && isAngle(first.name) ? ' (rad)' : '';
  const table = (title: string, rows: readonly (readonly number[])[]) => {
    const lines = rows.map((row, r) => {
      const time = times ? `<th scope="row">${escaped(String(times[r]))} s</th>` : '';
      const cells = row.map((value, c) => {
        const differs = !(Math.abs(yours[r][c] - marrows[r][c]) < VISIBLE);
        return `<td${differs ? ' class="differs"' : ''}>${escaped(decimalText(value))}</td>`;
      });
      return `<tr>${time}${cells.join('')}</tr>`;
    });
    return `<table><caption>${title}</caption><tbody>${lines.join('')}</tbody></table>`;
  };
  return `<figure class="numbers"><figcaption>${what}${unit}, first wrong one</figcaption>${table('Yours', yours)}${table('Marrow’s', marrows)}</figure>`;
}

/** Differences that four decimals show. */
const VISIBLE = 5e-5;

function decimalText(value: number): string {
  return Number.isFinite(value) ? value.toFixed(4).replace('-', '−') : String(value);
}

/** By the name of the DOF that a channel drives: `arm.rx`. */
function isAngle(name: string | undefined): boolean {
  return name !== undefined && /\.r[xyz]?$/.test(name);
}

function problemsOf({ problems }: Grade): string {
  if (problems.length === 0) return '';
  const items = problems.map((problem) => {
    const { severity, code, message, assumed, excerpt } = problem;
    const line = excerpt
      ? `<pre>${escaped(excerpt.text)}\n${escaped(excerpt.text.slice(0, excerpt.caret).replace(/[^\t]/g, ' '))}^</pre>`
      : '';
    return `<li class="${severity}"><b>${severity}</b> <code>${escaped(placeOf(problem))}</code> ${escaped(message)}${
      assumed === undefined ? '' : ` <span class="faint">(${escaped(assumed)})</span>`
    } <span class="faint">${escaped(code)}</span>${line}</li>`;
  });
  return `<article><h3>Problems</h3><ul>${items.join('\n')}</ul></article>`;
}

function badge({ verdict }: Grade): string {
  return `<span class="badge ${verdict.replace(' ', '-')}">${verdict}</span>`;
}

function number(text: string): string {
  return `<td class="number">${escaped(text)}</td>`;
}

const ENTITIES: Readonly<Record<string, string>> = {
  '&': '&amp;',
  '<': '&lt;',
  '>': '&gt;',
  '"': '&quot;',
  "'": '&#39;',
};

/** Names of students and files are free text; control characters are shown as such. */
function escaped(text: string): string {
  return text.replace(/[&<>"']/g, (c) => ENTITIES[c]).replace(/[^\P{Cc}\t\n]/gu, '\ufffd');
}
