/** What is drawn of a comparison: verdicts of joints, theirs in world space, errors as colours. */
import { multiplyAffine } from '../../../math/mat4.ts';
import type { Skeleton } from '../../../model/skeleton.ts';
import type { ShownComparison } from '../../state/dump-comparison.ts';
import { heatScale } from '../skin/four-text.ts';

/** What a drawing shows: joints and bones, or the skin. */
export type ComparedPart = 'joints' | 'skin';

/** What was compared, that with the first wrong item first. */
export function comparedParts({ frame }: ShownComparison): readonly ComparedPart[] {
  const hasJoints = frame.jointErrors.length > 0;
  const hasSkin = errorsOfSkin(frame).length > 0;
  if (!hasJoints || !hasSkin) return hasJoints ? ['joints'] : hasSkin ? ['skin'] : [];
  const what = frame.first?.what;
  return what === 'vertex' || what === 'normal' ? ['skin', 'joints'] : ['joints', 'skin'];
}

/** Whether it can be told which joints are wrong by themselves: not from positions alone. */
export function tellsOwn({ theirs }: ShownComparison): boolean {
  return theirs.world !== undefined || theirs.local !== undefined;
}

/** World matrices, 16 per joint, or positions, x y z per joint; of local matrices their products. */
export function theirJoints({ joints }: Skeleton, { theirs }: ShownComparison): Float64Array | undefined {
  const { world, positions, local } = theirs;
  if (world ?? positions) return world ?? positions;
  if (!local) return undefined;
  const made = new Float64Array(16 * joints.length);
  joints.forEach(({ parent }, j) => {
    if (parent < 0) made.set(local.subarray(16 * j, 16 * j + 16), 16 * j);
    else multiplyAffine(made, 16 * parent, local, 16 * j, made, 16 * j);
  });
  return made;
}

/** Of vertices, else of normals; empty if neither was compared. */
export function errorsOfSkin({ vertexErrors, normalErrors }: ShownComparison['frame']): Float64Array {
  return vertexErrors.length > 0 ? vertexErrors : normalErrors;
}

export interface HeatScale {
  /** Error of the brightest colour, a round part of the size; larger ones have it too. */
  readonly top: number;
  /** Item with the largest error; undefined if all agree. */
  readonly worst: number | undefined;
}

/**
 * Writes errors as parts of the scale, from 0 to 1. If all are within the tolerance, that is its end.
 *
 * @param out as many as errors
 */
export function fillHeat(errors: Float64Array, tolerance: number, out: Float32Array): HeatScale {
  let largest = 0;
  let most = tolerance;
  let worst: number | undefined;
  for (let v = 0; v < errors.length; v++) {
    const error = errors[v];
    if (Number.isFinite(error)) largest = Math.max(largest, error);
    // Not `>`: NaN is infinitely wrong.
    if (error <= most) continue;
    most = Number.isNaN(error) ? Number.POSITIVE_INFINITY : error;
    worst = v;
  }
  const top = largest > tolerance ? heatScale(largest) || largest : tolerance;
  for (let v = 0; v < errors.length; v++) {
    const part = errors[v] / top;
    out[v] = part <= 1 ? part : 1;
  }
  return { top, worst };
}
