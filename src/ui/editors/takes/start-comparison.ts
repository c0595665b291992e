/** Begins comparing two takes: overlays them, over the time that both cover, and says which joints are left out. */
import { overlayTakes } from '../../../edit/commands/takes.ts';
import { RETARGETED } from '../../../edit/drivers.ts';
import { type ComparedJoints, comparedJoints } from '../../../evaluate/compare/compared-joints.ts';
import { attempt } from '../../state/actions/attempt.ts';
import { showing } from '../../state/takes.ts';
import type { Uses } from '../../state/workbench.ts';
import { plural, shown } from '../../widgets/numbers/number-text.ts';
import { endComparison, followMovedTake, followOverlay } from './compared-takes.ts';
import { playRange } from './played-range.ts';
import type { TakeRow } from './rows.ts';

/**
 * Overlays two takes, tinted, with the distances of their joints; refused with a message if they have no joints in
 * common.
 */
export function compareTakes(
  wb: Uses<'store' | 'viewport' | 'transport' | 'timeline' | 'messages' | 'dialog'>,
  one: TakeRow,
  other: TakeRow,
): void {
  // Of one character, its document shows the retargeted take: the viewer draws its own one over it.
  const isTurned = other.take === RETARGETED && one.characterId === other.characterId;
  const [first, second] = isTurned ? [other, one] : [one, other];
  const [a, b] = [first, second].map((row) => showing(wb.store.document, row));
  if (!a?.skeleton || !b?.skeleton) {
    wb.messages.note('Takes are compared joint by joint, so both need a skeleton.', 'warning');
    return;
  }
  const joints = comparedJoints(a, b);
  if (!joints.first.length) {
    wb.messages.confirm(nothingText(first.name, second.name), retargetOffer(wb));
    return;
  }
  attempt(wb.messages, () => {
    endComparison(wb);
    const before = wb.store.document;
    const { range: playedBefore } = wb.transport.get();
    wb.store.apply(overlayTakes, { first, second });
    const after = wb.store.document;
    wb.timeline.takes.distances.update((now) => ({ ...now, picked: [] }));
    const comparison = {
      first: { characterId: first.characterId, take: first.take },
      second: { characterId: second.characterId, take: second.take },
    };
    wb.timeline.takes.comparison.set(comparison);
    followMovedTake(wb, comparison);
    if (!joints.isSame) sayWhich(wb, joints);
    const ends = [first, second].map(({ range, offsetSeconds }) => range.map((t) => t - offsetSeconds));
    const common: [number, number] = [Math.max(ends[0][0], ends[1][0]), Math.min(ends[0][1], ends[1][1])];
    const both: [number, number] = [Math.min(ends[0][0], ends[1][0]), Math.max(ends[0][1], ends[1][1])];
    const played = common[1] > common[0] ? common : both;
    playRange(wb, played);
    const overlay = { comparison, before, after, playedBefore, played, compared: [after], apart: [before] };
    // Nothing changed, so nothing is to be restored, and no undo step belongs to the comparison.
    if (after !== before) followOverlay(wb, overlay);
    wb.timeline.change({ tab: 'takes' });
    wb.timeline.fit(both);
    wb.viewport.camera.reveal(first.characterId, second.characterId);
  });
}

/** Said until the comparison ends. */
function sayWhich(
  wb: Uses<'messages' | 'dialog' | 'timeline'>,
  { first, onlyFirst, onlySecond }: ComparedJoints,
): void {
  const { messages, timeline } = wb;
  const left = onlyFirst.length + onlySecond.length;
  // Few matches of many joints: they can be matched by hand.
  const isLittle = left > 2 * first.length;
  const text = `${partText(first.length, left)}${isLittle ? ` ${BY_HAND}` : ''}`;
  if (isLittle) messages.confirm(text, retargetOffer(wb));
  else messages.note(text, 'info');
  const stop = timeline.takes.comparison.subscribe(() => {
    stop();
    if (messages.passing.get() === text) messages.passing.set(undefined);
  });
}

const BY_HAND = 'To match joints by hand, retarget one take to the other character (Edit > Retarget take…).';

const retargetOffer = (wb: Uses<'dialog'>) => ({ label: 'Retarget take…', run: () => wb.dialog.set('retarget') });

/** What a comparison of skeletons that differ covers, in numbers of joints. */
export function partText(compared: number, left: number): string {
  const are = compared === 1 ? 'is' : 'are';
  const head = `${plural(compared, 'joint')} ${are} compared, matched by name and body part`;
  return left === 0 ? `${head}.` : `${head}; ${shown(left)} ${left === 1 ? 'has' : 'have'} no matching joint.`;
}

/** Two takes that share no joint, and what to do. */
function nothingText(first: string, second: string): string {
  return `${first} and ${second} have no joints in common, by name or body part. Match them by hand in Edit > Retarget take…, then compare again.`;
}
