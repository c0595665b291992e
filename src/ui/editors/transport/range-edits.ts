/**
 * Typing a range: that of the take, which is saved with it, if only one take plays; else the playback range only.
 * Dragging the range's ends, and shortcuts, always set the playback range only.
 */
import { setClipRange } from '../../../edit/commands/clips.ts';
import { type Character, playingCharacters } from '../../../model/document.ts';
import { attempt } from '../../state/actions/attempt.ts';
import type { Uses } from '../../state/workbench.ts';
import { announce } from '../../widgets/announce.ts';
import { timeText } from '../timeline/time-menu.ts';

/** The only character that plays a take. */
function onlyTake(wb: Uses<'store'>): Character | undefined {
  const playing = playingCharacters(wb.store.document);
  return playing.length === 1 ? playing[0] : undefined;
}

/** Says the range, which a key has changed. */
export function sayRange(wb: Uses<'transport' | 'settings'>): void {
  announce(rangeText(wb));
}

/** `Range 0 s to 2.5 s`. */
export function rangeText(wb: Uses<'transport' | 'settings'>): string {
  const [from, to] = wb.transport.get().range;
  return `Range ${timeText(wb, from)} to ${timeText(wb, to)}`;
}

/** @param range seconds of the transport; refused with a message if it ends before it starts */
export function typeRange(
  wb: Uses<'store' | 'transport' | 'settings' | 'messages'>,
  range: readonly [number, number],
): void {
  const [from, to] = range;
  if (from > to) {
    wb.messages.note(`A range that starts at ${timeText(wb, from)} can’t end at ${timeText(wb, to)}.`, 'warning');
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
