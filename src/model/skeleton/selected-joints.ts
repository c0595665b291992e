/**
 * The selected joints as an ordered set, whose last one is active. They belong to one character: a joint of another one
 * replaces them.
 */
import type { Selection } from '../session.ts';
import type { Skeleton } from './skeleton.ts';

/** A joint, and the instance at which it was picked. */
export interface JointPick {
  readonly characterId: string;
  readonly placement?: number;
  /** Index. */
  readonly joint: number;
}

const NONE: readonly number[] = [];

/** In the order of selection, the active one last. */
export function jointsIn({ joint, others = NONE }: Selection): readonly number[] {
  return joint === undefined ? NONE : [...others, joint];
}

/**
 * The selection of several joints of one character.
 * @param joints the last one becomes active; repeated ones count where they come last; none: only the character
 */
export function withJoints({ characterId, placement }: Omit<JointPick, 'joint'>, joints: readonly number[]): Selection {
  const each = [...new Set([...joints].reverse())].reverse();
  const joint = each.at(-1);
  const others = each.slice(0, -1);
  return {
    characterId,
    ...(placement !== undefined && { placement }),
    ...(joint !== undefined && { joint }),
    ...(others.length > 0 && { others }),
  };
}

/** Adds a joint, which becomes active, or removes it; then the one selected before it is active. */
export function withJointToggled(selection: Selection, pick: JointPick): Selection {
  const before = selection.characterId === pick.characterId ? jointsIn(selection) : NONE;
  const { joint } = pick;
  return withJoints(pick, before.includes(joint) ? before.filter((j) => j !== joint) : [...before, joint]);
}

/** One of the selected joints becomes active, and all stay selected; another one is selected alone. */
export function withJointActive(selection: Selection, pick: JointPick): Selection {
  const before = selection.characterId === pick.characterId ? jointsIn(selection) : NONE;
  const { joint } = pick;
  return withJoints(pick, before.includes(joint) ? [...before, joint] : [joint]);
}

/**
 * Those that are the same joints after a change of the skeleton: none if joints were added or removed, which renumbers
 * them, or if one has another name and place.
 */
export function othersKept(others: readonly number[], before: Skeleton, after: Skeleton): readonly number[] {
  if (before === after) return others;
  if (before.joints.length !== after.joints.length) return NONE;
  const isSame = (j: number) => {
    const [was, now] = [before.joints[j], after.joints[j]];
    return was !== undefined && (was.name === now.name || was.offset === now.offset);
  };
  return others.every(isSame) ? others : NONE;
}
