/** Which way characters face, by what is left and right of them. */
import { isBvh } from '../../model/document.ts';
import { filePose } from '../../model/dofs.ts';
import type { Skeleton } from '../../model/skeleton.ts';
import { readName, type Word } from '../retarget/names.ts';
import { worldOf } from './world-of.ts';

/**
 * Facing direction of a character as x and z with y up: perpendicular to the line between joints that are left and right
 * by their role or their name; z if neither tells. Motion capture may face anywhere, so there the pose decides; elsewhere a pose that turns the
 * whole figure is shown as turned.
 */
export function frontOf(
  skeleton: Skeleton | undefined,
  values: ArrayLike<number>,
  up: 'y' | 'z',
): readonly [number, number] {
  if (!skeleton) return [0, 1];
  const world = worldOf(skeleton, isBvh({ skeleton }) ? values : filePose(skeleton, 0), false);
  let x = 0;
  let z = 0;
  skeleton.joints.forEach(({ name, role }, j) => {
    const { side } = readName(role ?? name);
    if (side === 'middle') return;
    const sign = side === 'left' ? 1 : -1;
    x += sign * world[16 * j + 12];
    z += sign * (up === 'y' ? world[16 * j + 14] : -world[16 * j + 13]);
  });
  // Left × up.
  return Math.hypot(x, z) > 0 ? [-z, x] : [0, 1];
}

const ARMS: ReadonlySet<Word | undefined> = new Set<Word>(['arm', 'forearm', 'hand']);
const LEGS: ReadonlySet<Word | undefined> = new Set<Word>(['thigh', 'shin', 'foot']);

/** Whether a skeleton has arms and legs on both sides, by roles or names. */
export function isPerson({ joints }: Skeleton): boolean {
  const limbs = new Set(
    joints.map(({ name, role }) => {
      const { side, word } = readName(role ?? name);
      return `${side} ${ARMS.has(word) ? 'arm' : LEGS.has(word) ? 'leg' : ''}`;
    }),
  );
  return ['left arm', 'right arm', 'left leg', 'right leg'].every((limb) => limbs.has(limb));
}
