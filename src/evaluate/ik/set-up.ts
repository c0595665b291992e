/**
 * Builds the solver's input, pins and stiffness, from a character's IK settings (`model/ik.ts`) and what is dragged.
 * Done once at the start of a drag; then `movePin` is enough.
 *
 *     const targets = pinTargets(setup, world);                       where the pins are, in the pose that is shown
 *     const pins = ikPinsOf(setup, targets, { pin: 3 });              or { joint, point, target }
 *     const problem = ikProblem(skeleton, pins, dofs, { clamps, stiffness: stiffnessOf(skeleton, setup, locks) });
 *     movePin(problem, draggedIndex(setup, dragged), x, y, z);
 */
import { transformPoint, type Vec3 } from '../../math/vec3.ts';
import type { Character } from '../../model/document.ts';
import { defaultIk, type IkSetup, type Pin, type StiffJoint } from '../../model/ik.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { compileSkeleton } from '../kinematics.ts';
import { orientationAt } from './orientation.ts';
import { IkError, type IkPin, ikStiffness, type Turn } from './pins.ts';

/** The target of a pin, in the space of the world matrices. */
export interface PinTarget {
  readonly position: Vec3;
  /** Target orientation of the joint's axes, for pins that hold it. */
  readonly orientation?: Turn;
}

/** The dragged point: a pin by id, or an unpinned point of a joint. */
export type DragTarget =
  | { readonly pin: number }
  | {
      readonly joint: number;
      /** In the joint's space. */
      readonly point: Vec3;
      /** In the space of the world matrices. */
      readonly target: Vec3;
    };

/** The character's settings, or the defaults. */
export function ikOf({ ik, skeleton }: Pick<Character, 'ik' | 'skeleton'>): IkSetup {
  return ik ?? defaultIk(skeleton);
}

/** Positions of the pins in a pose, by id. @param world from `worldMatrices` */
export function pinTargets({ pins }: Pick<IkSetup, 'pins'>, world: Float64Array): Map<number, PinTarget> {
  return new Map(pins.map((pin) => [pin.id, pinTarget(pin, world)]));
}

/** Position of a pin in a pose. @param world from `worldMatrices` */
export function pinTarget({ joint, point, holdsOrientation }: Pin, world: Float64Array): PinTarget {
  const position = pointAt(world, joint, point);
  return holdsOrientation ? { position, orientation: orientationAt(world, joint) } : { position };
}

/** Position of a point of a joint. @param world from `worldMatrices` */
export function pointAt(world: Float64Array, joint: number, point: Vec3): Vec3 {
  return transformPoint(world, point, 16 * joint);
}

/**
 * The solver's pins: those of the settings, in order, then a dragged point that is no pin. During a drag all others
 * hold: if not all can be satisfied, the dragged point gives way.
 *
 * @param targets of every pin, by id
 * @throws IkError for a pin without a target, or a dragged one that doesn't exist
 */
export function ikPinsOf(
  { pins }: Pick<IkSetup, 'pins'>,
  targets: ReadonlyMap<number, PinTarget>,
  dragged?: DragTarget,
): IkPin[] {
  const draggedPin = dragged && 'pin' in dragged ? dragged.pin : undefined;
  if (draggedPin !== undefined && !pins.some(({ id }) => id === draggedPin))
    throw new IkError(`Pin ${draggedPin} is dragged, but does not exist.`);
  const made = pins.map(({ id, joint, point, weight }): IkPin => {
    const target = targets.get(id);
    if (!target) throw new IkError(`Pin ${id} has no target.`);
    const { position, orientation } = target;
    const holds = dragged !== undefined && id !== draggedPin;
    return { joint, point, target: position, weight, holds, ...(orientation && { orientation }) };
  });
  if (!dragged || 'pin' in dragged) return made;
  const { joint, point, target } = dragged;
  return [...made, { joint, point, target }];
}

/** Index of the dragged one among the solver's pins, for `movePin`; -1 if it doesn't exist. */
export function draggedIndex({ pins }: Pick<IkSetup, 'pins'>, dragged: DragTarget): number {
  return 'pin' in dragged ? pins.findIndex(({ id }) => id === dragged.pin) : pins.length;
}

/** How the root is held: not at all, its position, or its turn too. */
export type RootHold = 'moves' | 'in place' | 'fixed';

const NONE: ReadonlySet<number> = new Set();

/**
 * How a character's root is held. In the axis-angle form it is the first bone, which turns in place unless that is
 * locked; arms of one or two bones could reach nothing otherwise.
 */
export function rootHold({ form }: Pick<Skeleton, 'form'>, { stiff, rootIsFree }: Omit<IkSetup, 'pins'>): RootHold {
  if (rootIsFree) return 'moves';
  const isLocked = stiff.some(({ joint, stiffness }) => joint === 0 && stiffness === undefined);
  return form === 'axis-angle' && !isLocked ? 'in place' : 'fixed';
}

/**
 * Stiffness of each of the character's DOFs except morphs: `ikStiffness` with the settings' joints locked (Infinity) or
 * stiffened. Root translation depends on `rootIsFree` only; locking the root joint locks its rotation, and so does a
 * root that is fixed (`rootHold`). So are DOFs that are locked themselves. If a locked joint's DOFs are linked,
 * the DOFs they follow are locked too, or it would bend with them.
 */
export function stiffnessOf(
  skeleton: Skeleton,
  setup: Omit<IkSetup, 'pins'>,
  locked: ReadonlySet<number> = NONE,
): Float64Array {
  const { stiff, rootIsFree } = setup;
  const stiffness = ikStiffness(skeleton, rootIsFree);
  const { firstDof, travel, jointCount, couples } = compileSkeleton(skeleton);
  const root: readonly StiffJoint[] = rootHold(skeleton, setup) === 'fixed' ? [{ joint: 0 }] : [];
  for (const { joint, stiffness: factor = Infinity } of [...stiff, ...root]) {
    if (joint >= jointCount) continue;
    for (let dof = firstDof[joint]; dof < firstDof[joint + 1]; dof++) {
      if (!travel.includes(dof)) stiffness[dof] *= factor;
    }
  }
  for (const dof of locked) if (dof < stiffness.length) stiffness[dof] = Infinity;
  // Each link comes after the one that its source follows.
  for (let i = couples.length - 1; i >= 0; i--) {
    const { dof, follows, gain } = couples[i];
    if (gain !== 0) stiffness[follows] = Math.max(stiffness[follows], stiffness[dof]);
  }
  return stiffness;
}

/**
 * A character's reach from its skeleton alone: the longest path along its bones from the root's pivot to any end; the
 * size of a box if all joints coincide, else 1. For tolerances independent of the unit of length.
 */
export function reachOfSkeleton({ joints }: Skeleton): number {
  const ways = new Float64Array(joints.length);
  let longest = 0;
  let widest = 0;
  joints.forEach(({ parent, offset, length = 0, endSites = [], box }, j) => {
    if (parent >= 0) ways[j] = ways[parent] + Math.hypot(...offset);
    longest = Math.max(longest, ways[j] + length, ...endSites.map((end) => ways[j] + Math.hypot(...end)));
    widest = Math.max(widest, Math.hypot(...box.max.map((max, k) => max - box.min[k])));
  });
  return longest > 0 ? longest : widest > 0 ? widest : 1;
}
