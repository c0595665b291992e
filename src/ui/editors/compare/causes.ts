/** The mistakes that explain what was found: what was done, what should be done, and how much it explains. */
import { areEqual, beginText, subjectText, unexplainedSentences } from '../../../teaching/compare/compared-text.ts';
import type { Cause } from '../../../teaching/search/found-causes.ts';
import type { ComparedResult } from '../../state/dump-comparison.ts';
import { element } from '../../widgets/dom.ts';
import { explainsText, numberText } from './banner-text.ts';

/**
 * @param newest names of the dumps that were given last: what is about them comes first
 * @param hasSeveral dumps, so that they are named
 */
export function causesList(result: ComparedResult, newest: readonly string[], hasSeveral: boolean): HTMLElement {
  const { comparison } = result;
  const list = element('div', { class: 'compare-causes' });
  const isNew = ({ about }: Cause) => about?.files.some((file) => newest.includes(file)) ?? false;
  const causes = [...comparison.causes.filter(isNew), ...comparison.causes.filter((cause) => !isNew(cause))];
  if (areEqual(causes)) {
    list.append(element('p', { class: 'faint' }, 'Each of these explains it; these numbers can’t tell them apart.'));
  }
  list.append(...causes.map((cause) => causeBlock(cause, result)));
  const unexplained = unexplainedSentences(comparison, hasSeveral);
  list.append(...unexplained.map((sentence) => element('p', { class: 'compare-sentence' }, sentence)));
  if (causes.length === 0 && !comparison.agrees && unexplained.length > 0) {
    list.append(element('p', { class: 'faint' }, beginText(comparison)));
  }
  return list;
}

function causeBlock(cause: Cause, result: ComparedResult): HTMLElement {
  const { code, detail, alternatives, sentences, formulas, residual, about } = cause;
  return element(
    'article',
    { class: 'compare-cause', 'aria-label': code },
    ...(about ? [element('p', { class: 'faint' }, `In the ${subjectText(about, true)}:`)] : []),
    ...sentences.map((sentence) => element('p', { class: 'compare-sentence' }, sentence)),
    ...alternatives.map((other) => element('p', { class: 'faint' }, `Equally: ${other}.`)),
    ...[...new Set(formulas)].map((formula) => element('p', { class: 'compare-formula' }, formula)),
    element(
      'p',
      { class: 'faint' },
      `${explainsText(cause, result)} The largest remaining error is ${numberText(residual)}. `,
      element('code', { tooltip: detail || undefined }, code),
    ),
  );
}
