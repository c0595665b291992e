/**
 * A joint's motion on the other side of a plane: with M = diag(−1, 1, 1), or −1 at y or z,
 *
 *     M · J(φ) · M = J′(φ′)          φ′ = ±φ, a sign a DOF
 *
 *     rotation about a by θ      M·R(a, θ)·M = R(−M·a, θ): axes of rotations are pseudovectors
 *     translation along a        M·T(t·a)·M = T(t·M·a)
 *     scale along a              M·a for a
 *     shear h of two axes        −h where one of the two is the axis across
 *     screw                      axis −M·a turns the same; what it advances along M·a is the pitch −p
 *
 * Angles about x, y and z keep their sign about the axis across and lose it about the others, whatever their order.
 */
import type { Vec3 } from '../../math/vec3.ts';
import { type Box, dofsOf, type Limit, type Motion } from '../../model/skeleton.ts';

export interface MirroredMotion {
  readonly motion: Motion;
  /** One for each DOF: 1 or −1. */
  readonly signs: readonly number[];
}

/**
 * @param across 0, 1 or 2 for x, y or z
 * @param like the motion of the joint that is there already: an axis goes the way that its does
 */
export function mirroredMotion(motion: Motion, across: number, like?: Motion): MirroredMotion {
  const mirrored = plainlyMirrored(motion, across);
  const signs = dofsOf(motion).map(({ name }) => signOf(motion, name, across));
  const isAgainst =
    like?.kind === mirrored.kind && 'axis' in like && 'axis' in mirrored && dot(like.axis, mirrored.axis) < 0;
  // Against its axis, everything is the same with the other sign. Scales don't know which way theirs goes.
  if (isAgainst && mirrored.kind === 'scale') return { motion: { ...mirrored, axis: like.axis }, signs };
  if (isAgainst) return { motion: { ...mirrored, axis: negated(mirrored.axis) }, signs: signs.map((sign) => -sign) };
  return { motion: mirrored, signs };
}

function plainlyMirrored(motion: Motion, across: number): Motion {
  switch (motion.kind) {
    case 'hinge':
      return { ...motion, axis: negated(reflected(motion.axis, across)) };
    case 'screw':
      return { ...motion, axis: negated(reflected(motion.axis, across)), pitch: -motion.pitch + 0 };
    case 'prismatic':
    case 'scale':
      return { ...motion, axis: reflected(motion.axis, across) };
    default:
      return motion;
  }
}

function signOf({ kind }: Motion, name: string, across: number): number {
  const axis = 'xyz'[across];
  // Their axis is mirrored instead.
  if (kind === 'hinge' || kind === 'screw' || kind === 'prismatic' || kind === 'scale') return 1;
  if (kind === 'shear') return name.includes(axis) ? -1 : 1;
  if (name.startsWith('t')) return name[1] === axis ? -1 : 1;
  if (name.startsWith('r') || name.startsWith('q')) return name[1] === axis || name === 'qw' ? 1 : -1;
  return 1;
}

export function reflected(v: Vec3, across: number): Vec3 {
  // −0 is no place of its own.
  const at = (k: number) => (k === across ? -v[k] + 0 : v[k]);
  return [at(0), at(1), at(2)];
}

export function reflectedBox({ min, max }: Box, across: number): Box {
  const [a, b] = [reflected(min, across), reflected(max, across)];
  const low = (k: number) => (k === across ? b : a)[k];
  const high = (k: number) => (k === across ? a : b)[k];
  return { min: [low(0), low(1), low(2)], max: [high(0), high(1), high(2)] };
}

export function mirroredLimit(limit: Limit, sign: number): Limit {
  return sign > 0 ? limit : { min: -limit.max + 0, max: -limit.min + 0 };
}

function negated([x, y, z]: Vec3): Vec3 {
  return [-x + 0, -y + 0, -z + 0];
}

function dot(a: Vec3, b: Vec3): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
