/**
 * The world-space axes along or about which each of a joint's DOFs moves in the current pose; the basis for gizmo
 * handles.
 *
 *     W = F · J(φ)        F: everything above the joint, with its offset        J = A_d · M_d(φ_d) · …
 *
 * A_d is the product of the joint's DOFs to the left of DOF d: J with d and everything to its right at rest. So the
 * axis of d is that of ∂J/∂φ_d at rest, transformed by F · A_d: the rings of an Euler rotation are gimbal rings, each
 * turned by those applied after it. The form of the derivative tells the kind of handle, independent of the joint's
 * type.
 */
import { determinant3, multiplyAffine, setIdentity } from '../../math/mat4.ts';
import {
  acrossOf,
  add,
  dot,
  scaled,
  subtract,
  transformPoint,
  transformVector,
  unit,
  type Vec3,
} from '../../math/vec3.ts';
import { dofAxis } from '../../model/skeleton/dof-axis.ts';
import { rootDofCount } from '../../model/skeleton/dofs.ts';
import { dofsOf, takesLimits } from '../../model/skeleton/joint-types.ts';
import type { Motion, Skeleton } from '../../model/skeleton/skeleton.ts';
import { compileSkeleton } from '../kinematics.ts';

/**
 * turn: about the axis, screws included. slide: along it. stretch: along it, whatever happens across. grow: uniformly,
 * without an axis. shear: points on the arm move along the axis.
 */
export type DofKind = 'turn' | 'slide' | 'stretch' | 'grow' | 'shear';

/** x, y or z, the DOF's colour everywhere (`model/dof-axis.ts`); `other`: none of them. */
export type Hue = 0 | 1 | 2 | 'other';

/** The axis of one DOF in the current pose, as a gizmo's handle needs it. */
export interface DofAxis {
  /** Index into the character's DOFs (`model/dofs.ts`). */
  readonly dof: number;
  /** `rx`. */
  readonly name: string;
  readonly kind: DofKind;
  /** Normalised, in the world; arbitrary if the DOF has no axis. */
  readonly axis: Vec3;
  /** Position of the handle in the world: on the axis, as near the joint's origin as possible. */
  readonly centre: Vec3;
  /** World distance of sliding by 1 in the DOF, or world length of 1 along the axis. */
  readonly reach: number;
  /** For a turn: a direction perpendicular to the axis that stays fixed while the DOF turns. */
  readonly zero?: Vec3;
  /** For a shear: points there, at distance 1, move by the value along the axis. */
  readonly arm?: Vec3;
  readonly hue: Hue;
}

/** How a DOF moves at rest, in its own factor's space. */
interface AtRest {
  readonly kind: DofKind;
  readonly axis: Vec3;
  readonly arm?: Vec3;
}

/**
 * In DOF order; for the root its translation first. Quaternion components are omitted, since they don't turn
 * independently, and so are axes that have no length or direction left in the world.
 * @param dofs the character's, as shown
 * @param world 16 per joint, column-major, in the character's space
 * @param placement 16, column-major, from there to the world
 */
export function dofAxes(
  skeleton: Skeleton,
  joint: number,
  dofs: Float64Array,
  world: Float64Array,
  placement: Float64Array,
): DofAxis[] {
  const compiled = compileSkeleton(skeleton);
  const { motion } = skeleton.joints[joint];
  const pivot = transformPoint(placement, [world[16 * joint + 12], world[16 * joint + 13], world[16 * joint + 14]]);
  const found: (DofAxis | undefined)[] = [];
  if (joint === 0) {
    for (let k = 0; k < rootDofCount(skeleton); k++) {
      const along = { kind: 'slide', axis: unitAxis(k) } as const;
      found.push(inWorld(along, k, `t${'xyz'[k]}`, placement, pivot, hueOf(motion, `t${'xyz'[k]}`)));
    }
  }
  if (!takesLimits(motion)) return found.filter((axis) => axis !== undefined);
  const own = dofsOf(motion);
  const rule = compiled.motions[joint];
  const order = rule.screws?.map((screw) => screw.dof) ?? own.map((_, d) => d);
  const frame = frameOf(skeleton, joint, dofs, world, placement);
  const first = compiled.firstDof[joint];
  const rest = Float64Array.from(own, (dof) => dof.rest);
  const byDof: (DofAxis | undefined)[] = own.map(() => undefined);
  const before = rest.slice();
  const factor = new Float64Array(16);
  const toWorld = new Float64Array(16);
  for (const d of order) {
    rule.writeDerivative(rest, 0, d, factor, 0);
    const atRest = motionAtRest(factor);
    if (atRest) {
      rule.write(before, 0, factor, 0);
      // A shear's DOFs are added, not multiplied: each moves as if it were alone.
      if (atRest.kind === 'shear') setIdentity(factor);
      multiplyAffine(frame, 0, factor, 0, toWorld, 0);
      byDof[d] = inWorld(atRest, first + d, own[d].name, toWorld, pivot, hueOf(motion, own[d].name));
    }
    before[d] = dofs[first + d];
  }
  return [...found, ...byDof].filter((axis) => axis !== undefined);
}

/** The frame of a joint's own matrix J in the world: everything above it, with its offset. */
export function frameOf(
  skeleton: Skeleton,
  joint: number,
  dofs: Float64Array,
  world: Float64Array,
  placement: Float64Array,
): Float64Array {
  const { offsets, parent, hasRootTranslation } = compileSkeleton(skeleton);
  const frame = placement.slice(0, 16);
  if (parent[joint] >= 0) multiplyAffine(placement, 0, world, 16 * parent[joint], frame, 0);
  const moves = parent[joint] < 0 && hasRootTranslation;
  const along = (k: number) => offsets[3 * joint + k] + (moves ? dofs[k] : 0);
  const origin = transformPoint(frame, [along(0), along(1), along(2)]);
  frame.set(origin, 12);
  return frame;
}

/**
 * Classifies a derivative at rest: skew-symmetric for a turn, only the last column for a slide, symmetric for a
 * stretch; otherwise one axis moves along another.
 */
function motionAtRest(m: Float64Array): AtRest | undefined {
  const turn = unit([m[6] - m[9], m[8] - m[2], m[1] - m[4]]);
  const isSymmetric = m[1] === m[4] && m[2] === m[8] && m[6] === m[9];
  const isHollow = m[0] === 0 && m[5] === 0 && m[10] === 0;
  if (turn && Math.abs(m[1] + m[4]) + Math.abs(m[2] + m[8]) + Math.abs(m[6] + m[9]) < 1e-9) {
    return { kind: 'turn', axis: turn };
  }
  if (isSymmetric && !(isHollow && m[1] === 0 && m[2] === 0 && m[6] === 0)) return stretchAtRest(m);
  const slide = unit([m[12], m[13], m[14]]);
  if (slide) return { kind: 'slide', axis: slide };
  for (let c = 0; c < 3; c++) {
    for (let r = 0; r < 3; r++) {
      if (r !== c && m[4 * c + r] !== 0) return { kind: 'shear', axis: unitAxis(r), arm: unitAxis(c) };
    }
  }
  return undefined;
}

/** a·aᵀ + p·(I − a·aᵀ): 1 along a, p across it; without p·I the largest column is along a. */
function stretchAtRest(m: Float64Array): AtRest | undefined {
  const across = (m[0] + m[5] + m[10] - 1) / 2;
  let axis: Vec3 | undefined;
  let largest = 1e-9;
  for (let c = 0; c < 3; c++) {
    const column: Vec3 = [m[4 * c], m[4 * c + 1], m[4 * c + 2]];
    const own = add(column, unitAxis(c), -across);
    if (Math.hypot(...own) <= largest) continue;
    largest = Math.hypot(...own);
    axis = unit(own);
  }
  return axis ? { kind: 'stretch', axis } : { kind: 'grow', axis: [1, 0, 0] };
}

function inWorld(
  { kind, axis, arm }: AtRest,
  dof: number,
  name: string,
  toWorld: Float64Array,
  pivot: Vec3,
  hue: Hue,
): DofAxis | undefined {
  const along = transformVector(toWorld, axis);
  const reach = Math.hypot(...along);
  const direction = unit(along);
  if (!direction) return undefined;
  const common = { dof, name, kind, reach, hue };
  if (kind === 'turn') {
    // A mirror reverses rotations.
    const about = determinant3(toWorld) < 0 ? scaled(direction, -1) : direction;
    const start: Vec3 = [toWorld[12], toWorld[13], toWorld[14]];
    const across = transformVector(toWorld, acrossOf(axis));
    const zero = unit(add(across, about, -dot(across, about))) ?? acrossOf(about);
    return { ...common, axis: about, zero, centre: add(start, about, dot(subtract(pivot, start), about)) };
  }
  const made = { ...common, axis: direction, centre: pivot };
  return arm ? { ...made, arm: transformVector(toWorld, arm) } : made;
}

function hueOf(motion: Motion, name: string): Hue {
  const letter = dofAxis(motion, name);
  return letter === undefined ? 'other' : HUES[letter];
}
const HUES = { x: 0, y: 1, z: 2 } as const;

function unitAxis(k: number): Vec3 {
  return [k === 0 ? 1 : 0, k === 1 ? 1 : 0, k === 2 ? 1 : 0];
}
