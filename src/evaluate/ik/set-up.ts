/**
 * From what the document says of a character's inverse kinematics (`model/ik.ts`) and what is being dragged to what the
 * solver takes: its pins and how unwilling each DOF is. Made once where a drag begins; after that `movePin` is enough.
 *
 *     const targets = pinTargets(setup, world);                       where the pins are, in the pose that is shown
 *     const pins = ikPinsOf(setup, targets, { pin: 3 });              or { joint, point, target }
 *     const problem = ikProblem(skeleton, pins, dofs, { clamps, stiffness: stiffnessOf(skeleton, setup) });
 *     movePin(problem, draggedIndex(setup, dragged), x, y, z);
 */
import { transformPoint, type Vec3 } from '../../math/vec3.ts';
import type { Character } from '../../model/document.ts';
import { defaultIk, type IkSetup, type Pin } from '../../model/ik.ts';
import type { Skeleton } from '../../model/skeleton.ts';
import { compileSkeleton } from '../kinematics.ts';
import { orientationAt } from './orientation.ts';
import { IkError, type IkPin, ikStiffness, type Turn } from './pins.ts';

/** Where a pin holds: in the space of the world matrices. */
export interface PinTarget {
  readonly position: Vec3;
  /** How the joint's axes should stand there; only where the pin holds its orientation. */
  readonly orientation?: Turn;
}

/** What the hand has: a pin, by its id, or a point of a joint that nothing holds otherwise. */
export type DragTarget =
  | { readonly pin: number }
  | {
      readonly joint: number;
      /** In the joint's space. */
      readonly point: Vec3;
      /** In the space of the world matrices. */
      readonly target: Vec3;
    };

/** The character's setup, or what holds where nothing is said. */
export function ikOf({ ik, skeleton }: Pick<Character, 'ik' | 'skeleton'>): IkSetup {
  return ik ?? defaultIk(skeleton);
}

/** Where the pins are at a pose, by id. @param world as of `worldMatrices` */
export function pinTargets({ pins }: Pick<IkSetup, 'pins'>, world: Float64Array): Map<number, PinTarget> {
  return new Map(pins.map((pin) => [pin.id, pinTarget(pin, world)]));
}

/** Where a pin is at a pose. @param world as of `worldMatrices` */
export function pinTarget({ joint, point, holdsOrientation }: Pin, world: Float64Array): PinTarget {
  const position = pointAt(world, joint, point);
  return holdsOrientation ? { position, orientation: orientationAt(world, joint) } : { position };
}

/** Where a point of a joint is. @param world as of `worldMatrices` */
export function pointAt(world: Float64Array, joint: number, point: Vec3): Vec3 {
  return transformPoint(world, point, 16 * joint);
}

/**
 * The solver's pins: those of the setup, in its order, and after them a point that is dragged and no pin. While
 * something is dragged, all else holds: what can't be had both is lost by the hand.
 *
 * @param targets of every pin, by id
 * @throws IkError for a pin without a target, or one that is dragged and isn't there
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

/** Which of the solver's pins is the one that is dragged, for `movePin`; -1 where its pin isn't there. */
export function draggedIndex({ pins }: Pick<IkSetup, 'pins'>, dragged: DragTarget): number {
  return 'pin' in dragged ? pins.findIndex(({ id }) => id === dragged.pin) : pins.length;
}

/**
 * How unwilling each of the character's DOFs but the morphs' is to move: `ikStiffness` with the setup's joints locked
 * (Infinity) or stiffened. What carries the character goes by `rootIsFree` alone: locking the root joint keeps it from
 * turning. A joint that is locked while its DOFs follow others locks those too, or it would bend with them.
 */
export function stiffnessOf(skeleton: Skeleton, { stiff, rootIsFree }: Omit<IkSetup, 'pins'>): Float64Array {
  const stiffness = ikStiffness(skeleton, rootIsFree);
  const { firstDof, travel, jointCount, couples } = compileSkeleton(skeleton);
  for (const { joint, stiffness: factor = Infinity } of stiff) {
    if (joint >= jointCount) continue;
    for (let dof = firstDof[joint]; dof < firstDof[joint + 1]; dof++) {
      if (!travel.includes(dof)) stiffness[dof] *= factor;
    }
  }
  // Each couple comes after the one that it follows in turn.
  for (let i = couples.length - 1; i >= 0; i--) {
    const { dof, follows, gain } = couples[i];
    if (gain !== 0) stiffness[follows] = Math.max(stiffness[follows], stiffness[dof]);
  }
  return stiffness;
}

/**
 * How far a character reaches by its skeleton alone: the longest way along its bones from the root's pivot to any end;
 * where all joints are in one place the size of a box, else 1. For tolerances that are to hold in metres and
 * centimetres alike.
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
