/**
 * The handles of a joint: one for each of its DOFs and, if it can rotate about any axis, a ring facing the viewer and a
 * ball inside.
 */
import {
  acrossOf,
  add,
  cross,
  dot,
  scaled,
  subtract,
  transformPoint,
  transformVector,
  unit,
  type Vec3,
} from '../../math/vec3.ts';
import { hasOwnBox } from '../../model/skeleton/axis-angle.ts';
import { hasBox } from '../../model/skeleton/boxes.ts';
import { coupleOf } from '../../model/skeleton/couples.ts';
import { characterDofs } from '../../model/skeleton/dofs.ts';
import { isUnlimited, type Skeleton } from '../../model/skeleton/skeleton.ts';
import { type DofAxis, dofAxes } from './dof-axes.ts';
import { type FreeTurn, freeTurn, turnsOnlyFreely } from './free-turn.ts';

/**
 * A DOF by index; `own`: free rotation about the x, y or z of the gizmo; `along`: motion along one of them; `across`:
 * in the plane of the other two; `view`: rotation about the line of sight; `ball`: like a trackball.
 */
export type HandleId =
  | { readonly kind: 'dof'; readonly dof: number }
  | { readonly kind: 'own' | 'along' | 'across'; readonly axis: 0 | 1 | 2 }
  | { readonly kind: 'view' }
  | { readonly kind: 'ball' };

/** A DOF's range and its value. Infinite if unlimited. */
export interface HandleRange {
  readonly value: number;
  readonly min: number;
  readonly max: number;
}

/** A gizmo's handle for one DOF, or one axis. */
export interface Handle extends Omit<DofAxis, 'dof'> {
  readonly id: HandleId;
  /** For a turn: direction of the bone, perpendicular to the axis. */
  readonly mark: Vec3;
  readonly range: HandleRange;
}

/** A handle that moves in a plane. */
export interface PlaneHandle {
  readonly id: HandleId;
  /** Position in the world. */
  readonly centre: Vec3;
  /** The two axes of the plane, normalised, in the world. */
  readonly axes: readonly [Vec3, Vec3];
  /** Colour: that of the axis across. */
  readonly hue: 0 | 1 | 2;
}

/** All handles of a joint in the current pose; positions and lengths are in the world. */
export interface JointHandles {
  /** The joint's origin in the world. */
  readonly pivot: Vec3;
  /** Length of the joint's longest bone, or of its box, in the world; 0 if it has neither. */
  readonly size: number;
  readonly handles: readonly Handle[];
  readonly planes?: readonly PlaneHandle[];
  readonly freeTurn: FreeTurn | undefined;
}

/** Whether two ids name the same handle; two undefined ones are the same. */
export function sameHandle(a: HandleId | undefined, b: HandleId | undefined): boolean {
  if (!a || !b) return a === b;
  if (a.kind === 'dof') return b.kind === 'dof' && a.dof === b.dof;
  return a.kind === b.kind && axisOf(a) === axisOf(b);
}

/** The axis of the gizmo that a handle is about, along, or across; undefined for one of a DOF, or of none. */
export function axisOf(id: HandleId): 0 | 1 | 2 | undefined {
  return id.kind === 'own' || id.kind === 'along' || id.kind === 'across' ? id.axis : undefined;
}

/**
 * Linked DOFs have no handles, since they can't be set by hand. The arguments are those of `dofAxes`.
 */
export function jointHandles(
  skeleton: Skeleton,
  joint: number,
  dofs: Float64Array,
  world: Float64Array,
  placement: Float64Array,
): JointHandles {
  const pivot = transformPoint(placement, [world[16 * joint + 12], world[16 * joint + 13], world[16 * joint + 14]]);
  const bone = boneDirection(skeleton, joint, world, placement);
  const all = characterDofs(skeleton, []);
  const handles = dofAxes(skeleton, joint, dofs, world, placement)
    .filter(({ dof }) => !coupleOf(skeleton, dof))
    .map((axis): Handle => {
      const { limit } = all[axis.dof];
      const holds = limit.min <= limit.max && !isUnlimited(limit);
      const [min, max] = holds ? [limit.min, limit.max] : [-Infinity, Infinity];
      const range = { value: dofs[axis.dof], min, max };
      const still = rotated(axis.zero ?? acrossOf(axis.axis), axis.axis, range.value);
      return { ...axis, id: { kind: 'dof', dof: axis.dof }, mark: markOf(axis.axis, bone, still), range };
    });
  const turn = freeTurn(skeleton, joint);
  if (turn && turnsOnlyFreely(skeleton.joints[joint])) handles.push(...ownRings(joint, world, placement, pivot));
  return { pivot, size: sizeOf(skeleton, joint, world, placement), handles, freeTurn: turn };
}

/** Rings about the joint's own axes, if no DOF turns about an axis of its own. */
function ownRings(joint: number, world: Float64Array, placement: Float64Array, pivot: Vec3): Handle[] {
  return ([0, 1, 2] as const).flatMap((k) => {
    const axis = unit(
      transformVector(placement, [
        world[16 * joint + 4 * k],
        world[16 * joint + 4 * k + 1],
        world[16 * joint + 4 * k + 2],
      ]),
    );
    if (!axis) return [];
    return [ownRing(k, axis, pivot)];
  });
}

/** A ring of free rotation about an axis. */
export function ownRing(k: 0 | 1 | 2, axis: Vec3, centre: Vec3): Handle {
  const range = { value: 0, min: -Infinity, max: Infinity };
  const id = { kind: 'own', axis: k } as const;
  return { id, name: 'xyz'[k], kind: 'turn', axis, centre, reach: 1, hue: k, mark: acrossOf(axis), range };
}

/**
 * A unit vector perpendicular to the axis, as close to the bone as possible; if the bone is along the axis, another
 * direction that turns with it.
 */
function markOf(axis: Vec3, bone: Vec3 | undefined, other: Vec3): Vec3 {
  const across = bone && add(bone, axis, -dot(axis, bone));
  return (across && Math.hypot(...across) > MIN_ACROSS ? unit(across) : undefined) ?? other;
}

/** Minimum part of a unit bone across the axis; below it the bone gives no direction. */
const MIN_ACROSS = 0.2;

/** Rotates a vector that is perpendicular to the axis. */
function rotated(across: Vec3, axis: Vec3, angle: number): Vec3 {
  return add(scaled(across, Math.cos(angle)), cross(axis, across), Math.sin(angle));
}

/** The unit direction of the joint's bone in the world: towards its children, its own end, or the middle of its box. */
function boneDirection(
  skeleton: Skeleton,
  joint: number,
  world: Float64Array,
  placement: Float64Array,
): Vec3 | undefined {
  const { box, length, endSites } = skeleton.joints[joint];
  const ends = toChildren(skeleton, joint, world);
  if (!ends.length) {
    const tip: Vec3 | undefined = length !== undefined ? [0, length, 0] : endSites?.[0];
    const middle = scaled(add(box.min, box.max), 0.5);
    ends.push(transformVector(world, tip ?? middle, 16 * joint));
  }
  const sum = ends.reduce<Vec3>((all, end) => add(all, end), [0, 0, 0]);
  return unit(transformVector(placement, sum));
}

function sizeOf(skeleton: Skeleton, joint: number, world: Float64Array, placement: Float64Array): number {
  const own = skeleton.joints[joint];
  const tip: readonly Vec3[] = own.length === undefined ? [] : [[0, own.length, 0]];
  const ends = [...tip, ...(own.endSites ?? [])].map((end) => transformVector(world, end, 16 * joint));
  ends.push(...toChildren(skeleton, joint, world));
  // A default box says nothing of a joint's size, unless it is all that there is to see.
  if (hasBox(own) && (hasOwnBox(own) || !ends.length)) {
    const { min, max } = own.box;
    const middle: Vec3 = [(min[0] + max[0]) / 2, (min[1] + max[1]) / 2, (min[2] + max[2]) / 2];
    ends.push(transformVector(world, scaled(middle, 2), 16 * joint));
    for (let k = 0; k < 3; k++) {
      const half = Math.abs(max[k] - min[k]) / 2;
      ends.push([
        half * world[16 * joint + 4 * k],
        half * world[16 * joint + 4 * k + 1],
        half * world[16 * joint + 4 * k + 2],
      ]);
    }
  }
  return ends.reduce((most, end) => Math.max(most, Math.hypot(...transformVector(placement, end))), 0);
}

/** From a joint's origin to those of its children, in the character's space. */
function toChildren({ joints }: Skeleton, joint: number, world: Float64Array): Vec3[] {
  const own: Vec3 = [world[16 * joint + 12], world[16 * joint + 13], world[16 * joint + 14]];
  const found: Vec3[] = [];
  for (let j = joint + 1; j < joints.length && joints[j].parent >= joint; j++) {
    if (joints[j].parent === joint)
      found.push(subtract([world[16 * j + 12], world[16 * j + 13], world[16 * j + 14]], own));
  }
  return found;
}
