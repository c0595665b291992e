/** Matrices relative to the parent's, of world matrices that any program gave. */
import { invertAffine, isSingular, multiplyAffine } from '../../math/mat4.ts';

const inverse = new Float64Array(16);

/**
 * inv(W of the parent)·W of each joint; NaN where the parent's is singular.
 *
 * @param world 16 per joint, column-major
 */
export function relativeMatrices(
  world: Float64Array,
  joints: readonly { readonly parent: number }[],
): Float64Array<ArrayBuffer> {
  const out = new Float64Array(world.length);
  joints.forEach(({ parent }, j) => {
    if (parent < 0) out.set(world.subarray(16 * j, 16 * j + 16), 16 * j);
    else if (isSingular(world, 16 * parent)) out.fill(Number.NaN, 16 * j, 16 * j + 16);
    else {
      invertAffine(world, 16 * parent, inverse, 0);
      multiplyAffine(inverse, 0, world, 16 * j, out, 16 * j);
    }
  });
  return out;
}

/** World matrices of matrices relative to parents; the inverse of `relativeMatrices`. */
export function worldOfRelative(
  relative: Float64Array,
  joints: readonly { readonly parent: number }[],
): Float64Array<ArrayBuffer> {
  const out = Float64Array.from(relative);
  joints.forEach(({ parent }, j) => {
    if (parent >= 0) multiplyAffine(out, 16 * parent, relative, 16 * j, out, 16 * j);
  });
  return out;
}
