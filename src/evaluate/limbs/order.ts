/** The order in which limbs are solved: each after those that move its parent or one of its spaces. */
import type { Limb } from '../../model/limbs.ts';
import { couplesOf } from '../../model/skeleton/couples.ts';
import { firstDofs } from '../../model/skeleton/dofs.ts';
import { jointReferred } from '../../model/skeleton/joint-reference.ts';
import { dofsOf } from '../../model/skeleton/joint-types.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { PARENT_SPACE, spacesOf, WORLD_SPACE } from '../../model/takes/goals.ts';
import type { GoalProblem } from '../../model/takes/layer-code.ts';
import type { Goal, Goals } from '../../model/takes/take.ts';

/** A goal with what it refers to. */
export interface GoalOfLimb {
  readonly goal: Goal;
  /** Its place among the goals of the take. */
  readonly index: number;
  readonly limb: Limb;
  /** The joint of each of its spaces; -1 for the character's own. */
  readonly spaces: readonly number[];
  /** DOFs that follow those of the limb. */
  readonly followers: readonly number[];
}

/** Goals in the order in which they are solved, and those that are not solved. */
export interface GoalOrder {
  readonly ordered: readonly GoalOfLimb[];
  readonly problems: readonly GoalProblem[];
}

/** Orders the goals of a take for the limbs of a skeleton. */
export function orderedGoals({ list }: Goals, limbs: readonly Limb[], skeleton: Skeleton): GoalOrder {
  const problems: GoalProblem[] = [];
  const found = list.flatMap((goal, index): GoalOfLimb[] => {
    const limb = limbs.find(({ name }) => name === goal.limb);
    if (!limb) {
      const message = `there is no limb "${goal.limb}".`;
      problems.push({ code: 'goal-without-limb', goal: index, path: 'limb', message });
      return [];
    }
    const spaces = jointsOfSpaces(goal, limb, skeleton);
    const unknown = spaces.indexOf(undefined);
    if (unknown >= 0) {
      const name = spacesOf(goal)[unknown][1];
      const path = typeof goal.space === 'string' ? 'space' : `space[${unknown}]`;
      const message = `${skeleton.name} has no joint "${name}".`;
      problems.push({ code: 'limb-joint-unknown', goal: index, path, message });
      return [];
    }
    const known = spaces.flatMap((joint) => joint ?? []);
    return [{ goal, index, limb, spaces: known, followers: followersOf(limb, skeleton) }];
  });
  const left = [...found].sort((a, b) => limbs.indexOf(a.limb) - limbs.indexOf(b.limb));
  const ordered: GoalOfLimb[] = [];
  while (left.length > 0) {
    const next = left.findIndex((one) => !left.some((other) => waitsFor(one, other, skeleton)));
    if (next < 0) {
      problems.push(ring(left));
      break;
    }
    ordered.push(...left.splice(next, 1));
  }
  return { ordered, problems };
}

/** @param left the goals that wait for each other, or for such */
function ring(left: readonly GoalOfLimb[]): GoalProblem {
  const [{ goal, index }] = left;
  const why =
    left.length === 1
      ? `the goal of ${goal.limb} is in a space that ${goal.limb} moves`
      : `the goals of ${left.map((one) => one.goal.limb).join(', ')} wait for each other`;
  return { code: 'limb-cycle', goal: index, path: 'space', message: `${why}.` };
}

/** Undefined for joints that there are not. */
function jointsOfSpaces(goal: Goal, { joints }: Limb, skeleton: Skeleton): readonly (number | undefined)[] {
  const indexOf = jointReferred(skeleton.joints);
  return spacesOf(goal).map(([, name]) => {
    if (name === WORLD_SPACE) return -1;
    return name === PARENT_SPACE ? skeleton.joints[joints[0]].parent : indexOf(name);
  });
}

/** Whether a limb is solved after another, which may be itself: that moves what it is attached to, or a space. */
function waitsFor({ limb, spaces }: GoalOfLimb, other: GoalOfLimb, skeleton: Skeleton): boolean {
  const { joints } = skeleton;
  const first = firstDofs(skeleton);
  const jointOf = (dof: number) => first.findLastIndex((own) => own <= dof);
  const moved = new Set([...other.limb.joints, ...other.followers.map(jointOf)]);
  const isMoved = (from: number) => {
    for (let j = from; j >= 0; j = joints[j].parent) if (moved.has(j)) return true;
    return false;
  };
  return isMoved(joints[limb.joints[0]].parent) || spaces.some(isMoved);
}

/** All DOFs that follow the limb's, directly or through others, in the order in which they are computed. */
function followersOf({ joints }: Limb, skeleton: Skeleton): readonly number[] {
  const first = firstDofs(skeleton);
  const moved = new Set(joints.flatMap((j) => dofsOf(skeleton.joints[j].motion).map((_, k) => first[j] + k)));
  return couplesOf(skeleton).ordered.flatMap(({ dof, follows }) => {
    if (!moved.has(follows)) return [];
    moved.add(dof);
    return [dof];
  });
}
