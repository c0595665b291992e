/**
 * What is set by hand over keys lasts for one moment, and is seen to go when time moves on. Going is an undo step, so
 * that Ctrl+Z gives it back to be keyed, and time goes back to its moment with it. Only while there is something to be
 * redone it stays in the document, shown at its moment and no other: undoing, looking round and redoing has to work, and
 * a step would end it.
 */
import { discardUnkeyed } from '../../../edit/commands/pose.ts';
import { countUnkeyed } from '../../../edit/unkeyed.ts';
import { findCharacter } from '../../../model/document.ts';
import { isMac } from '../../kit/keyboard.ts';
import { findAction } from '../../state/action.ts';
import { shortcutsFor, shortcutText } from '../../state/shortcuts.ts';
import type { Uses } from '../../state/workbench.ts';

/** Drops what was set at another time than this, and says so once. */
export function dropStale(wb: Uses<'store' | 'actions' | 'settings' | 'messages'>, timeSeconds: number): void {
  const { store, messages } = wb;
  if (countUnkeyed(store.document, timeSeconds) === 0 || store.redoLabel !== undefined) return;
  // A drag that ends with the moment may leave none.
  store.settle();
  const count = countUnkeyed(store.document, timeSeconds);
  if (count === 0) return;
  // No key can be made where another character's take moves it.
  const canBeKeyed = store.document.characters.some((c) => c.unkeyed && !c.driver);
  store.apply(discardUnkeyed, { exceptSeconds: timeSeconds });
  const undo = keyNameOf(wb, 'edit.undo');
  const key = canBeKeyed ? keyNameOf(wb, 'key.pose') : undefined;
  const hints = [undo && `${undo} restores ${count === 1 ? 'it' : 'them'}`, key && `${key} keys such changes`];
  const said = hints.filter(Boolean).join(', ');
  const what = count === 1 ? 'Unkeyed change' : `${count} unkeyed changes`;
  messages.note(`${what} discarded${said && `. ${said}`}.`);
}

/** The key of an action as a menu shows it; undefined where it has none. */
export function keyNameOf(wb: Uses<'actions' | 'settings'>, actionId: string): string | undefined {
  const action = findAction(wb, actionId);
  const [shortcut] = action ? shortcutsFor(action, wb.settings.get()) : [];
  return shortcut && shortcutText(shortcut, isMac);
}

/** Goes to the moment of values that come back, by undo or from a script: elsewhere they could not be seen. */
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
