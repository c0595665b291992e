/**
 * Carries a motion to another place and heading: a rotation about the up axis and a shift over the ground, applied to
 * the root. So one take continues from where another ends.
 *
 *     p′ = R·p + t        R about the up axis, t along the ground
 */

import { type CompiledSkeleton, compileSkeleton, worldMatrices } from '../../evaluate/kinematics.ts';
import { carrierIn } from '../../evaluate/space/carrier.ts';
import { upAxis } from '../../evaluate/space/space.ts';
import { multiply3, turnAbout, writeRotationPart } from '../../math/mat3.ts';
import { quaternionOfRotation } from '../../math/quaternion.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import type { Space } from '../../model/space.ts';
import type { Take } from '../../model/takes/take.ts';
import { anglesOf, type JointRotation, jointRotations } from './rotations.ts';

/** A rotation about the up axis, then a shift over the ground. */
export interface Carry {
  /** Radians about the up axis. */
  readonly turn: number;
  /** x y z in the character's own space, 0 along the up axis. */
  readonly shift: readonly [number, number, number];
}

/** The carry that moves nothing. */
export const STAYS: Carry = { turn: 0, shift: [0, 0, 0] };

/** Whether a carry moves anything. */
export function isCarried({ turn, shift }: Carry): boolean {
  return turn !== 0 || shift.some((v) => v !== 0);
}

/** Where a character is and faces in one frame. */
export interface Stance {
  /** x y z of the joint that carries the body. */
  readonly place: Float64Array;
  /** Nine numbers: its rotation. */
  readonly rotation: Float64Array;
}

/** Moves the poses of one skeleton. */
export class Carrier {
  readonly compiled: CompiledSkeleton;
  /** The joint whose place and heading count: the hips below a root that stays. */
  readonly joint: number;
  readonly up: 1 | 2;
  private readonly root: JointRotation | undefined;
  private readonly world: Float64Array;
  private readonly local = new Float64Array(16);
  private readonly a = new Float64Array(9);
  private readonly b = new Float64Array(9);
  private readonly q = new Float64Array(4);

  constructor(skeleton: Skeleton, take: Take, up: Space['up']) {
    this.compiled = compileSkeleton(skeleton);
    this.joint = carrierIn(skeleton, take);
    this.up = upAxis({ up });
    this.root = jointRotations(skeleton).find(({ joint }) => joint === 0);
    this.world = new Float64Array(16 * this.compiled.jointCount);
  }

  /** World matrices of a pose; overwritten by the next call. */
  worldOf(dofs: Float64Array): Float64Array {
    worldMatrices(this.compiled, dofs, this.world);
    return this.world;
  }

  /** Place and rotation of the joint that carries the body, for a row of DOFs. */
  stanceOf(dofs: Float64Array): Stance {
    const world = this.worldOf(dofs);
    const rotation = new Float64Array(9);
    writeRotationPart(world, 16 * this.joint, rotation, 0, 3);
    const at = 16 * this.joint + 12;
    return { place: world.slice(at, at + 3), rotation };
  }

  /** The turn that faces the second stance like the first. Skeletons whose root can't turn are not turned. */
  turnBetween(first: Stance, second: Stance): number {
    if (!this.root) return 0;
    // D = R_first · R_secondᵀ; its nearest rotation about the up axis.
    const d = (r: number, c: number) => {
      let sum = 0;
      for (let k = 0; k < 3; k++) sum += first.rotation[3 * k + r] * second.rotation[3 * k + c];
      return sum;
    };
    const [u, v] = this.up === 1 ? [2, 0] : [0, 1];
    return Math.atan2(d(v, u) - d(u, v), d(u, u) + d(v, v));
  }

  /** The carry with this turn that takes one point over another, as seen from above. */
  over(turn: number, from: ArrayLike<number>, to: ArrayLike<number>): Carry {
    const moved = this.turned(turn, from);
    const shift = [0, 1, 2].map((k) => (k === this.up ? 0 : to[k] - moved[k]));
    return { turn, shift: [shift[0], shift[1], shift[2]] };
  }

  /** A point, or with `isDirection` a direction, carried. */
  point({ turn, shift }: Carry, p: ArrayLike<number>, isDirection = false): number[] {
    return this.turned(turn, p).map((v, k) => (isDirection ? v : v + shift[k]));
  }

  /**
   * Carries a pose, in place.
   * @param previous the frame before, already carried: angles are those nearest to its own
   */
  carry(carry: Carry, dofs: Float64Array, previous: Float64Array): void {
    const { compiled, local, a, b, q, root } = this;
    const first = compiled.hasRootTranslation ? 3 : 0;
    compiled.motions[0].write(dofs, compiled.firstDof[0], local, 0);
    const at = [0, 1, 2].map((k) => local[12 + k] + (first ? dofs[k] : 0));
    const moved = this.point(carry, at);
    for (let k = 0; k < 3; k++) {
      const dof = first ? k : compiled.slides[k];
      if (dof >= 0) dofs[dof] += moved[k] - at[k];
    }
    if (!root || carry.turn === 0) return;
    writeRotationPart(local, 0, a, 0, 3);
    const [y, z] = this.up === 1 ? [1, 0] : [0, 1];
    turnAbout(0, y, z, Math.cos(carry.turn), Math.sin(carry.turn), b, 0);
    multiply3(b, 0, a, 0, local, 0);
    quaternionOfRotation(local, 0, q);
    const [i, j, k] = root.channels;
    const found = anglesOf(q, 0, root.axes, previous[i], previous[j], previous[k]);
    dofs[i] = found[0];
    dofs[j] = found[1];
    dofs[k] = found[2];
  }

  private turned(turn: number, p: ArrayLike<number>): number[] {
    if (turn === 0) return [p[0], p[1], p[2]];
    const [u, v] = this.up === 1 ? [2, 0] : [0, 1];
    const [cos, sin] = [Math.cos(turn), Math.sin(turn)];
    const out = [p[0], p[1], p[2]];
    out[u] = cos * p[u] - sin * p[v];
    out[v] = sin * p[u] + cos * p[v];
    return out;
  }
}
