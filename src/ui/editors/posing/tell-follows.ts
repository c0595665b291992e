/** A message, once, when what a retargeted or attached character follows is posed: such a change is lost. */
import { compileSkeleton } from '../../../evaluate/kinematics.ts';
import { movedDofs } from '../../../evaluate/retarget/moved-dofs.ts';
import { type Character, shownTake } from '../../../model/document.ts';
import type { Uses } from '../../state/workbench.ts';

/** @param dofs the posed ones, as indices into the character's */
export function tellFollows(wb: Uses<'posing' | 'messages'>, character: Character, dofs: readonly number[]): void {
  const { id, name, driver, skeleton } = character;
  const moved = movedDofs(character);
  const tell = (leader: string, text: string) => {
    const { toldToFollow } = wb.posing;
    const what = `${id} ${leader}`;
    if (toldToFollow.has(what)) return;
    toldToFollow.add(what);
    wb.messages.note(text);
  };
  if (driver && moved && dofs.some((dof) => moved.has(dof))) {
    tell(driver.sourceId, `${name} is retargeted from ${driver.source.name}. Bake it to keep your pose.`);
  }
  if (driver || !skeleton || !shownTake(character)?.attached) return;
  const [, next] = compileSkeleton(skeleton).firstDof;
  if (dofs.some((dof) => dof < next)) {
    tell(
      'attached',
      `The root of ${name} follows another character while it is attached. Put it down or detach it to pose that.`,
    );
  }
}
