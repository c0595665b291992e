/**
 * Comparing two takes: one laid over the other, all others hidden. This is a step of the document, and the comparison
 * lasts as long as the step: undo ends it, redo restores it. Ending it restores everything: by undoing the step if it
 * is the last one, else by a step of its own (*Stop comparing*), which keeps later changes.
 */
import { endOverlay, overlayTakes } from '../../../edit/commands/takes.ts';
import { isSameSkeleton, matchJoints } from '../../../evaluate/joint-match.ts';
import { type Document, findCharacter, rangeOfClips } from '../../../model/document.ts';
import { plural, shown } from '../../kit/number-text.ts';
import { fitWindow } from '../../kit/time-window.ts';
import { attempt } from '../../state/attempt.ts';
import type { ComparisonOverlay } from '../../state/takes.ts';
import type { Uses } from '../../state/workbench.ts';
import { playRange } from './played-range.ts';
import type { TakeRow } from './rows.ts';

/**
 * Overlays two takes, tinted, with the distances of their joints; refused with a message if they have no joints in
 * common.
 */
export function compareTakes(
  wb: Uses<'store' | 'viewport' | 'transport' | 'timeline' | 'messages'>,
  first: TakeRow,
  second: TakeRow,
): void {
  const { document } = wb.store;
  const skeletons = [first, second].map((row) => findCharacter(document, row.characterId)?.skeleton);
  const [a, b] = skeletons;
  if (!a || !b) {
    wb.messages.note('Takes are compared joint by joint, so both need a skeleton.', 'warning');
    return;
  }
  const match = matchJoints(a, b);
  if (!match.first.length) {
    wb.messages.note(
      `${first.name} and ${second.name} have no joints in common: they are matched by name and parent. Retarget one take onto the other’s character first (Edit > Retarget take…).`,
      'warning',
    );
    return;
  }
  attempt(wb.messages, () => {
    endComparison(wb);
    const before = wb.store.document;
    const { range: playedBefore } = wb.transport.get();
    wb.store.apply(overlayTakes, { first, second });
    const after = wb.store.document;
    if (!isSameSkeleton(match)) {
      wb.messages.note(partText(match.first.length, match.onlyFirst.length + match.onlySecond.length), 'info');
    }
    wb.timeline.takes.distances.update((now) => ({ ...now, picked: [] }));
    const comparison = {
      first: { characterId: first.characterId, clip: first.clip },
      second: { characterId: second.characterId, clip: second.clip },
    };
    wb.timeline.takes.comparison.set(comparison);
    const ends = [first, second].map(({ range, offsetSeconds }) => range.map((t) => t - offsetSeconds));
    const common: [number, number] = [Math.max(ends[0][0], ends[1][0]), Math.min(ends[0][1], ends[1][1])];
    const both: [number, number] = [Math.min(ends[0][0], ends[1][0]), Math.max(ends[0][1], ends[1][1])];
    const played = common[1] > common[0] ? common : both;
    playRange(wb, played);
    const overlay = { comparison, before, after, playedBefore, played, compared: [after], apart: [before] };
    // Nothing changed, so nothing is to be restored, and no undo step belongs to the comparison.
    if (after !== before) followOverlay(wb, overlay);
    wb.timeline.change({ tab: 'takes', window: fitWindow(both) });
    wb.viewport.reveal(first.characterId, second.characterId);
  });
}

/** Restores everything. Does nothing unless comparing. */
export function endComparison(wb: Uses<'store' | 'transport' | 'timeline' | 'messages'>): void {
  const { store, timeline } = wb;
  const { takes } = timeline;
  const comparison = takes.comparison.get();
  const { overlay } = takes;
  if (comparison && overlay?.comparison === comparison) {
    store.settle();
    if (store.document === overlay.after) store.undo();
    else attempt(wb.messages, () => takeApart(wb, overlay));
  }
  takes.comparison.set(undefined);
}

function takeApart(wb: Uses<'store' | 'transport'>, overlay: ComparisonOverlay): void {
  const { store } = wb;
  const { document: compared } = store;
  store.apply(endOverlay, { before: overlay.before.characters, overlaid: overlay.after.characters });
  if (store.document === compared) return;
  overlay.compared.push(compared);
  overlay.apart.push(store.document);
  playAsBefore(wb, overlay, compared);
}

/** Undo and redo leave and re-enter the comparison. */
function followOverlay(wb: Uses<'store' | 'transport' | 'timeline'>, overlay: ComparisonOverlay): void {
  const { takes } = wb.timeline;
  takes.overlay = overlay;
  const stop = wb.store.subscribe((now, before) => {
    if (takes.overlay !== overlay) {
      stop();
      return;
    }
    if (now.document === before.document) return;
    const isCompared = takes.comparison.get() === overlay.comparison;
    if (isCompared && overlay.apart.includes(now.document)) {
      takes.comparison.set(undefined);
      playAsBefore(wb, overlay, before.document);
    } else if (!takes.comparison.get() && overlay.compared.includes(now.document)) {
      takes.comparison.set(overlay.comparison);
      playRange(wb, overlay.played);
    }
  });
}

/**
 * The previous playback range, unless another one was set meanwhile.
 *
 * @param compared the document that was left: if the range is that of its clips, it has changed with them already
 */
function playAsBefore(
  wb: Uses<'store' | 'transport'>,
  { played, playedBefore: range }: ComparisonOverlay,
  compared: Document,
): void {
  const followed = isSame(rangeOfClips(compared), played) ? rangeOfClips(wb.store.document) : undefined;
  wb.transport.update((p) => {
    if (!isSame(p.range, played) && !isSame(followed, p.range)) return p;
    return { ...p, range, timeSeconds: Math.min(range[1], Math.max(range[0], p.timeSeconds)) };
  });
}

function isSame(a: readonly [number, number] | undefined, b: readonly [number, number]): boolean {
  return a?.[0] === b[0] && a[1] === b[1];
}

/** What a comparison of skeletons that differ covers, in numbers of joints. */
export function partText(compared: number, left: number): string {
  const are = compared === 1 ? 'is' : 'are';
  const leftOut = left === 1 ? 'has no counterpart and is left out' : 'have no counterpart and are left out';
  // Names and parents are what joints are matched by: few matches of many joints are another rig.
  const advice = left > compared ? ' To compare all, retarget one take onto the other character first.' : '';
  return `${plural(compared, 'joint')} ${are} compared; ${shown(left)} ${leftOut}.${advice}`;
}
