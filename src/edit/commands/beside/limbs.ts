/**
 * Limbs of a character, and their goals in the shown take. Limbs are saved in its `.limbs.json`, beside the skeleton;
 * goals in that of the take. Keys of goals are edited as those of any channel (`channel-edits.ts`).
 */
import { provideLayers } from '../../../evaluate/layers.ts';
import { goalProblems } from '../../../evaluate/limbs/over-pose.ts';
import { currentValues, GOAL_OF, goalValues, matchValues, POLE_OF } from '../../../evaluate/limbs/posed.ts';
import { type Character, type Document, shownTake } from '../../../model/document.ts';
import { limbProblem } from '../../../model/limb-problems.ts';
import type { Limb } from '../../../model/limbs.ts';
import { characterDofs } from '../../../model/skeleton/dofs.ts';
import { jointName } from '../../../model/skeleton/joint-name.ts';
import type { Skeleton } from '../../../model/skeleton/skeleton.ts';
import { firstGoalChannel, spaceAt, withGoals } from '../../../model/takes/goals.ts';
import { GOAL_CHANNELS, type GoalChannel } from '../../../model/takes/take.ts';
import { indexIn } from '../../arguments.ts';
import { changeCharacter, requireCharacter } from '../../characters.ts';
import { command } from '../../command.ts';
import { CommandError } from '../../command-error.ts';
import { cutName } from '../../cut-name.ts';
import { sameValue } from '../../delta.ts';
import { refuseLayers } from '../../layers/refuse-layers.ts';
import { goalOfLimb, keyedGoal, matchOfLimb, newGoal, switched, withGoal } from '../../limbs/change-goals.ts';
import { solvedTake } from '../../limbs/flatten-goals.ts';
import { isMirrorOf, mirroredLimb, nameOnOtherSide, proposedBend } from '../../limbs/propose.ts';
import { inSpace, inSpaceFrom } from '../../limbs/spaces.ts';
import { refuseMoved } from '../../refuse-moved.ts';
import { freeName } from '../../rig/names.ts';
import { boolean, filledText, index, number, oneOf, optional, record, text, tuple } from '../../schema/shape.ts';
import { CHARACTER, indices, NOW, range, vector } from '../../schema/shared-shapes.ts';
import { requireTake, withChannels, withTake } from '../../takes.ts';
import { unkeyedAt, withoutUnkeyed, withUnkeyed } from '../../unkeyed.ts';

/** A limb by its index. */
const LIMB = { ...CHARACTER, limb: index } as const;
/** At a time; the range is that of a take that has to be made. */
const LIMB_NOW = { ...NOW, limb: index, playedRange: optional(range) } as const;
/** The rotation DOF of the middle joint that bends, and to which side. */
const bend = optional(record({ dof: text, sign: oneOf([1, -1]) }));
const SETTINGS = { name: optional(filledText), tip: optional(vector), bend, orient: optional(boolean) } as const;

/** Makes a limb of a chain of joints: its last one can then go to a goal while a take plays. */
export const addLimb = command({
  id: 'limbs.add',
  args: {
    ...CHARACTER,
    /** Indices, each the parent of the next. */
    joints: indices,
    /** Default: that of the last joint. `bend` is proposed by the bones. */
    ...SETTINGS,
    /** Adds the limb of the other side, too. */
    mirrored: optional(boolean),
  },
  label(document, { characterId, joints, mirrored, name = lastName(document, characterId, joints) }) {
    const { skeleton } = requireCharacter(document, characterId);
    const other = mirrored && skeleton && nameOnOtherSide(skeleton, { name, joints });
    return other ? `Add limbs ${cutName(name)} and ${cutName(other)}` : `Add limb ${cutName(name)}`;
  },
  run: (document, { characterId, joints, mirrored = false, ...given }) =>
    changeLimbs(document, characterId, (list, skeleton) => {
      for (const joint of joints) indexIn(joint, 0, skeleton.joints.length, 'joint');
      refuseTaken(list, joints, skeleton);
      const name = given.name ?? freeName(namesOf(list), lastName(document, characterId, joints));
      const limb = sound({ ...limbOf(skeleton, { joints, name, ...given }) }, skeleton, list);
      if (!mirrored) return [...list, limb];
      const other = mirroredLimb(skeleton, limb, namesOf([...list, limb]));
      if (!other) throw new CommandError(`A joint of ${cutName(name)} has no counterpart on the other side.`);
      return [...list, limb, sound(other, skeleton, [...list, limb])];
    }),
});

/** Changes a limb: its name, joints, tip, bend, or whether it takes the goal's rotation. */
export const changeLimb = command({
  id: 'limbs.change',
  args: {
    ...LIMB,
    /** Omitted ones are not changed. */
    joints: optional(indices),
    ...SETTINGS,
  },
  label: (document, { name, ...of }) =>
    name === undefined ? `Change limb ${limbIn(document, of)}` : `Rename limb ${limbIn(document, of)}`,
  run: (document, { characterId, limb: at, ...given }) =>
    changeLimbs(document, characterId, (list, skeleton) => {
      const before = list[indexIn(at, 0, list.length, 'limb')];
      for (const joint of given.joints ?? []) indexIn(joint, 0, skeleton.joints.length, 'joint');
      const set = Object.fromEntries(Object.entries(given).filter(([, value]) => value !== undefined));
      const { bend: was, ...rest } = { ...before, ...set };
      const kept = given.joints && !given.bend ? rest : { ...rest, bend: was && { ...before.bend, ...was } };
      return list.with(at, sound(limbOf(skeleton, kept), skeleton, list.toSpliced(at, 1)));
    }),
});

/** Removes a limb, and its goals in all takes: FK moves its joints again. */
export const removeLimb = command({
  id: 'limbs.remove',
  args: LIMB,
  label: (document, of) => `Remove limb ${limbIn(document, of)}`,
  run: (document, { characterId, limb }) =>
    changeLimbs(document, characterId, (list) => list.toSpliced(indexIn(limb, 0, list.length, 'limb'), 1)),
});

/**
 * Keys the goal of a limb at a time: its place, rotation, pole, and share of IK, as given. Without any of them, goal
 * and pole as they are. A limb without a goal gets one, of the pose that is shown.
 */
export const keyLimb = command({
  id: 'limbs.key',
  args: {
    ...LIMB_NOW,
    /** tx ty tz rx ry rz, in the goal's space. */
    goal: optional(tuple(...GOAL_OF)),
    /** A point to whose side the limb bends. */
    pole: optional(vector),
    /** From 0, FK, to 1, IK. */
    blend: optional(number),
    /** From this time on: `world`, `parent`, or a joint. The limb doesn't jump. */
    space: optional(filledText),
  },
  label: (document, of) => `Key limb ${limbIn(document, of)}`,
  run: (document, { goal: place, pole, blend, space, timeSeconds, ...of }) =>
    changeGoal(document, { ...of, timeSeconds }, (character, limb) => {
      const known = goalOfLimb(requireTake(character), limb);
      const now = known ?? newGoal(limb);
      const match = matchOfLimb(character, limb, now, timeSeconds);
      const asShown = matchValues(now, limb, match, false);
      const isBare = (place ?? pole ?? blend ?? space) === undefined;
      // It goes into the other space from where it was dragged to.
      const time = timeSeconds + character.timeOffsetSeconds;
      const isOtherSpace = known !== undefined && space !== undefined && spaceAt(known, time) !== space;
      const isMovedByHand = isOtherSpace && withoutByHand(character, goalIndex(character, limb)) !== character;
      const values = new Map<GoalChannel, number>([
        ...(known ? (isBare || isMovedByHand ? currentValues(known, match) : []) : asShown),
        ...(place ? goalValues(GOAL_OF, place) : []),
        ...(pole ? goalValues(POLE_OF, pole) : []),
        ...(blend === undefined ? [] : ([['blend', blend]] as const)),
      ]);
      const keyed = keyedGoal(now, values, time);
      const next = withGoal(character, keyed);
      return space === undefined ? next : withGoal(next, inSpaceFrom(next, limb, keyed, space, timeSeconds));
    }),
});

/** Switches a limb between FK and IK at a time. It doesn't jump, and moves as before up to then. */
export const switchLimb = command({
  id: 'limbs.switch',
  args: { ...LIMB_NOW, to: oneOf(['ik', 'fk']) },
  label: (document, { to, ...of }) => `Switch ${limbIn(document, of)} to ${to.toUpperCase()}`,
  run: (document, { to, timeSeconds, ...of }) =>
    changeGoal(document, { ...of, timeSeconds }, (character, limb) => {
      const isFk = !goalOfLimb(requireTake(character), limb);
      return isFk && to === 'fk' ? character : switched(character, limb, to, timeSeconds);
    }),
});

/** Puts a goal and its pole into another space for all times; its keys stay where they are. */
export const setLimbSpace = command({
  id: 'limbs.setSpace',
  args: {
    ...LIMB_NOW,
    /** `world`, `parent`, or a joint by name or `#index`. */
    space: filledText,
  },
  label: (document, { space, ...of }) => `Put ${limbIn(document, of)} into the space of ${cutName(space)}`,
  run: (document, { space, timeSeconds, ...of }) =>
    changeGoal(document, { ...of, timeSeconds }, (character, limb) => {
      const goal = goalOfLimb(requireTake(character), limb);
      if (!goal) throw new CommandError(`${limb.name} has no goal in this take. Switch it to IK first.`);
      return withGoal(character, inSpace(character, limb, goal, space, timeSeconds));
    }),
});

/**
 * Replaces the goals of the shown take by keys of the limbs' joints at whole frames: it moves the same in FK.
 * Attachments stay.
 */
export const flattenLimbs = command({
  id: 'limbs.flatten',
  args: CHARACTER,
  label: (document, { characterId }) =>
    `Flatten limbs of ${cutName(shownTake(requireCharacter(document, characterId))?.name ?? 'take')}`,
  run: (document, { characterId }) =>
    changeCharacter(document, characterId, (character) => {
      refuseMoved(character);
      const take = requireTake(character);
      if (!take.goals) throw new CommandError(`${take.name} has no goals of limbs.`);
      refuseLayers(take, ['layers']);
      const flat = solvedTake(character, take, { keepsAttachments: true });
      return withTake(withoutUnkeyed(character), character.shownTake, flat);
    }),
});

type GivenLimb = Pick<Limb, 'joints' | 'name'> & Partial<Limb>;

/** With what is left out proposed, or as in files. */
function limbOf(
  skeleton: Skeleton,
  { joints, name, tip = [0, 0, 0], orient = false, bend: how, ...rest }: GivenLimb,
): Limb {
  const limb = { ...rest, name, joints, tip, orient };
  const isChain = joints.every((joint, k) => k === 0 || skeleton.joints[joint].parent === joints[k - 1]);
  const bends = how ?? (isChain ? proposedBend(skeleton, limb) : undefined);
  return bends ? { ...limb, bend: bends } : limb;
}

/** @throws CommandError if the limb is no chain, shares a joint or a name with another, or can't bend so */
function sound(limb: Limb, skeleton: Skeleton, others: readonly Limb[]): Limb {
  if (others.some(({ name }) => name === limb.name)) {
    throw new CommandError(`Another limb is called "${cutName(limb.name)}".`);
  }
  const problem = limbProblem(limb, skeleton, others);
  if (!problem) return limb;
  throw new CommandError(problem.message);
}

/** Refuses joints that belong to a limb, before another one has a name. */
function refuseTaken(list: readonly Limb[], joints: readonly number[], skeleton: Skeleton): void {
  const owner = list.find((limb) => limb.joints.some((joint) => joints.includes(joint)));
  if (!owner) return;
  const name = cutName(owner.name);
  if (!sameValue(owner.joints, joints)) {
    const shared = owner.joints.find((joint) => joints.includes(joint)) ?? 0;
    throw new CommandError(`${jointName(skeleton, shared)} already belongs to the limb ${name}.`);
  }
  const mirror = list.find((limb) => isMirrorOf(skeleton, limb, owner));
  throw new CommandError(`${name} is a limb already${mirror ? `, as is its mirror, ${cutName(mirror.name)}` : ''}.`);
}

/** The character with other limbs, and with the goals in its takes called as they are; none rather than no limbs. */
function changeLimbs(
  document: Document,
  characterId: string,
  make: (list: readonly Limb[], skeleton: Skeleton) => readonly Limb[],
): Document {
  provideLayers();
  return changeCharacter(document, characterId, (character) => {
    const { skeleton, limbs } = character;
    if (!skeleton) throw new CommandError(`${character.name} has no skeleton, so it has no joints for limbs.`);
    const before = limbs?.list ?? [];
    const list = make(before, skeleton);
    if (sameValue(list, before)) return character;
    const isKept = list.length > 0 || limbs?.others !== undefined || character.parts?.limbs?.file !== undefined;
    const takes = character.takes.map((take) => {
      const goals = take.goals?.list;
      if (!goals) return take;
      const kept = goals.flatMap((goal) => {
        const at = before.findIndex(({ name }) => name === goal.limb);
        if (at < 0) return [goal];
        // One limb is changed, added or removed at a time, and stays in its place.
        const now = list.length < before.length ? list.find(({ name }) => name === goal.limb) : list[at];
        return now ? [now.name === goal.limb ? goal : { ...goal, limb: now.name }] : [];
      });
      return kept.length === goals.length && kept.every((goal, i) => goal === goals[i]) ? take : withGoals(take, kept);
    });
    const isSame = takes.every((take, i) => take === character.takes[i]);
    const { limbs: _before, ...rest } = isSame ? character : withoutByHand(character);
    const now: Character = isSame ? rest : { ...rest, takes };
    return isKept ? { ...now, limbs: { ...limbs, list } } : now;
  });
}

interface OfGoal {
  readonly characterId: string;
  readonly limb: number;
  readonly timeSeconds: number;
  readonly playedRange?: readonly [number, number];
}

/** The character with another goal of a limb in its shown take, which is made if there is none. */
function changeGoal(
  document: Document,
  { characterId, limb, timeSeconds, playedRange }: OfGoal,
  change: (character: Character, limb: Limb) => Character,
): Document {
  provideLayers();
  return changeCharacter(document, characterId, (character) => {
    const list = character.limbs?.list ?? [];
    const one = list[indexIn(limb, 0, list.length, 'limb')];
    refuseMoved(character);
    const { timeOffsetSeconds: offset } = character;
    const [start, end] = playedRange ?? [Math.min(0, timeSeconds), Math.max(1, timeSeconds)];
    const taking = withChannels(character, [start + offset, end + offset]);
    const next = change(taking, one);
    if (next === taking) return character;
    const { skeleton, limbs } = next;
    const goals = shownTake(next)?.goals;
    const at = goalIndex(next, one);
    const problem = skeleton && limbs && goals && goalProblems(goals, limbs, skeleton).find(({ goal }) => goal === at);
    if (problem) throw new CommandError(`${cutName(one.name)}: ${problem.message}`);
    return withoutByHand(next, at);
  });
}

function goalIndex(character: Character, { name }: Limb): number {
  return shownTake(character)?.goals?.list.findIndex(({ limb }) => limb === name) ?? -1;
}

/** The character without unkeyed values of a goal, which is another one now; default: of all of them. */
function withoutByHand(character: Character, goal?: number): Character {
  const { unkeyed, skeleton, morphs } = character;
  if (!unkeyed) return character;
  const count = characterDofs(skeleton, morphs).length;
  const first = firstGoalChannel(count, goal ?? 0);
  const end = goal === undefined ? Infinity : first + GOAL_CHANNELS.length;
  const left = [...unkeyedAt(character, unkeyed.timeSeconds)].filter(([dof]) => dof < first || dof >= end);
  return withUnkeyed(character, unkeyed.timeSeconds, new Map(left));
}

function namesOf(list: readonly Limb[]): ReadonlySet<string> {
  return new Set(list.map(({ name }) => name));
}

function lastName(document: Document, characterId: string, joints: readonly number[]): string {
  const last = joints[joints.length - 1] ?? -1;
  return requireCharacter(document, characterId).skeleton?.joints[last]?.name || 'limb';
}

function limbIn(
  document: Document,
  { characterId, limb }: { readonly characterId: string; readonly limb: number },
): string {
  return cutName(requireCharacter(document, characterId).limbs?.list[limb]?.name ?? String(limb));
}
