/**
 * Rotations and positions of a character's joints, frame after frame, as quaternions x y z w.
 *
 *     local q = q of J(φ)        world q = q_parent · q        world p = p_parent + q_parent · t        t: from the pivot
 *
 * Where no joint stretches, quaternions are made of angles, without matrices: the sines and cosines of a whole frame in
 * one go. Where one does, rotations are those of the world matrices, and local ones follow from these.
 *
 * In the scene: metres, y up, on the ground (`evaluate/space.ts`); the root's rotation includes that of the up axis, so
 * local rotations and the offsets compose to the world ones. Without a space all is as in the file.
 */
import { appliedDofs, eulerDofs, renamedAxes } from '../evaluate/euler-dofs.ts';
import { type CompiledSkeleton, compileSkeleton, worldMatrices } from '../evaluate/kinematics.ts';
import { metresPerUnit } from '../evaluate/metres.ts';
import { applySpace } from '../evaluate/space.ts';
import { writeRotationPart } from '../math/mat3.ts';
import { quaternionOfRotation } from '../math/quaternion.ts';
import { writeSinesAndCosines } from '../math/sines-cosines.ts';
import { stretches } from '../model/joint-types.ts';
import type { Skeleton } from '../model/skeleton.ts';
import type { Space } from '../model/space.ts';

export class JointTransforms {
  /** Four per joint, unit. From one frame to the next the signs change as little as they can. */
  readonly local: Float64Array;
  readonly world: Float64Array;
  /** Three per joint. */
  readonly positions: Float64Array;

  private readonly compiled: CompiledSkeleton;
  /** Whether the next frame is the first: its quaternions have w ≥ 0. */
  private isFirst = true;
  private readonly isRigid: boolean;
  private readonly metres: number;
  private readonly isTurned: boolean;
  /** Rotations by three angles: their joints; three DOFs, and three axes (0, 1, 2), each; signs as in `renamedAxes`. */
  private readonly eulerJoints: Int32Array;
  private readonly eulerDofs: Int32Array;
  private readonly eulerAxes: Int32Array;
  private readonly eulerSigns: Float64Array;
  /** DOFs along an axis of these joints; which of `ways` they move, and from where. */
  private readonly slidingDofs: Int32Array;
  private readonly slidingWays: Int32Array;
  private readonly slidingOffsets: Float64Array;
  /** All other joints. */
  private readonly otherJoints: Int32Array;
  private readonly halves: Float64Array;
  private readonly turned: Float64Array;
  /** From the pivot's parent to the pivot, three per joint, in the file's unit. */
  private readonly ways: Float64Array;
  private readonly matrices: Float64Array;
  /** Joints of the End Sites, and x y z in their spaces. */
  private readonly endJoints: Int32Array;
  private readonly ends: Float64Array;

  constructor(
    skeleton: Skeleton,
    private readonly space: Space | undefined,
  ) {
    const { joints } = skeleton;
    const compiled = compileSkeleton(skeleton);
    this.compiled = compiled;
    this.isRigid = !joints.some(({ motion }) => stretches(motion));
    this.metres = space ? metresPerUnit(space) : 1;
    this.isTurned = space?.up === 'z';
    const count = joints.length;
    this.local = new Float64Array(4 * count);
    this.world = new Float64Array(4 * count);
    this.positions = new Float64Array(3 * count);
    this.ways = Float64Array.from(compiled.offsets);
    this.endJoints = Int32Array.from(joints.flatMap(({ endSites = [] }, j) => endSites.map(() => j)));
    this.ends = Float64Array.from(joints.flatMap(({ endSites = [] }) => endSites.flat()));
    const eulers: number[] = [];
    const others: number[] = [];
    for (let j = 0; j < count; j++) (compiled.turns[3 * j] >= 0 ? eulers : others).push(j);
    const rules = eulers.map((j) => {
      const euler = eulerDofs(joints[j].motion);
      if (!euler) throw new Error(`Joint ${j} turns by three angles, but has no order of them.`);
      return { dofs: appliedDofs(euler).map((dof) => compiled.firstDof[j] + dof), ...renamedAxes(euler.order) };
    });
    this.eulerJoints = Int32Array.from(eulers);
    this.eulerDofs = Int32Array.from(rules.flatMap(({ dofs }) => dofs));
    this.eulerAxes = Int32Array.from(rules.flatMap(({ axes }) => axes));
    this.eulerSigns = Float64Array.from(rules, ({ sign }) => sign);
    const sliding = eulers.flatMap((j) => [3 * j, 3 * j + 1, 3 * j + 2]).filter((way) => compiled.slides[way] >= 0);
    this.slidingDofs = Int32Array.from(sliding, (way) => compiled.slides[way]);
    this.slidingWays = Int32Array.from(sliding);
    this.slidingOffsets = Float64Array.from(sliding, (way) => compiled.offsets[way]);
    this.otherJoints = Int32Array.from(others);
    this.halves = new Float64Array(3 * eulers.length);
    this.turned = new Float64Array(6 * eulers.length);
    this.matrices = new Float64Array(16 * (this.isRigid ? 1 : count));
  }

  /** The next frame is the first again. */
  restart(): void {
    this.isFirst = true;
  }

  /** @param dofs of the character, with limits and links applied */
  pose(dofs: Float64Array): void {
    if (this.isRigid) {
      this.poseEulers(dofs);
      this.poseOthers(dofs);
      this.compose();
    } else this.poseByMatrices(dofs);
    this.isFirst = false;
  }

  /** Writes x y z of each End Site, in the order of the joints. */
  writeEnds(out: Float64Array): void {
    const { endJoints, ends, matrices: m, world, positions, metres } = this;
    for (let e = 0; e < endJoints.length; e++) {
      const j = endJoints[e];
      const o = 3 * e;
      const x = ends[o];
      const y = ends[o + 1];
      const z = ends[o + 2];
      if (this.isRigid) {
        turnBy(world, 4 * j, metres * x, metres * y, metres * z);
        for (let k = 0; k < 3; k++) out[o + k] = positions[3 * j + k] + point[k];
        continue;
      }
      const at = 16 * j;
      applySpace(
        this.space,
        m[at] * x + m[at + 4] * y + m[at + 8] * z + m[at + 12],
        m[at + 1] * x + m[at + 5] * y + m[at + 9] * z + m[at + 13],
        m[at + 2] * x + m[at + 6] * y + m[at + 10] * z + m[at + 14],
        point,
      );
      for (let k = 0; k < 3; k++) out[o + k] = point[k];
    }
  }

  private poseEulers(dofs: Float64Array): void {
    const { eulerJoints, eulerDofs, eulerAxes, eulerSigns, halves, turned, isFirst } = this;
    const { ways, slidingDofs, slidingWays, slidingOffsets } = this;
    const q = this.local;
    for (let r = 0; r < eulerJoints.length; r++) {
      const half = eulerSigns[r] / 2;
      halves[3 * r] = half * dofs[eulerDofs[3 * r]];
      halves[3 * r + 1] = half * dofs[eulerDofs[3 * r + 1]];
      halves[3 * r + 2] = half * dofs[eulerDofs[3 * r + 2]];
    }
    writeSinesAndCosines(halves, halves.length, turned);
    for (let r = 0; r < eulerJoints.length; r++) {
      const j = eulerJoints[r];
      const sx = turned[6 * r];
      const cx = turned[6 * r + 1];
      const sy = turned[6 * r + 2];
      const cy = turned[6 * r + 3];
      const sz = turned[6 * r + 4];
      const cz = turned[6 * r + 5];
      const cc = cy * cz;
      const ss = sy * sz;
      const sc = sy * cz;
      const cs = cy * sz;
      let sign = eulerSigns[r];
      let w = cx * cc + sx * ss;
      const o = 4 * j;
      const a = o + eulerAxes[3 * r];
      const b = o + eulerAxes[3 * r + 1];
      const c = o + eulerAxes[3 * r + 2];
      const x = sign * (sx * cc - cx * ss);
      const y = sign * (cx * sc + sx * cs);
      const z = sign * (cx * cs - sx * sc);
      const near = isFirst ? w : x * q[a] + y * q[b] + z * q[c] + w * q[o + 3];
      sign = near < 0 ? -1 : 1;
      w *= sign;
      q[a] = sign * x;
      q[b] = sign * y;
      q[c] = sign * z;
      q[o + 3] = w;
    }
    for (let i = 0; i < slidingDofs.length; i++) ways[slidingWays[i]] = slidingOffsets[i] + dofs[slidingDofs[i]];
  }

  private poseOthers(dofs: Float64Array): void {
    const { compiled, otherJoints, ways, matrices, local, isFirst } = this;
    const { motions, firstDof, offsets } = compiled;
    for (let i = 0; i < otherJoints.length; i++) {
      const j = otherJoints[i];
      motions[j].write(dofs, firstDof[j], matrices, 0);
      for (let k = 0; k < 3; k++) ways[3 * j + k] = offsets[3 * j + k] + matrices[12 + k];
      writeRotationPart(matrices, 0, rotation, 0, 3);
      readQuaternion();
      put(local, 4 * j, quaternion[0], quaternion[1], quaternion[2], quaternion[3], isFirst);
    }
    if (!compiled.hasRootTranslation) return;
    // Of a root with three angles nothing has been computed yet in this frame.
    const isEuler = compiled.turns[0] >= 0;
    for (let k = 0; k < 3; k++) {
      const slide = compiled.slides[k];
      ways[k] = dofs[k] + (isEuler ? offsets[k] + (slide < 0 ? 0 : dofs[slide]) : ways[k]);
    }
  }

  /** World rotations and positions, from the root down. */
  private compose(): void {
    const { compiled, local, world, positions, ways, metres, space, isTurned, isFirst } = this;
    const { parent, jointCount } = compiled;
    for (let j = 0; j < jointCount; j++) {
      const above = parent[j];
      const o = 4 * j;
      if (above < 0) {
        if (isTurned) turnUp(local, o);
        put(world, o, local[o], local[o + 1], local[o + 2], local[o + 3], isFirst);
        for (let k = 0; k < 4; k++) local[o + k] = world[o + k];
        applySpace(space, ways[3 * j], ways[3 * j + 1], ways[3 * j + 2], point);
        for (let k = 0; k < 3; k++) positions[3 * j + k] = point[k];
        continue;
      }
      const p = 4 * above;
      const ax = world[p];
      const ay = world[p + 1];
      const az = world[p + 2];
      const aw = world[p + 3];
      const bx = local[o];
      const by = local[o + 1];
      const bz = local[o + 2];
      const bw = local[o + 3];
      const x = aw * bx + ax * bw + ay * bz - az * by;
      const y = aw * by - ax * bz + ay * bw + az * bx;
      const z = aw * bz + ax * by - ay * bx + az * bw;
      const w = aw * bw - ax * bx - ay * by - az * bz;
      put(world, o, x, y, z, w, isFirst);
      // v + 2 a × (a × v + w v), of Rodrigues
      const vx = metres * ways[3 * j];
      const vy = metres * ways[3 * j + 1];
      const vz = metres * ways[3 * j + 2];
      const cx = ay * vz - az * vy + aw * vx;
      const cy = az * vx - ax * vz + aw * vy;
      const cz = ax * vy - ay * vx + aw * vz;
      positions[3 * j] = positions[3 * above] + vx + 2 * (ay * cz - az * cy);
      positions[3 * j + 1] = positions[3 * above + 1] + vy + 2 * (az * cx - ax * cz);
      positions[3 * j + 2] = positions[3 * above + 2] + vz + 2 * (ax * cy - ay * cx);
    }
  }

  private poseByMatrices(dofs: Float64Array): void {
    const { compiled, matrices, local, world, positions, space, isTurned, isFirst } = this;
    worldMatrices(compiled, dofs, matrices);
    for (let j = 0; j < compiled.jointCount; j++) {
      const o = 4 * j;
      writeRotationPart(matrices, 16 * j, rotation, 0, 3);
      readQuaternion();
      if (isTurned) turnUp(quaternion, 0);
      put(world, o, quaternion[0], quaternion[1], quaternion[2], quaternion[3], isFirst);
      applySpace(space, matrices[16 * j + 12], matrices[16 * j + 13], matrices[16 * j + 14], point);
      for (let k = 0; k < 3; k++) positions[3 * j + k] = point[k];
      const above = compiled.parent[j];
      if (above < 0) {
        for (let k = 0; k < 4; k++) local[o + k] = world[o + k];
        continue;
      }
      const p = 4 * above;
      const [ax, ay, az, aw] = [-world[p], -world[p + 1], -world[p + 2], world[p + 3]];
      const [bx, by, bz, bw] = [world[o], world[o + 1], world[o + 2], world[o + 3]];
      const x = aw * bx + ax * bw + ay * bz - az * by;
      const y = aw * by - ax * bz + ay * bw + az * bx;
      const z = aw * bz + ax * by - ay * bx + az * bw;
      const w = aw * bw - ax * bx - ay * by - az * bz;
      put(local, o, x, y, z, w, isFirst);
    }
  }
}

/** Scratch; never escapes. */
const point = new Float64Array(3);
const rotation = new Float64Array(9);
const quaternion = new Float64Array(4);

/** Reads `rotation` as a unit quaternion: of columns that were nearly parallel it is one only roughly. */
function readQuaternion(): void {
  quaternionOfRotation(rotation, 0, quaternion);
  let square = 0;
  for (let k = 0; k < 4; k++) square += quaternion[k] * quaternion[k];
  const length = Math.sqrt(square);
  for (let k = 0; k < 4; k++) quaternion[k] /= length;
}

/** Writes a quaternion with the sign nearer to the one there, or in the first frame with w ≥ 0. */
function put(out: Float64Array, o: number, x: number, y: number, z: number, w: number, isFirst: boolean): void {
  const near = isFirst ? w : x * out[o] + y * out[o + 1] + z * out[o + 2] + w * out[o + 3];
  const sign = near < 0 ? -1 : 1;
  out[o] = sign * x;
  out[o + 1] = sign * y;
  out[o + 2] = sign * z;
  out[o + 3] = sign * w;
}

/** Rotates `point` to v by the quaternion at `q[o]`. */
function turnBy(q: Float64Array, o: number, x: number, y: number, z: number): void {
  const cx = q[o + 1] * z - q[o + 2] * y + q[o + 3] * x;
  const cy = q[o + 2] * x - q[o] * z + q[o + 3] * y;
  const cz = q[o] * y - q[o + 1] * x + q[o + 3] * z;
  point[0] = x + 2 * (q[o + 1] * cz - q[o + 2] * cy);
  point[1] = y + 2 * (q[o + 2] * cx - q[o] * cz);
  point[2] = z + 2 * (q[o] * cy - q[o + 1] * cx);
}

/** Turns q by the up axis, (x, y, z) → (x, z, −y): the product of −√½ i + √½ and q. */
function turnUp(q: Float64Array, o: number): void {
  const x = q[o];
  const y = q[o + 1];
  const z = q[o + 2];
  const w = q[o + 3];
  q[o] = Math.SQRT1_2 * (x - w);
  q[o + 1] = Math.SQRT1_2 * (y + z);
  q[o + 2] = Math.SQRT1_2 * (z - y);
  q[o + 3] = Math.SQRT1_2 * (w + x);
}
