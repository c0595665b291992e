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
import { rotationPart } from '../../evaluate/euler-angles.ts';
import { type CompiledSkeleton, compileSkeleton, worldMatrices } from '../../evaluate/kinematics.ts';
import { backMultiply3, multiply3 } from '../../evaluate/retarget/rotations.ts';
import type { Vec3 } from '../../math/vec3.ts';
import { filePose, restPose } from '../../model/dofs.ts';
import { dofsOf, type Joint, type Skeleton } from '../../model/skeleton.ts';
import { type Partners, partnersAcross, sizeOf } from './partners.ts';
import { partnersByName, sideOf } from './sides.ts';

/** What of a skeleton its poses are mirrored by. */
export interface Reflection {
  /** Of the plane, of length 1; the plane goes through the root as it stands in the pose of reference. */
  readonly normal: Vec3;
  /** M, nine numbers. */
  readonly matrix: Float64Array;
  /** Each joint's counterpart, itself for one in the middle, -1 where it has none: its DOFs stay. */
  readonly partner: Int32Array;
  /** The character's DOFs in the pose of reference, without morphs. */
  readonly reference: Float64Array;
  /** K of each joint that has a partner, nine numbers. */
  readonly maps: Float64Array;
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
const [ACROSS_X, ACROSS_Y, ACROSS_Z] = [X, Y, Z].map(reflectionMatrix);
/** Every axis the other way. */
const AGAINST = Float64Array.of(-1, 0, 0, 0, -1, 0, 0, 0, -1);
/** Within 15° of an axis that axis is meant. */
const NEARLY = Math.cos(Math.PI / 12);
/** Mirrored joints this near to their partners, on average: as symmetric as figures are. In sizes. */
const SYMMETRIC = 0.02;
/** Paired joints that are hardly apart: the pose says nothing of sides. */
const APART = 1e-3;

const made = new WeakMap<Skeleton, Reflection>();

/** A skeleton's reflection, found once for each skeleton. */
export function reflectionOf(skeleton: Skeleton): Reflection {
  let known = made.get(skeleton);
  if (!known) {
    known = find(skeleton);
    made.set(skeleton, known);
  }
  return known;
}

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
  const maps = mapsOf(skeleton, compiled, chosen, matrix);
  const lateral = lateralOf(skeleton, partner);
  const found = { normal, matrix, partner, reference: dofs, maps, size, lateral };
  return { ...found, signs: signsOf(skeleton, compiled, found) };
}

/** K of each joint that has a counterpart: its parent's, turned as the two joints are in the pose of reference. */
function mapsOf(skeleton: Skeleton, compiled: CompiledSkeleton, { partner, dofs }: Candidate, mirror: Float64Array) {
  const { jointCount, parent, firstDof, motions } = compiled;
  const maps = new Float64Array(9 * jointCount);
  const turns = new Float64Array(9 * jointCount);
  const local = new Float64Array(16);
  for (let j = 0; j < jointCount; j++) {
    motions[j].write(dofs, firstDof[j], local, 0);
    rotationPart(local, 0);
    for (let c = 0; c < 3; c++) for (let r = 0; r < 3; r++) turns[9 * j + 3 * c + r] = local[4 * c + r];
  }
  const turned = new Float64Array(9);
  const own = new Float64Array(9);
  for (let j = 0; j < jointCount; j++) {
    const other = partner[j];
    if (other < 0) continue;
    const above = parent[j];
    const isKnown = above >= 0 && partner[above] >= 0;
    multiply3(isKnown ? maps : mirror, isKnown ? 9 * above : 0, turns, 9 * j, turned, 0);
    backMultiply3(turns, 9 * other, turned, 0, own, 0);
    maps.set(fittingMap(skeleton, partner, j, own), 9 * j);
  }
  return maps;
}

/** Of that part of the offsets a map may miss them; another one has to miss them by so much less. */
const MISSED = 0.15;
const MUCH_LESS = 0.25;

/**
 * The map itself where it takes the offsets of the joint's children to those of their counterparts, as it should; else
 * the one that does, of those that leave axes along axes. Against the bone instead of along it, all three axes are.
 */
function fittingMap({ joints }: Skeleton, partner: Int32Array, j: number, map: Float64Array): Float64Array {
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
  const missed = (m: Float64Array) => {
    let sum = 0;
    for (const [[x, y, z], to] of pairs) {
      sum += Math.hypot(...[0, 1, 2].map((k) => m[k] * x + m[3 + k] * y + m[6 + k] * z - to[k]));
    }
    return sum;
  };
  const own = missed(map);
  if (own <= MISSED * length) return map;
  let best = map;
  let least = MUCH_LESS * own;
  for (const candidate of other === j ? [ACROSS_X, ACROSS_Z, ACROSS_Y] : [AGAINST, ACROSS_X, ACROSS_Y, ACROSS_Z]) {
    const its = missed(candidate);
    if (its >= least) continue;
    best = candidate;
    least = 0.9 * its;
  }
  return best;
}

const lists = new WeakMap<readonly Joint[], readonly number[][]>();

function childrenOf(joints: readonly Joint[]): readonly number[][] {
  const known = lists.get(joints);
  if (known) return known;
  const children: number[][] = joints.map(() => []);
  joints.forEach(({ parent }, j) => {
    if (parent >= 0) children[parent].push(j);
  });
  lists.set(joints, children);
  return children;
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
    if (motion.kind !== 'bvh' || motion.positions !== 'replace') return;
    motion.channels.forEach((name, d) => {
      if (name.startsWith('t')) values[firstDof[j] + d] = offset['xyz'.indexOf(name[1])];
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
    ...{ normal, dofs, size: sizeOf(points) },
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
    if (Math.hypot(...d) < APART * sizeOf(points)) return;
    first = parent;
    for (let k = 0; k < 3; k++) sum[k] += d[k];
  });
  const length = Math.hypot(...sum);
  if (!(length > APART * sizeOf(points))) return undefined;
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

/** I − 2·n·nᵀ, nine numbers. */
function reflectionMatrix(normal: Vec3): Float64Array {
  const out = new Float64Array(9);
  for (let c = 0; c < 3; c++) {
    for (let r = 0; r < 3; r++) out[3 * c + r] = (r === c ? 1 : 0) - 2 * normal[r] * normal[c];
  }
  return out;
}

/** Away from the pose of reference, each DOF by another amount. */
const PROBES = [0.31, -0.47, 0.73, 0.22, -0.61, 0.53, 0.17, -0.29, 0.41];
const EXACT = 1e-9;

type Unsigned = Omit<Reflection, 'signs'>;

function signsOf(skeleton: Skeleton, compiled: CompiledSkeleton, reflection: Unsigned): Int8Array {
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

/** A mirrored value by its sign: as far from the reference, without losing bits where that is nothing, or mirrored too. */
export function signed(sign: number, from: number, to: number, value: number): number {
  if (sign > 0) return from === to ? value : to + (value - from);
  return (from === -to ? -value : to - (value - from)) + 0;
}

/** Scratch, never escapes. */
const matrix = new Float64Array(16);
const nine = new Float64Array(9);
const half = new Float64Array(9);

/**
 * Writes J of a joint's partner as it has to be, 16 numbers, for the joint's own DOFs.
 * @param dofs of the character; of them the joint's own, `s`, count
 */
export function localMirrored(
  compiled: CompiledSkeleton,
  reflection: Pick<Reflection, 'partner' | 'reference' | 'maps' | 'matrix'>,
  s: number,
  dofs: Float64Array,
  out: Float64Array,
): void {
  const { partner, reference, maps } = reflection;
  const t = partner[s];
  const above = compiled.parent[s];
  const [map, mo] = above < 0 ? [reflection.matrix, 0] : [maps, 9 * above];
  // Where both pivots are in the pose of reference.
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
