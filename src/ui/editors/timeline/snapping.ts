/**
 * Snapping while keys are dragged: what is grabbed lands on a whole frame or a whole step of values, and everything else
 * that is selected moves along by the same amount. Snapping each key by itself would change the distances between keys,
 * which is what *Snap to frames* is for.
 */
import { lengthStep } from '../../../model/reach.ts';
import type { DofUnit, Skeleton } from '../../../model/skeleton.ts';
import { niceStep } from '../../kit/ruler.ts';
import { withoutNoise } from '../../state/angles.ts';

/** Seconds to move by, near `seconds`, that put a key of the transport's `keySeconds` on a whole frame. */
export function snapSeconds(keySeconds: number, seconds: number, framesPerSecond: number): number {
  return Math.round((keySeconds + seconds) * framesPerSecond) / framesPerSecond - keySeconds;
}

/** What to add, near `by`, so that a value of `value` becomes a whole number of steps. */
export function snapValue(value: number, by: number, step: number): number {
  return step > 0 ? Math.round((value + by) / step) * step - value : by;
}

/** Lines of values are not asked to be nearer than this, in pixels. */
const NEAREST_PIXELS = 12;

/**
 * The step of values that can be hit with a mouse: 1, 2 or 5 times a power of ten of what is *shown*, so whole degrees
 * rather than odd radians.
 *
 * @param pixelsPerUnit pixels for each model unit
 * @param shownPerUnit what a model unit is shown as: 180/π for degrees, else 1
 */
export function valueStep(pixelsPerUnit: number, shownPerUnit: number): number {
  return niceStep((NEAREST_PIXELS / Math.abs(pixelsPerUnit)) * shownPerUnit) / shownPerUnit;
}

/**
 * One press of an arrow key: 1°; of lengths about a hundredth of the character, which may be a metre high or a hundred
 * inches; 0.01 of radians and weights. In model units.
 */
export function nudgeStep(unit: DofUnit, degrees: boolean, skeleton: Skeleton | undefined): number {
  if (unit === 'length') return lengthStep(skeleton);
  return unit === 'angle' && degrees ? Math.PI / 180 : 0.01;
}

/** A whole frame but for rounding is that frame; times are shown without the noise of the sums they came from. */
export function frameNumber(seconds: number, framesPerSecond: number): number {
  const frames = seconds * framesPerSecond;
  const whole = Math.round(frames);
  return Math.abs(frames - whole) < 1e-6 ? whole : withoutNoise(frames);
}
