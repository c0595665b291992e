/** With auto-key on, what is changed over samples isn't keyed, as one expects: converting them is offered, as by K. */
import { findCharacter } from '../../../model/document.ts';
import type { Uses } from '../../state/workbench.ts';
import { isSampled, keyNow } from './pose-edits.ts';

/** Follows steps until ended. */
export function offerOverSamples(wb: Uses<'store' | 'transport' | 'timeline' | 'settings' | 'messages'>): () => void {
  return wb.store.onStep((now, before) => {
    if (!wb.timeline.autoKey.get()) return;
    for (const character of now.document.characters) {
      const { id, unkeyed } = character;
      if (!unkeyed || findCharacter(before.document, id)?.unkeyed === unkeyed) continue;
      const dofs = unkeyed.dofs.filter((dof) => isSampled(character, dof));
      if (dofs.length > 0) keyNow(wb, [{ character, dofs }]);
    }
  });
}
