/**
 * Comparing two takes: one laid over the other, all others out of the picture. That is a step of the document, and the
 * comparison lasts as long as that step stands: undo ends it, redo brings it back. Ending it puts everything back where
 * it was: by taking the step back where it is the last one, else by a step of its own (*Stop comparing*), which leaves
 * alone what was changed meanwhile.
 */
import { endOverlay, overlayTakes } from '../../edit/commands/takes.ts';
import { isSameSkeleton, matchJoints } from '../../evaluate/joint-match.ts';
import { findCharacter } from '../../model/document.ts';
import { attempt } from '../attempt.ts';
import { fitWindow } from '../time-window.ts';
import type { Workbench } from '../workbench.ts';
import { playRange } from './played-range.ts';
import type { TakeRow } from './rows.ts';
import type { Overlay } from './takes.ts';

/** One over the other, tinted, with the distance of their joints; refused with a word where they have nothing in common. */
export function compareTakes(wb: Workbench, first: TakeRow, second: TakeRow): void {
  const { document } = wb.store;
  const skeletons = [first, second].map((row) => findCharacter(document, row.characterId)?.skeleton);
  const [a, b] = skeletons;
  if (!a || !b) {
    wb.messages.note('Takes are compared joint by joint: both need a skeleton.', 'warning');
    return;
  }
  const match = matchJoints(a, b);
  if (!match.first.length) {
    wb.messages.note(
      `${first.name} and ${second.name} have no joints in common: they are matched by their names and parents.`,
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
      const missing = match.onlyFirst.length + match.onlySecond.length;
      wb.messages.note(
        `${match.first.length} joints are compared; ${missing} have no partner and are left out.`,
        'info',
      );
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
    // Nothing was to be changed: nothing is to be put back, and no step of undo is the comparison's.
    if (after !== before) followOverlay(wb, overlay);
    wb.timeline.change({ tab: 'takes', window: fitWindow(both) });
    wb.viewport.reveal(first.characterId);
  });
}

/** Everything as it was before. Nothing happens where nothing is compared. */
export function endComparison(wb: Workbench): void {
  const { store, timeline } = wb;
  const { takes } = timeline;
  const comparison = takes.comparison.get();
  if (!comparison) return;
  const { overlay } = takes;
  if (overlay?.comparison === comparison) {
    if (store.document === overlay.after) store.undo();
    else {
      const { document } = store;
      const { before, after } = overlay;
      attempt(wb.messages, () =>
        store.apply(endOverlay, { before: before.characters, overlaid: after.characters }),
      );
      if (store.document !== document) {
        overlay.compared.push(document);
        overlay.apart.push(store.document);
      }
    }
    playAsBefore(wb, overlay);
  }
  takes.comparison.set(undefined);
}

/** Undo and redo lead out of the comparison and into it. */
function followOverlay(wb: Workbench, overlay: Overlay): void {
  const { takes } = wb.timeline;
  takes.overlay = overlay;
  const stop = wb.store.subscribe((now, before) => {
    if (takes.overlay !== overlay) return stop();
    if (now.document === before.document) return;
    const isCompared = takes.comparison.get() === overlay.comparison;
    if (isCompared && overlay.apart.includes(now.document)) {
      takes.comparison.set(undefined);
      playAsBefore(wb, overlay);
    } else if (!takes.comparison.get() && overlay.compared.includes(now.document)) {
      takes.comparison.set(overlay.comparison);
      playRange(wb, overlay.played);
    }
  });
}

/** What was played before, unless another range was set meanwhile. */
function playAsBefore(wb: Workbench, { played, playedBefore: range }: Overlay): void {
  wb.transport.update((p) => {
    if (p.range[0] !== played[0] || p.range[1] !== played[1]) return p;
    return { ...p, range, timeSeconds: Math.min(range[1], Math.max(range[0], p.timeSeconds)) };
  });
}
