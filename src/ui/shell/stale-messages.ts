/**
 * A refusal stays in the line until the next step: after that it would seem to be about that step. A refusal during a
 * drag, or while typing a number, isn't cleared by the end of that same edit.
 */
import type { Document } from '../../model/document.ts';
import type { Said } from '../state/messages.ts';
import type { Uses } from '../state/workbench.ts';

/** Follows steps until ended. Subscribe before listeners that add messages about a step. */
export function leaveRefusalsBehind({ store, messages }: Uses<'store' | 'messages'>): () => void {
  /** Messages at the start of the running change, and the document it started from. */
  let begun: { readonly from: Document; readonly said: Said } | undefined;
  const stops = [
    store.subscribe((now, before) => {
      if (now.document === before.document) return;
      // Cancelled: nothing was done.
      if (now.document === begun?.from) begun = undefined;
      else begun ??= { from: before.document, said: messages.said };
    }),
    store.onStep((_now, before) => {
      // Otherwise a change without a step: opening files, or undo.
      messages.leaveBehind(begun?.from === before.document ? begun.said : messages.said);
      begun = undefined;
    }),
  ];
  return () => {
    for (const stop of stops) stop();
  };
}
