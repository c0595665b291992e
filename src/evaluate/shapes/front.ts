/** Which way characters face, by what is left and right of them. */
import { isBvh } from '../../model/document.ts';
import { filePose } from '../../model/skeleton/dofs.ts';
import type { Joint, Skeleton } from '../../model/skeleton/skeleton.ts';
import type { Space } from '../../model/space.ts';
import { worldOf } from './world-of.ts';

/**
 * Facing direction of a character as x and z with y up: perpendicular to the line between joints that are left and
 * right; z if there are none. Motion capture may face anywhere, so there the pose decides; elsewhere a pose that turns
 * the whole character is shown as turned.
 */
export function frontOf(
  skeleton: Skeleton | undefined,
  values: ArrayLike<number>,
  up: Space['up'],
  sideOf: (joint: Joint) => string | undefined,
): readonly [number, number] {
  if (!skeleton) return [0, 1];
  const world = worldOf(skeleton, isBvh({ skeleton }) ? values : filePose(skeleton, 0), false);
  let x = 0;
  let z = 0;
  skeleton.joints.forEach((joint, j) => {
    const side = sideOf(joint);
    if (side !== 'left' && side !== 'right') return;
    const sign = side === 'left' ? 1 : -1;
    x += sign * world[16 * j + 12];
    z += sign * (up === 'y' ? world[16 * j + 14] : -world[16 * j + (up === 'z' ? 13 : 14)]);
  });
  // Left × up.
  return Math.hypot(x, z) > 0 ? [-z, x] : [0, 1];
}

/** The side of a joint that has one by its role, where a file states roles. */
export function sideByRole({ role }: Pick<Joint, 'role'>): string | undefined {
  return /^(left|right)/.exec(role ?? '')?.[0];
}
