/**
 * Mirrors a hierarchy across a plane through the root: creates each joint on the other side, or updates the existing
 * one. At rest all joints' spaces are parallel to the root's, so that one reflection M serves for all:
 *
 *     offset′ = M · offset        J′(φ′) = M · J(φ) · M   (`mirrored-motion.ts`)        so    W′ = M · W · M
 *
 * Counterparts are found as for mirrored poses (`pose/partners.ts`): by name, else by position. A match by position has
 * to be close; otherwise a joint beside a leg could be taken for the other leg.
 */

import { withoutRoundOff } from '../../math/round-off.ts';
import { reflected, type Vec3 } from '../../math/vec3.ts';
import type { Document } from '../../model/document.ts';
import { couplesOf } from '../../model/skeleton/couples.ts';
import { jointName } from '../../model/skeleton/joint-name.ts';
import type { Joint, Skeleton } from '../../model/skeleton/skeleton.ts';
import { CommandError } from '../command-error.ts';
import { partnersAcross } from '../pose/partners.ts';
import { partnersByName } from '../pose/sides.ts';
import { changedJoints, changedTree, type JointMap } from './joint-map.ts';
import { mirroredCouples } from './mirrored-couples.ts';
import { mirroredLimit, mirroredMotion, reflectedBox } from './mirrored-motion.ts';
import { freeName, mirroredName } from './names.ts';
import { withSkeletonChanged } from './remap.ts';
import { type Branch, branchesOf, listJoints } from './tree.ts';

/** Fractions of the size: tolerance for in the plane, in the middle, and for counterparts by position. */
const IN_PLANE = 1e-6;
const IN_MIDDLE = 0.05;
const NEAR = 0.05;

/** A skeleton with a mirrored hierarchy. */
export interface MirroredHierarchy {
  readonly map: JointMap;
  /** New index of the joint on the other side. */
  readonly other: number;
  /** Adds the links of the other side to the changed document. */
  readonly couple: (document: Document, characterId: string) => Document;
}

/** Throws a `CommandError` if there is no other side. @param across 0, 1 or 2 for x, y or z */
export function mirrored(skeleton: Skeleton, index: number, across: number): MirroredHierarchy {
  return new Mirroring(skeleton, across).mirror(index);
}

class Mirroring {
  /** x y z per joint: position at rest, relative to the root. */
  private readonly points: Float64Array;
  private readonly size: number;
  private readonly partner: Int32Array;
  private readonly byName: Int32Array;
  private readonly branches: Branch[];
  private readonly names: Set<string>;
  /** By mirrored joint: its branch on the other side, and the signs of its DOFs there. */
  private readonly done = new Map<number, { readonly branch: Branch; readonly signs: readonly number[] }>();

  constructor(
    private readonly skeleton: Skeleton,
    private readonly across: number,
  ) {
    const { joints } = skeleton;
    this.points = new Float64Array(3 * joints.length);
    let size = 0;
    joints.forEach(({ parent, offset }, j) => {
      if (parent < 0) return;
      for (let k = 0; k < 3; k++) this.points[3 * j + k] = this.points[3 * parent + k] + offset[k];
      size = Math.max(size, Math.hypot(...this.points.subarray(3 * j, 3 * j + 3)));
    });
    this.size = size || 1;
    this.partner = partnersAcross(skeleton, this.points, reflectionNormal(across)).partner;
    this.byName = partnersByName(joints.map(({ name }) => name));
    this.branches = branchesOf(skeleton);
    this.names = new Set(joints.map(({ name }) => name));
  }

  mirror(index: number): MirroredHierarchy {
    const { skeleton, branches } = this;
    const name = jointName(skeleton, index);
    if (index === 0) throw new CommandError(`${name} is the root, which has no other side.`);
    const { parent } = skeleton.joints[index];
    const above = this.sideOf(parent);
    if (above < 0) {
      throw new CommandError(`Mirror ${jointName(skeleton, parent)} first: it has no counterpart yet.`);
    }
    if (this.isInPlane(index)) {
      throw new CommandError(`${name} and its descendants lie in the mirror plane.`);
    }
    const there = this.counterpart(index);
    if (there >= 0 && skeleton.joints[there].parent !== above) {
      const [own, side] = [jointName(skeleton, there), jointName(skeleton, above)];
      throw new CommandError(`${own} is the counterpart, but its parent is not ${side}. Reparent it first.`);
    }
    const top = this.mirrorBranch(index, branches[above], above);
    const map = changedTree(skeleton, branches[0]);
    const indices = new Map(listJoints(branches[0]).branches.map((branch, j) => [branch, j]));
    return {
      map,
      other: indices.get(top) ?? 0,
      couple: (document, characterId) => this.withCouples(document, characterId, map, indices),
    };
  }

  /** The counterpart of a branch's parent: itself in the middle, -1 if there is none. */
  private sideOf(joint: number): number {
    if (joint === 0) return 0;
    const other = this.counterpart(joint);
    if (other >= 0) return other;
    const isOwn = this.partner[joint] === joint || !mirroredName(this.skeleton.joints[joint].name);
    return isOwn && Math.abs(this.points[3 * joint + this.across]) <= IN_MIDDLE * this.size ? joint : -1;
  }

  /** The existing joint on the other side; -1 if there is none. */
  private counterpart(joint: number): number {
    const { partner, byName, points, across, size } = this;
    const named = byName[joint];
    if (named >= 0) return named;
    const found = partner[joint];
    if (found < 0 || found === joint || byName[found] >= 0) return -1;
    const away = [0, 1, 2].map((k) => (k === across ? -1 : 1) * points[3 * joint + k] - points[3 * found + k]);
    return Math.hypot(...away) <= NEAR * size ? found : -1;
  }

  private isInPlane(index: number): boolean {
    const open = [this.branches[index]];
    for (let branch = open.pop(); branch; branch = open.pop()) {
      if (Math.abs(this.points[3 * branch.origin + this.across]) > IN_PLANE * this.size) return false;
      open.push(...branch.children);
    }
    return true;
  }

  /** @param above parent of the mirrored branch @param aboveIndex old index of the joint at its rest position */
  private mirrorBranch(index: number, above: Branch, aboveIndex: number): Branch {
    const top = this.mirrorJoint(index, above, this.correction(index, aboveIndex));
    const open = [index];
    for (let joint = open.pop(); joint !== undefined; joint = open.pop()) {
      const own = this.done.get(joint);
      // Only joints from before, since the branch may by now have children of its own making.
      const children = this.skeleton.joints.flatMap(({ parent }, j) => (parent === joint ? [j] : []));
      for (const child of children) {
        if (!own || this.isElsewhere(child, own.branch)) continue;
        this.mirrorJoint(child, own.branch, [0, 0, 0]);
        open.push(child);
      }
    }
    return top;
  }

  /** Whether its counterpart exists with another parent: then it is left alone, and not duplicated. */
  private isElsewhere(joint: number, above: Branch): boolean {
    const other = this.counterpart(joint);
    return other >= 0 && !above.children.includes(this.branches[other]);
  }

  /** Correction of the offset if the parent is not exactly mirrored itself. */
  private correction(index: number, above: number): Vec3 {
    const { points, across, size } = this;
    const { parent } = this.skeleton.joints[index];
    const at = (k: number) => {
      const by = (k === across ? -1 : 1) * points[3 * parent + k] - points[3 * above + k];
      return Math.abs(by) <= 1e-12 * size ? 0 : by;
    };
    return [at(0), at(1), at(2)];
  }

  private mirrorJoint(index: number, above: Branch, correction: Vec3): Branch {
    const { skeleton, across, branches, done } = this;
    const joint = skeleton.joints[index];
    const found = this.counterpart(index);
    const there = found >= 0 ? branches[found] : undefined;
    const { motion, signs } = mirroredMotion(joint.motion, across, there?.joint.motion);
    const offset = reflected(joint.offset, across);
    // Without a correction every digit is kept.
    const at = (k: number) => (correction[k] === 0 ? offset[k] : withoutRoundOff(offset[k] + correction[k], this.size));
    const own = {
      offset: [at(0), at(1), at(2)] as const,
      box: reflectedBox(joint.box, across),
      motion,
      limits: joint.limits.map((limit, d) => mirroredLimit(limit, signs[d] ?? 1)),
      ...endsOf(joint, across),
    };
    if (there) {
      there.joint = inStep(there.joint, own);
      done.set(index, { branch: there, signs });
      return there;
    }
    const name = this.newName(joint.name);
    const pose = joint.pose.map((value, d) => value * (signs[d] ?? 1) + 0);
    const made: Branch = {
      origin: -1,
      joint: { name, parent: -1, ...own, pose },
      children: [],
      like: { joint: index, signs },
    };
    above.children.push(made);
    done.set(index, { branch: made, signs });
    return made;
  }

  private newName(name: string): string {
    if (name === '') return '';
    const made = freeName(this.names, mirroredName(name) ?? name);
    this.names.add(made);
    return made;
  }

  /** The document with links on the other side too; unchanged if they would be circular. */
  private withCouples(
    document: Document,
    characterId: string,
    { after, to }: JointMap,
    indices: ReadonlyMap<Branch, number>,
  ): Document {
    const sides = new Map(
      [...this.done].map(([joint, { branch, signs }]) => [joint, { joint: indices.get(branch) ?? 0, signs }] as const),
    );
    const joints = mirroredCouples(this.skeleton, after, this.across, sides, (joint) => {
      const other = this.counterpart(joint);
      return to[other >= 0 ? other : joint];
    });
    if (joints === after.joints || couplesOf({ name: '', joints }).circular.length > 0) return document;
    return withSkeletonChanged(document, characterId, changedJoints(after, joints));
  }
}

function reflectionNormal(across: number): Vec3 {
  return [across === 0 ? 1 : 0, across === 1 ? 1 : 0, across === 2 ? 1 : 0];
}

/** A bone along +y mirrored across y becomes an End Site, since joints' bones can't point along −y. */
function endsOf({ length, endSites = [] }: Joint, across: number): Pick<Joint, 'length' | 'endSites'> {
  const ends = endSites.map((end) => reflected(end, across));
  if (length !== undefined && across === 1 && length > 0) return { endSites: [...ends, [0, -length, 0]] };
  return { ...(length !== undefined && { length }), ...(ends.length && { endSites: ends }) };
}

/** The existing joint, updated; the same object if nothing changes. */
function inStep(joint: Joint, own: Pick<Joint, 'offset' | 'box' | 'motion' | 'limits' | 'length' | 'endSites'>): Joint {
  const { length: _length, endSites: _endSites, ...rest } = joint;
  const motion = isSame(joint.motion, own.motion) ? joint.motion : own.motion;
  const next: Joint = { ...rest, ...own, motion };
  const isStill =
    motion === joint.motion &&
    isSame([joint.offset, joint.box, joint.limits], [next.offset, next.box, next.limits]) &&
    joint.length === next.length &&
    isSame(joint.endSites ?? [], next.endSites ?? []);
  return isStill ? joint : next;
}

/** For plain data with fields in the same order. */
function isSame(a: unknown, b: unknown): boolean {
  return JSON.stringify(a) === JSON.stringify(b);
}
