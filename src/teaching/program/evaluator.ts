/**
 * Runs a program on a character: the same files, by any rules. With `RIGHT_PROGRAM` the numbers are those of
 * `evaluate/pose.ts`, `evaluate/kinematics.ts` and `evaluate/deform.ts`.
 *
 * What depends on few rules is kept from one program to the next: the DOFs of each set of curve rules, skeletons and
 * attachments as read by others.
 */

import { applyConstraints, type CompiledSkeleton } from '../../evaluate/kinematics.ts';
import { dofCountOf, poseFrom, poseSource } from '../../evaluate/pose.ts';
import { invertAffine, multiplyAffine } from '../../math/mat4.ts';
import { type Character, isBvh, shownTake } from '../../model/document.ts';
import { restPose, rootDofCount } from '../../model/skeleton/dofs.ts';
import { dofsOf, replacesOffset } from '../../model/skeleton/joint-types.ts';
import { type CurveRules, channelValue, RIGHT_CURVES } from './curve-rules.ts';
import { inFilePose } from './file-pose.ts';
import { mayBeSame, sidesOf } from './jumps.ts';
import type { Breadth, JointRules, Program, Wanted, WorldMap } from './program.ts';
import { hasThreeAngles, isFor, programSkeletons, turns } from './skeleton-rules.ts';
import { SkinRun } from './skin-run.ts';

/** Undefined: the file pose, without the animation. */
export type FrameTime = number | undefined;

/** A program's numbers of a frame. The next run overwrites them. */
export interface FrameNumbers {
  /** 16 per joint, column-major; empty without a skeleton. */
  readonly world: Float64Array;
  readonly local: Float64Array;
  /** x y z per vertex; empty without a skin, or if not wanted. */
  readonly vertices: Float64Array;
  readonly normals: Float64Array;
}

const NONE = new Float64Array(0);
/** Jump of a DOF within a millionth of a second; what moves as fast is as good as a jump. */
const JUMP = 1e-4;
const IDENTITY_SCRATCH = new Float64Array(16);

/** Evaluates one character by the rules of any program; its arrays are overwritten by the next frame. */
export class Evaluator {
  readonly jointCount: number;
  private readonly skeletons: ReturnType<typeof programSkeletons> | undefined;
  private readonly skin: SkinRun | undefined;
  private readonly dofs: Float64Array;
  private readonly moved: Float64Array;
  private readonly world: Float64Array;
  private readonly local: Float64Array;
  private readonly mapped: Float64Array;
  private readonly known = new Map<CurveRules, Map<FrameTime, Float64Array>>();
  private readonly sides = new Map<CurveRules, Map<FrameTime, readonly FrameTime[]>>();
  /** Joints in breadth-first order. */
  private readonly breadthFirst: Int32Array;
  /** The sign rule of each DOF: 0 to 3, −1 for none. */
  private readonly signOf: Int8Array;
  private readonly isAngle: Uint8Array;
  private readonly isOfBvh: boolean;
  /** Per DOF, by the rule's breadth. */
  private readonly breadths = new Map<Breadth, Uint8Array>();

  constructor(readonly character: Character) {
    const { skeleton } = character;
    this.jointCount = skeleton?.joints.length ?? 0;
    this.skeletons = skeleton && programSkeletons(skeleton);
    this.dofs = new Float64Array(dofCountOf(character));
    this.moved = new Float64Array(this.dofs.length);
    this.world = new Float64Array(16 * this.jointCount);
    this.local = new Float64Array(16 * this.jointCount);
    this.mapped = new Float64Array(16 * this.jointCount);
    this.skin = character.skins[character.shownSkin] && new SkinRun(character);
    this.breadthFirst = breadthFirstOrder(skeleton?.joints.map(({ parent }) => parent) ?? []);
    this.signOf = new Int8Array(this.dofs.length).fill(-1);
    this.isAngle = new Uint8Array(this.dofs.length);
    this.isOfBvh = isBvh(character);
    let d = rootDofCount(skeleton);
    for (const { motion } of skeleton?.joints ?? []) {
      for (const { name, unit } of dofsOf(motion)) {
        this.isAngle[d] = unit === 'angle' ? 1 : 0;
        this.signOf[d++] = unit === 'angle' ? ['rx', 'ry', 'rz', name].indexOf(name) : -1;
      }
    }
  }

  /** The numbers of a program at a time; those that are not wanted may be empty. The next call overwrites them. */
  frame(program: Program, time: FrameTime, wanted: Wanted): FrameNumbers {
    const given = this.dofsAt(program.curves, time);
    const { jointCount, skeletons } = this;
    if (skeletons) this.joints(program.joints, skeletons, given);
    const { world: maps } = program.joints;
    const world = maps.length > 0 ? this.mapAll(this.world, maps, this.mapped) : this.world;
    let vertices: Float64Array = NONE;
    let normals: Float64Array = NONE;
    if (this.skin && (wanted.vertices || wanted.normals)) {
      const ofPoints = maps.filter((map) => map.endsWith('points'));
      const forSkin = ofPoints.length === 0 ? world : ofPoints.length === maps.length ? this.world : world;
      ({ vertices, normals } = this.skin.run(program.skin, given, jointCount > 0 ? forSkin : undefined, wanted));
      for (const map of ofPoints) mapPoints(map, vertices, normals);
    }
    if (wanted.local && maps.length > 0) this.mapAll(this.local, maps, this.local);
    return { world, local: this.local, vertices, normals };
  }

  /** The time, and those on either side of it where a DOF jumps there; cached. */
  sidesAt(curves: CurveRules, time: FrameTime): readonly FrameTime[] {
    let byTime = this.sides.get(curves);
    if (!byTime) {
      byTime = new Map();
      this.sides.set(curves, byTime);
    }
    let sides = byTime.get(time);
    if (!sides) {
      sides = time === undefined ? [time] : [time, ...this.jumpsAt(curves, time)];
      byTime.set(time, sides);
    }
    return sides;
  }

  private jumpsAt(curves: CurveRules, time: number): readonly number[] {
    const own = this.dofsAt(curves, time);
    return sidesOf(time).filter((side) => {
      const dofs = this.makeDofs(curves, side);
      return own.some((value, d) => Math.abs(value - dofs[d]) > JUMP);
    });
  }

  /** All DOFs before limits. */
  private dofsAt(curves: CurveRules, time: FrameTime): Float64Array {
    let byTime = this.known.get(curves);
    if (!byTime) {
      byTime = new Map();
      this.known.set(curves, byTime);
    }
    let dofs = byTime.get(time);
    if (!dofs) {
      dofs = this.makeDofs(curves, time);
      byTime.set(time, dofs);
    }
    return dofs;
  }

  private makeDofs(curves: CurveRules, time: FrameTime): Float64Array {
    const { character } = this;
    const out = new Float64Array(this.dofs.length);
    const source = poseSource(time === undefined ? inFilePose(character) : unkeyedBeside(character, time));
    // Without a skeleton nothing is limited yet.
    poseFrom({ ...source, skeleton: undefined }, time ?? 0, out);
    const take = shownTake(character);
    if (curves === RIGHT_CURVES || time === undefined || !take || character.driver) return out;
    for (let d = 0; d < source.driven; d++) {
      const channel = take.channels[d];
      if (channel.kind === 'keys')
        out[d] = channelValue(channel, take.range, time + character.timeOffsetSeconds, curves);
    }
    return out;
  }

  private joints(rules: JointRules, skeletons: ReturnType<typeof programSkeletons>, given: Float64Array): void {
    const { compiled, dofFrom } = skeletons.get(rules);
    const dofs = this.fileDofs(rules, compiled, given);
    if (this.character.clampsToLimits && rules.hasLimits) applyConstraints(compiled, dofs, true);
    else applyConstraints(compiled, dofs, false);
    const { at } = rules.angles;
    const factor = this.angleFactor(rules);
    const { are: signs, for: signed } = rules.signs;
    const forAngles = this.isFor(rules.angles.for);
    const forSigns = this.isFor(signed);
    if ((at === 'joint' && factor !== 1) || signs.some((sign) => sign !== 1)) {
      const scale = at === 'joint' ? factor : 1;
      for (let d = 0; d < dofs.length; d++) {
        if (!this.isAngle[d]) continue;
        if (forAngles[d]) dofs[d] *= scale;
        if (forSigns[d]) dofs[d] *= signs[this.signOf[d]];
      }
    }
    if (rules.root !== 'moves') this.stop(rules, compiled, dofs);
    if (dofFrom) {
      const { moved } = this;
      moved.set(dofs);
      for (let d = 0; d < dofFrom.length; d++) moved[d] = dofs[dofFrom[d]];
      dofs.set(moved);
    }
    this.matrices(rules, compiled, dofs);
  }

  /** The values that the files give to the DOFs. */
  private fileDofs(rules: JointRules, compiled: CompiledSkeleton, given: Float64Array): Float64Array {
    const { dofs, moved } = this;
    dofs.set(given);
    const { skeleton } = this.character;
    const { firstDof, travel } = compiled;
    if (rules.pose !== 'given' && skeleton) {
      const rest = restPose(skeleton, this.character.morphs.length);
      const kept = Array.from(travel, (d) => dofs[d]);
      skeleton.joints.forEach(({ motion, offset }, j) => {
        dofsOf(motion).forEach(({ name }, i) => {
          const axis = ['tx', 'ty', 'tz'].indexOf(name);
          dofs[firstDof[j] + i] = replacesOffset(motion, name) ? offset[axis] : rest[firstDof[j] + i];
        });
      });
      travel.forEach((d, k) => {
        if (d < 0 || rules.pose === 'rest, root at offset') return;
        dofs[d] = rules.pose === 'rest' ? kept[k] : 0;
      });
      if (rules.pose === 'rest, root at offset' && compiled.hasRootTranslation) dofs.fill(0, 0, 3);
    }
    if (rules.breadthFirst.of === 'dofs' || rules.breadthFirst.of === 'both') {
      moved.set(dofs);
      let next = firstDof[0];
      for (const j of this.breadthFirst) {
        for (let d = firstDof[j]; d < firstDof[j + 1]; d++, next++) {
          if (rules.breadthFirst.isInverse) dofs[next] = moved[d];
          else dofs[d] = moved[next];
        }
      }
    }
    const { isReversed, for: breadth, withRoot } = rules.dofOrder;
    if (isReversed && skeleton) {
      skeleton.joints.forEach(({ motion }, j) => {
        if ((j === 0 && !withRoot) || !isFor(motion, breadth) || !hasThreeAngles(motion)) return;
        const names = dofsOf(motion).map(({ name }) => name);
        const x = firstDof[j] + names.indexOf('rx');
        const z = firstDof[j] + names.indexOf('rz');
        [dofs[x], dofs[z]] = [dofs[z], dofs[x]];
      });
    }
    const { at } = rules.angles;
    const factor = this.angleFactor(rules);
    if (at === 'file' && factor !== 1) {
      const forAngles = this.isFor(rules.angles.for);
      for (let d = 0; d < dofs.length; d++) if (this.isAngle[d] && forAngles[d]) dofs[d] *= factor;
    }
    return dofs;
  }

  /** Captured angles are degrees in their file, which has a rule of its own for that. */
  private angleFactor({ angles, bvhDegrees }: JointRules): number {
    if (!this.isOfBvh) return angles.factor;
    if (bvhDegrees) return 180 / Math.PI;
    return Math.min(1, angles.factor);
  }

  /** Whether a rule is for each DOF. */
  private isFor(breadth: Breadth): Uint8Array {
    let list = this.breadths.get(breadth);
    if (!list) {
      list = new Uint8Array(this.dofs.length);
      const { skeleton } = this.character;
      let d = rootDofCount(skeleton);
      for (const { motion } of skeleton?.joints ?? []) {
        const end = d + dofsOf(motion).length;
        list.fill(isFor(motion, breadth) ? 1 : 0, d, end);
        d = end;
      }
      this.breadths.set(breadth, list);
    }
    return list;
  }

  private stop({ root }: JointRules, compiled: CompiledSkeleton, dofs: Float64Array): void {
    const joint = this.character.skeleton?.joints[0];
    compiled.travel.forEach((d, k) => {
      if (d < 0) return;
      // A BVH root's channels replace its offset, which stays.
      dofs[d] =
        compiled.hasRootTranslation || root === 'stays at 0' ? 0 : (joint?.offset[k] ?? 0) - compiled.offsets[k];
    });
  }

  private matrices(rules: JointRules, compiled: CompiledSkeleton, dofs: Float64Array): void {
    const { local, world, jointCount } = this;
    const { parent, firstDof, offsets, motions, hasRootTranslation } = compiled;
    const joints = this.character.skeleton?.joints ?? [];
    for (let j = 0; j < jointCount; j++) {
      const o = 16 * j;
      motions[j].write(dofs, firstDof[j], local, o);
      if (rules.transposed !== 'none') {
        const { motion } = joints[j];
        if (isFor(motion, rules.transposed) && turns(motion)) transpose3(local, o);
      }
      let x = rules.offset === 'none' ? 0 : offsets[3 * j];
      let y = rules.offset === 'none' ? 0 : offsets[3 * j + 1];
      let z = rules.offset === 'none' ? 0 : offsets[3 * j + 2];
      if (parent[j] < 0 && hasRootTranslation) {
        x += dofs[0];
        y += dofs[1];
        z += dofs[2];
      }
      if (rules.offset === 'before' || rules.offset === 'none') {
        local[o + 12] += x;
        local[o + 13] += y;
        local[o + 14] += z;
      } else {
        if (rules.offset === 'inner after') {
          x += local[o + 12];
          y += local[o + 13];
          z += local[o + 14];
          local[o + 12] = local[o + 13] = local[o + 14] = 0;
        }
        for (let r = 0; r < 3; r++) local[o + 12 + r] += local[o + r] * x + local[o + 4 + r] * y + local[o + 8 + r] * z;
      }
      const above = parent[j];
      if (above < 0 || rules.concatenation === 'no parent') world.set(local.subarray(o, o + 16), o);
      else if (rules.concatenation === 'parent first') multiplyAffine(world, 16 * above, local, o, world, o);
      else multiplyAffine(local, o, world, 16 * above, world, o);
    }
    if (rules.breadthFirst.of === 'joints' || rules.breadthFirst.of === 'both') {
      this.permute(world, rules.breadthFirst.isInverse);
      this.permute(local, rules.breadthFirst.isInverse);
    }
  }

  private permute(matrices: Float64Array, isInverse: boolean): void {
    const { breadthFirst, mapped } = this;
    mapped.set(matrices);
    for (let j = 0; j < breadthFirst.length; j++) {
      const from = isInverse ? j : breadthFirst[j];
      const to = isInverse ? breadthFirst[j] : j;
      for (let i = 0; i < 16; i++) matrices[16 * to + i] = mapped[16 * from + i];
    }
  }

  private mapAll(from: Float64Array, maps: readonly WorldMap[], out: Float64Array): Float64Array {
    out.set(from);
    for (const map of maps) for (let o = 0; o < out.length; o += 16) mapMatrix(map, out, o);
    return out;
  }
}

function mapMatrix(map: WorldMap, m: Float64Array, o: number): void {
  if (map === 'inverse') {
    invertAffine(m, o, IDENTITY_SCRATCH, 0);
    m.set(IDENTITY_SCRATCH, o);
  } else if (map.startsWith('mirror')) {
    for (const i of [2, 6, 8, 9, 14]) m[o + i] = -m[o + i];
  } else {
    exchange(m, o + 1, o + 2);
    exchange(m, o + 13, o + 14);
    exchange(m, o + 4, o + 8);
    exchange(m, o + 5, o + 10);
    exchange(m, o + 6, o + 9);
  }
}

function mapPoints(map: WorldMap, ...lists: Float64Array[]): void {
  for (const points of lists) {
    for (let o = 0; o < points.length; o += 3) {
      if (map.startsWith('mirror')) points[o + 2] = -points[o + 2];
      else exchange(points, o + 1, o + 2);
    }
  }
}

function exchange(m: Float64Array, a: number, b: number): void {
  const value = m[a];
  m[a] = m[b];
  m[b] = value;
}

function transpose3(m: Float64Array, o: number): void {
  exchange(m, o + 1, o + 4);
  exchange(m, o + 2, o + 8);
  exchange(m, o + 6, o + 9);
}

/** The character with its unkeyed changes at that time, if it is theirs or beside it: they make no jump. */
function unkeyedBeside(character: Character, time: number): Character {
  const { unkeyed } = character;
  if (!unkeyed || !mayBeSame(time, unkeyed.timeSeconds)) return character;
  return { ...character, unkeyed: { ...unkeyed, timeSeconds: time } };
}

/** By depth, and in one depth as in the file. */
function breadthFirstOrder(parents: readonly number[]): Int32Array {
  const depth: number[] = [];
  for (const parent of parents) depth.push(parent < 0 ? 0 : depth[parent] + 1);
  return Int32Array.from(parents.map((_, j) => j).sort((a, b) => depth[a] - depth[b] || a - b));
}
