/**
 * Which way a figure faces, and what turns its mirror image back to face that way.
 *
 * Mirrored across an upright plane, a figure at ψ to that plane is at −ψ to it; a turn about the up axis by 2ψ brings it
 * back. Then it is mirrored across the upright plane of its own, and mirrored twice it is itself, for its heading is kept:
 * T₂ψ·M·T₂ψ·M = T₂ψ·T₋₂ψ = 1. A turn by half a circle of ψ changes nothing, so left and right may be taken for each other.
 */
import type { CompiledSkeleton } from '../../evaluate/kinematics.ts';
import { turnAbout, writeRotationPart } from '../../math/mat3.ts';
import { cross, dot, transformVector, unit, type Vec3 } from '../../math/vec3.ts';
import type { Reflection } from './reflection.ts';

/** Nearer to the plane than that (as a sine) it faces along it. */
const ALONG = 1e-12;
/** A direction that is steeper than that (as a cosine) says nothing of where a figure faces. */
const STEEP = 0.3;

/**
 * The turn about the up axis by 2ψ, nine numbers; undefined where the figure faces along the plane, and where the plane
 * does not stand upright. Its heading is that of its root: a head may look elsewhere.
 *
 * @param sides from one side of the figure to the other in the pose of reference, of length 1
 * @param dofs of the character, before it is mirrored
 */
export function headingBack(
  compiled: CompiledSkeleton,
  { normal, reference }: Pick<Reflection, 'normal' | 'reference'>,
  sides: Vec3,
  dofs: Float64Array,
  up: 'y' | 'z',
): Float64Array | undefined {
  const upward: Vec3 = up === 'y' ? [0, 1, 0] : [0, 0, 1];
  const along = unit(cross(normal, upward));
  if (!along || Math.abs(dot(normal, upward)) > ALONG) return undefined;
  const now = rootTurn(compiled, dofs);
  const before = rootTurn(compiled, reference);
  const fromReference = (v: Vec3) => transformVector(now, transposed(before, v));
  /** cos ψ and sin ψ of what is along `zero` at ψ = 0; undefined where it is steep. */
  const angle = (v: Vec3, zero: Vec3) => {
    const [c, s] = [dot(v, zero), dot(v, cross(upward, zero))];
    const length = Math.hypot(c, s);
    return length > STEEP * Math.hypot(...v) ? ([c / length, s / length] as const) : undefined;
  };
  // Lying on one side, from foot to head, which are in the plane between the sides.
  const found = angle(fromReference(sides), normal) ?? angle(fromReference(upward), along);
  if (!found) return undefined;
  const [cos, sin] = found;
  if (Math.abs(sin) < ALONG) return undefined;
  const out = new Float64Array(9);
  turnAbout(...upward, cos * cos - sin * sin, 2 * sin * cos, out, 0);
  return out;
}

/** The root's rotation and what else turns and stretches it, 16 numbers. */
function rootTurn({ motions, firstDof }: CompiledSkeleton, dofs: Float64Array): Float64Array {
  const local = new Float64Array(16);
  motions[0].write(dofs, firstDof[0], local, 0);
  writeRotationPart(local, 0, local, 0, 4);
  return local;
}

/** The rotation's inverse, of a direction. */
function transposed(m: Float64Array, [x, y, z]: Vec3): Vec3 {
  const row = (c: number) => m[4 * c] * x + m[4 * c + 1] * y + m[4 * c + 2] * z;
  return [row(0), row(1), row(2)];
}
