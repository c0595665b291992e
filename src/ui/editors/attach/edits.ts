/** Ends attachments of the current character, at the current time. */
import { putDown, removeAttachment } from '../../../edit/commands/beside/attach.ts';
import { shownTake } from '../../../model/document.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import { attempt } from '../../state/actions/attempt.ts';
import type { Uses } from '../../state/workbench.ts';

type Parts = Uses<'store' | 'transport' | 'messages'>;

export function putDownNow(wb: Parts): void {
  const character = currentCharacter(wb);
  if (!character) return;
  const { timeSeconds } = wb.transport.get();
  attempt(wb.messages, () => wb.store.apply(putDown, { characterId: character.id, timeSeconds }));
}

/** Removes the attachment at the current time, else the one before it, else the first. */
export function detachNow(wb: Parts): void {
  const character = currentCharacter(wb);
  const list = (character && shownTake(character)?.attached?.list) ?? [];
  if (!character || list.length === 0) return;
  const time = wb.transport.get().timeSeconds + character.timeOffsetSeconds;
  const index = Math.max(
    0,
    list.findLastIndex(({ span }) => span[0] <= time),
  );
  attempt(wb.messages, () => wb.store.apply(removeAttachment, { characterId: character.id, index }));
}
