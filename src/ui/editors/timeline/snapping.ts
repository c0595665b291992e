/**
 * Snapping of dragged keys: the grabbed key snaps to a whole frame or value step, and the rest of the selection moves
 * by the same amount. Snapping each key separately would change their distances; that is what *Snap to frames* is for.
 */

import { roundStep } from '../../../math/round-steps.ts';
import { lengthStep } from '../../../model/skeleton/reach.ts';
import type { DofUnit, Skeleton } from '../../../model/skeleton/skeleton.ts';
import { withoutNoise } from '../../state/joints/angles.ts';

/** Seconds to move by, close to `seconds`, that put a key at `keySeconds` of the transport on a whole frame. */
export function snapSeconds(keySeconds: number, seconds: number, framesPerSecond: number): number {
  return Math.round((keySeconds + seconds) * framesPerSecond) / framesPerSecond - keySeconds;
}

/** The change, close to `by`, that makes `value` a whole number of steps. */
export function snapValue(value: number, by: number, step: number): number {
  return step > 0 ? Math.round((value + by) / step) * step - value : by;
}

/** Minimum size of a value step in pixels. */
const NEAREST_PIXELS = 12;

/**
 * The value step for snapping by mouse: 1, 2 or 5 times a power of ten in displayed units, so whole degrees rather than
 * odd radians.
 *
 * @param pixelsPerUnit pixels per model unit
 * @param shownPerUnit displayed units per model unit: 180/π for degrees, else 1
 */
export function valueStep(pixelsPerUnit: number, shownPerUnit: number): number {
  return roundStep((NEAREST_PIXELS / Math.abs(pixelsPerUnit)) * shownPerUnit) / shownPerUnit;
}

/**
 * Step of an arrow key: 1°; for lengths about a hundredth of the character's size; 0.01 for radians and weights. In
 * model units.
 */
export function nudgeStep(unit: DofUnit, degrees: boolean, skeleton: Skeleton | undefined): number {
  if (unit === 'length') return lengthStep(skeleton);
  return unit === 'angle' && degrees ? Math.PI / 180 : 0.01;
}

/** The frame number, rounded if it is whole up to rounding errors. */
export function frameNumber(seconds: number, framesPerSecond: number): number {
  const frames = seconds * framesPerSecond;
  const whole = Math.round(frames);
  return Math.abs(frames - whole) < 1e-6 ? whole : withoutNoise(frames);
}
