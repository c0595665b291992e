/** Names of channels: those of the DOFs that they drive. */
import { type Character, shownSkin, shownTake } from '../../model/document.ts';
import { characterDofs } from '../../model/skeleton/dofs.ts';

/** `hip.rx`; nothing if the channel drives no DOF. */
export function nameOfChannel(character: Character, index: number): { readonly name?: string } {
  if (!character.skeleton || !shownTake(character)) return {};
  const dof = characterDofs(character.skeleton, shownSkin(character) ? character.morphs : [])[index];
  if (!dof) return {};
  const joint = character.skeleton.joints[dof.joint]?.name;
  return { name: joint ? `${joint}.${dof.name}` : dof.name };
}
