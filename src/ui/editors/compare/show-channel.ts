/** Shows a channel in the curve editor, with the reasons of its values beside it. */
import { type Character, shownSkin } from '../../../model/document.ts';
import { characterDofs } from '../../../model/dofs.ts';
import type { Uses } from '../../state/workbench.ts';
import { chooseDof } from '../posing/active-dof.ts';

export function showChannel(wb: Uses<'store' | 'timeline' | 'posing'>, character: Character, channel: number): void {
  const dof = characterDofs(character.skeleton, shownSkin(character) ? character.morphs : [])[channel];
  const isOfJoint = dof !== undefined && dof.joint >= 0;
  wb.store.select({ characterId: character.id, ...(isOfJoint && { joint: dof.joint }) });
  if (isOfJoint) chooseDof(wb, channel);
  wb.timeline.change({ tab: 'curves', showsWhy: true, list: isOfJoint ? 'selected' : 'all' });
  wb.timeline.isolate([channel]);
}
