/**
 * Which feet stand when a drag of the whole body begins: they hold, as if pinned with their orientation, until it ends.
 * Feet are those of legs that are recognised, as for *Lock feet*; else all ends of limbs, such as an insect's.
 */
import { transformPoint, type Vec3, ZERO } from '../../../math/vec3.ts';
import type { Character } from '../../../model/document.ts';
import { hasOwnBox } from '../../../model/skeleton/axis-angle.ts';
import { tipOf } from '../../../model/skeleton/bone-ends.ts';
import { filePose } from '../../../model/skeleton/dofs.ts';
import type { Joint, Skeleton } from '../../../model/skeleton/skeleton.ts';
import type { Space } from '../../../model/space.ts';
import { compileSkeleton, worldMatrices } from '../../kinematics.ts';
import { LIMB_SIDES, partsOf } from '../../retarget/roles.ts';
import { limbOf } from '../limb.ts';

/** Fraction of the character's height above the ground. */
const STANDS = 0.02;

/**
 * Joints, ascending.
 * @param world of the pose at the start, from `worldMatrices`
 * @param placement from the character's space to the scene's, whose ground is y = 0
 */
export function standingFeet(
  { space }: Pick<Character, 'space'>,
  skeleton: Skeleton,
  world: Float64Array,
  placement: Float64Array,
): readonly number[] {
  const feet = feetOf(skeleton, space?.up);
  const lows = feet.map((foot) => heights(skeleton, world, placement, foot)[0]);
  // Where the origin is in a character's middle, its feet are below the ground, and the lowest one stands.
  const ground = Math.min(0, ...lows);
  const least = ground + STANDS * heightOf(skeleton, placement);
  return feet.filter((_, i) => lows[i] <= least);
}

function feetOf(skeleton: Skeleton, up: Space['up'] | undefined): readonly number[] {
  const { single } = partsOf(skeleton, up);
  const feet = LIMB_SIDES.flatMap((side) => {
    const leg = (['thigh', 'shin', 'foot'] as const).map((part) => single.get(`${side} ${part}`));
    return leg.every((joint) => joint !== undefined) ? leg.slice(2) : [];
  });
  if (feet.length > 0) return feet.sort((a, b) => a - b);
  const { subtreeEnd, jointCount } = compileSkeleton(skeleton);
  const all = Array.from({ length: jointCount }, (_, j) => j);
  return all.filter((j) => subtreeEnd[j] === j + 1 && limbOf(skeleton, j) !== 'body');
}

/** In the file pose; in the scene's unit. */
function heightOf(skeleton: Skeleton, placement: Float64Array): number {
  const compiled = compileSkeleton(skeleton);
  const world = new Float64Array(16 * compiled.jointCount);
  worldMatrices(compiled, Float64Array.from(filePose(skeleton, 0)), world);
  const [low, high] = heights(skeleton, world, placement, 0);
  return high - low;
}

/** The lowest and the highest point of a joint and all below it, in the scene. */
function heights(skeleton: Skeleton, world: Float64Array, placement: Float64Array, joint: number): [number, number] {
  const { subtreeEnd } = compileSkeleton(skeleton);
  let [low, high] = [Infinity, -Infinity];
  for (let j = joint; j < subtreeEnd[joint]; j++) {
    for (const point of pointsOf(skeleton.joints[j])) {
      const y = transformPoint(placement, transformPoint(world, point, 16 * j))[1];
      low = Math.min(low, y);
      high = Math.max(high, y);
    }
  }
  return [low, high];
}

/** Pivot, ends of bones, and the corners of a box that someone set. */
function pointsOf(joint: Joint): readonly Vec3[] {
  const tip = tipOf(joint);
  const points: Vec3[] = [ZERO, ...(joint.endSites ?? []), ...(tip ? [tip] : [])];
  if (!hasOwnBox(joint)) return points;
  const { min, max } = joint.box;
  for (const x of [min[0], max[0]])
    for (const y of [min[1], max[1]]) for (const z of [min[2], max[2]]) points.push([x, y, z]);
  return points;
}
