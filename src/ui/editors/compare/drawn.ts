/** What is drawn of a comparison: verdicts of joints, theirs in world space, errors as colours. */
import { multiplyAffine } from '../../../math/mat4.ts';
import { perObject } from '../../../model/per-object.ts';
import type { Skeleton } from '../../../model/skeleton/skeleton.ts';
import type { ComparedResult, ShownComparison } from '../../state/dump-comparison.ts';
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

/**
 * Error of the brightest colour of a skin, a round part of the size: the same at all times that were compared, so that
 * colours mean the same while time moves. If all are within the tolerance, that is it.
 */
export function heatTop({ result, frame }: ShownComparison): number {
  const { vertices, normals } = largestErrors(result);
  const largest = frame.vertexErrors.length > 0 ? vertices : normals;
  return largest > result.tolerance ? heatScale(largest) || largest : result.tolerance;
}

/** At all times; infinite ones don't count. Cached. */
const largestErrors = perObject(({ comparison: { frames } }: ComparedResult) => ({
  vertices: frames.reduce((most, { vertexErrors }) => largestOf(vertexErrors, most), 0),
  normals: frames.reduce((most, { normalErrors }) => largestOf(normalErrors, most), 0),
}));

function largestOf(errors: Float64Array, from: number): number {
  let largest = from;
  for (const error of errors) if (error > largest && error < Infinity) largest = error;
  return largest;
}

/**
 * Writes errors as parts of the largest that is shown, from 0 to 1: larger ones, and those that are not numbers, are 1.
 *
 * @param out as many as errors
 * @returns index of the largest error; undefined if all are within the tolerance
 */
export function fillHeat(errors: Float64Array, tolerance: number, top: number, out: Float32Array): number | undefined {
  let most = tolerance;
  let worst: number | undefined;
  for (let v = 0; v < errors.length; v++) {
    const error = errors[v];
    const part = error / top;
    out[v] = part <= 1 ? part : 1;
    // Not `>`: NaN is infinitely wrong.
    if (error <= most) continue;
    most = Number.isNaN(error) ? Number.POSITIVE_INFINITY : error;
    worst = v;
  }
  return worst;
}
