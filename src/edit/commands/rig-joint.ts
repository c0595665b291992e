/** Properties of one joint of a skeleton: name, offset, motion, box, bone and file pose. */

import type { Vec3 } from '../../math/vec3.ts';
import type { Character, Document } from '../../model/document.ts';
import type { Pin } from '../../model/ik.ts';
import { tipOf } from '../../model/skeleton/bone-ends.ts';
import { firstDofs } from '../../model/skeleton/dofs.ts';
import { dofsOf, positionsOf, turnsJoint } from '../../model/skeleton/joint-types.ts';
import type { Joint, Motion, Skeleton } from '../../model/skeleton/skeleton.ts';
import { indexIn } from '../arguments.ts';
import { changeCharacter, requireCharacter } from '../characters.ts';
import { command } from '../command.ts';
import { CommandError } from '../command-error.ts';
import { cutName, SHORT_NAME } from '../cut-name.ts';
import { calledIn, findJoint, rigged, withJoint } from '../rig/apply.ts';
import { changedJoints, type JointMap } from '../rig/joint-map.ts';
import { lostKeys } from '../rig/lost-keys.ts';
import { checkedMotion, motion } from '../rig/motion-shape.ts';
import { intoSpace, localPivot, turnedAs, withPivots } from '../rig/places.ts';
import { restAtOffsets } from '../rig/remap-skin.ts';
import type { OfJoint } from '../rig/rigging.ts';
import { requireSkeleton, type ShownPose, shownAt } from '../rig/shown.ts';
import { index, nullable, number, oneOf, optional, record, text } from '../schema/shape.ts';
import { JOINT, RIGGING, vector } from '../schema/shared-shapes.ts';
import { characterIn } from '../step-names.ts';

/** Renames a joint; names may repeat. */
export const renameJoint = command({
  id: 'rig.rename',
  args: {
    ...JOINT,
    /** May be empty. */
    name: text,
  },
  label(document, { characterId, joint, name }) {
    const before = calledIn(document, characterId, joint, name ? SHORT_NAME : undefined);
    return name ? `Rename ${before} to ${cutName(name, SHORT_NAME)}` : `Clear name of ${before}`;
  },
  run: (document, args) =>
    withJoint(document, args, (joint) => (joint.name === args.name ? joint : { ...joint, name: args.name })),
});

/**
 * Sets a joint's pivot in its parent's space. BVH position channels that replace the offset move by the same amount.
 * With fixed children, these and End Sites keep their positions in the displayed pose.
 */
export const setOffset = command({
  id: 'rig.setOffset',
  args: {
    ...JOINT,
    offset: vector,
    /** Whether descendants move along, or stay in place in the displayed pose. */
    children: oneOf(['follow', 'stay']),
  },
  label: (document, { characterId, joint }) => `Move ${calledIn(document, characterId, joint)}`,
  run(document, args) {
    const { characterId, joint: index, offset, children, timeSeconds = 0 } = args;
    const { character, skeleton, joint } = findJoint(document, characterId, index);
    if (same(offset, joint.offset)) return document;
    if (children === 'follow') return withJoint(document, args, (own) => ({ ...own, offset }));
    const shown = shownAt(character, timeSeconds);
    const by: Vec3 = [offset[0] - joint.offset[0], offset[1] - joint.offset[1], offset[2] - joint.offset[2]];
    const ends = joint.endSites && endsStaying(shown, joint, index, by);
    const pivots = new Map<number, Vec3>();
    skeleton.joints.forEach(({ parent }, j) => {
      if (parent === index) pivots.set(j, localPivot(shown, j));
    });
    return withJoint(
      document,
      args,
      (own) => ({ ...own, offset, ...(ends && { endSites: ends }) }),
      (next) => withPivots(next, characterId, pivots, timeSeconds),
    );
  },
});

/**
 * End Sites moved in the opposite direction, so that they stay in place while their joint moves by this vector in its
 * parent's space.
 */
function endsStaying(shown: ShownPose, joint: Joint, index: number, by: Vec3): readonly Vec3[] {
  const { world } = shown;
  const o = 16 * joint.parent;
  const along = (r: number) =>
    joint.parent < 0 ? by[r] : world[o + r] * by[0] + world[o + 4 + r] * by[1] + world[o + 8 + r] * by[2];
  const [x, y, z] = intoSpace(index, shown, [along(0), along(1), along(2)]);
  return (joint.endSites ?? []).map((end): Vec3 => [end[0] - x, end[1] - y, end[2] - z]);
}

/**
 * Changes how a joint moves. DOFs that both motions have (`rig/same-dof.ts`) keep pose, limits, channels and links. If
 * none of these rotates the joint, the new DOFs keep its rotation in the displayed pose, if they can do so exactly. The
 * label says which keys are lost with removed DOFs.
 */
export const setMotion = command({
  id: 'rig.setMotion',
  args: {
    ...JOINT,
    motion,
  },
  label(document, args) {
    const lost = keysLostBy(document, args);
    const name = calledIn(document, args.characterId, args.joint, lost === undefined ? undefined : SHORT_NAME);
    return `Set type of ${name}${lost === undefined ? '' : `, losing ${lost}`}`;
  },
  run(document, args) {
    const { characterId, joint: index, motion, timeSeconds: seconds = 0 } = args;
    const { character, skeleton, joint } = findJoint(document, characterId, index);
    if (sameMotion(motion, joint.motion)) return document;
    const map = withMotion(skeleton, index, motion);
    return rigged(document, args, map, index, (next) => {
      const turned = turnsAnew(map, index)
        ? turnedAs(next, character, shownAt(character, seconds), index, index, seconds)
        : next;
      // A position that replaced the offset is absolute, not a displacement from it.
      if (index === 0 || positionsOf(joint.motion) !== 'replace' || positionsOf(motion) === 'replace') return turned;
      const pivot = localPivot(shownAt(character, seconds), index);
      return withPivots(turned, characterId, new Map([[index, pivot]]), seconds);
    });
  },
});

function withMotion(skeleton: Skeleton, index: number, motion: Motion): JointMap {
  return changedJoints(
    skeleton,
    skeleton.joints.map((one, j) => (j === index ? { ...one, motion } : one)),
  );
}

/** Keys that the takes lose by this change of motion: `3 keys of r`. Undefined if nothing. */
export function keysLostBy(
  document: Document,
  { characterId, joint, motion }: Pick<OfJoint, 'characterId' | 'joint'> & { readonly motion: Motion },
): string | undefined {
  const { character, skeleton } = findJoint(document, characterId, joint);
  return lostKeys(character, withMotion(skeleton, joint, checkedMotion(motion)), joint);
}

/** Whether all DOFs that rotate a joint are new. */
function turnsAnew({ after, dofs }: JointMap, index: number): boolean {
  const { motion } = after.joints[index];
  const first = firstDofs(after)[index];
  return dofsOf(motion).every((dof, d) => !turnsJoint(dof) || dofs[first + d].from < 0);
}

/** The box drawn for a joint, in its own space; min > max occurs in files and is accepted here too. */
export const setBox = command({
  id: 'rig.setBox',
  args: {
    ...JOINT,
    box: record({ min: vector, max: vector }),
  },
  label: (document, { characterId, joint }) => `Set box of ${calledIn(document, characterId, joint)}`,
  run(document, args) {
    const { box } = args;
    return withJoint(document, args, (joint) =>
      same(joint.box.min, box.min) && same(joint.box.max, box.max) ? joint : { ...joint, box },
    );
  },
});

/** The length of a joint's own bone, along its +y. Children at its tip move with it, and so do pins there. */
export const setLength = command({
  id: 'rig.setLength',
  args: {
    ...JOINT,
    /** Null removes its own bone. */
    length: nullable(number),
  },
  label: (document, { characterId, joint }) => `Set bone of ${calledIn(document, characterId, joint)}`,
  run(document, args) {
    const { characterId, joint: index, length } = args;
    const { skeleton, joint } = findJoint(document, characterId, index);
    if (length !== null && length < 0) {
      throw new CommandError(`A length must be 0 or more, found ${length}.`);
    }
    if ((length ?? undefined) === joint.length) return document;
    const tip = tipOf(joint);
    const { length: _before, ...rest } = joint;
    const changed: Joint = length === null ? rest : { ...rest, length };
    const joints = skeleton.joints.map((one, j) => {
      if (j === index) return changed;
      const isAtTip = one.parent === index && tip !== undefined && length !== null && same(one.offset, tip);
      return isAtTip ? { ...one, offset: [0, length, 0] as const } : one;
    });
    return rigged(document, args, changedJoints(skeleton, joints), index, (next) => {
      // The tip of a bone of length 0 is the joint itself, which doesn't move.
      if (!joint.length || tip === undefined || length === null) return next;
      return changeCharacter(next, characterId, (character) => withPinsAt(character, index, tip, [0, length, 0]));
    });
  },
});

/** Moves a joint's pins from one of its points to another; if two would coincide, the first is kept. */
function withPinsAt(character: Character, joint: number, from: Vec3, to: Vec3): Character {
  const { ik } = character;
  const isThere = (pin: Pin, point: Vec3) => pin.joint === joint && same(pin.point, point);
  if (!ik?.pins.some((pin) => isThere(pin, from))) return character;
  const taken = ik.pins.some((pin) => isThere(pin, to));
  const pins = taken
    ? ik.pins.filter((pin) => !isThere(pin, from))
    : ik.pins.map((pin) => (isThere(pin, from) ? { ...pin, point: to } : pin));
  return { ...character, ik: { ...ik, pins } };
}

/**
 * Sets the file pose of one joint or all, from the displayed pose or from every DOF at rest. The display does not
 * change.
 */
export const setFilePose = command({
  id: 'rig.setFilePose',
  args: {
    ...RIGGING,
    /** Default: all joints. */
    joint: optional(index),
    from: oneOf(['shown', 'rest']),
  },
  label: (document, { characterId, joint }) =>
    joint === undefined
      ? `Set file pose of ${characterIn(document, characterId)}`
      : `Set file pose of ${calledIn(document, characterId, joint)}`,
  run(document, args) {
    const { characterId, joint: only } = args;
    const character = requireCharacter(document, characterId);
    const skeleton = requireSkeleton(character);
    if (only !== undefined) indexIn(only, 0, skeleton.joints.length, 'joint');
    const values = args.from === 'shown' ? shownAt(character, args.timeSeconds ?? 0).dofs : restAtOffsets(skeleton);
    const first = firstDofs(skeleton);
    const joints = skeleton.joints.map((joint, j) => {
      if (only !== undefined && j !== only) return joint;
      const pose = joint.pose.map((_, d) => values[first[j] + d]);
      return same(pose, joint.pose) ? joint : { ...joint, pose };
    });
    if (joints.every((joint, j) => joint === skeleton.joints[j])) return document;
    return rigged(document, args, changedJoints(skeleton, joints), only);
  },
});

function same(a: readonly number[], b: readonly number[]): boolean {
  return a.length === b.length && a.every((value, i) => Object.is(value, b[i]));
}

/** @param checked from `checkedMotion`, which has a fixed order of fields */
function sameMotion(checked: Motion, motion: Motion): boolean {
  return JSON.stringify(checked) === JSON.stringify(checkedMotion(motion));
}
