/**
 * Adds keys. One outside the cycle of a repeating channel would change all of its motion, which is rarely intended: a
 * dialog asks what to do, while the viewport shows the pose to be keyed. The answer can be made permanent (*Keys >
 * Editing*).
 *
 * Auto-key asks once on release, for everything that the drag has changed: asking during the drag would end it, and not
 * asking would lengthen a walk with every touch.
 *
 * A pose can also be keyed for a moment, which neither changes the cycle nor jumps: that is the first answer, and is
 * offered after keys that are abrupt (`offer-moment.ts`).
 */

import { documentIn, type Edit } from '../../edit/change.ts';
import type { ArgsOf, Command } from '../../edit/command.ts';
import { keyForMoment } from '../../edit/commands/moment.ts';
import type { KeyOptions } from '../../edit/key-dofs.ts';
import { changedCyclesOf, type OutsideCycle } from '../../edit/keys/cycle.ts';
import { type KeyedPose, keyedPose } from '../../edit/keys/keyed-pose.ts';
import { type Document, findCharacter, shownClip } from '../../model/document.ts';
import type { CycleQuestion, Easing, KeyedMoment } from './cycle-question.ts';
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
  wb: Uses<'store' | 'timeline' | 'transport'>,
  command: Command<A, Document | Edit>,
  args: (outsideCycle: OutsideCycle) => A,
): void {
  const { store } = wb;
  const { outsideCycle, cycleQuestion } = wb.timeline;
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
  const { timeSeconds } = wb.transport.get();
  const pose = keyedPose(before, documentIn(longer), timeSeconds);
  const question: CycleQuestion = {
    ...found,
    timeSeconds,
    ...(pose && {
      moment: {
        show: (easing) => shown.preview(keyForMoment.run(before, momentArgs(wb, pose, easing))),
        answer(easing) {
          if (!close()) return;
          store.apply(keyForMoment, momentArgs(wb, pose, easing));
          keepMoment(wb, momentArgs(wb, pose, easing));
        },
      },
    }),
    show: (how) => shown.preview(command.run(before, args(how))),
    answer(how) {
      // Something else has happened meanwhile, and the keys may be of what is no more.
      if (close()) store.apply(command, args(how));
    },
    cancel: close,
  };
  cycleQuestion.set(question);
}

/**
 * Asks how long a pose is to be eased in and out, while the viewport and the curves show it.
 *
 * @param pose its values at the current time
 * @param undoes whether the last step has keyed it, and is to be replaced
 */
export function askForMoment(
  wb: Uses<'store' | 'timeline' | 'transport'>,
  pose: KeyedPose,
  before: Document,
  undoes: boolean,
): void {
  const { store } = wb;
  const { cycleQuestion } = wb.timeline;
  const character = findCharacter(before, pose.characterId);
  if (!character) return;
  cycleQuestion.get()?.cancel();
  store.settle();
  const { timeSeconds } = wb.transport.get();
  const shown = store.begin(keyForMoment.label(before, momentArgs(wb, pose, wb.timeline.easing.get())), 'tried');
  const close = () => {
    const isOpen = !shown.closed;
    shown.cancel();
    if (cycleQuestion.get() === question) cycleQuestion.set(undefined);
    return isOpen;
  };
  const question: CycleQuestion = {
    character,
    changed: [],
    timeSeconds,
    moment: {
      show: (easing) => shown.preview(keyForMoment.run(before, momentArgs(wb, pose, easing))),
      answer(easing) {
        if (!close()) return;
        if (undoes) store.undo();
        store.apply(keyForMoment, momentArgs(wb, pose, easing));
        keepMoment(wb, momentArgs(wb, pose, easing));
      },
    },
    show() {},
    answer() {},
    cancel: close,
  };
  cycleQuestion.set(question);
}

/** What the last step has keyed for a moment, so that it can be eased otherwise. */
export function keepMoment({ store, timeline }: Uses<'store' | 'timeline'>, args: ArgsOf<typeof keyForMoment>): void {
  timeline.moment.set({ args, label: store.undoLabel, clip: clipOf(store.document, args) });
}

/** Whether nothing was done since. */
export function isLastMoment({ store }: Uses<'store'>, { args, label, clip }: KeyedMoment): boolean {
  return store.undoLabel === label && clip !== undefined && clipOf(store.document, args) === clip;
}

function clipOf(document: Document, { characterId }: { readonly characterId: string }) {
  const character = findCharacter(document, characterId);
  return character && shownClip(character);
}

/** Easing goes over whole frames, so that keys and frames that are there stay where they are. */
export function wholeFrames({ transport }: Uses<'transport'>, seconds: number): number {
  const { framesPerSecond } = transport.get();
  return Math.max(1, Math.round(seconds * framesPerSecond)) / framesPerSecond;
}

function momentArgs(
  wb: Uses<'transport'>,
  { characterId, dofs }: KeyedPose,
  { easeIn, easeOut }: Easing,
): ArgsOf<typeof keyForMoment> {
  const { timeSeconds, range } = wb.transport.get();
  return {
    characterId,
    timeSeconds,
    dofs: [...dofs],
    easeIn: wholeFrames(wb, easeIn),
    easeOut: wholeFrames(wb, easeOut),
    ...(range[1] > range[0] && { playedRange: range }),
  };
}

/** The same for commands that key only with auto-key. */
export function addKeyed<A extends { readonly key?: KeyOptions | undefined }>(
  wb: Uses<'store' | 'timeline' | 'transport'>,
  command: Command<A, Document | Edit>,
  args: A,
): void {
  const { key } = args;
  if (key) addKeys(wb, command, (outsideCycle) => ({ ...args, key: { ...key, outsideCycle } }));
  else wb.store.apply(command, args);
}
