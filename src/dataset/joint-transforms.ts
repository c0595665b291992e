/**
 * Rotations and positions of a character's joints, frame after frame, as quaternions x y z w.
 *
 *     local q = q of J(φ)        world q = q_parent · q        world p = p_parent + q_parent · t        t: from the pivot
 *
 * Frames come in blocks, and a block joint by joint: what is the same in all frames stays available, and what is
 * written is near by. Where no joint stretches, quaternions are made of angles, without matrices: the sines and cosines
 * of a joint's block in one go. Where one does, rotations are those of the world matrices, and local ones follow from
 * these.
 *
 * In the scene: metres, y up, on the ground (`evaluate/space.ts`); the root's rotation includes that of the up axis, so
 * local rotations and the offsets compose to the world ones. Without a space all is as in the file.
 */

import { endSitesOf, endsAt, hasStretches } from '../evaluate/end-sites.ts';
import { type CompiledSkeleton, compileSkeleton, worldMatrices } from '../evaluate/kinematics.ts';
import { appliedDofs, eulerDofs, renamedAxes } from '../evaluate/rotations/euler-dofs.ts';
import { metresPerUnit } from '../evaluate/space/metres.ts';
import { applySpace } from '../evaluate/space/space.ts';
import { writeRotationPart } from '../math/mat3.ts';
import { writeSinesAndCosines } from '../math/sines-cosines.ts';
import { stretches } from '../model/skeleton/joint-types.ts';
import { perSkeleton } from '../model/skeleton/per-skeleton.ts';
import type { Skeleton } from '../model/skeleton/skeleton.ts';
import type { Space } from '../model/space.ts';
import { put, turnUp, writeUnitQuaternion } from './frame-quaternions.ts';
import { BLOCK, type JointRows, JointRowWriter } from './joint-rows.ts';

/** A rotation by three angles: its DOFs, which of x, y, z they turn about, and the sign, as in `renamedAxes`. */
interface Turn {
  readonly dofs: readonly [number, number, number];
  readonly axes: readonly [number, number, number];
  readonly sign: number;
}

/** Cached. */
const turnsOf = perSkeleton((skeleton): readonly (Turn | undefined)[] => {
  const { turns, firstDof } = compileSkeleton(skeleton);
  return skeleton.joints.map(({ motion }, j) => {
    if (turns[3 * j] < 0) return undefined;
    const euler = eulerDofs(motion);
    if (!euler) throw new Error(`Joint ${j} has three rotation angles but no rotation order.`);
    const [a, b, c] = appliedDofs(euler);
    return { dofs: [firstDof[j] + a, firstDof[j] + b, firstDof[j] + c], ...renamedAxes(euler.order) };
  });
});

/** Evaluates the rotations and positions of all joints for blocks of frames; reused from block to block. */
export class JointTransforms {
  /** Points of each frame of the block: x y z of each joint, then of each End Site. */
  readonly points: readonly Float64Array[];

  private readonly compiled: CompiledSkeleton;
  private readonly isRigid: boolean;
  private readonly metres: number;
  private readonly up: Space['up'];
  /** Rotation of each joint; undefined for those that turn otherwise. */
  private readonly turns: readonly (Turn | undefined)[];
  /** All of `points`, and how many numbers a frame has. */
  private readonly allPoints: Float64Array;
  private readonly width: number;
  /** Rotations of the block, four numbers per frame, joint by joint. */
  private readonly local: Float64Array;
  private readonly world: Float64Array;
  /** Those of the frame before the block, four per joint: from one frame to the next signs change as little as they can. */
  private readonly localBefore: Float64Array;
  private readonly worldBefore: Float64Array;
  /** From the parent's pivot to the joint's, in the file's unit: three numbers per frame, joint by joint. */
  private readonly ways: Float64Array;
  /** Whether its DOFs move the pivot of a joint; that of others stays where it is. */
  private readonly moves: readonly boolean[];
  /** Numbers of one joint, per frame: angles, their sines and cosines. */
  private readonly halves = new Float64Array(3 * BLOCK);
  private readonly turned = new Float64Array(6 * BLOCK);
  private readonly matrices: Float64Array;
  private readonly writer: JointRowWriter;
  /** Joints of the End Sites, and x y z in their spaces. */
  private readonly endJoints: Int32Array;
  private readonly ends: Float64Array;
  /** Those of one frame, where DOFs lengthen bones. */
  private readonly lengthened: Float64Array | undefined;

  constructor(
    private readonly skeleton: Skeleton,
    private readonly space: Space | undefined,
  ) {
    const { joints } = skeleton;
    const compiled = compileSkeleton(skeleton);
    this.compiled = compiled;
    this.isRigid = !joints.some(({ motion }) => stretches(motion));
    this.metres = space ? metresPerUnit(space) : 1;
    this.up = space?.up ?? 'y';
    const count = joints.length;
    const { owners, ends } = endSitesOf(skeleton);
    this.endJoints = owners;
    this.ends = ends;
    this.lengthened = hasStretches(skeleton) ? ends.slice() : undefined;
    this.width = 3 * (count + this.endJoints.length);
    this.allPoints = new Float64Array(BLOCK * this.width);
    this.points = Array.from({ length: BLOCK }, (_, b) =>
      this.allPoints.subarray(b * this.width, (b + 1) * this.width),
    );
    this.local = new Float64Array(4 * BLOCK * count);
    this.world = new Float64Array(4 * BLOCK * count);
    this.localBefore = new Float64Array(4 * count);
    this.worldBefore = new Float64Array(4 * count);
    this.turns = turnsOf(skeleton);
    const { slides, offsets, hasRootTranslation } = compiled;
    this.moves = joints.map(
      (_, j) => (j === 0 && hasRootTranslation) || slides.subarray(3 * j, 3 * j + 3).some((d) => d >= 0),
    );
    this.ways = new Float64Array(3 * BLOCK * count);
    for (let i = 0; i < this.ways.length; i++) this.ways[i] = offsets[3 * Math.floor(i / (3 * BLOCK)) + (i % 3)];
    this.matrices = new Float64Array(16 * (this.isRigid ? 1 : count));
    const { local, world, allPoints, width } = this;
    this.writer = new JointRowWriter({ jointCount: count, local, world, allPoints, width });
    this.restart();
  }

  /** The next frame is the first: its quaternions have w ≥ 0. */
  restart(): void {
    const { localBefore, worldBefore } = this;
    for (let i = 0; i < localBefore.length; i++) localBefore[i] = worldBefore[i] = i % 4 === 3 ? 1 : 0;
  }

  /**
   * Poses a block of frames, which follow those before.
   * @param dofs of the character, with limits and links applied, frame after frame
   * @param count of frames, at most `BLOCK`
   * @param rows where to write them, from which row on; absent: nowhere but to `points`
   */
  pose(dofs: Float64Array, count: number, rows?: JointRows, row = 0): void {
    const stride = dofs.length / BLOCK;
    if (!this.isRigid) this.poseByMatrices(dofs, stride, count);
    for (let j = 0; j < this.compiled.jointCount; j++) {
      if (this.isRigid) {
        const turn = this.turns[j];
        if (turn) {
          if (this.moves[j]) this.follow(dofs, stride, count, j);
          this.turnByAngles(dofs, stride, count, j, turn);
        } else this.turnByMotion(dofs, stride, count, j);
        this.compose(count, j);
      }
      if (rows) this.writer.write(rows, row, count, j);
    }
    if (this.lengthened && this.isRigid) this.placeMovingEnds(dofs, stride, count, this.lengthened);
    else this.placeEnds(0, count, this.ends);
  }

  /** Writes `ways` of a joint that moves. */
  private follow(dofs: Float64Array, stride: number, count: number, j: number): void {
    const { ways, compiled } = this;
    const { offsets, slides, hasRootTranslation } = compiled;
    const isCarried = j === 0 && hasRootTranslation;
    for (let k = 0; k < 3; k++) {
      const offset = offsets[3 * j + k];
      const slide = slides[3 * j + k];
      for (let b = 0; b < count; b++) {
        const way = slide < 0 ? offset : offset + dofs[b * stride + slide];
        ways[3 * (BLOCK * j + b) + k] = isCarried ? way + dofs[b * stride + k] : way;
      }
    }
  }

  /** Writes `local` of a joint, of any sign. */
  private turnByAngles(dofs: Float64Array, stride: number, count: number, j: number, turn: Turn): void {
    const { halves, turned, local } = this;
    const { sign } = turn;
    const [first, second, third] = turn.dofs;
    const [ax, ay, az] = turn.axes;
    const half = sign / 2;
    for (let b = 0; b < count; b++) {
      halves[3 * b] = half * dofs[b * stride + first];
      halves[3 * b + 1] = half * dofs[b * stride + second];
      halves[3 * b + 2] = half * dofs[b * stride + third];
    }
    writeSinesAndCosines(halves, 3 * count, turned);
    let o = 4 * BLOCK * j;
    for (let t = 0; t < 6 * count; t += 6) {
      const sx = turned[t];
      const cx = turned[t + 1];
      const sy = turned[t + 2];
      const cy = turned[t + 3];
      const sz = turned[t + 4];
      const cz = turned[t + 5];
      const cc = cy * cz;
      const ss = sy * sz;
      const sc = sy * cz;
      const cs = cy * sz;
      local[o + ax] = sign * (sx * cc - cx * ss);
      local[o + ay] = sign * (cx * sc + sx * cs);
      local[o + az] = sign * (cx * cs - sx * sc);
      local[o + 3] = cx * cc + sx * ss;
      o += 4;
    }
  }

  /** As `turnByAngles`, of a joint of another kind, which may also move its pivot. */
  private turnByMotion(dofs: Float64Array, stride: number, count: number, j: number): void {
    const { compiled, matrices, local, ways } = this;
    const { motions, firstDof, offsets, hasRootTranslation } = compiled;
    const isMoved = j === 0 && hasRootTranslation;
    for (let b = 0; b < count; b++) {
      motions[j].write(dofs, b * stride + firstDof[j], matrices, 0);
      for (let k = 0; k < 3; k++) {
        const way = offsets[3 * j + k] + matrices[12 + k];
        ways[3 * (BLOCK * j + b) + k] = isMoved ? dofs[b * stride + k] + way : way;
      }
      writeRotationPart(matrices, 0, rotation, 0, 3);
      writeUnitQuaternion(rotation, quaternion);
      local.set(quaternion, 4 * (BLOCK * j + b));
    }
  }

  /** World rotations and positions of a joint, and the signs of its rotations. */
  private compose(count: number, j: number): void {
    const { compiled, local, world, localBefore, worldBefore, ways, allPoints, width, metres } = this;
    const above = compiled.parent[j];
    if (above < 0) {
      this.composeRoot(count, j);
      return;
    }
    let lx = localBefore[4 * j];
    let ly = localBefore[4 * j + 1];
    let lz = localBefore[4 * j + 2];
    let lw = localBefore[4 * j + 3];
    let x = worldBefore[4 * j];
    let y = worldBefore[4 * j + 1];
    let z = worldBefore[4 * j + 2];
    let w = worldBefore[4 * j + 3];
    for (let b = 0; b < count; b++) {
      const o = 4 * (BLOCK * j + b);
      const p = 4 * (BLOCK * above + b);
      const ax = world[p];
      const ay = world[p + 1];
      const az = world[p + 2];
      const aw = world[p + 3];
      let bx = local[o];
      let by = local[o + 1];
      let bz = local[o + 2];
      let bw = local[o + 3];
      if (bx * lx + by * ly + bz * lz + bw * lw < 0) {
        bx = -bx;
        by = -by;
        bz = -bz;
        bw = -bw;
      }
      local[o] = lx = bx;
      local[o + 1] = ly = by;
      local[o + 2] = lz = bz;
      local[o + 3] = lw = bw;
      const nx = aw * bx + ax * bw + ay * bz - az * by;
      const ny = aw * by - ax * bz + ay * bw + az * bx;
      const nz = aw * bz + ax * by - ay * bx + az * bw;
      const nw = aw * bw - ax * bx - ay * by - az * bz;
      const sign = nx * x + ny * y + nz * z + nw * w < 0 ? -1 : 1;
      world[o] = x = sign * nx;
      world[o + 1] = y = sign * ny;
      world[o + 2] = z = sign * nz;
      world[o + 3] = w = sign * nw;
      // v + 2 a × (a × v + w v), of Rodrigues
      const v = 3 * (BLOCK * j + b);
      const vx = metres * ways[v];
      const vy = metres * ways[v + 1];
      const vz = metres * ways[v + 2];
      const cx = ay * vz - az * vy + aw * vx;
      const cy = az * vx - ax * vz + aw * vy;
      const cz = ax * vy - ay * vx + aw * vz;
      const from = b * width + 3 * above;
      const to = b * width + 3 * j;
      allPoints[to] = allPoints[from] + vx + 2 * (ay * cz - az * cy);
      allPoints[to + 1] = allPoints[from + 1] + vy + 2 * (az * cx - ax * cz);
      allPoints[to + 2] = allPoints[from + 2] + vz + 2 * (ax * cy - ay * cx);
    }
    localBefore[4 * j] = lx;
    localBefore[4 * j + 1] = ly;
    localBefore[4 * j + 2] = lz;
    localBefore[4 * j + 3] = lw;
    worldBefore[4 * j] = x;
    worldBefore[4 * j + 1] = y;
    worldBefore[4 * j + 2] = z;
    worldBefore[4 * j + 3] = w;
  }

  private composeRoot(count: number, j: number): void {
    const { local, world, worldBefore, ways, points, space, up } = this;
    for (let b = 0; b < count; b++) {
      const o = 4 * (BLOCK * j + b);
      if (up !== 'y') turnUp(local, o, up);
      put(local, o, local[o], local[o + 1], local[o + 2], local[o + 3], worldBefore, 4 * j);
      for (let k = 0; k < 4; k++) world[o + k] = local[o + k];
      const v = 3 * (BLOCK * j + b);
      applySpace(space, ways[v], ways[v + 1], ways[v + 2], point);
      points[b].set(point, 3 * j);
    }
  }

  private poseByMatrices(dofs: Float64Array, stride: number, count: number): void {
    const { compiled, matrices, local, world, localBefore, worldBefore, points, space, up } = this;
    const { parent, jointCount } = compiled;
    for (let b = 0; b < count; b++) {
      worldMatrices(compiled, dofs.subarray(b * stride, (b + 1) * stride), matrices);
      for (let j = 0; j < jointCount; j++) {
        const o = 4 * (BLOCK * j + b);
        writeRotationPart(matrices, 16 * j, rotation, 0, 3);
        writeUnitQuaternion(rotation, quaternion);
        if (up !== 'y') turnUp(quaternion, 0, up);
        put(world, o, quaternion[0], quaternion[1], quaternion[2], quaternion[3], worldBefore, 4 * j);
        applySpace(space, matrices[16 * j + 12], matrices[16 * j + 13], matrices[16 * j + 14], point);
        points[b].set(point, 3 * j);
        const above = parent[j];
        if (above < 0) {
          for (let k = 0; k < 4; k++) local[o + k] = world[o + k];
          continue;
        }
        const p = 4 * (BLOCK * above + b);
        const [ax, ay, az, aw] = [-world[p], -world[p + 1], -world[p + 2], world[p + 3]];
        const [bx, by, bz, bw] = [world[o], world[o + 1], world[o + 2], world[o + 3]];
        const x = aw * bx + ax * bw + ay * bz - az * by;
        const y = aw * by - ax * bz + ay * bw + az * bx;
        const z = aw * bz + ax * by - ay * bx + az * bw;
        const w = aw * bw - ax * bx - ay * by - az * bz;
        put(local, o, x, y, z, w, localBefore, 4 * j);
      }
      this.placeEndsByMatrices(b);
    }
  }

  /** Writes velocities of the last of `count` rows. */
  end(rows: JointRows, count: number): void {
    this.writer.end(rows, count);
  }

  private placeMovingEnds(dofs: Float64Array, stride: number, count: number, lengthened: Float64Array): void {
    const { skeleton, endJoints, ends } = this;
    for (let b = 0; b < count; b++) {
      endsAt(skeleton, endJoints, ends, dofs, b * stride, lengthened);
      this.placeEnds(b, b + 1, lengthened);
    }
  }

  /** By the rotations of rigid joints; the others have placed them. @param ends in some frames of the block */
  private placeEnds(first: number, end: number, ends: Float64Array): void {
    const { endJoints, world, allPoints, width, metres, compiled } = this;
    if (!this.isRigid) return;
    for (let e = 0; e < endJoints.length; e++) {
      const j = endJoints[e];
      const x = metres * ends[3 * e];
      const y = metres * ends[3 * e + 1];
      const z = metres * ends[3 * e + 2];
      for (let b = first; b < end; b++) {
        const from = b * width + 3 * j;
        const to = b * width + 3 * (compiled.jointCount + e);
        const q = 4 * (BLOCK * j + b);
        const ax = world[q];
        const ay = world[q + 1];
        const az = world[q + 2];
        const aw = world[q + 3];
        const cx = ay * z - az * y + aw * x;
        const cy = az * x - ax * z + aw * y;
        const cz = ax * y - ay * x + aw * z;
        allPoints[to] = allPoints[from] + (x + 2 * (ay * cz - az * cy));
        allPoints[to + 1] = allPoints[from + 1] + (y + 2 * (az * cx - ax * cz));
        allPoints[to + 2] = allPoints[from + 2] + (z + 2 * (ax * cy - ay * cx));
      }
    }
  }

  private placeEndsByMatrices(frame: number): void {
    const { endJoints, ends, matrices: m, points, compiled, space } = this;
    for (let e = 0; e < endJoints.length; e++) {
      const at = 16 * endJoints[e];
      const x = ends[3 * e];
      const y = ends[3 * e + 1];
      const z = ends[3 * e + 2];
      applySpace(
        space,
        m[at] * x + m[at + 4] * y + m[at + 8] * z + m[at + 12],
        m[at + 1] * x + m[at + 5] * y + m[at + 9] * z + m[at + 13],
        m[at + 2] * x + m[at + 6] * y + m[at + 10] * z + m[at + 14],
        point,
      );
      points[frame].set(point, 3 * (compiled.jointCount + e));
    }
  }
}

/** Scratch; never escapes. */
const point = new Float64Array(3);
const rotation = new Float64Array(9);
const quaternion = new Float64Array(4);
