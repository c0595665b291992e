import { transformPoint, type Vec3 } from '../../math/vec3.ts';
import type { FrameTarget } from '../compare/targets.ts';
import type { EndEffector } from './goal.ts';

/** Where a dump has the point; undefined if its numbers don't tell. */
export function placeIn({ world, positions }: FrameTarget, { joint, point }: EndEffector): Vec3 | undefined {
  if (world) return transformPoint(world, point, 16 * joint);
  if (!positions || point.some((part) => part !== 0)) return undefined;
  return [positions[3 * joint], positions[3 * joint + 1], positions[3 * joint + 2]];
}
