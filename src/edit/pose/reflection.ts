/**
 * How a skeleton is mirrored: across which plane, which joint onto which, and what becomes of the DOFs of each.
 *
 * Each joint j has a map K_j from its own axes to those of its counterpart j′, mirrored. With A for local rotations (and
 * whatever else is in them), t for where they move pivots to, t⁰ in the pose of reference, and M the reflection in the
 * character's axes, which stands above the root,
 *
 *     A′_{j′} = K_parent · A_j · K_j⁻¹        t′_{j′} − t⁰_{j′} = K_parent · (t_j − t⁰_j)
 *
 * and so R′_{j′} = M · R_j · K_j⁻¹ in the world. K is M where the axes of joints lie as the character's do while no DOF
 * turns, which is what most files have. Some skeletons have no sides then, as in the axis-angle form, whose bones all lie
 * along +y without their angles: there K follows from the pose of the file. And in some each joint has axes of its own,
 * along its bone on one side and against it on the other: there offsets tell, which K has to take to those of the other
 * side.
 *
 * In most skeletons that is a sign for each DOF: signs are found by trying them, whatever the kind of joint is, and are
 * exact to the last bit. Others are fitted (`fit-local.ts`).
 */
import { type CompiledSkeleton, compileSkeleton, worldMatrices } from '../../evaluate/kinematics.ts';
import type { Vec3 } from '../../math/vec3.ts';
import { filePose, restPose } from '../../model/dofs.ts';
import { dofsOf, replacesOffset } from '../../model/joint-types.ts';
import { perObject } from '../../model/per-object.ts';
import type { Skeleton } from '../../model/skeleton.ts';
import { halfWidth, type Partners, partnersAcross } from './partners.ts';
import { fittingMap, type JointMaps, mapsOf, reflectionMatrix } from './reflection-maps.ts';
import { signsOf } from './reflection-signs.ts';
import { partnersByName, sideOf } from './sides.ts';

/** What of a skeleton its poses are mirrored by. */
export interface Reflection extends JointMaps {
  /** Of the plane, of length 1; the plane goes through the root as it stands in the pose of reference. */
  readonly normal: Vec3;
  /**
   * For each DOF of a joint its sign there, where mirroring comes to that; 0 for all DOFs of other joints. By the DOF that
   * is written, that of the partner.
   */
  readonly signs: Int8Array;
  /** How large the skeleton is in the pose of reference. */
  readonly size: number;
  /** The first joint that has two sides below it, and which way those lie in its own axes; none in a skeleton of no sides. */
  readonly lateral: { readonly joint: number; readonly direction: Vec3 } | undefined;
}

const X: Vec3 = [1, 0, 0];
const Y: Vec3 = [0, 1, 0];
const Z: Vec3 = [0, 0, 1];
/** Within 15° of an axis that axis is meant. */
const NEARLY = Math.cos(Math.PI / 12);
/** Mirrored joints this near to their partners, on average: as symmetric as figures are. In sizes. */
const SYMMETRIC = 0.02;
/** Paired joints that are hardly apart: the pose says nothing of sides. */
const APART = 1e-3;

/** A skeleton's reflection, found once for each skeleton. */
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

/** No DOF turned; position channels that take the place of offsets at those. */
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

/** Whether the file's pose shows the sides better: the other has none, or is none of a symmetric figure. */
function saysMore(inFile: Candidate, atRest: Candidate): boolean {
  const sides = ({ apart, paired }: Candidate) => paired > 0 && apart > APART * paired;
  if (sides(inFile) !== sides(atRest)) return sides(inFile);
  const count = atRest.partner.length;
  if (atRest.asymmetry <= SYMMETRIC * count) return false;
  return inFile.asymmetry < atRest.asymmetry / 2;
}

/** The plane through the root across which the skeleton is its own mirror image, as nearly as it is in that pose. */
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
  // Where two do as well: most figures face along z, some along x, and hardly any lies on its side.
  return [X, Z, Y].map(candidate).reduce((best, other) => {
    const isBetter = other.paired === best.paired ? other.asymmetry < 0.5 * best.asymmetry : other.paired > best.paired;
    return isBetter ? other : best;
  });
}

/**
 * From right to left, where names say which joints those are: of the first joint that has pairs below it. Farther out
 * joints may have axes of their own.
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

/**
 * The same for a figure that is to be mirrored across another plane of the character's space. Where the root has no sides
 * of its own it stands as that plane does.
 */
export function acrossPlane(skeleton: Skeleton, reflection: Reflection, normal: Vec3): Reflection {
  if (reflection.normal.every((v, k) => v === normal[k])) return reflection;
  const compiled = compileSkeleton(skeleton);
  const matrix = reflectionMatrix(normal);
  const maps = reflection.maps.slice();
  if (fittingMap(skeleton, reflection.partner, 0, matrix) === matrix) maps.set(matrix);
  const turned = { ...reflection, normal, matrix, maps };
  return { ...turned, signs: signsOf(skeleton, compiled, turned) };
}
