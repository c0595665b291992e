/**
 * Grades as one HTML file without anything outside it: an overview, and a page per submission that its address leads to
 * (`report.html#3`). Printed, all follow one another.
 */
import {
  equalCauses,
  errorText,
  firstWrongText,
  type Grade,
  gradedText,
  type PartGrade,
  placeOf,
  wrongPart,
} from './grade.ts';
import { STYLE } from './style.ts';

export interface ReportFacts {
  /** As given. */
  readonly folder: string;
  readonly reference: string;
  readonly tolerance: number;
  /** Paths of files that belong to no submission. */
  readonly skipped: readonly string[];
}

export function asHtml(grades: readonly Grade[], { folder, reference, tolerance, skipped }: ReportFacts): string {
  const counts = (['right', 'wrong', 'not judged'] as const).map(
    (verdict) => `<b>${grades.filter((grade) => grade.verdict === verdict).length}</b> ${verdict}`,
  );
  return `<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>${escaped(folder)} – Marrow</title>
<style>${STYLE}</style>
<main id="overview">
<header>
<h1>${escaped(folder)}</h1>
<p>${grades.length} submissions: ${counts.join(', ')}. Compared with <code>${escaped(reference)}</code> within ${tolerance}.</p>
${skippedText(skipped)}</header>
<div class="wide"><table>
<thead><tr>${['Submission', 'Verdict', 'Joints', 'Joint error', 'Vertex error', 'Channels', 'First wrong', 'Cause', 'Problems'].map((title) => `<th scope="col">${title}</th>`).join('')}</tr></thead>
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

/** All that explain the first wrong part as well. */
function causesOf(part: PartGrade): string {
  const codes = equalCauses(part).map(({ code }) => `<code>${escaped(code)}</code>`);
  return codes.length > 0 ? codes.join(' or ') : '<span class="faint">none known</span>';
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
  const { files, agrees, jointError, vertexError, channels, own, inherited, causes, mismatches } = part;
  const facts: (readonly [string, string])[] = [
    ['Compared', gradedText(part)],
    ['Joint error', errorText(jointError)],
    ['Vertex error', errorText(vertexError)],
    ['Channels right', channels ? `${channels.right} of ${channels.of}` : ''],
    ['Differs', mismatches.join('; ')],
    ['First wrong', mismatches.length > 0 && !part.first ? '' : firstWrongText({ ...part, mismatches: [] })],
    ['Wrong by themselves', own.join(', ')],
    ['Wrong by a parent', inherited.join(', ')],
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
  const none =
    agrees || causes.length > 0 ? '' : '<p class="faint">No known mistake, nor two together, explains it.</p>';
  return `<article>
<h3>${files.map((file) => escaped(file)).join('<br>')}</h3>
<dl>${shown.join('')}</dl>
${explained.join('\n')}${none}
</article>`;
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
