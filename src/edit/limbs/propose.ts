/** Limbs proposed from the bones: which joints, how the middle one bends, and the same on the other side. */

import { compileSkeleton, worldMatrices } from '../../evaluate/kinematics.ts';
import { bendNumbers, closedChain, writeBend } from '../../evaluate/limbs/bend.ts';
import { invertAffine } from '../../math/mat4.ts';
import { transformPoint, type Vec3 } from '../../math/vec3.ts';
import type { Bend, Limb } from '../../model/limbs.ts';
import { filePose } from '../../model/skeleton/dofs.ts';
import { dofsOf, turnsJoint } from '../../model/skeleton/joint-types.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { partnersPose } from '../pose/mirror.ts';
import { reflectionOf } from '../pose/reflection.ts';
import { freeName, mirroredName } from '../rig/names.ts';

/** A middle joint that is as good as straight doesn't say to which side it bends. */
const STRAIGHT = 1e-3;
/** Radians by which a limb is bent to see which way its counterpart bends. */
const BENT = 0.5;

/**
 * The joints of a limb for selected ones: those from the topmost to the lowest of them, if they are on one way; for a
 * single joint that and the two above it. Undefined if there is no such chain.
 */
export function proposedJoints({ joints }: Skeleton, selected: readonly number[]): readonly number[] | undefined {
  const last = Math.max(...selected);
  const top = selected.length > 1 ? Math.min(...selected) : undefined;
  const chain: number[] = [];
  for (let j = last; j >= 0; j = joints[j].parent) {
    chain.unshift(j);
    if (top === undefined ? chain.length === 3 : j === top) break;
  }
  const isWhole = top === undefined ? chain.length === 3 && chain[0] > 0 : selected.every((j) => chain.includes(j));
  return isWhole ? chain : undefined;
}

/**
 * How the middle of three joints bends: by the rotation DOF that brings the ends nearest to each other, and is not held
 * by its limits, to the side of the file pose, or of the limits. Undefined for other chains.
 */
export function proposedBend(skeleton: Skeleton, limb: Omit<Limb, 'bend' | 'name'>): Bend | undefined {
  const { joints } = limb;
  if (joints.length !== 3) return undefined;
  const middle = skeleton.joints[joints[1]];
  const compiled = compileSkeleton(skeleton);
  const pose = Float64Array.from(filePose(skeleton, 0));
  let best: { readonly bend: Bend; readonly score: number } | undefined;
  dofsOf(middle.motion).forEach((dof, k) => {
    if (dof.unit !== 'angle') return;
    const limit = middle.limits[k];
    const isHeld = limit !== undefined && limit.max - limit.min <= STRAIGHT && limit.max >= limit.min;
    const chain = closedChain({ ...limb, name: '', bend: { dof: dof.name, sign: 1 } }, skeleton, compiled);
    if (chain) writeBend(chain, pose);
    const { h, reach, angle0 } = bendNumbers;
    const score = (chain && reach > 0 ? h / (reach * reach) : 0) - (isHeld ? 1 : 0);
    // Equal but for rounding: the first.
    if (best && score <= best.score + STRAIGHT) return;
    const straight = chain ? angle0 : 0;
    const bent = Math.sin((pose[compiled.firstDof[joints[1]] + k] ?? 0) - straight);
    const side = Math.abs(bent) > STRAIGHT ? bent : limit ? (limit.min + limit.max) / 2 - straight : 1;
    best = { bend: { dof: dof.name, sign: side < 0 ? -1 : 1 }, score };
  });
  return best?.bend;
}

/** Whether the last joint can take a goal's rotation. */
export function canOrient({ joints: all }: Skeleton, joints: readonly number[]): boolean {
  return dofsOf(all[joints[joints.length - 1]].motion).filter(turnsJoint).length >= 3;
}

/** Whether each joint of a limb has a counterpart on the other side, of which none belongs to a limb yet. */
export function hasOtherSide(skeleton: Skeleton, joints: readonly number[], limbs: readonly Limb[]): boolean {
  const { partner } = reflectionOf(skeleton);
  return joints.every((joint) => {
    const other = partner[joint];
    return other >= 0 && !joints.includes(other) && !limbs.some((limb) => limb.joints.includes(other));
  });
}

/** Whether a limb is of the counterparts of another's joints. */
export function isMirrorOf(skeleton: Skeleton, limb: Limb, other: Limb): boolean {
  const { partner } = reflectionOf(skeleton);
  return (
    limb !== other &&
    limb.joints.length === other.joints.length &&
    limb.joints.every((joint, k) => partner[joint] === other.joints[k])
  );
}

/** The name of the limb on the other side, if it has one there. */
export function nameOnOtherSide(
  skeleton: Skeleton,
  { name, joints }: Pick<Limb, 'name' | 'joints'>,
): string | undefined {
  const last = reflectionOf(skeleton).partner[joints[joints.length - 1]];
  return mirroredName(name) ?? skeleton.joints[last]?.name;
}

/** The limb on the other side; undefined if a joint of it has no counterpart there. */
export function mirroredLimb(skeleton: Skeleton, limb: Limb, taken: ReadonlySet<string>): Limb | undefined {
  const { partner, normal } = reflectionOf(skeleton);
  const joints = limb.joints.map((joint) => partner[joint]);
  if (joints.some((joint, k) => joint < 0 || joint === limb.joints[k])) return undefined;
  const last = limb.joints[limb.joints.length - 1];
  const name = nameOnOtherSide(skeleton, limb) ?? limb.name;
  const compiled = compileSkeleton(skeleton);
  const pose = Float64Array.from(filePose(skeleton, 0));
  const world = new Float64Array(16 * compiled.jointCount);
  worldMatrices(compiled, pose, world);
  const across = transformPoint(world, limb.tip, 16 * last);
  const root: Vec3 = [world[12], world[13], world[14]];
  const away = across.reduce((sum, part, k) => sum + (part - root[k]) * normal[k], 0);
  const back = new Float64Array(16);
  invertAffine(world, 16 * joints[joints.length - 1], back, 0);
  const [x, y, z] = across.map((part, k) => part - 2 * away * normal[k]);
  const isAtPivot = limb.tip.every((part) => part === 0);
  const { bend, ...rest } = limb;
  const other: Limb = {
    ...rest,
    name: freeName(taken, name),
    joints,
    tip: isAtPivot ? limb.tip : transformPoint(back, [x, y, z]),
  };
  return bend ? { ...other, bend: mirroredBend(skeleton, limb, other, bend) } : other;
}

/** To which side the other limb bends, in the pose of this one when it bends. */
function mirroredBend(skeleton: Skeleton, limb: Limb, other: Limb, bend: Bend): Bend {
  const compiled = compileSkeleton(skeleton);
  const [own, theirs] = [closedChain(limb, skeleton, compiled), closedChain({ ...other, bend }, skeleton, compiled)];
  const fallback = proposedBend(skeleton, other) ?? bend;
  if (!own || !theirs) return fallback;
  const pose = Float64Array.from(filePose(skeleton, 0));
  writeBend(own, pose);
  pose[own.dof] = bendNumbers.angle0 + own.sign * BENT;
  const { dofs } = partnersPose(skeleton, pose, false, [limb.joints[1]]);
  writeBend(theirs, dofs);
  const bent = Math.sin(dofs[theirs.dof] - bendNumbers.angle0);
  return Math.abs(bent) > STRAIGHT ? { ...bend, sign: bent < 0 ? -1 : 1 } : fallback;
}
