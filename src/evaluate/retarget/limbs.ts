/**
 * Arms and legs whose lower bone bends about one axis only, like a hinge knee. The direction of the shin is then right
 * only if the thigh is twisted so that the hinge is perpendicular to the plane in which the leg bends:
 *
 *     n = d_thigh × d_shin        roll: about d_thigh, from the hinge's axis to ±n
 *
 * Straight limbs define no plane: the roll fades out as they straighten, so that no knee spins.
 */

import { multiply3, turnAbout, turnVector } from '../../math/mat3.ts';
import { smoothstep } from '../../math/smoothstep.ts';
import type { CompiledSkeleton } from '../kinematics.ts';
import { aims, type Bodies, driven } from './align.ts';
import { type BodySide, LIMB_SIDES } from './roles.ts';

/** An arm or leg of the target that follows the source, with its hinge if it has one. */
export interface Limb {
  readonly side: BodySide;
  readonly part: 'arm' | 'leg';
  /** Joints of the target. */
  readonly upper: number;
  readonly lower: number;
  readonly end: number;
  /** The only axis about which the lower bone bends, in the upper joint's space; absent if it can bend about any. */
  readonly hinge?: Float64Array;
  /** 1 or -1: direction in which the hinge bends; 0 for both. */
  readonly bends: number;
}

/** A DOF with a smaller range than this doesn't count as moving; radians. */
const STIFF = 0.02;
/** An axis this close to the bone (cosine) twists it and doesn't bend. */
const ALONG = 0.8;

/**
 * The arms and legs of the target of which all three joints are driven.
 * @param rest the target's DOFs in its file pose
 * @param clamps whether its limits are enforced
 */
export function limbsOf(bodies: Bodies, target: CompiledSkeleton, rest: Float64Array, clamps: boolean): Limb[] {
  const aimed = aims(bodies);
  return LIMB_SIDES.flatMap((side) =>
    (
      [
        ['arm', 'arm', 'forearm', 'hand'],
        ['leg', 'thigh', 'shin', 'foot'],
      ] as const
    ).flatMap(([part, upperPart, lowerPart, endPart]): Limb[] => {
      const upper = driven(bodies, `${side} ${upperPart}`);
      const lower = driven(bodies, `${side} ${lowerPart}`);
      const end = driven(bodies, `${side} ${endPart}`);
      if (upper < 0 || lower < 0 || end < 0 || aimed.length === 0) return [];
      const limb: Limb = { side, part, upper, lower, end, bends: 0 };
      const bend =
        bodies.target.joints[lower].parent === upper ? bendOf(bodies, target, limb, rest, clamps) : undefined;
      return [{ ...limb, ...bend }];
    }),
  );
}

/** Angle by which other DOFs are turned to see whether an axis depends on them; radians. */
const NUDGE = 0.5;

function bendOf(bodies: Bodies, target: CompiledSkeleton, limb: Limb, rest: Float64Array, clamps: boolean) {
  const { lower, end } = limb;
  const { points, rotations } = bodies.rest;
  const first = target.firstDof[lower];
  const bone = Float64Array.from([0, 1, 2], (k) => points[3 * end + k] - points[3 * lower + k]);
  const length = Math.hypot(...bone);
  const upper = rotations.subarray(9 * limb.upper, 9 * limb.upper + 9);
  const moving: { dof: number; low: number; high: number }[] = [];
  for (let dof = 0; dof < target.firstDof[lower + 1] - first; dof++) {
    const own = first - target.firstDof[0] + dof;
    const low = clamps ? target.lower[own] : -Infinity;
    const high = clamps ? target.upper[own] : Infinity;
    if (high - low >= STIFF) moving.push({ dof, low, high });
  }
  const found = moving.flatMap(({ dof, low, high }) => {
    const axis = axisOf(target, lower, dof, rest);
    if (!axis) return [];
    const turned = new Float64Array(3);
    turnVector(upper, 0, axis, 0, turned, 0);
    const along = Math.abs(turned[0] * bone[0] + turned[1] * bone[1] + turned[2] * bone[2]) / (length || 1);
    return along < ALONG ? [{ dof, axis, low, high }] : [];
  });
  if (found.length !== 1) return undefined;
  const [{ dof, axis, low, high }] = found;
  // A twist that is applied after the bend turns the axis: then the bone bends in any direction.
  const nudged = Float64Array.from(rest);
  for (const other of moving) if (other.dof !== dof) nudged[first + other.dof] += NUDGE;
  const other = axisOf(target, lower, dof, nudged);
  if (!other || axis.some((v, k) => Math.abs(v - other[k]) > 1e-6)) return undefined;
  const bends = low > -0.5 && high > 0.5 ? 1 : high < 0.5 && low < -0.5 ? -1 : 0;
  return { hinge: axis, bends };
}

/** The axis about which a DOF rotates a joint, in the parent's space; undefined if it does something else. */
function axisOf(target: CompiledSkeleton, joint: number, dof: number, dofs: Float64Array): Float64Array | undefined {
  const first = target.firstDof[joint];
  const j = new Float64Array(16);
  const d = new Float64Array(16);
  target.motions[joint].write(dofs, first, j, 0);
  target.motions[joint].writeDerivative(dofs, first, dof, d, 0);
  // ∂J·J⁻¹ of a rotation is [a]×.
  const at = (r: number, c: number) => d[r] * j[c] + d[4 + r] * j[4 + c] + d[8 + r] * j[8 + c];
  const axis = Float64Array.of(at(2, 1), at(0, 2), at(1, 0));
  return Math.abs(Math.hypot(...axis) - 1) > 1e-6 ? undefined : axis;
}

/** Limbs bent less than 3° count as straight; from 15° the plane has full weight. Sines. */
const STRAIGHT = 0.05;
const BENT = 0.26;

/** Scratch; never escapes. */
const d1 = new Float64Array(3);
const d2 = new Float64Array(3);
const axis = new Float64Array(3);
const turn = new Float64Array(9);
const before = new Float64Array(9);

/**
 * Twists the wanted rotation of the limb's upper joint.
 * @param bones unit vectors in each joint's space
 */
export function rollLimb(limb: Limb, bones: Float64Array, wanted: Float64Array): void {
  const { upper, lower, hinge, bends } = limb;
  if (!hinge) return;
  turnVector(wanted, 9 * upper, bones, 3 * upper, d1, 0);
  turnVector(wanted, 9 * lower, bones, 3 * lower, d2, 0);
  let nx = d1[1] * d2[2] - d1[2] * d2[1];
  let ny = d1[2] * d2[0] - d1[0] * d2[2];
  let nz = d1[0] * d2[1] - d1[1] * d2[0];
  const sine = Math.sqrt(nx * nx + ny * ny + nz * nz);
  if (!(sine > STRAIGHT)) return;
  turnVector(wanted, 9 * upper, hinge, 0, axis, 0);
  const along = axis[0] * d1[0] + axis[1] * d1[1] + axis[2] * d1[2];
  for (let k = 0; k < 3; k++) axis[k] -= along * d1[k];
  let cos = (axis[0] * nx + axis[1] * ny + axis[2] * nz) / sine;
  const sign = bends !== 0 ? bends : cos < 0 ? -1 : 1;
  nx *= sign / sine;
  ny *= sign / sine;
  nz *= sign / sine;
  cos *= sign;
  const sin =
    d1[0] * (axis[1] * nz - axis[2] * ny) +
    d1[1] * (axis[2] * nx - axis[0] * nz) +
    d1[2] * (axis[0] * ny - axis[1] * nx);
  // A limb that bends against its hinge, as noise at a straight knee does, is not turned around for it.
  const share = smoothstep(STRAIGHT, BENT, sine) * smoothstep(-0.7, 0, cos);
  if (share === 0) return;
  const angle = share * Math.atan2(sin, cos);
  turnAbout(d1[0], d1[1], d1[2], Math.cos(angle), Math.sin(angle), turn, 0);
  for (let k = 0; k < 9; k++) before[k] = wanted[9 * upper + k];
  multiply3(turn, 0, before, 0, wanted, 9 * upper);
}
