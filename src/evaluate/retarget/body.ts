/**
 * A skeleton in the scene: rotations and positions of its joints in metres with y up, whatever its own unit and up
 * axis. Matching, aligning and measuring work on these, so that only this file deals with spaces.
 */
import { multiply3, setIdentity3, writeRotationPart } from '../../math/mat3.ts';
import { filePose } from '../../model/skeleton/dofs.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import type { Space } from '../../model/space.ts';
import { compileSkeleton, worldMatrices } from '../kinematics.ts';
import { metresPerUnit } from '../space/metres.ts';

/** A posed skeleton in the scene. */
export interface RetargetBody {
  /** 9 numbers per joint. */
  readonly rotations: Float64Array;
  /** x y z per joint; metres, y up. */
  readonly points: Float64Array;
}

/** The up axis of a space as a rotation from the character's own axes to the scene's. */
export function upRotation(space: Space | undefined): Float64Array {
  const out = new Float64Array(9);
  // (x, y, z) → (x, z, −y), or (x, −y, −z)
  if (space?.up === 'z') out.set([1, 0, 0, 0, 0, -1, 0, 1, 0]);
  else if (space?.up === '-y') out.set([1, 0, 0, 0, -1, 0, 0, 0, -1]);
  else setIdentity3(out);
  return out;
}

/**
 * A posed skeleton in the scene: metres, y up.
 * @param dofs all of the character's; absent: the file pose
 */
export function retargetBody(skeleton: Skeleton, space: Space | undefined, dofs?: Float64Array): RetargetBody {
  const compiled = compileSkeleton(skeleton);
  const { jointCount } = compiled;
  const world = new Float64Array(16 * jointCount);
  worldMatrices(compiled, dofs ?? Float64Array.from(filePose(skeleton, 0)), world);
  const up = upRotation(space);
  const metres = space ? metresPerUnit(space) : 1;
  const lift = space?.lift ?? 0;
  const rotations = new Float64Array(9 * jointCount);
  const points = new Float64Array(3 * jointCount);
  const own = new Float64Array(9);
  for (let j = 0; j < jointCount; j++) {
    writeRotationPart(world, 16 * j, own, 0, 3);
    multiply3(up, 0, own, 0, rotations, 9 * j);
    const [x, y, z] = [world[16 * j + 12], world[16 * j + 13], world[16 * j + 14]];
    for (let k = 0; k < 3; k++) points[3 * j + k] = metres * (up[k] * x + up[3 + k] * y + up[6 + k] * z);
    points[3 * j + 1] += lift;
  }
  return { rotations, points };
}

/** Distance of joints `a` and `b`, in metres. */
export function distance({ points }: RetargetBody, a: number, b: number): number {
  return Math.hypot(
    points[3 * a] - points[3 * b],
    points[3 * a + 1] - points[3 * b + 1],
    points[3 * a + 2] - points[3 * b + 2],
  );
}
