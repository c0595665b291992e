/** Three steps for those who see the page for the first time. They go for good once followed or closed. */
import { type Document, findCharacter } from '../../model/document.ts';
import type { Selection } from '../../model/session.ts';
import { button, element } from '../kit/dom.ts';
import { icon } from '../kit/icons.ts';
import { touchWords } from '../kit/touch-words.ts';
import type { Uses } from '../state/workbench.ts';

const STEPS = ['Click a joint', 'Drag its ring', 'Press K to key it'] as const;

interface Seen {
  readonly document: Document;
  readonly selection: Selection;
}

export function firstSteps(wb: Uses<'store' | 'settings' | 'posing'>): HTMLElement {
  let done = 0;
  const leave = () => wb.settings.update((s) => ({ ...s, firstSteps: false }));
  const steps = STEPS.map((text, i) =>
    element('li', {}, element('b', { 'aria-hidden': 'true' }, String(i + 1)), touchWords(text)),
  );
  const close = button('Close first steps', { class: 'tool small' }, icon('close'), leave);
  const line = element(
    'section',
    { class: 'first-steps', 'aria-label': 'First steps' },
    element('ol', {}, ...steps),
    close,
  );
  const show = () => {
    line.hidden = !areShown(wb);
    steps.forEach((step, i) => {
      step.classList.toggle('done', i < done);
      step.classList.toggle('next', i === done);
    });
  };
  const follow = (now: Seen, before: Seen) => {
    if (!wb.settings.get().firstSteps) return;
    done = stepsDone(done, now, before);
    if (done === STEPS.length) leave();
    else show();
  };
  // Previews may be cancelled, so documents count only by their steps.
  wb.store.subscribe((now, { selection }) => follow(now, { document: now.document, selection }));
  wb.store.onStep(follow);
  wb.settings.subscribe((now, before) => {
    if (now.firstSteps === before.firstSteps) return;
    done = wb.store.selection.joint === undefined ? 0 : 1;
    show();
  });
  wb.posing.mode.subscribe(show);
  show();
  return line;
}

/** Only in FK: in the other modes a click or a drag does something else. */
export function areShown({ settings, store, posing }: Uses<'store' | 'settings' | 'posing'>): boolean {
  return settings.get().firstSteps && store.document.characters.length > 0 && posing.mode.get() === 'fk';
}

/** How many of the steps are done after a change, of which `done` were before. */
export function stepsDone(done: number, now: Seen, before: Seen): number {
  if (done < 2 && now.selection.joint === undefined) return 0;
  if (done === 0) return 1;
  // Opening others is none of the steps.
  const changed = now.document.characters.flatMap((c) => {
    const was = findCharacter(before.document, c.id);
    return was && was !== c ? [{ was, is: c }] : [];
  });
  if (changed.length === 0) return done;
  return changed.some(({ was, is }) => was.clips !== is.clips) ? STEPS.length : Math.max(done, 2);
}
