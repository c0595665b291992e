/**
 * Unkeyed changes last for one time only, and visibly go when the time changes. Discarding is an undo step, so that
 * Ctrl+Z restores them to be keyed, and the time with them. While there is something to redo they stay in the document,
 * shown only at their time, since a new step would discard the redo history.
 */
import { discardUnkeyed } from '../../../edit/commands/unkeyed.ts';
import { countUnkeyed } from '../../../edit/unkeyed.ts';
import { channelOf } from '../../../evaluate/pose.ts';
import { findCharacter } from '../../../model/document.ts';
import { onDemand } from '../../state/on-demand.ts';
import type { Uses } from '../../state/workbench.ts';

/** Discards changes made at another time, with a message. */
export function dropStale(wb: Uses<'store' | 'actions' | 'settings' | 'messages'>, timeSeconds: number): void {
  const { store, messages } = wb;
  if (countUnkeyed(store.document, timeSeconds) === 0 || store.redoLabel !== undefined) return;
  // Finishing a running drag may leave none.
  store.settle();
  const count = countUnkeyed(store.document, timeSeconds);
  if (count === 0) return;
  // Retargeted DOFs can't be keyed, nor can samples as they are.
  const canBeKeyed = store.document.characters.some(
    (c) => !c.driver && c.unkeyed?.dofs.some((dof) => channelOf(c, dof)?.kind !== 'samples'),
  );
  store.apply(discardUnkeyed, { exceptSeconds: timeSeconds });
  const { document } = store;
  // With the names of keys, which the page's start has no use for.
  onDemand(messages, 'A message', () => import('./tell-discarded.ts')).then((module) => {
    // By then its button could undo another step.
    if (store.document === document) module?.tellDiscarded(wb, count, canBeKeyed);
  });
}

/** Sets the time of restored values (by undo, or from a script), where alone they are visible. */
export function followUnkeyed({ store, transport }: Uses<'store' | 'transport'>): () => void {
  return store.subscribe((now, before) => {
    if (now.document === before.document) return;
    const { timeSeconds } = transport.get();
    for (const { id, unkeyed } of now.document.characters) {
      if (!unkeyed || unkeyed.timeSeconds === timeSeconds) continue;
      if (findCharacter(before.document, id)?.unkeyed === unkeyed) continue;
      transport.update((p) => ({ ...p, timeSeconds: unkeyed.timeSeconds, playing: false }));
      return;
    }
  });
}
