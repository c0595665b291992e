/** The dialog about a key outside a channel's cycle, shown beside the pose to be keyed. */
import { OUTSIDE_CYCLE } from '../../../edit/keys/cycle.ts';
import { attempt } from '../../state/actions/attempt.ts';
import { manualLink } from '../../state/manual-link.ts';
import type { Uses } from '../../state/workbench.ts';
import type { DialogContent } from '../../widgets/dialog.ts';
import { element } from '../../widgets/dom.ts';
import { cycleText, OUTSIDE_LABELS } from './cycle-text.ts';

const TITLE = 'Key outside the cycle';

export function cycleDialog(wb: Uses<'transport' | 'timeline' | 'messages'>, close: () => void): DialogContent {
  const question = wb.timeline.cycleQuestion.get();
  const kind = 'tool-dialog is-aside cycle-dialog';
  if (!question) return { title: TITLE, kind, body: element('p', {}, 'No key is waiting for an answer.') };
  const { about, answers } = cycleText(question, wb.transport.get().range);
  const always = element('input', { type: 'checkbox' });
  const first = OUTSIDE_CYCLE.find((how) => answers[how] !== undefined);
  const choices = OUTSIDE_CYCLE.flatMap((how) => {
    const detail = answers[how];
    if (detail === undefined) return [];
    const made = element(
      'button',
      { type: 'button', class: 'choice-card', ...(how === first && { autofocus: true }) },
      element('span', { class: 'choice-name' }, OUTSIDE_LABELS[how]),
      element('span', { class: 'faint' }, detail),
    );
    // Previews the result in the curves.
    const show = () => attempt(wb.messages, () => question.show(how));
    made.addEventListener('focus', show);
    made.addEventListener('pointerenter', show);
    made.addEventListener('click', () => {
      if (always.checked) wb.timeline.outsideCycle.set(how);
      attempt(wb.messages, () => question.answer(how));
    });
    return made;
  });
  const cancel = element('button', { type: 'button', class: 'plain' }, 'Cancel');
  cancel.addEventListener('click', close);
  const body = element(
    'div',
    { class: 'tool-form' },
    element('p', {}, about, ' ', manualLink('What is a cycle?', 'cycle')),
    ...choices,
    element('label', { class: 'cycle-always' }, always, 'Don’t ask again until the page is reloaded'),
    element('div', { class: 'tool-buttons' }, cancel),
  );
  return { title: TITLE, kind, body, stays: true };
}
