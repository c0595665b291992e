/** The maps K of a reflection (`reflection.ts`): from each joint's own axes to those of its counterpart, mirrored. */
import type { CompiledSkeleton } from '../../evaluate/kinematics.ts';
import { backMultiply3, multiply3, writeRotationPart } from '../../math/mat3.ts';
import type { Vec3 } from '../../math/vec3.ts';
import { perObject } from '../../model/per-object.ts';
import type { Joint, Skeleton } from '../../model/skeleton/skeleton.ts';

/** How the DOFs of each joint are mirrored. */
export interface JointMaps {
  /** M, nine numbers. */
  readonly matrix: Float64Array;
  /** Each joint's counterpart, itself in the middle, -1 if it has none and keeps its DOFs. */
  readonly partner: Int32Array;
  /** The character's DOFs in the reference pose, without morphs. */
  readonly reference: Float64Array;
  /** K of each joint with a partner, nine numbers. */
  readonly maps: Float64Array;
}

/** I − 2·n·nᵀ, nine numbers. */
export function reflectionMatrix(normal: Vec3): Float64Array {
  const out = new Float64Array(9);
  for (let c = 0; c < 3; c++) {
    for (let r = 0; r < 3; r++) out[3 * c + r] = (r === c ? 1 : 0) - 2 * normal[r] * normal[c];
  }
  return out;
}

const [ACROSS_X, ACROSS_Y, ACROSS_Z] = ([0, 1, 2] as const).map((k) =>
  reflectionMatrix([k === 0 ? 1 : 0, k === 1 ? 1 : 0, k === 2 ? 1 : 0]),
);
/** All axes reversed. */
const REVERSED = Float64Array.of(-1, 0, 0, 0, -1, 0, 0, 0, -1);

/** K of each joint with a counterpart: its parent's, rotated by the two joints' rotations in the reference pose. */
export function mapsOf(
  skeleton: Skeleton,
  compiled: CompiledSkeleton,
  { partner, reference, matrix }: Omit<JointMaps, 'maps'>,
): Float64Array {
  const { jointCount, parent, firstDof, motions } = compiled;
  const maps = new Float64Array(9 * jointCount);
  const rotations = new Float64Array(9 * jointCount);
  const local = new Float64Array(16);
  for (let j = 0; j < jointCount; j++) {
    motions[j].write(reference, firstDof[j], local, 0);
    writeRotationPart(local, 0, local, 0, 4);
    for (let c = 0; c < 3; c++) for (let r = 0; r < 3; r++) rotations[9 * j + 3 * c + r] = local[4 * c + r];
  }
  const rotated = new Float64Array(9);
  const own = new Float64Array(9);
  for (let j = 0; j < jointCount; j++) {
    const other = partner[j];
    if (other < 0) continue;
    const above = parent[j];
    const isKnown = above >= 0 && partner[above] >= 0;
    multiply3(isKnown ? maps : matrix, isKnown ? 9 * above : 0, rotations, 9 * j, rotated, 0);
    backMultiply3(rotations, 9 * other, rotated, 0, own, 0);
    maps.set(fittingMap(skeleton, partner, j, own), 9 * j);
  }
  return maps;
}

/** Accepted error of a map on the offsets, relative to their length. */
const ACCEPTED_ERROR = 0.15;
/** Another map replaces it if its error is smaller by this factor; a later candidate must be clearly better still. */
const MUCH_BETTER = 0.25;
const CLEARLY_BETTER = 0.9;

/**
 * The map itself if it takes the offsets of the joint's children to those of their counterparts; else the one that
 * does, among those that permute axes. If bones run along opposite directions, all three axes are reversed.
 */
export function fittingMap({ joints }: Skeleton, partner: Int32Array, j: number, map: Float64Array): Float64Array {
  const other = partner[j];
  const pairs: (readonly [Vec3, Vec3])[] = [];
  let length = 0;
  const add = (from: Vec3, to: Vec3) => {
    pairs.push([from, to]);
    length += Math.hypot(...from);
  };
  for (const c of childrenOf(joints)[j]) {
    if (partner[c] >= 0 && joints[partner[c]].parent === other) add(joints[c].offset, joints[partner[c]].offset);
  }
  const ends = joints[other].endSites ?? [];
  joints[j].endSites?.forEach((end, i) => {
    if (ends.length === joints[j].endSites?.length) add(end, ends[i]);
  });
  const errorOf = (m: Float64Array) => {
    let sum = 0;
    for (const [[x, y, z], to] of pairs) {
      sum += Math.hypot(...[0, 1, 2].map((k) => m[k] * x + m[3 + k] * y + m[6 + k] * z - to[k]));
    }
    return sum;
  };
  const own = errorOf(map);
  if (own <= ACCEPTED_ERROR * length) return map;
  let best = map;
  let least = MUCH_BETTER * own;
  for (const candidate of other === j ? [ACROSS_X, ACROSS_Z, ACROSS_Y] : [REVERSED, ACROSS_X, ACROSS_Y, ACROSS_Z]) {
    const error = errorOf(candidate);
    if (error >= least) continue;
    best = candidate;
    least = CLEARLY_BETTER * error;
  }
  return best;
}

const childrenOf = perObject((joints: readonly Joint[]): readonly number[][] => {
  const children: number[][] = joints.map(() => []);
  joints.forEach(({ parent }, j) => {
    if (parent >= 0) children[parent].push(j);
  });
  return children;
});
