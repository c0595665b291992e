/**
 * How a joint's DOFs are mirrored (`reflection.ts`): the matrix J of its partner and, if that is all there is to it, a
 * sign for each DOF. Signs are found by trial, independent of joint types.
 */
import type { CompiledSkeleton } from '../../evaluate/kinematics.ts';
import { multiply3 } from '../../math/mat3.ts';
import { withoutRoundOff } from '../../math/round-off.ts';
import { dofsOf } from '../../model/skeleton/joint-types.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import type { JointMaps } from './reflection-maps.ts';

/** Values away from the reference pose, different for each DOF. */
const PROBES = [0.31, -0.47, 0.73, 0.22, -0.61, 0.53, 0.17, -0.29, 0.41];
const EXACT = 1e-9;

/** For each DOF of a joint its sign in the partner's, by target DOF; 0 if signs are not sufficient. */
export function signsOf(skeleton: Skeleton, compiled: CompiledSkeleton, reflection: JointMaps): Int8Array {
  const { partner, reference } = reflection;
  const signs = new Int8Array(compiled.firstDof[compiled.jointCount]);
  const theirs = reference.slice();
  const own = reference.slice();
  const wanted = new Float64Array(16);
  const got = new Float64Array(16);
  const names = skeleton.joints.map(({ motion }) =>
    dofsOf(motion)
      .map(({ name }) => name)
      .join(),
  );
  for (let s = 0; s < compiled.jointCount; s++) {
    const t = partner[s];
    if (t < 0 || names[s] !== names[t] || partner[compiled.parent[s]] !== compiled.parent[t]) {
      if (s > 0) continue;
    }
    const from = compiled.firstDof[s];
    const to = compiled.firstDof[t];
    const count = compiled.firstDof[s + 1] - from;
    const agrees = () => {
      localMirrored(compiled, reflection, s, theirs, wanted);
      compiled.motions[t].write(own, to, got, 0);
      for (let k = 0; k < 15; k++) if (Math.abs(got[k] - wanted[k]) > EXACT * (1 + Math.abs(wanted[k]))) return false;
      return true;
    };
    const found = new Array<number>(count).fill(0);
    let isSigned = true;
    for (let d = 0; d < count && isSigned; d++) {
      theirs[from + d] = reference[from + d] + PROBES[d % PROBES.length];
      for (const sign of [1, -1]) {
        own[to + d] = signed(sign, reference[from + d], reference[to + d], theirs[from + d]);
        if (agrees()) {
          found[d] = sign;
          break;
        }
      }
      isSigned = found[d] !== 0;
      theirs[from + d] = reference[from + d];
      own[to + d] = reference[to + d];
    }
    for (let d = 0; d < count; d++) {
      theirs[from + d] = reference[from + d] + PROBES[d % PROBES.length];
      own[to + d] = signed(found[d], reference[from + d], reference[to + d], theirs[from + d]);
    }
    if (isSigned && agrees()) signs.set(found, to);
    for (let d = 0; d < count; d++) {
      theirs[from + d] = reference[from + d];
      own[to + d] = reference[to + d];
    }
  }
  return signs;
}

/**
 * Mirrors a value by its sign, keeping the distance from the reference; exact if the reference is zero or mirrored too.
 */
export function signed(sign: number, from: number, to: number, value: number): number {
  if (from === sign * to) return sign * value + 0;
  return withoutRoundOff(to + sign * (value - from), Math.max(Math.abs(from), Math.abs(to), Math.abs(value)));
}

/** Scratch; never escapes. */
const matrix = new Float64Array(16);
const nine = new Float64Array(9);
const half = new Float64Array(9);

/**
 * Writes the wanted J of a joint's partner, 16 numbers, from the joint's own DOFs.
 * @param dofs of the character, of which only those of joint `s` are used
 */
export function localMirrored(
  compiled: CompiledSkeleton,
  reflection: JointMaps,
  s: number,
  dofs: Float64Array,
  out: Float64Array,
): void {
  const { partner, reference, maps } = reflection;
  const t = partner[s];
  const above = compiled.parent[s];
  const [map, mo] = above < 0 ? [reflection.matrix, 0] : [maps, 9 * above];
  // Both pivots in the reference pose.
  compiled.motions[s].write(reference, compiled.firstDof[s], matrix, 0);
  const [x0, y0, z0] = [matrix[12], matrix[13], matrix[14]];
  compiled.motions[t].write(reference, compiled.firstDof[t], matrix, 0);
  const [x1, y1, z1] = [matrix[12], matrix[13], matrix[14]];
  compiled.motions[s].write(dofs, compiled.firstDof[s], matrix, 0);
  for (let c = 0; c < 3; c++) for (let r = 0; r < 3; r++) nine[3 * c + r] = matrix[4 * c + r];
  // K is orthogonal: its inverse is its transpose.
  multiply3(map, mo, nine, 0, half, 0);
  for (let c = 0; c < 3; c++) {
    for (let r = 0; r < 3; r++) {
      let sum = 0;
      for (let k = 0; k < 3; k++) sum += half[3 * k + r] * maps[9 * s + 3 * k + c];
      out[4 * c + r] = sum;
    }
  }
  const [x, y, z] = [matrix[12] - x0, matrix[13] - y0, matrix[14] - z0];
  out[12] = x1 + map[mo] * x + map[mo + 3] * y + map[mo + 6] * z;
  out[13] = y1 + map[mo + 1] * x + map[mo + 4] * y + map[mo + 7] * z;
  out[14] = z1 + map[mo + 2] * x + map[mo + 5] * y + map[mo + 8] * z;
  out[3] = out[7] = out[11] = 0;
  out[15] = 1;
}
