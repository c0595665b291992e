/** A skin that was opened without a skeleton can't move: a new skeleton is offered for it, and to open one. */
import { findCharacter } from '../../../model/document.ts';
import { tryById } from '../../state/actions/action.ts';
import type { Uses } from '../../state/workbench.ts';

/** Follows what is opened, until ended. */
export function followLoneSkins(wb: Uses<'store' | 'actions' | 'messages'>): () => void {
  const { store, messages } = wb;
  return store.subscribe(({ document }, { document: before }) => {
    if (document.characters === before.characters) return;
    const lone = document.characters.find(
      ({ id, skeleton, skins }) => !skeleton && skins.length > 0 && !findCharacter(before, id),
    );
    if (!lone) return;
    messages.suggest(
      `${lone.name} is a skin without a skeleton: it can’t be posed.`,
      [
        { label: 'New skeleton', run: () => tryById(wb, 'rigging.new') },
        { label: 'Add a .skel…', run: () => tryById(wb, 'file.open') },
      ],
      () => findCharacter(store.document, lone.id)?.skeleton !== undefined || !findCharacter(store.document, lone.id),
    );
  });
}
