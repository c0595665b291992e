/** What to say of a pin that can't be where it should be: which limits stand in the way. */
import type { Character } from '../../../model/document.ts';
import { characterDofs } from '../../../model/dofs.ts';

/** Limits named at once; the rest is counted. */
const MOST_NAMED = 3;

/**
 * `knee_l rx at its limit`, or `out of reach` where no limit binds. Limits on the way from the joint to the root come
 * first, nearest first: those are the ones that one sees.
 *
 * @param binding the character's DOFs that stand at a limit and would go on
 */
export function gapText(character: Character, joint: number, binding: readonly number[], canMove = true): string {
  if (!canMove) return 'nothing here is free to move';
  const { skeleton } = character;
  if (!skeleton || binding.length === 0) return 'out of reach';
  const dofs = characterDofs(skeleton, character.morphs);
  const onWay = wayToRoot(character, joint);
  const place = (dof: number) => {
    const at = onWay.indexOf(dofs[dof]?.joint ?? -1);
    return at < 0 ? onWay.length : at;
  };
  const ordered = [...binding].sort((a, b) => place(a) - place(b) || a - b);
  const named = ordered.slice(0, MOST_NAMED).map((dof) => {
    const { joint: of = -1, name = '' } = dofs[dof] ?? {};
    return `${jointName(character, of)} ${name}`;
  });
  const more = ordered.length - named.length;
  const list = `${named.join(', ')}${more > 0 ? ` and ${more} more` : ''}`;
  return ordered.length === 1 ? `${list} at its limit` : `${list} at their limits`;
}

export function jointName({ skeleton }: Pick<Character, 'skeleton'>, joint: number): string {
  return skeleton?.joints[joint]?.name || `joint ${joint}`;
}

/** The joint, its parent, and so on. */
function wayToRoot({ skeleton }: Character, joint: number): number[] {
  const way: number[] = [];
  for (let j = joint; j >= 0; j = skeleton?.joints[j]?.parent ?? -1) way.push(j);
  return way;
}
