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

import { type Change, documentIn } from '../../edit/change.ts';
import type { ArgsOf, Command } from '../../edit/command.ts';
import { keyForMoment } from '../../edit/commands/moment.ts';
import type { KeyOptions } from '../../edit/key-dofs.ts';
import { changedCyclesOf, type OutsideCycle } from '../../edit/keys/cycle.ts';
import { type KeyedPose, keyedPose } from '../../edit/keys/keyed-pose.ts';
import type { Gesture } from '../../edit/store.ts';
import { type Document, findCharacter, shownTake } from '../../model/document.ts';
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
  command: Command<A, Document | Change>,
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
  const { shown, close, ask } = asking(wb, command.label(before, args('lengthen')));
  // At the time that is shown, all answers give this pose.
  shown.preview(longer);
  const { timeSeconds } = wb.transport.get();
  const pose = keyedPose(before, documentIn(longer), timeSeconds);
  ask({
    ...found,
    timeSeconds,
    ...(pose && { moment: momentAsked(wb, pose, before, shown, close) }),
    show: (how) => shown.preview(command.run(before, args(how))),
    answer(how) {
      // Something else has happened meanwhile, and the keys may be of what is no more.
      if (close()) store.apply(command, args(how));
    },
    cancel: close,
  });
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
  const character = findCharacter(before, pose.characterId);
  if (!character) return;
  wb.timeline.cycleQuestion.get()?.cancel();
  wb.store.settle();
  const { shown, close, ask } = asking(wb, keyForMoment.label(before, momentArgs(wb, pose, wb.timeline.easing.get())));
  ask({
    character,
    changed: [],
    timeSeconds: wb.transport.get().timeSeconds,
    moment: momentAsked(wb, pose, before, shown, close, undoes),
    show() {},
    answer() {},
    cancel: close,
  });
}

/** @returns what the question is shown by, and what ends it, which returns whether it was open */
function asking({ store, timeline: { cycleQuestion } }: Uses<'store' | 'timeline'>, label: string) {
  const shown = store.begin(label, 'tried');
  let asked: CycleQuestion | undefined;
  const close = () => {
    const isOpen = !shown.closed;
    shown.cancel();
    if (cycleQuestion.get() === asked) cycleQuestion.set(undefined);
    return isOpen;
  };
  const ask = (question: CycleQuestion) => {
    asked = question;
    cycleQuestion.set(question);
  };
  return { shown, close, ask };
}

function momentAsked(
  wb: Uses<'store' | 'timeline' | 'transport'>,
  pose: KeyedPose,
  before: Document,
  shown: Gesture,
  close: () => boolean,
  undoes = false,
): CycleQuestion['moment'] {
  return {
    easing: usualEasing(wb, pose, before),
    show: (easing) => shown.preview(keyForMoment.run(before, momentArgs(wb, pose, easing))),
    answer(easing) {
      if (!close()) return;
      if (undoes) wb.store.undo();
      const args = momentArgs(wb, pose, easing);
      wb.store.apply(keyForMoment, args);
      keepMoment(wb, args);
    },
  };
}

/** Beside the last moment it ends at that one's pose, which stays as it was made. */
function usualEasing(wb: Uses<'timeline' | 'transport'>, { characterId }: KeyedPose, document: Document): Easing {
  const { easeIn, easeOut } = wb.timeline.easing.get();
  const last = wb.timeline.moment.get();
  const isThere = last?.take && last.args.characterId === characterId && takeOf(document, last.args) === last.take;
  const since = isThere ? wb.transport.get().timeSeconds - last.args.timeSeconds : 0;
  return {
    easeIn: since > 0 ? Math.min(easeIn, wholeFrames(wb, since)) : easeIn,
    easeOut: since < 0 ? Math.min(easeOut, wholeFrames(wb, -since)) : easeOut,
  };
}

/** What the last step has keyed for a moment, so that it can be eased otherwise. */
export function keepMoment({ store, timeline }: Uses<'store' | 'timeline'>, args: ArgsOf<typeof keyForMoment>): void {
  timeline.moment.set({ args, label: store.undoLabel, take: takeOf(store.document, args) });
}

/** Whether nothing was done since. */
export function isLastMoment({ store }: Uses<'store'>, { args, label, take }: KeyedMoment): boolean {
  return store.undoLabel === label && take !== undefined && takeOf(store.document, args) === take;
}

function takeOf(document: Document, { characterId }: { readonly characterId: string }) {
  const character = findCharacter(document, characterId);
  return character && shownTake(character);
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
  command: Command<A, Document | Change>,
  args: A,
): void {
  const { key } = args;
  if (key) addKeys(wb, command, (outsideCycle) => ({ ...args, key: { ...key, outsideCycle } }));
  else wb.store.apply(command, args);
}
