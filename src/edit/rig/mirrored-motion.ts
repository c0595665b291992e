/**
 * Mirrors a joint's motion across a plane: with M = diag(−1, 1, 1), or −1 at y or z,
 *
 *     M · J(φ) · M = J′(φ′)          φ′ = ±φ, a sign a DOF
 *
 *     rotation about a by θ      M·R(a, θ)·M = R(−M·a, θ): axes of rotations are pseudovectors
 *     translation along a        M·T(t·a)·M = T(t·M·a)
 *     scale along a              M·a for a
 *     shear h of two axes        −h if one of the two is the mirrored axis
 *     screw                      the same rotation about −M·a; the advance along M·a is the pitch −p
 *
 * Angles keep their sign about the mirrored axis and lose it about the others, in any order.
 */
import { dot, negated, reflected } from '../../math/vec3.ts';
import {
  axisParameter,
  dofsOf,
  isSameType,
  jointTypeOf,
  stretches,
  withParameter,
} from '../../model/skeleton/joint-types.ts';
import type { Box, Limit, Motion } from '../../model/skeleton/skeleton.ts';

/** A mirrored motion, and the signs by which its values are those of the original. */
export interface MirroredMotion {
  readonly motion: Motion;
  /** One per DOF: 1 or −1. */
  readonly signs: readonly number[];
}

/**
 * A motion mirrored across the plane perpendicular to an axis.
 * @param across 0, 1 or 2 for x, y or z
 * @param like the motion of the existing joint, whose axis direction is used
 */
export function mirroredMotion(motion: Motion, across: number, like?: Motion): MirroredMotion {
  const mirrored = jointTypeOf(motion).mirrored(motion, across);
  const dofs = dofsOf(motion);
  const signs = dofs.map(({ name }) => signOf(name, across));
  const axis = axisParameter(mirrored);
  const theirs = like && isSameType(like, mirrored) ? axisParameter(like) : undefined;
  if (!axis || !theirs || !(dot(axis, theirs) < 0)) return { motion: mirrored, signs };
  // With the axis reversed, the signs are reversed. Scales don't depend on its direction.
  if (stretches(motion)) return { motion: withParameter(mirrored, 'axis', theirs), signs };
  return { motion: withParameter(mirrored, 'axis', negated(axis)), signs: signs.map((sign) => -sign) };
}

function signOf(name: string, across: number): number {
  const axis = 'xyz'[across];
  // About or along the joint's own axis, which is mirrored instead.
  if (name.length === 1) return 1;
  if (name.startsWith('h')) return name.includes(axis) ? -1 : 1;
  if (name.startsWith('t')) return name[1] === axis ? -1 : 1;
  if (name.startsWith('r') || name.startsWith('q')) return name[1] === axis || name === 'qw' ? 1 : -1;
  return 1;
}

/** A box reflected at the plane perpendicular to axis `across` (0, 1, 2 for x, y, z). */
export function reflectedBox({ min, max }: Box, across: number): Box {
  const [a, b] = [reflected(min, across), reflected(max, across)];
  const low = (k: number) => (k === across ? b : a)[k];
  const high = (k: number) => (k === across ? a : b)[k];
  return { min: [low(0), low(1), low(2)], max: [high(0), high(1), high(2)] };
}

/** The limits of a DOF whose values are multiplied by `sign`, 1 or −1. */
export function mirroredLimit(limit: Limit, sign: number): Limit {
  return sign > 0 ? limit : { min: -limit.max + 0, max: -limit.min + 0 };
}
