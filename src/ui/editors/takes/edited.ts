/** Which takes the editing of whole takes applies to. */
import type { TakeRef } from '../../../edit/commands/takes.ts';
import { playedTake } from '../../../evaluate/bake.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import { needs } from '../../state/actions/needs.ts';
import type { Uses } from '../../state/workbench.ts';
import { currentTake } from '../timeline/current-take.ts';
import { chosenTakes } from './play.ts';
import { type TakeRow, takeRows } from './rows.ts';
import { takesToCompare } from './which-takes.ts';

/**
 * The selected takes if there are several or the list of takes is in view, else the current character's; none while
 * that is retargeted.
 */
export function takesToEdit(wb: Uses<'store' | 'timeline'>): readonly TakeRef[] {
  const chosen = chosenTakes(wb).filter(({ take }) => take >= 0);
  const isListed = wb.timeline.view.get().tab === 'takes';
  if (chosen.length > 1 || (isListed && chosen.length === 1)) return chosen;
  const current = currentTake(wb);
  if (current) return [{ characterId: current.character.id, take: current.character.shownTake }];
  return chosen;
}

/** The selected takes, or the only two, in the list's order. */
export function takesToJoin(wb: Uses<'store' | 'timeline'>): readonly TakeRow[] {
  const chosen = chosenTakes(wb).filter(({ take }) => take >= 0);
  if (chosen.length > 1) return chosen;
  return takesToCompare(wb)?.filter(({ take }) => take >= 0) ?? [];
}

/** Takes that can be inserted into the current one: all others. */
export function takesToInsert(wb: Uses<'store'>): readonly TakeRow[] {
  const current = currentTake(wb)?.character;
  return takeRows(wb.store.document).filter(
    ({ characterId, take }) => take >= 0 && !(characterId === current?.id && take === current.shownTake),
  );
}

export const needsTakesToEdit = needs(
  'There is no take to edit: select one in the Takes tab.',
  (wb: Uses<'store' | 'timeline'>) => takesToEdit(wb).length > 0,
);
export const needsTakesToJoin = needs(
  'Select two takes or more in the Takes tab; they are joined in the order of the list.',
  (wb: Uses<'store' | 'timeline'>) => takesToJoin(wb).length > 1,
);
export const needsFrames = needs(
  'The current take has no samples.',
  (wb: Uses<'store'>) => currentTake(wb)?.take.samples !== undefined,
);
export const needsPlayedTake = needs('The current character plays no take.', (wb: Uses<'store'>) => {
  const character = currentCharacter(wb);
  return character?.skeleton !== undefined && playedTake(character) !== undefined;
});
