/**
 * Unkeyed changes last for one time only, and visibly go when the time changes. Discarding is an undo step, so that
 * Ctrl+Z restores them to be keyed, and the time with them. While there is something to redo they stay in the document,
 * shown only at their time, since a new step would discard the redo history.
 */
import { discardUnkeyed } from '../../../edit/commands/unkeyed.ts';
import { countUnkeyed } from '../../../edit/unkeyed.ts';
import { findCharacter } from '../../../model/document.ts';
import { findAction, tryAction } from '../../state/action.ts';
import { keyNameOf } from '../../state/tooltips.ts';
import type { Uses } from '../../state/workbench.ts';

/** Discards changes made at another time, with a message. */
export function dropStale(wb: Uses<'store' | 'actions' | 'settings' | 'messages'>, timeSeconds: number): void {
  const { store, messages } = wb;
  if (countUnkeyed(store.document, timeSeconds) === 0 || store.redoLabel !== undefined) return;
  // Finishing a running drag may leave none.
  store.settle();
  const count = countUnkeyed(store.document, timeSeconds);
  if (count === 0) return;
  // Retargeted DOFs can't be keyed.
  const canBeKeyed = store.document.characters.some((c) => c.unkeyed && !c.driver);
  store.apply(discardUnkeyed, { exceptSeconds: timeSeconds });
  const undo = keyNameOf(wb, 'edit.undo');
  const key = canBeKeyed ? keyNameOf(wb, 'key.changed') : undefined;
  const hints = [undo && `${undo} restores ${count === 1 ? 'it' : 'them'}`, key && `${key} keys such changes`];
  const said = hints.filter(Boolean).join(', ');
  const what = count === 1 ? 'Unkeyed change' : `${count} unkeyed changes`;
  const action = findAction(wb, 'edit.undo');
  const text = `${what} discarded${said && `. ${said}`}.`;
  if (action) messages.confirm(text, { label: 'Undo', run: () => tryAction(wb, action) });
  else messages.note(text);
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
