/** Explains why a pin can't reach its target. */
import type { Hindrance } from '../../../evaluate/ik/drag/hindrance.ts';
import type { Character } from '../../../model/document.ts';
import { characterDofs } from '../../../model/skeleton/dofs.ts';
import { jointName } from '../../../model/skeleton/joint-name.ts';
import type { Skeleton } from '../../../model/skeleton/skeleton.ts';

/** Maximum number of limits listed; the rest is counted. */
const MAX_NAMED = 3;
/** The same for names of pins and locks. */
const MAX_JOINTS = 2;

/** `knee_l rx at its limit`, `knee_l is locked`, or both; otherwise other causes: pins that hold, or a fixed root. */
export function gapText(character: Character, joint: number, hindrance: Hindrance): string {
  const { binding, holders, locks, canMove, rootStays } = hindrance;
  if (!canMove && rootStays) return 'the root is fixed: allow it to move';
  const limits = canMove ? limitsText(character, joint, binding) : '';
  const locked = locks.length > 0 ? locksText(character, joint, locks) : '';
  if (limits || locked) return [limits, locked].filter((part) => part !== '').join(', ');
  return canMove ? outOfReach(character, [...new Set(holders)], joint, rootStays) : 'nothing here can move';
}

/** Limits between the joint and the root first, nearest first: those are visible. */
function limitsText(character: Character, joint: number, binding: readonly number[]): string {
  const { skeleton } = character;
  if (!skeleton || binding.length === 0) return '';
  const dofs = characterDofs(skeleton, character.morphs);
  const onWay = wayToRoot(character, joint);
  const place = (dof: number) => {
    const at = onWay.indexOf(dofs[dof]?.joint ?? -1);
    return at < 0 ? onWay.length : at;
  };
  const ordered = [...binding].sort((a, b) => place(a) - place(b) || a - b);
  const named = ordered.slice(0, MAX_NAMED).map((dof) => {
    const { joint: of = -1, name = '' } = dofs[dof] ?? {};
    return `${jointName(character.skeleton, of)} ${name}`;
  });
  const more = ordered.length - named.length;
  const list = `${named.join(', ')}${more > 0 ? ` and ${more} more` : ''}`;
  return ordered.length === 1 ? `${list} at its limit` : `${list} at their limits`;
}

function locksText({ skeleton }: Character, joint: number, locks: readonly number[]): string {
  // The text follows its name.
  if (locks.length === 1 && locks[0] === joint) return 'it is locked';
  return `${namesOf(skeleton, locks)} ${locks.length === 1 ? 'is' : 'are'} locked`;
}

function namesOf(skeleton: Skeleton | undefined, joints: readonly number[]): string {
  const named = joints.slice(0, MAX_JOINTS).map((joint) => jointName(skeleton, joint));
  const more = joints.length - named.length;
  return more > 0 ? `${named.join(', ')} and ${more} more` : named.join(' and ');
}

function outOfReach({ skeleton }: Character, holders: readonly number[], joint: number, rootStays: boolean): string {
  const others = holders.filter((other) => other !== joint);
  if (others.length === 0) return rootStays ? 'out of reach while the root is fixed' : 'out of reach';
  return `out of reach while ${namesOf(skeleton, others)} ${others.length === 1 ? 'holds' : 'hold'}`;
}

/** The joint, its parent, and so on. */
function wayToRoot({ skeleton }: Character, joint: number): number[] {
  const way: number[] = [];
  for (let j = joint; j >= 0; j = skeleton?.joints[j]?.parent ?? -1) way.push(j);
  return way;
}
