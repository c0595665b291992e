/** A message, once, when a retargeted character is posed: such a change can't be keyed, and is lost. */
import { movedDofs } from '../../../evaluate/retarget/moved-dofs.ts';
import type { Character } from '../../../model/document.ts';
import type { Uses } from '../../state/workbench.ts';

/** @param dofs the posed ones, as indices into the character's */
export function tellFollows(wb: Uses<'posing' | 'messages'>, character: Character, dofs: readonly number[]): void {
  const { id, name, driver } = character;
  const moved = movedDofs(character);
  if (!driver || !moved || !dofs.some((dof) => moved.has(dof))) return;
  const { toldToFollow } = wb.posing;
  const what = `${id} ${driver.sourceId}`;
  if (toldToFollow.has(what)) return;
  toldToFollow.add(what);
  wb.messages.note(`${name} is retargeted from ${driver.source.name}. Bake it to keep your pose.`);
}
