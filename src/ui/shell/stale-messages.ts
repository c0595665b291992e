/**
 * A refusal stays in the line until the next thing is done: beyond that it would read as if that had been refused. What
 * is refused in the middle of a drag, or while a number is typed, is not left behind by the end of that very drag.
 */
import type { Document } from '../../model/document.ts';
import type { Said } from '../state/messages.ts';
import type { Uses } from '../state/workbench.ts';

/** Follows the steps until it is ended. Subscribe it before others that say something of a step. */
export function leaveRefusalsBehind({ store, messages }: Uses<'store' | 'messages'>): () => void {
  /** What had been said when the change began that is under way, and what it began from. */
  let begun: { readonly from: Document; readonly said: Said } | undefined;
  const stops = [
    store.subscribe((now, before) => {
      if (now.document === before.document) return;
      // Given up: nothing was done.
      if (now.document === begun?.from) begun = undefined;
      else begun ??= { from: before.document, said: messages.said };
    }),
    store.onStep((_now, before) => {
      // Else it is of a change that was no step: of files that were opened, of undo.
      messages.leaveBehind(begun?.from === before.document ? begun.said : messages.said);
      begun = undefined;
    }),
  ];
  return () => {
    for (const stop of stops) stop();
  };
}
