/** Shows a channel in the curve editor, with the reasons of its values beside it. */
import { type Character, shownSkin } from '../../../model/document.ts';
import { characterDofs } from '../../../model/skeleton/dofs.ts';
import type { Uses } from '../../state/workbench.ts';
import { chooseDof } from '../posing/active-dof.ts';

/** The current time is in view then: the first wrong one may be far outside the playback range. */
export function showChannel(
  wb: Uses<'store' | 'timeline' | 'posing' | 'transport'>,
  character: Character,
  channel: number,
): void {
  const dof = characterDofs(character.skeleton, shownSkin(character) ? character.morphs : [])[channel];
  const isOfJoint = dof !== undefined && dof.joint >= 0;
  wb.store.select({ characterId: character.id, ...(isOfJoint && { joint: dof.joint }) });
  if (isOfJoint) chooseDof(wb, channel);
  const { window } = wb.timeline.view.get();
  const { timeSeconds } = wb.transport.get();
  const isInView = timeSeconds >= window.from && timeSeconds <= window.to;
  wb.timeline.change({
    tab: 'curves',
    showsWhy: true,
    list: isOfJoint ? 'selected' : 'all',
  });
  if (!isInView) wb.timeline.fit([Math.min(window.from, timeSeconds), Math.max(window.to, timeSeconds)]);
  wb.timeline.isolate([channel]);
}
