/**
 * The facing direction of a character, and the rotation that restores it after mirroring.
 *
 * Mirrored across a vertical plane, a character at angle ψ to the plane is at −ψ; a rotation about the up axis by 2ψ
 * restores its heading. It is then mirrored across its own vertical plane, and mirroring twice is the identity:
 * T₂ψ·M·T₂ψ·M = T₂ψ·T₋₂ψ = 1. Adding 180° to ψ changes nothing, so left and right may be confused.
 */
import type { CompiledSkeleton } from '../../evaluate/kinematics.ts';
import { turnAbout, writeRotationPart } from '../../math/mat3.ts';
import { cross, dot, transformVector, unit, type Vec3 } from '../../math/vec3.ts';
import type { Space } from '../../model/space.ts';
import type { Reflection } from './reflection.ts';

/** Closer to the plane than this (sine) counts as facing along it. */
const ALONG = 1e-12;
/** A direction steeper than this (cosine) gives no heading. */
const STEEP = 0.3;

/**
 * The rotation about the up axis by 2ψ, nine numbers; undefined if the character faces along the plane, or the plane is
 * not vertical. The heading is that of the root, since a head may look elsewhere.
 *
 * @param sides unit vector from one side of the character to the other, in the reference pose
 * @param dofs of the character, before mirroring
 */
export function headingBack(
  compiled: CompiledSkeleton,
  { normal, reference }: Pick<Reflection, 'normal' | 'reference'>,
  sides: Vec3,
  dofs: Float64Array,
  up: Space['up'],
): Float64Array | undefined {
  const upward: Vec3 = up === 'z' ? [0, 0, 1] : [0, 1, 0];
  const along = unit(cross(normal, upward));
  if (!along || Math.abs(dot(normal, upward)) > ALONG) return undefined;
  const now = rootTurn(compiled, dofs);
  const before = rootTurn(compiled, reference);
  const fromReference = (v: Vec3) => transformVector(now, transposed(before, v));
  /** cos ψ and sin ψ of a vector relative to `zero`; undefined if it is steep. */
  const angle = (v: Vec3, zero: Vec3) => {
    const [c, s] = [dot(v, zero), dot(v, cross(upward, zero))];
    const length = Math.hypot(c, s);
    return length > STEEP * Math.hypot(...v) ? ([c / length, s / length] as const) : undefined;
  };
  // Lying on one side: from foot to head, which is in the plane between the sides.
  const found = angle(fromReference(sides), normal) ?? angle(fromReference(upward), along);
  if (!found) return undefined;
  const [cos, sin] = found;
  if (Math.abs(sin) < ALONG) return undefined;
  const out = new Float64Array(9);
  turnAbout(...upward, cos * cos - sin * sin, 2 * sin * cos, out, 0);
  return out;
}

/** The matrix of the root's own DOFs, 16 numbers. */
function rootTurn({ motions, firstDof }: CompiledSkeleton, dofs: Float64Array): Float64Array {
  const local = new Float64Array(16);
  motions[0].write(dofs, firstDof[0], local, 0);
  writeRotationPart(local, 0, local, 0, 4);
  return local;
}

/** The inverse rotation applied to a direction. */
function transposed(m: Float64Array, [x, y, z]: Vec3): Vec3 {
  const row = (c: number) => m[4 * c] * x + m[4 * c + 1] * y + m[4 * c + 2] * z;
  return [row(0), row(1), row(2)];
}
