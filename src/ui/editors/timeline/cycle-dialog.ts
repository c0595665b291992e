/**
 * The dialog about a pose that is keyed over motion that goes on, and about keys outside a channel’s cycle, shown
 * beside the pose to be keyed.
 */
import { OUTSIDE_CYCLE } from '../../../edit/keys/cycle.ts';
import { attempt } from '../../state/actions/attempt.ts';
import type { CycleQuestion } from '../../state/cycle-question.ts';
import { manualLink } from '../../state/manual-link.ts';
import type { Uses } from '../../state/workbench.ts';
import type { DialogContent } from '../../widgets/dialog.ts';
import { element, setAttribute } from '../../widgets/dom.ts';
import { plainButton } from '../../widgets/form/form.ts';
import { cycleText, momentText, OUTSIDE_LABELS } from './cycle-text.ts';
import { easingFields } from './easing-fields.ts';

const TITLE = 'Key outside the cycle';
const MOMENT_TITLE = 'Key for a moment';

type Parts = Uses<'transport' | 'timeline' | 'messages'>;

export function cycleDialog(wb: Parts, close: () => void): DialogContent {
  const question = wb.timeline.cycleQuestion.get();
  const kind = 'tool-dialog is-aside cycle-dialog';
  if (!question) return { title: TITLE, kind, body: element('p', {}, 'No key waits for an answer.') };
  const isAlone = question.changed.length === 0;
  const parts = isAlone ? momentForm(wb, question, close) : outsideParts(wb, question, close);
  const body = element('div', { class: 'tool-form' }, ...parts);
  return { title: isAlone ? MOMENT_TITLE : TITLE, kind, body, stays: true };
}

/** A choice and what it does. */
function card(name: string, detail: string): HTMLButtonElement {
  return element(
    'button',
    { type: 'button', class: 'choice-card' },
    element('span', { class: 'choice-name' }, name),
    element('span', { class: 'faint' }, detail),
  );
}

/** What a choice does is previewed while it has the focus or the pointer, and done when it is pressed. */
function answers(wb: Uses<'messages'>, choice: HTMLButtonElement, show: () => void, answer: () => void): void {
  const preview = () => attempt(wb.messages, show);
  choice.addEventListener('focus', preview);
  choice.addEventListener('pointerenter', preview);
  choice.addEventListener('click', () => attempt(wb.messages, answer));
}

/** A moment as the only choice: what it does, its easing, and the buttons. */
function momentForm(wb: Parts, question: CycleQuestion, close: () => void): readonly HTMLElement[] {
  const { moment } = question;
  if (!moment) return [];
  const made = element('button', { type: 'button', class: 'plain primary', autofocus: true }, 'Key');
  return [
    element('p', {}, momentText(question, wb.transport.get().range)),
    easingOf(wb, moment, made),
    element('div', { class: 'tool-buttons' }, plainButton('Cancel', close), made),
  ];
}

/** A moment as the first of several choices. */
function momentCard(wb: Parts, question: CycleQuestion): readonly HTMLElement[] {
  const { moment } = question;
  if (!moment) return [];
  const made = card('For a moment', momentText(question, wb.transport.get().range));
  setAttribute(made, 'autofocus', '');
  return [made, easingOf(wb, moment, made)];
}

/** Seconds of easing, which are previewed as they change, and keyed by Enter or `choice`. */
function easingOf(wb: Parts, moment: NonNullable<CycleQuestion['moment']>, choice: HTMLButtonElement): HTMLElement {
  let { easing } = moment;
  answers(
    wb,
    choice,
    () => moment.show(easing),
    () => moment.answer(easing),
  );
  return easingFields(
    easing,
    (next) => {
      easing = next;
      wb.timeline.easing.set(next);
      attempt(wb.messages, () => moment.show(next));
    },
    (reason) => wb.messages.note(reason, 'warning'),
    () => choice.click(),
  );
}

/** Why it asks; a moment, or what becomes of the key alone. */
function outsideParts(wb: Parts, question: CycleQuestion, close: () => void): readonly HTMLElement[] {
  const { about, answers: details } = cycleText(question, wb.transport.get().range);
  const always = element('input', { type: 'checkbox' });
  const choices = OUTSIDE_CYCLE.flatMap((how) => {
    const detail = details[how];
    if (detail === undefined) return [];
    const answer = () => {
      if (always.checked) wb.timeline.outsideCycle.set(how);
      question.answer(how);
    };
    const made = card(OUTSIDE_LABELS[how], detail);
    answers(wb, made, () => question.show(how), answer);
    return [made];
  });
  if (!question.moment && choices[0]) setAttribute(choices[0], 'autofocus', '');
  return [
    element('p', {}, about, ' ', manualLink('What is a cycle?', 'cycle')),
    ...momentCard(wb, question),
    ...choices,
    element('label', { class: 'cycle-always' }, always, 'Don’t ask again until the page is reloaded'),
    element('div', { class: 'tool-buttons' }, plainButton('Cancel', close)),
  ];
}
