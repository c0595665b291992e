/**
 * How a skeleton is mirrored: the plane, the pairs of joints, and the mapping of their DOFs.
 *
 * Each joint j has a map K_j from its own axes to those of its counterpart j′, mirrored. With A the 3×3 part of local
 * matrices, t the displacement of pivots, t⁰ that in the reference pose, and M the reflection in the character's axes,
 * used above the root,
 *
 *     A′_{j′} = K_parent · A_j · K_j⁻¹        t′_{j′} − t⁰_{j′} = K_parent · (t_j − t⁰_j)
 *
 * and so R′_{j′} = M · R_j · K_j⁻¹ in the world. K is M if joints' axes are parallel to the character's at rest, as in
 * most files. Some skeletons have no sides at rest, such as the axis-angle form, whose bones are all along +y: there K
 * follows from the file pose. And in some each joint has axes of its own, along its bone on one side and against it on
 * the other: there K must take the offsets to those of the other side.
 *
 * For most skeletons this is a sign per DOF: signs are found by trial, independent of joint types, and exact. Others
 * are fitted (`fit-local.ts`).
 */
import { type CompiledSkeleton, compileSkeleton, worldMatrices } from '../../evaluate/kinematics.ts';
import type { Vec3 } from '../../math/vec3.ts';
import { perObject } from '../../model/per-object.ts';
import { filePose, restPose } from '../../model/skeleton/dofs.ts';
import { dofsOf, replacesOffset } from '../../model/skeleton/joint-types.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { halfWidth, type Partners, partnersAcross } from './partners.ts';
import { fittingMap, type JointMaps, mapsOf, reflectionMatrix } from './reflection-maps.ts';
import { signsOf } from './reflection-signs.ts';
import { partnersByName, sideOf } from './sides.ts';

/** The data for mirroring poses of a skeleton. */
export interface Reflection extends JointMaps {
  /** Normal of the plane, normalised; the plane passes through the root in the reference pose. */
  readonly normal: Vec3;
  /**
   * For each DOF of a joint its sign, if signs are sufficient for the joint; otherwise 0. By target DOF, that of the
   * partner.
   */
  readonly signs: Int8Array;
  /** Size of the skeleton in the reference pose. */
  readonly size: number;
  /**
   * The first joint with two sides below it, and their direction in its own axes; undefined for a skeleton without
   * sides.
   */
  readonly lateral: { readonly joint: number; readonly direction: Vec3 } | undefined;
}

const X: Vec3 = [1, 0, 0];
const Y: Vec3 = [0, 1, 0];
const Z: Vec3 = [0, 0, 1];
/** Directions within 15° of an axis snap to it. */
const NEARLY = Math.cos(Math.PI / 12);
/** Average distance of mirrored joints from their partners up to which a character is symmetric. In sizes. */
const SYMMETRIC = 0.02;
/** Paired joints this close show no sides. */
const APART = 1e-3;

/** A skeleton's reflection, cached. */
export const reflectionOf = perObject(find);

interface Candidate extends Partners {
  readonly normal: Vec3;
  readonly dofs: Float64Array;
  readonly size: number;
}

function find(skeleton: Skeleton): Reflection {
  const compiled = compileSkeleton(skeleton);
  const atRest = bestPlane(skeleton, compiled, restValues(skeleton));
  const inFile = bestPlane(skeleton, compiled, Float64Array.from(filePose(skeleton, 0)));
  const chosen = saysMore(inFile, atRest) ? inFile : atRest;
  const { normal, partner, dofs, size } = chosen;
  const matrix = reflectionMatrix(normal);
  const base = { normal, matrix, partner, reference: dofs, size, lateral: lateralOf(skeleton, partner) };
  const found = { ...base, maps: mapsOf(skeleton, compiled, base) };
  return { ...found, signs: signsOf(skeleton, compiled, found) };
}

function lateralOf({ joints }: Skeleton, partner: Int32Array): Reflection['lateral'] {
  const isOuter = (j: number) => partner[j] > j && partner[joints[j].parent] === joints[j].parent;
  for (let j = 1; j < joints.length; j++) {
    const other = partner[j];
    const { parent } = joints[j];
    if (!isOuter(j) || joints[other].parent !== parent) continue;
    const d = [0, 1, 2].map((k) => joints[j].offset[k] - joints[other].offset[k]);
    const length = Math.hypot(...d);
    if (length > 0) return { joint: parent, direction: [d[0] / length, d[1] / length, d[2] / length] };
  }
  return undefined;
}

/** All DOFs at rest; position channels that replace offsets at the offsets. */
function restValues(skeleton: Skeleton): Float64Array {
  const values = Float64Array.from(restPose(skeleton, 0));
  const { firstDof } = compileSkeleton(skeleton);
  skeleton.joints.forEach(({ motion, offset }, j) => {
    dofsOf(motion).forEach(({ name }, d) => {
      if (replacesOffset(motion, name)) values[firstDof[j] + d] = offset['xyz'.indexOf(name[1])];
    });
  });
  return values;
}

/** Whether the file pose shows the sides better: the other shows none, or is not symmetric. */
function saysMore(inFile: Candidate, atRest: Candidate): boolean {
  const sides = ({ apart, paired }: Candidate) => paired > 0 && apart > APART * paired;
  if (sides(inFile) !== sides(atRest)) return sides(inFile);
  const count = atRest.partner.length;
  if (atRest.asymmetry <= SYMMETRIC * count) return false;
  return inFile.asymmetry < atRest.asymmetry / 2;
}

/** The plane through the root across which the skeleton is most symmetric in that pose. */
function bestPlane(skeleton: Skeleton, compiled: CompiledSkeleton, dofs: Float64Array): Candidate {
  const world = new Float64Array(16 * compiled.jointCount);
  worldMatrices(compiled, dofs, world);
  const points = new Float64Array(3 * compiled.jointCount);
  for (let j = 0; j < compiled.jointCount; j++) for (let k = 0; k < 3; k++) points[3 * j + k] = world[16 * j + 12 + k];
  const candidate = (normal: Vec3): Candidate => ({
    ...partnersAcross(skeleton, points, normal),
    ...{ normal, dofs, size: halfWidth(points) },
  });
  const named = normalByNames(skeleton, points);
  if (named) return candidate(named);
  // For ties: most characters face along z, some along x, and hardly any lies on its side.
  return [X, Z, Y].map(candidate).reduce((best, other) => {
    const isBetter = other.paired === best.paired ? other.asymmetry < 0.5 * best.asymmetry : other.paired > best.paired;
    return isBetter ? other : best;
  });
}

/**
 * From right to left, by names, at the first joint with pairs below it. Joints farther out may have axes of their own.
 */
function normalByNames({ joints }: Skeleton, points: Float64Array): Vec3 | undefined {
  const partner = partnersByName(joints.map(({ name }) => name));
  const sum = [0, 0, 0];
  let first = -1;
  joints.forEach(({ name, parent }, j) => {
    const other = partner[j];
    if (other < 0 || joints[other].parent !== parent || partner[parent] >= 0) return;
    if (sideOf(name) !== 'left' || (first >= 0 && first !== parent)) return;
    const d = [0, 1, 2].map((k) => points[3 * j + k] - points[3 * other + k]);
    if (Math.hypot(...d) < APART * halfWidth(points)) return;
    first = parent;
    for (let k = 0; k < 3; k++) sum[k] += d[k];
  });
  const length = Math.hypot(...sum);
  if (!(length > APART * halfWidth(points))) return undefined;
  const [x, y, z] = sum.map((v) => v / length);
  return [X, Y, Z].find((axis) => Math.abs(axis[0] * x + axis[1] * y + axis[2] * z) > NEARLY) ?? [x, y, z];
}

/** The reflection across another plane of the character's space. A root without sides of its own takes the plane's. */
export function acrossPlane(skeleton: Skeleton, reflection: Reflection, normal: Vec3): Reflection {
  if (reflection.normal.every((v, k) => v === normal[k])) return reflection;
  const compiled = compileSkeleton(skeleton);
  const matrix = reflectionMatrix(normal);
  const maps = reflection.maps.slice();
  if (fittingMap(skeleton, reflection.partner, 0, matrix) === matrix) maps.set(matrix);
  const turned = { ...reflection, normal, matrix, maps };
  return { ...turned, signs: signsOf(skeleton, compiled, turned) };
}
