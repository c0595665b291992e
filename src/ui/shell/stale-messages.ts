/**
 * A refusal stays in the line until the next step: after that it would seem to be about that step. A refusal during a
 * drag, or while typing a number, isn't cleared by the end of that same edit.
 */
import type { Character, Document } from '../../model/document.ts';
import type { Said } from '../state/messages.ts';
import type { Uses } from '../state/workbench.ts';

/**
 * Follows steps until ended; after each change of document, selection or mode, what is over leaves the line, and so do
 * problems of files of which nothing is in the document any more. Subscribe before listeners that add messages about a
 * step.
 */
export function leaveRefusalsBehind({ store, messages, posing }: Uses<'store' | 'messages' | 'posing'>): () => void {
  /** Messages at the start of the running change, and the document it started from. */
  let begun: { readonly from: Document; readonly said: Said } | undefined;
  const stops = [
    store.subscribe((now, before) => {
      messages.leaveOver();
      if (now.document === before.document) return;
      leaveProblemsOfRemoved(messages, now.document, before.document);
      // Cancelled: nothing was done.
      if (now.document === begun?.from) begun = undefined;
      else begun ??= { from: before.document, said: messages.said };
    }),
    store.onStep((_now, before) => {
      // Otherwise a change without a step: opening files, or undo.
      messages.leaveBehind(begun?.from === before.document ? begun.said : messages.said);
      begun = undefined;
    }),
    posing.mode.subscribe(() => messages.leaveOver()),
  ];
  return () => {
    for (const stop of stops) stop();
  };
}

/** Problems of the files of removed characters, if no other one has them. */
function leaveProblemsOfRemoved(messages: Uses<'messages'>['messages'], now: Document, before: Document): void {
  const kept = new Set(now.characters.map(({ id }) => id));
  const removed = before.characters.filter(({ id }) => !kept.has(id));
  if (removed.length === 0) return;
  const files = new Set(removed.flatMap(filesOf));
  for (const character of now.characters) for (const file of filesOf(character)) files.delete(file);
  messages.leaveLine(({ diagnostics }) => diagnostics.length > 0 && diagnostics.every(({ file }) => files.has(file)));
}

const filesOf = ({ sources, unread = [] }: Character) =>
  [...sources, ...unread].flatMap(({ name, path }) => [name, path]);
