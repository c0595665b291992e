/**
 * A refusal stays in the line until the next step: after that it would seem to be about that step. A refusal during a
 * drag, or while typing a number, isn't cleared by the end of that same edit.
 */
import type { Diagnostic } from '../../model/diagnostic.ts';
import type { Character, Document } from '../../model/document.ts';
import { sameName } from '../../model/files.ts';
import type { Said } from '../state/messages.ts';
import type { Uses } from '../state/workbench.ts';

/**
 * Follows steps until ended; after each change of document, selection or mode, what is over leaves the line, and so do
 * problems of files of which nothing is in the document any more. That a file was not given leaves the list while its
 * character has that file. Subscribe before listeners that add messages about a
 * step.
 */
export function leaveRefusalsBehind({ store, messages, posing }: Uses<'store' | 'messages' | 'posing'>): () => void {
  /** Messages at the start of the running change, and the document it started from. */
  let begun: { readonly from: Document; readonly said: Said } | undefined;
  const stops = [
    store.subscribe((now, before) => {
      messages.leaveOver();
      if (now.document === before.document) return;
      if (filesDiffer(now.document, before.document)) messages.settle(hasCome(now.document));
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

function filesDiffer({ characters: now }: Document, { characters: before }: Document): boolean {
  return now.length !== before.length || now.some(({ sources }, i) => sources !== before[i].sources);
}

/** Whether a file that was not given is there now: all characters that have the file that names it have it. */
function hasCome({ characters }: Document): (problem: Diagnostic) => boolean {
  const having = new Map<string, Character[]>();
  for (const character of characters) {
    for (const { name } of character.sources) {
      const all = having.get(name.toLowerCase());
      if (all) all.push(character);
      else having.set(name.toLowerCase(), [character]);
    }
  }
  return ({ file, missing }) =>
    missing !== undefined &&
    (having.get(file.toLowerCase())?.every(({ sources }) => sources.some(({ name }) => sameName(name, missing))) ??
      false);
}

const filesOf = ({ sources, unread = [] }: Character) =>
  [...sources, ...unread].flatMap(({ name, path }) => [name, path]);
