/**
 * Mirrors a pose: of the whole character, of a hierarchy and its counterpart, or of one side onto the other.
 *
 * The visible pose is mirrored: joint by joint from the root, the mirrored world rotation relative to the parent's
 * result. So if a joint can't rotate like its counterpart, its descendants compensate as far as possible. Linked DOFs
 * are skipped.
 */
import { applyConstraints, type CompiledSkeleton, compileSkeleton, worldMatrices } from '../../evaluate/kinematics.ts';
import { fitJoint, jointFit } from '../../evaluate/retarget/fit.ts';
import { backMultiply3, multiply3, writeRotationPart } from '../../math/mat3.ts';
import { withoutRoundOff } from '../../math/round-off.ts';
import { isBvh } from '../../model/document.ts';
import { dofsOf } from '../../model/skeleton/joint-types.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import type { Space } from '../../model/space.ts';
import { fitLocal } from './fit-local.ts';
import { headingBack } from './heading.ts';
import { acrossPlane, type Reflection, reflectionOf } from './reflection.ts';
import { localMirrored, signed } from './reflection-signs.ts';

/** Which joints take which pose. */
export interface MirrorScope {
  /** The joint whose hierarchy is mirrored; absent or the root: the whole character with its position. */
  readonly joint?: number;
  /**
   * `swap`: the sides exchange their poses; `toOther`: the other side takes the pose of the joint's side, which is
   * unchanged.
   */
  readonly way: 'swap' | 'toOther';
  /** Up axis of the character's space; default y. */
  readonly up?: Space['up'];
  /**
   * Mirrors the whole character in place: its root keeps its position and heading (`heading.ts`). Absent: across the
   * plane of the character's space, to its other side.
   */
  readonly stays?: boolean;
}

/** The mirrored pose, and which joints take part. */
export interface MirroredPose {
  /** The character's DOFs, without morphs. */
  readonly dofs: Float64Array;
  /** Joints that got a pose, ascending. */
  readonly joints: readonly number[];
  /** Joints in scope without a counterpart, ascending; they keep their pose. */
  readonly alone: readonly number[];
}

/** The joint's counterpart; itself in the middle, undefined if it has none. */
export function counterpartOf(skeleton: Skeleton, joint: number): number | undefined {
  const other = reflectionOf(skeleton).partner[joint];
  return other >= 0 ? other : undefined;
}

/**
 * Mirrors a displayed pose.
 * @param dofs of the character as displayed: with limits and links applied
 * @param clamps whether limits are enforced
 */
export function mirroredPose(
  skeleton: Skeleton,
  dofs: ArrayLike<number>,
  clamps: boolean,
  scope: MirrorScope,
): MirroredPose {
  const compiled = compileSkeleton(skeleton);
  const count = compiled.firstDof[compiled.jointCount];
  const from = Float64Array.from({ length: count }, (_, d) => dofs[d] ?? 0);
  const out = from.slice();
  const isWhole = scope.joint === undefined || scope.joint === 0;
  const { up = 'y' } = scope;
  const reflection = isWhole ? wholeReflection(skeleton, from, up) : reflectionOf(skeleton);
  const { joints, alone } = jointsMeant(compiled, reflection, scope);
  const isCarried = isWhole && scope.way === 'swap';
  const stand =
    isCarried && scope.stays
      ? { turn: headingBack(compiled, reflection, reflectionOf(skeleton).normal, from, up) }
      : undefined;
  if (isCarried && !stand && compiled.hasRootTranslation) mirrorTravel(reflection, from, out);
  new Mirroring(skeleton, compiled, reflection, from, out, { clamps, stand }).run(new Set(joints));
  applyConstraints(compiled, out, clamps);
  return { dofs: out, joints, alone };
}

/**
 * Some joints' counterparts in the pose that these have, as the other side of a hierarchy takes it: each relative to
 * its parent, which doesn't take part unless it is one of them.
 *
 * @param dofs of the character, before limits and links apply
 * @param sources the joints whose pose is taken
 * @param flips joints in the middle are mirrored, and joints that are each other's counterparts exchange their poses;
 * otherwise both are left alone
 */
export function partnersPose(
  skeleton: Skeleton,
  dofs: ArrayLike<number>,
  clamps: boolean,
  sources: readonly number[],
  flips = false,
): MirroredPose {
  const compiled = compileSkeleton(skeleton);
  const from = Float64Array.from({ length: compiled.firstDof[compiled.jointCount] }, (_, d) => dofs[d] ?? 0);
  applyConstraints(compiled, from, clamps);
  const out = from.slice();
  const reflection = reflectionOf(skeleton);
  const given = new Set(sources);
  const targets = new Set<number>();
  const alone: number[] = [];
  for (const source of given) {
    const partner = reflection.partner[source];
    if (partner < 0) alone.push(source);
    else if (flips || !given.has(partner)) targets.add(partner);
  }
  new Mirroring(skeleton, compiled, reflection, from, out, { clamps, stand: undefined }).run(targets);
  applyConstraints(compiled, out, clamps);
  const inOrder = (joints: Iterable<number>) => [...joints].sort((a, b) => a - b);
  return { dofs: out, joints: inOrder(targets), alone: inOrder(alone) };
}

/**
 * How the whole character is mirrored.
 *
 * Motion capture may face anywhere, and its joints have axes of their own: it is mirrored across the vertical plane of
 * the character's space nearest to its own plane of symmetry, so that it keeps its facing direction.
 *
 * @param dofs of the pose that faces
 */
export function wholeReflection(skeleton: Skeleton, dofs: Float64Array, up: Space['up']): Reflection {
  return (isBvh({ skeleton }) ? facing(skeleton, dofs, up) : undefined) ?? reflectionOf(skeleton);
}

/**
 * The whole character across a given plane, its sides swapped, without limits: a frame of a take (`take-mirror.ts`).
 * @param dofs of the joints, without morphs
 */
export function swappedPose(skeleton: Skeleton, reflection: Reflection, dofs: Float64Array): Float64Array {
  const compiled = compileSkeleton(skeleton);
  const out = dofs.slice();
  if (compiled.hasRootTranslation) mirrorTravel(reflection, dofs, out);
  const { joints } = jointsMeant(compiled, reflection, { way: 'swap' });
  new Mirroring(skeleton, compiled, reflection, dofs, out, { clamps: false, stand: undefined }).run(new Set(joints));
  return out;
}

function facing(skeleton: Skeleton, dofs: Float64Array, up: Space['up']): Reflection | undefined {
  const reflection = reflectionOf(skeleton);
  const { lateral } = reflection;
  if (!lateral) return undefined;
  const compiled = compileSkeleton(skeleton);
  const world = new Float64Array(16 * compiled.jointCount);
  worldMatrices(compiled, dofs, world);
  const o = 16 * lateral.joint;
  const [x, y, z] = lateral.direction;
  const [ax, ay, az] = [0, 1, 2].map((k) => Math.abs(world[o + k] * x + world[o + 4 + k] * y + world[o + 8 + k] * z));
  const other = up === 'z' ? ay : az;
  return acrossPlane(skeleton, reflection, other > ax ? (up === 'z' ? [0, 1, 0] : [0, 0, 1]) : [1, 0, 0]);
}

function jointsMeant(compiled: CompiledSkeleton, { partner }: Reflection, { joint = 0, way }: MirrorScope) {
  const inBranch = (j: number, top: number) => top >= 0 && j >= top && j < compiled.subtreeEnd[top];
  const other = partner[joint];
  const joints: number[] = [];
  const alone: number[] = [];
  for (let j = 0; j < compiled.jointCount; j++) {
    const isMeant = way === 'swap' ? inBranch(j, joint) || inBranch(j, other) : inBranch(j, other);
    const source = partner[j];
    if (isMeant && source >= 0 && (way === 'swap' || inBranch(source, joint))) joints.push(j);
    else if (isMeant || inBranch(j, joint)) {
      if (source < 0) alone.push(j);
    }
  }
  return { joints, alone };
}

/** Root translation, relative to the point where the plane passes through the root. */
function mirrorTravel({ matrix: m, reference }: Reflection, from: Float64Array, out: Float64Array): void {
  const [x, y, z] = [from[0] - reference[0], from[1] - reference[1], from[2] - reference[2]];
  for (let k = 0; k < 3; k++) {
    const way = m[k] * x + m[3 + k] * y + m[6 + k] * z;
    const size = Math.abs(reference[k]);
    // Exact if the plane passes through the origin. Adding 0 avoids −0.
    out[k] = size === 0 ? way + 0 : withoutRoundOff(reference[k] + way, Math.max(size, Math.abs(way)));
  }
}

/** Tolerance of a rotation, beyond which descendants compensate. */
const ASTRAY = 1e-7;

/** How the root keeps its position. */
interface Stand {
  /** Nine numbers, in the character's space; absent if it faces along the plane already. */
  readonly turn: Float64Array | undefined;
}

class Mirroring {
  private readonly bone = new Float64Array(3);
  /** World rotations of the pose to mirror, of the result, and as wanted; nine per joint. */
  private readonly theirs: Float64Array;
  private readonly made: Float64Array;
  private readonly meant: Float64Array;
  private readonly astray: Uint8Array;
  /** For each mirrored joint, from the world of its counterpart's hierarchy to that of its own. */
  private readonly across: (Float64Array | undefined)[];
  private readonly wanted = new Float64Array(16);
  private readonly local = new Float64Array(16);
  private readonly a = new Float64Array(9);
  private readonly b = new Float64Array(9);

  constructor(
    private readonly skeleton: Skeleton,
    private readonly compiled: CompiledSkeleton,
    private readonly reflection: Reflection,
    private readonly from: Float64Array,
    private readonly out: Float64Array,
    private readonly how: { readonly clamps: boolean; readonly stand: Stand | undefined },
  ) {
    const { jointCount } = compiled;
    this.theirs = new Float64Array(9 * jointCount);
    this.made = new Float64Array(9 * jointCount);
    this.meant = new Float64Array(9 * jointCount);
    this.astray = new Uint8Array(jointCount);
    this.across = new Array(jointCount).fill(undefined);
    for (let j = 0; j < jointCount; j++) this.turn(j, from, this.theirs);
  }

  run(targets: ReadonlySet<number>): void {
    const { compiled, reflection } = this;
    for (let t = 0; t < compiled.jointCount; t++) {
      if (targets.has(t)) this.mirror(t, reflection.partner[t], targets);
      this.turn(t, this.out, this.made);
      if (!targets.has(t)) continue;
      for (let k = 0; k < 9; k++) {
        if (Math.abs(this.made[9 * t + k] - this.meant[9 * t + k]) > ASTRAY) this.astray[t] = 1;
      }
    }
  }

  /** A joint's world rotation, given its parent's. */
  private turn(j: number, dofs: Float64Array, worlds: Float64Array): void {
    const { compiled, local, a } = this;
    compiled.motions[j].write(dofs, compiled.firstDof[j], local, 0);
    if (compiled.motions[j].stretches) writeRotationPart(local, 0, local, 0, 4);
    const above = compiled.parent[j];
    take3(local, a);
    if (above >= 0) multiply3(worlds, 9 * above, a, 0, worlds, 9 * j);
    else worlds.set(a, 9 * j);
  }

  private mirror(t: number, s: number, targets: ReadonlySet<number>): void {
    const { compiled, reflection } = this;
    const above = compiled.parent[t];
    if (above < 0 && this.how.stand) {
      this.mirrorRoot();
      return;
    }
    const continues = above >= 0 && targets.has(above);
    const isInStep = above < 0 || reflection.partner[above] === compiled.parent[s];
    const across = (continues && this.across[above]) || this.acrossTo(t, s);
    this.across[t] = across;
    this.writeMeant(t, s, across);
    const { signs } = reflection;
    const [first, end] = [compiled.firstDof[t], compiled.firstDof[t + 1]];
    if (end === first) return;
    const theirs = compiled.firstDof[s];
    const hasSigns = signs[first] !== 0;
    const isAstray = above >= 0 && this.astray[above] === 1;
    if (hasSigns && isInStep && !isAstray) {
      const values = this.bySigns(t, s);
      if (this.isAllowed(t, values)) {
        this.out.set(values, first);
        return;
      }
    }
    this.writeWanted(t, s, isInStep);
    const sameCount = end - first === compiled.firstDof[s + 1] - theirs;
    this.fit(t, hasSigns && sameCount ? this.bySigns(t, s) : undefined);
  }

  /** Mirrors the root in place: with its heading restored and its pivot unchanged. */
  private mirrorRoot(): void {
    const { compiled, reflection, wanted, from, local, a, b } = this;
    const turn = this.how.stand?.turn;
    const across = reflection.matrix.slice();
    if (turn) multiply3(turn, 0, reflection.matrix, 0, across, 0);
    this.across[0] = across;
    this.writeMeant(0, 0, across);
    const [first, end] = [compiled.firstDof[0], compiled.firstDof[1]];
    if (end === first) return;
    localMirrored(compiled, reflection, 0, from, wanted);
    if (turn) {
      take3(wanted, a);
      multiply3(turn, 0, a, 0, b, 0);
      put3(b, wanted);
    }
    compiled.motions[0].write(from, first, local, 0);
    for (let k = 12; k < 15; k++) wanted[k] = local[k];
    const kept = from.slice(first, end);
    if (!turn && reflection.signs[first] !== 0) {
      // Sliding DOFs are kept, rotating ones mirrored.
      const slides = dofsOf(this.skeleton.joints[0].motion).map(({ unit }) => unit === 'length');
      const values = this.bySigns(0, 0).map((value, d) => (slides[d] ? kept[d] : value));
      if (this.isAllowed(0, values) && this.isWanted(values)) {
        this.out.set(values, first);
        return;
      }
    }
    this.fit(0, kept);
    // Root translation compensates for what its own DOFs can't, as with a screw.
    if (!compiled.hasRootTranslation) return;
    compiled.motions[0].write(this.out, first, local, 0);
    for (let k = 0; k < 3; k++) {
      const missing = wanted[12 + k] - local[12 + k];
      if (Math.abs(missing) > ASTRAY * reflection.size) this.out[k] += missing;
    }
  }

  /** Whether these values of the root's own DOFs give the wanted matrix. */
  private isWanted(values: Float64Array): boolean {
    this.compiled.motions[0].write(values, 0, this.local, 0);
    return this.wanted.every((v, k) => Math.abs(v - this.local[k]) <= ASTRAY * (1 + Math.abs(v)));
  }

  private bySigns(t: number, s: number): Float64Array {
    const { compiled, from } = this;
    const { signs, reference } = this.reflection;
    const [first, end] = [compiled.firstDof[t], compiled.firstDof[t + 1]];
    const theirs = compiled.firstDof[s];
    return Float64Array.from({ length: end - first }, (_, d) =>
      signed(signs[first + d] || 1, reference[theirs + d], reference[first + d], from[theirs + d]),
    );
  }

  private isAllowed(t: number, values: Float64Array): boolean {
    if (!this.how.clamps) return true;
    const { lower, upper, firstDof } = this.compiled;
    const at = firstDof[t] - firstDof[0];
    return values.every((value, d) => value >= lower[at + d] && value <= upper[at + d]);
  }

  /**
   * The map from world rotations of one hierarchy to those of the other at their tops: M for the whole character; else
   * the map between their two parents, which don't change.
   */
  private acrossTo(t: number, s: number): Float64Array {
    const { compiled, a } = this;
    const [above, theirs] = [compiled.parent[t], compiled.parent[s]];
    const across = new Float64Array(9);
    if (above < 0 || theirs < 0) {
      across.set(this.reflection.matrix);
      return across;
    }
    // R_a′ · K_a · R_a⁻¹
    timesTransposed3(this.reflection.maps, 9 * theirs, this.theirs, 9 * theirs, a);
    multiply3(this.made, 9 * above, a, 0, across, 0);
    return across;
  }

  /** The wanted world rotation of a joint: G · R_j · K_j⁻¹. */
  private writeMeant(t: number, s: number, across: Float64Array): void {
    const { a } = this;
    const { maps } = this.reflection;
    timesTransposed3(this.theirs, 9 * s, maps, 9 * s, a);
    multiply3(across, 0, a, 0, this.meant, 9 * t);
  }

  /** The joint's own matrix for that: its counterpart's, mirrored, and corrected if the parent is off. */
  private writeWanted(t: number, s: number, isInStep: boolean): void {
    const { compiled, reflection, wanted, a, b } = this;
    const above = compiled.parent[t];
    localMirrored(compiled, reflection, s, this.from, wanted);
    if (above < 0) return;
    if (isInStep && this.astray[above] === 1) {
      take3(wanted, a);
      multiply3(this.meant, 9 * above, a, 0, b, 0);
      backMultiply3(this.made, 9 * above, b, 0, a, 0);
      put3(a, wanted);
    } else if (!isInStep) {
      backMultiply3(this.made, 9 * above, this.meant, 9 * t, a, 0);
      put3(a, wanted);
    }
  }

  private fit(t: number, guess: Float64Array | undefined): void {
    const { compiled, skeleton, out, reflection, wanted, a } = this;
    const { clamps } = this.how;
    const [first, end] = [compiled.firstDof[t], compiled.firstDof[t + 1]];
    const at = first - compiled.firstDof[0];
    const before = out.slice(first, end);
    const follows = new Set(compiled.couples.map(({ dof }) => dof));
    const bound = (limits: Float64Array, none: number) =>
      Float64Array.from(before, (value, d) => {
        if (follows.has(first + d)) return value;
        return clamps ? limits[at + d] : none;
      });
    const beginnings: ArrayLike<number>[] = guess ? [guess] : [];
    const turns = jointFit(compiled, skeleton.joints[t], t, clamps);
    if (turns) {
      take3(wanted, a);
      fitJoint(compiled, t, turns, a, this.bone, 0, out);
      beginnings.push(out.slice(first, end));
    }
    beginnings.push(before, reflection.reference.slice(first, end));
    fitLocal(
      {
        ...{ motion: compiled.motions[t], first, count: end - first, wanted, size: reflection.size },
        ...{ lower: bound(compiled.lower, -Infinity), upper: bound(compiled.upper, Infinity) },
      },
      beginnings,
      out,
    );
  }
}

/** `out = a · bᵀ` */
function timesTransposed3(a: Float64Array, ao: number, b: Float64Array, bo: number, out: Float64Array): void {
  for (let c = 0; c < 3; c++) {
    for (let r = 0; r < 3; r++) {
      let sum = 0;
      for (let k = 0; k < 3; k++) sum += a[ao + 3 * k + r] * b[bo + 3 * k + c];
      out[3 * c + r] = sum;
    }
  }
}

function take3(matrix: Float64Array, out: Float64Array): void {
  for (let c = 0; c < 3; c++) for (let r = 0; r < 3; r++) out[3 * c + r] = matrix[4 * c + r];
}

function put3(from: Float64Array, matrix: Float64Array): void {
  for (let c = 0; c < 3; c++) for (let r = 0; r < 3; r++) matrix[4 * c + r] = from[3 * c + r];
}
