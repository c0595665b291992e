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
  const parts = isAlone ? momentParts(wb, question) : outsideParts(wb, question);
  const body = element(
    'div',
    { class: 'tool-form' },
    ...parts,
    element('div', { class: 'tool-buttons' }, plainButton('Cancel', close), ...(isAlone ? [acceptButton(parts)] : [])),
  );
  return { title: isAlone ? MOMENT_TITLE : TITLE, kind, body, stays: true };
}

/** Where there is no other choice, a button that takes it. */
function acceptButton([choice]: readonly HTMLElement[]): HTMLElement {
  const made = element('button', { type: 'button', class: 'plain primary' }, 'Key it');
  made.addEventListener('click', () => choice?.click());
  return made;
}

/** A choice and what it does, which is previewed while it is pointed at. */
function card(wb: Uses<'messages'>, name: string, detail: string, show: () => void, answer: () => void): HTMLElement {
  const made = element(
    'button',
    { type: 'button', class: 'choice-card' },
    element('span', { class: 'choice-name' }, name),
    element('span', { class: 'faint' }, detail),
  );
  const preview = () => attempt(wb.messages, show);
  made.addEventListener('focus', preview);
  made.addEventListener('pointerenter', preview);
  made.addEventListener('click', () => attempt(wb.messages, answer));
  return made;
}

function momentParts(wb: Parts, question: CycleQuestion): readonly HTMLElement[] {
  const { moment } = question;
  if (!moment) return [];
  let { easing } = moment;
  const answer = () => moment.answer(easing);
  const made = card(
    wb,
    'For a moment',
    momentText(question, wb.transport.get().range),
    () => moment.show(easing),
    answer,
  );
  setAttribute(made, 'autofocus', '');
  const fields = easingFields(
    easing,
    (next) => {
      easing = next;
      wb.timeline.easing.set(next);
      attempt(wb.messages, () => moment.show(next));
    },
    (reason) => wb.messages.note(reason, 'warning'),
    () => attempt(wb.messages, answer),
  );
  return [made, fields];
}

/** Why it asks; a moment, or what becomes of the key alone. */
function outsideParts(wb: Parts, question: CycleQuestion): readonly HTMLElement[] {
  const { about, answers } = cycleText(question, wb.transport.get().range);
  const always = element('input', { type: 'checkbox' });
  const choices = OUTSIDE_CYCLE.flatMap((how) => {
    const detail = answers[how];
    if (detail === undefined) return [];
    const answer = () => {
      if (always.checked) wb.timeline.outsideCycle.set(how);
      question.answer(how);
    };
    return [card(wb, OUTSIDE_LABELS[how], detail, () => question.show(how), answer)];
  });
  if (!question.moment && choices[0]) setAttribute(choices[0], 'autofocus', '');
  return [
    element('p', {}, about, ' ', manualLink('What is a cycle?', 'cycle')),
    ...momentParts(wb, question),
    ...choices,
    element('label', { class: 'cycle-always' }, always, 'Don’t ask again until the page is reloaded'),
  ];
}
