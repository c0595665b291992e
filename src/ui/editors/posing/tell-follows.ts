/** Posing what another character's take moves: said once, for nothing of it can be keyed, and it is gone with the take. */
import { movedDofs } from '../../../evaluate/retarget/moved-dofs.ts';
import type { Character } from '../../../model/document.ts';
import type { Workbench } from '../../state/workbench.ts';

const told = new WeakMap<Workbench, Set<string>>();

/** @param dofs those that are posed, into the character's */
export function tellFollows(wb: Workbench, character: Character, dofs: readonly number[]): void {
  const { id, name, driver } = character;
  const moved = movedDofs(character);
  if (!driver || !moved || !dofs.some((dof) => moved.has(dof))) return;
  const known = told.get(wb) ?? new Set();
  told.set(wb, known);
  const what = `${id} ${driver.sourceId}`;
  if (known.has(what)) return;
  known.add(what);
  wb.messages.note(`${name} follows ${driver.source.name}: bake it to keep what you pose.`);
}
