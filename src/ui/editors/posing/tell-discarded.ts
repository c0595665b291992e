/** The message that unkeyed changes were discarded, with the ways to have them back. */
import { findAction, tryAction } from '../../state/actions/action.ts';
import { keyNameOf } from '../../state/actions/tooltips.ts';
import type { Uses } from '../../state/workbench.ts';

/**
 * To be told while the discarding is the last step, which its button undoes.
 *
 * @param count of the changes, at least 1
 * @param canBeKeyed whether keying them would have kept any
 */
export function tellDiscarded(
  wb: Uses<'store' | 'actions' | 'settings' | 'messages'>,
  count: number,
  canBeKeyed: boolean,
): void {
  const undo = keyNameOf(wb, 'edit.undo');
  const key = canBeKeyed ? keyNameOf(wb, 'key.changed') : undefined;
  const hints = [
    undo && `${undo} restores ${count === 1 ? 'it' : 'them'}`,
    key && `press ${key} before changing the time to keep them`,
  ];
  const said = hints.filter(Boolean).join(', ');
  const what = count === 1 ? 'Unkeyed change' : `${count} unkeyed changes`;
  const action = findAction(wb, 'edit.undo');
  const text = `${what} discarded${said && `. ${said}`}.`;
  const { document } = wb.store;
  // Its button undoes the last step.
  const isOver = () => wb.store.document !== document;
  if (action) wb.messages.confirm(text, { label: 'Undo', run: () => tryAction(wb, action) }, isOver);
  else wb.messages.note(text);
}
