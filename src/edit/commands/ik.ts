/**
 * A character's IK settings (`model/ik.ts`): pins, stiff or locked joints, and whether the root may move. These
 * commands move nothing; dragging then uses `pose.setDofs`.
 */

import { ikOf, reachOfSkeleton } from '../../evaluate/ik/set-up.ts';
import type { Character, Document } from '../../model/document.ts';
import { defaultIk, type IkSetup, type Pin, type StiffJoint } from '../../model/ik.ts';
import { jointName } from '../../model/skeleton/joint-name.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { indexIn } from '../arguments.ts';
import { changeCharacter, requireCharacter } from '../characters.ts';
import { command } from '../command.ts';
import { CommandError } from '../command-error.ts';
import { boolean, either, index, number, oneOf, optional } from '../schema/shape.ts';
import { CHARACTER, indices, vector } from '../schema/shared-shapes.ts';
import { characterIn, jointIn } from '../step-names.ts';

/** Appends a pin. Refuses a point that is already pinned. */
export const pinPoint = command({
  id: 'ik.pin',
  args: {
    ...CHARACTER,
    /** Index. */
    joint: index,
    /** In the joint's space. */
    point: vector,
    /** Greater than 0; default 1. */
    weight: optional(number),
    /** Default false. */
    holdsOrientation: optional(boolean),
  },
  label: (document, { characterId, joint }) => `Pin ${jointIn(requireCharacter(document, characterId), joint)}`,
  run: (document, { characterId, joint, point, weight = 1, holdsOrientation = false }) =>
    change(document, characterId, (ik, skeleton) => {
      const pin: Pin = {
        id: 1 + ik.pins.reduce((most, { id }) => Math.max(most, id), 0),
        joint: indexIn(joint, 0, skeleton.joints.length, 'joint'),
        point,
        weight: checkedWeight(weight),
        holdsOrientation,
      };
      refuseDouble(pin, ik.pins, skeleton);
      return { ...ik, pins: [...ik.pins, pin] };
    }),
});

/** Removes pins, by id. Refuses ids that the character has no pin of. */
export const unpin = command({
  id: 'ik.unpin',
  args: {
    ...CHARACTER,
    /** Ids. */
    pins: indices,
  },
  label: (document, { characterId, pins }) => `Unpin ${pinnedNames(requireCharacter(document, characterId), pins)}`,
  run: (document, { characterId, pins }) =>
    change(document, characterId, (ik) => {
      const gone = new Set(pins.map((id) => requirePin(ik, id).id));
      return gone.size ? { ...ik, pins: ik.pins.filter(({ id }) => !gone.has(id)) } : ik;
    }),
});

/** Removes all pins of a character. */
export const clearPins = command({
  id: 'ik.clearPins',
  args: CHARACTER,
  label(document, { characterId }) {
    const { length } = ikOf(requireCharacter(document, characterId)).pins;
    return `Remove ${length === 1 ? '1 pin' : `${length} pins`} of ${characterIn(document, characterId)}`;
  },
  run: (document, { characterId }) =>
    change(document, characterId, (ik) => (ik.pins.length ? { ...ik, pins: [] } : ik)),
});

/**
 * Changes a pin: its weight, orientation, joint or point. Refuses a point that another pin of the joint already holds.
 */
export const setPin = command({
  id: 'ik.setPin',
  args: {
    ...CHARACTER,
    /** Id of the pin, which it keeps. */
    pin: index,
    /** Omitted ones are not changed. */
    weight: optional(number),
    holdsOrientation: optional(boolean),
    joint: optional(index),
    /** In the joint's space; for another joint the same numbers are a point of that one. */
    point: optional(vector),
  },
  label(document, { characterId, pin, weight, holdsOrientation, joint, point }) {
    const name = pinnedNames(requireCharacter(document, characterId), [pin]);
    if (joint !== undefined || point !== undefined) return `Move pin of ${name}`;
    if (holdsOrientation !== undefined && weight === undefined) {
      return holdsOrientation ? `Pin orientation of ${name}` : `Unpin orientation of ${name}`;
    }
    return `Set pin of ${name}`;
  },
  run: (document, { characterId, pin: id, weight, holdsOrientation, joint, point }) =>
    change(document, characterId, (ik, skeleton) => {
      const before = requirePin(ik, id);
      const after: Pin = {
        ...before,
        ...(weight !== undefined && { weight: checkedWeight(weight) }),
        ...(holdsOrientation !== undefined && { holdsOrientation }),
        ...(joint !== undefined && { joint: indexIn(joint, 0, skeleton.joints.length, 'joint') }),
        ...(point !== undefined && { point }),
      };
      if (samePin(before, after)) return ik;
      const others = ik.pins.filter((other) => other !== before);
      if (joint !== undefined || point !== undefined) refuseDouble(after, others, skeleton);
      return { ...ik, pins: ik.pins.map((other) => (other === before ? after : other)) };
    }),
});

/** Sets how far joints resist bending in IK, or locks them. Affects dragging, not the pose. */
export const setStiffness = command({
  id: 'ik.setStiffness',
  args: {
    ...CHARACTER,
    /** Indices. */
    joints: indices,
    /** 1 is the default, 4 moves half as far for the same error; at least 1. */
    stiffness: either(number, oneOf(['locked', 'usual'])),
  },
  label(document, { characterId, joints, stiffness }) {
    const verb = stiffness === 'locked' ? 'Lock' : stiffness === 'usual' || stiffness === 1 ? 'Unlock' : 'Stiffen';
    return `${verb} ${jointNames(requireCharacter(document, characterId), joints)}`;
  },
  run: (document, { characterId, joints, stiffness }) =>
    change(document, characterId, (ik, skeleton) => {
      const how = checkedStiffness(stiffness);
      const chosen = new Set(joints.map((joint) => indexIn(joint, 0, skeleton.joints.length, 'joint')));
      const stiff = ik.stiff.filter(({ joint }) => !chosen.has(joint));
      if (how !== 'usual')
        for (const joint of chosen) stiff.push({ joint, ...(how !== 'locked' && { stiffness: how }) });
      stiff.sort((a, b) => a.joint - b.joint);
      return sameStiffness(stiff, ik.stiff) ? ik : { ...ik, stiff };
    }),
});

/** Whether root translation takes part. */
export const setRootFree = command({
  id: 'ik.setRootFree',
  args: {
    ...CHARACTER,
    isFree: boolean,
  },
  label: (document, { characterId, isFree }) =>
    `${isFree ? 'Allow root of' : 'Keep root of'} ${characterIn(document, characterId)} ${isFree ? 'to move' : 'in place'}`,
  run: (document, { characterId, isFree }) =>
    change(document, characterId, (ik) => (isFree === ik.rootIsFree ? ik : { ...ik, rootIsFree: isFree })),
});

/** The character with other settings; without any if they are the defaults. */
function change(document: Document, characterId: string, make: (ik: IkSetup, skeleton: Skeleton) => IkSetup): Document {
  return changeCharacter(document, characterId, (character) => {
    const { skeleton, ik: _before, ...rest } = character;
    if (!skeleton) throw new CommandError(`${character.name} has no skeleton, so there is nothing to pin.`);
    const before = ikOf(character);
    const after = make(before, skeleton);
    if (after === before) return character;
    return isDefault(after, skeleton) ? { ...rest, skeleton } : { ...character, ik: after };
  });
}

function isDefault({ pins, stiff, rootIsFree }: IkSetup, skeleton: Skeleton): boolean {
  return pins.length === 0 && stiff.length === 0 && rootIsFree === defaultIk(skeleton).rootIsFree;
}

/** Points of a joint closer than this fraction of the character's reach are the same. */
const SAME_POINT = 1e-6;

function refuseDouble({ joint, point }: Pin, others: readonly Pin[], skeleton: Skeleton): void {
  const near = SAME_POINT * reachOfSkeleton(skeleton);
  const there = others.some(
    (other) => other.joint === joint && Math.hypot(...point.map((p, k) => p - other.point[k])) <= near,
  );
  if (there) throw new CommandError(`That point of ${jointName(skeleton, joint)} is already pinned.`);
}

/** Throws if no pin has this id. */
export function requirePin({ pins }: Pick<IkSetup, 'pins'>, id: unknown): Pin {
  const pin = pins.find((p) => p.id === id);
  if (!pin)
    throw new CommandError(`There is no pin ${String(id)}; there are ${pins.map((p) => p.id).join(', ') || 'none'}.`);
  return pin;
}

function checkedWeight(weight: number): number {
  if (weight > 0) return weight;
  throw new CommandError(`The weight of a pin must be greater than 0, found ${weight}.`);
}

function checkedStiffness(stiffness: number | 'locked' | 'usual'): number | 'locked' | 'usual' {
  if (stiffness === 1) return 'usual';
  if (typeof stiffness === 'string' || stiffness > 1) return stiffness;
  throw new CommandError(`"stiffness" must be 1 (the default) or more, found ${stiffness}.`);
}

function samePin(a: Pin, b: Pin): boolean {
  const samePoint = a.point.every((part, k) => part === b.point[k]);
  return samePoint && a.joint === b.joint && a.weight === b.weight && a.holdsOrientation === b.holdsOrientation;
}

function sameStiffness(a: readonly StiffJoint[], b: readonly StiffJoint[]): boolean {
  return a.length === b.length && a.every((one, i) => one.joint === b[i].joint && one.stiffness === b[i].stiffness);
}

/** `foot_l`, `2 pins`; for labels, so it also handles missing pins. */
export function pinnedNames(character: Character, ids: readonly number[]): string {
  const pinned = ikOf(character).pins.filter(({ id }) => ids.includes(id));
  if (pinned.length === 1) return jointIn(character, pinned[0].joint);
  return `${pinned.length} points`;
}

function jointNames(character: Character, joints: readonly number[]): string {
  return joints.length === 1 ? jointIn(character, joints[0]) : `${joints.length} joints`;
}
