/** Locks DOFs, or unlocks them, from panels: what does it is loaded on first use. */
import { findCharacter } from '../../../model/document.ts';
import { onDemand } from '../../state/on-demand.ts';
import type { Uses } from '../../state/workbench.ts';

/** Locks them; unlocks them if all are locked. */
export function toggleLocks(wb: Uses<'store' | 'messages'>, characterId: string, dofs: readonly number[]): void {
  void onDemand(wb.messages, 'Locks', () => import('./edits.ts')).then((edits) => {
    const character = findCharacter(wb.store.document, characterId);
    if (character) edits?.toggleLocked(wb, character, dofs);
  });
}
