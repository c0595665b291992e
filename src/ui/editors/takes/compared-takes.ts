/**
 * Comparing two takes: one laid over the other, all others hidden (`start-comparison.ts`). This is a step of the
 * document, and the comparison lasts as long as the step: undo ends it, redo restores it. Ending it restores
 * everything: by undoing the step if it is the last one, else by a step of its own (*Stop comparing*), which keeps
 * later changes.
 */
import { endOverlay } from '../../../edit/commands/takes.ts';
import { type Document, findCharacter, rangeOfTakes } from '../../../model/document.ts';
import { attempt } from '../../state/actions/attempt.ts';
import type { Comparison, ComparisonOverlay } from '../../state/takes.ts';
import type { Uses } from '../../state/workbench.ts';
import { playRange } from './played-range.ts';

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
export function followOverlay(wb: Uses<'store' | 'transport' | 'timeline'>, overlay: ComparisonOverlay): void {
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

/** While two takes of one character are compared, the second stays the same take, whatever its index. */
export function followMovedTake(wb: Uses<'store' | 'transport' | 'timeline'>, comparison: Comparison): void {
  const { takes } = wb.timeline;
  let own = comparison;
  const stop = wb.store.subscribe((now, before) => {
    if (takes.comparison.get() !== own) {
      stop();
      return;
    }
    const moved = withMovedTake(own, before.document, now.document);
    if (moved === own) return;
    const { overlay } = takes;
    if (overlay?.comparison === own) followOverlay(wb, { ...overlay, comparison: moved });
    own = moved;
    takes.comparison.set(moved);
  });
}

/**
 * Two takes of one character: the second is known by its index, which changes when an earlier take is removed or comes
 * back. The same object if it doesn't.
 */
function withMovedTake(comparison: Comparison, before: Document, now: Document): Comparison {
  const { first, second } = comparison;
  if (first.characterId !== second.characterId || second.take < 0) return comparison;
  const takesIn = (document: Document) => findCharacter(document, second.characterId)?.takes;
  const [was, is] = [takesIn(before)?.[second.take], takesIn(now)];
  if (!was || !is || is[second.take] === was) return comparison;
  const take = is.indexOf(was);
  return take < 0 ? comparison : { first, second: { ...second, take } };
}

/**
 * The previous playback range, unless another one was set meanwhile.
 *
 * @param compared the document that was left: if the range is that of its takes, it has changed with them already
 */
function playAsBefore(
  wb: Uses<'store' | 'transport'>,
  { played, playedBefore: range }: ComparisonOverlay,
  compared: Document,
): void {
  const followed = isSame(rangeOfTakes(compared), played) ? rangeOfTakes(wb.store.document) : undefined;
  wb.transport.update((p) => {
    if (!isSame(p.range, played) && !isSame(followed, p.range)) return p;
    return { ...p, range, timeSeconds: Math.min(range[1], Math.max(range[0], p.timeSeconds)) };
  });
}

function isSame(a: readonly [number, number] | undefined, b: readonly [number, number]): boolean {
  return a?.[0] === b[0] && a[1] === b[1];
}
