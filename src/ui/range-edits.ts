/**
 * The range as it is typed: of the take, which saves it, where one take is all that plays; else only what is played.
 * Dragging the range's ends, and the keys that set it here and now, always mean what is played.
 */
import { setClipRange } from '../edit/commands/clips.ts';
import { type Character, shownClip } from '../model/document.ts';
import { attempt } from './attempt.ts';
import type { Workbench } from './workbench.ts';

/** The one character that plays a take. */
export function onlyTake(wb: Workbench): Character | undefined {
  const playing = wb.store.document.characters.filter((c) => shownClip(c));
  return playing.length === 1 ? playing[0] : undefined;
}

/** @param range seconds of the transport; refused, with a word, where it ends before it begins */
export function typeRange(wb: Workbench, range: readonly [number, number]): void {
  const [from, to] = range;
  if (from > to) {
    wb.messages.note(`A range can’t end at ${to} s where it begins at ${from} s.`, 'warning');
    return;
  }
  const character = onlyTake(wb);
  if (character) {
    const offset = character.timeOffsetSeconds;
    attempt(wb.messages, () =>
      wb.store.apply(setClipRange, { characterId: character.id, range: [from + offset, to + offset] }),
    );
  }
  wb.transport.update((p) => ({ ...p, range }));
}
