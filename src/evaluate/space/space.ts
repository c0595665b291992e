/**
 * From a character's own space to the scene's: metres, y up, feet on the ground y = 0.
 *
 *     M = T(0, lift, 0) · S(metres per unit) · Up     Up: identity for y; for z (x, y, z) → (x, z, −y), for -y (x, −y, −z)
 *
 * Motion capture files state none of them: `space-guess.ts` guesses.
 */

import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { DEFAULT_SPACE, type Space } from '../../model/space.ts';
import type { Take } from '../../model/takes/take.ts';
import { type FrameShape, frameShapes, percentile } from './frame-shapes.ts';
import { metresPerUnit } from './metres.ts';

/** `centimetres`, for messages. */
export function unitText({ unit, ...space }: Space): string {
  if (unit === 'own') return `units of ${Number(metresPerUnit({ unit, ...space }).toPrecision(3))} m`;
  return unit === 'cmu' ? 'CMU units' : unit === 'asIs' ? 'units as they are' : unit;
}

/** `centimetres, y up`, for messages. */
export function spaceText(space: Space): string {
  return `${unitText(space)}, ${upText(space)}`;
}

/** `y up`, for messages. */
export function upText({ up }: Pick<Space, 'up'>): string {
  return up === '-y' ? 'y down' : `${up} up`;
}

/** The vertical axis in the character's own space: 1 for y, 2 for z. */
export function upAxis(space: Pick<Space, 'up'> = DEFAULT_SPACE): 1 | 2 {
  return space.up === 'z' ? 2 : 1;
}

/** Writes a point of the character's own space in metres with y up, before any placement. */
export function applySpace(space: Space | undefined, x: number, y: number, z: number, out: Float64Array): void {
  const { up, lift } = space ?? DEFAULT_SPACE;
  const m = space ? metresPerUnit(space) : 1;
  out[0] = m * x;
  out[1] = m * (up === 'z' ? z : up === 'y' ? y : -y) + lift;
  out[2] = m * (up === 'z' ? -y : up === 'y' ? z : -z);
}

/** Percentile of the frames' lowest points: noise and toes through the floor are below, jumps above. */
export const GROUND_PERCENTILE = 0.15;

/** The lowest point of a frame, along the up axis. */
export function lowest({ min, max }: FrameShape, up: Space['up']): number {
  return up === '-y' ? -max[1] : min[upAxis({ up })];
}

/** The lift that puts a character on the ground in a space with known up axis and unit. */
export function liftOntoGround(skeleton: Skeleton, take: Take | undefined, space: Space): number {
  const lows = frameShapes(skeleton, take).map((frame) => lowest(frame, space.up));
  const low = metresPerUnit(space) * percentile(lows, GROUND_PERCENTILE);
  return Number.isFinite(low) ? -Number(low.toPrecision(4)) || 0 : 0;
}
