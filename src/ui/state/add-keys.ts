/**
 * Adds keys. One outside the cycle of a repeating channel would change all of its motion, which is rarely intended: a
 * dialog asks what to do, while the viewport shows the pose to be keyed. The answer can be made permanent (*Keys >
 * Editing*).
 *
 * Auto-key asks once on release, for everything that the drag has changed: asking during the drag would end it, and not
 * asking would lengthen a walk with every touch.
 */

import { documentIn, type Edit } from '../../edit/change.ts';
import type { Command } from '../../edit/command.ts';
import type { KeyOptions } from '../../edit/key-dofs.ts';
import { changedCyclesOf, type OutsideCycle } from '../../edit/keys/cycle.ts';
import { type Document, findCharacter } from '../../model/document.ts';
import type { CycleQuestion } from './cycle-question.ts';
import type { Uses } from './workbench.ts';

/** A character of which some channels repeat otherwise after a change, and those. */
export function cyclesChanged(
  before: Document,
  after: Document,
): Pick<CycleQuestion, 'character' | 'changed'> | undefined {
  for (const now of after.characters) {
    const character = findCharacter(before, now.id);
    const changed = character ? changedCyclesOf(character, now) : [];
    if (character && changed.length) return { character, changed };
  }
  return undefined;
}

/**
 * Applies a command that adds keys: one step, at once or when it is answered where they go.
 * @param args made for either answer
 */
export function addKeys<A>(
  { store, timeline }: Uses<'store' | 'timeline'>,
  command: Command<A, Document | Edit>,
  args: (outsideCycle: OutsideCycle) => A,
): void {
  const { outsideCycle, cycleQuestion } = timeline;
  cycleQuestion.get()?.cancel();
  const said = outsideCycle.get();
  if (said !== 'ask') {
    store.apply(command, args(said));
    return;
  }
  store.settle();
  const before = store.document;
  const longer = command.run(before, args('lengthen'));
  const found = cyclesChanged(before, documentIn(longer));
  if (!found) {
    store.apply(command, args('lengthen'));
    return;
  }
  // At the time that is shown, all answers give this pose.
  const shown = store.begin(command.label(before, args('lengthen')), 'tried');
  shown.preview(longer);
  const close = () => {
    const isOpen = !shown.closed;
    shown.cancel();
    if (cycleQuestion.get() === question) cycleQuestion.set(undefined);
    return isOpen;
  };
  const question: CycleQuestion = {
    ...found,
    show: (how) => shown.preview(command.run(before, args(how))),
    answer(how) {
      // Something else has happened meanwhile, and the keys may be of what is no more.
      if (close()) store.apply(command, args(how));
    },
    cancel: close,
  };
  cycleQuestion.set(question);
}

/** The same for commands that key only with auto-key. */
export function addKeyed<A extends { readonly key?: KeyOptions | undefined }>(
  wb: Uses<'store' | 'timeline'>,
  command: Command<A, Document | Edit>,
  args: A,
): void {
  const { key } = args;
  if (key) addKeys(wb, command, (outsideCycle) => ({ ...args, key: { ...key, outsideCycle } }));
  else wb.store.apply(command, args);
}
