/** Puts joints back in place, in the displayed pose, after their parents have changed. */
import { applyConstraints, type CompiledSkeleton, worldMatrices } from '../../evaluate/kinematics.ts';
import { isDriven } from '../../evaluate/pose.ts';
import { fitJoint, jointFit } from '../../evaluate/retarget/fit.ts';
import { backMultiply3, setIdentity3, writeRotationPart } from '../../math/mat3.ts';
import { invertAffine, isSingular } from '../../math/mat4.ts';
import type { Vec3 } from '../../math/vec3.ts';
import { type Character, type Document, findCharacter } from '../../model/document.ts';
import { filePose } from '../../model/skeleton/dofs.ts';
import { dofsOf, isOfBvh, turnsJoint } from '../../model/skeleton/joint-types.ts';
import type { Joint } from '../../model/skeleton/skeleton.ts';
import { documentIn } from '../change.ts';
import { requireCharacter } from '../characters.ts';
import { CommandError } from '../command-error.ts';
import { setDofs } from '../commands/pose.ts';
import { changedJoints } from './joint-map.ts';
import { withSkeletonChanged } from './remap.ts';
import { requireSkeleton, type ShownPose, shownAt, skeletonSize } from './shown.ts';

/** Fraction of the size within which a joint counts as in place. */
const THERE = 1e-13;
/** Tolerance of the elements of a rotation. */
const TURNED = 1e-9;

/** A joint that keeps the place of a joint in an earlier character. */
export interface Kept {
  /** Current index. */
  readonly joint: number;
  /** Earlier index. */
  readonly origin: number;
}

/** Position x y z of a joint's pivot. */
export function localPivot({ world }: ShownPose, joint: number): Vec3 {
  const o = 16 * joint + 12;
  return [world[o], world[o + 1], world[o + 2]];
}

/**
 * The document with each of these joints in its earlier place: its pivot, and its rotation if its DOFs can represent
 * that exactly within limits and nothing drives them (keys, samples, retargeting, a link). None may be a descendant of
 * another. Throws a `CommandError` if a pose makes that impossible.
 */
export function keepPlaces(
  document: Document,
  before: Character,
  kept: readonly Kept[],
  timeSeconds: number,
): Document {
  const was = shownAt(before, timeSeconds);
  const { id } = before;
  let next = document;
  for (const { joint, origin } of kept) next = turnedAs(next, before, was, joint, origin, timeSeconds);
  const pivots = new Map(kept.map(({ joint, origin }) => [joint, localPivot(was, origin)]));
  return withPivots(next, id, pivots, timeSeconds);
}

/**
 * The document with these joints' offsets changed so that their pivots are there. None may be a descendant of another.
 */
export function withPivots(
  document: Document,
  characterId: string,
  pivots: ReadonlyMap<number, Vec3>,
  timeSeconds: number,
): Document {
  const character = requireCharacter(document, characterId);
  const skeleton = requireSkeleton(character);
  const shown = shownAt(character, timeSeconds);
  const joints = skeleton.joints.map((joint, j) => {
    const pivot = pivots.get(j);
    return pivot ? withPivot(joint, j, pivot, shown) : joint;
  });
  if (joints.every((joint, j) => joint === skeleton.joints[j])) return document;
  return withSkeletonChanged(document, characterId, changedJoints(skeleton, joints));
}

function withPivot(joint: Joint, j: number, pivot: Vec3, shown: ShownPose): Joint {
  const { world } = shown;
  const size = skeletonSize(world);
  const now = localPivot(shown, j);
  if (now.every((v, k) => Math.abs(v - pivot[k]) <= THERE * size)) return joint;
  const by = intoSpace(joint.parent, shown, [pivot[0] - now[0], pivot[1] - now[1], pivot[2] - now[2]]);
  const { offset } = joint;
  const at = (k: number) => (Math.abs(by[k]) <= THERE * size ? offset[k] : tidy(offset[k] + by[k], size));
  return { ...joint, offset: [at(0), at(1), at(2)] };
}

/** A vector of the character's space in that of a joint; -1 for none. Throws if the joint's matrix is singular. */
export function intoSpace(joint: number, { world }: ShownPose, [x, y, z]: Vec3): Vec3 {
  if (joint < 0) return [x, y, z];
  if (isSingular(world, 16 * joint)) {
    throw new CommandError('A joint is scaled to zero in the current pose, so nothing can be placed below it.');
  }
  invertAffine(world, 16 * joint, inverse, 0);
  const along = (r: number) => inverse[r] * x + inverse[4 + r] * y + inverse[8 + r] * z;
  return [along(0), along(1), along(2)];
}

/** Scratch; never escapes. */
const inverse = new Float64Array(16);

/** Rounds to twelve digits relative to the overall size, since the number is written to files. */
export function tidy(value: number, size: number): number {
  const digits = Math.min(100, Math.max(0, 12 - Math.floor(Math.log10(size))));
  // Adding 0 avoids −0.
  return Number(value.toFixed(digits)) + 0;
}

/** The document with a joint rotated like an earlier one, if possible; see `keepPlaces`. */
export function turnedAs(
  document: Document,
  before: Character,
  was: ShownPose,
  joint: number,
  origin: number,
  timeSeconds: number,
): Document {
  const character = requireCharacter(document, before.id);
  const skeleton = requireSkeleton(character);
  const { motion } = skeleton.joints[joint];
  const shown = shownAt(character, timeSeconds);
  const { firstDof } = shown.compiled;
  const turning = dofsOf(motion).flatMap((dof, d) => (turnsJoint(dof) ? [firstDof[joint] + d] : []));
  // By keys, samples or retargeting.
  if (turning.some((dof) => isDriven(character, dof))) return document;
  const clamps = character.clampsToLimits;
  const values = dofsAs(
    shown.compiled,
    skeleton.joints[joint],
    joint,
    shown.dofs,
    { world: was.world, joint: origin },
    clamps,
  );
  let next = document;
  if (values) {
    const dofs = turning
      .map((index) => ({ index, value: values[index] }))
      .filter(({ index, value }) => value !== shown.dofs[index]);
    if (dofs.length) next = documentIn(setDofs.run(document, { characterId: before.id, dofs, timeSeconds }));
  }
  return isOfBvh(motion) ? next : turnedInFile(next, before, joint, origin, turning);
}

/** The same in the file pose, which limits don't affect. */
function turnedInFile(
  document: Document,
  before: Character,
  joint: number,
  origin: number,
  turning: readonly number[],
): Document {
  const was = inFilePose(before);
  const character = findCharacter(document, before.id) ?? before;
  const skeleton = requireSkeleton(character);
  const is = inFilePose(character);
  const own = skeleton.joints[joint];
  const values = dofsAs(is.compiled, own, joint, is.dofs, { world: was.world, joint: origin }, false);
  if (!values || turning.every((dof) => values[dof] === is.dofs[dof])) return document;
  const first = is.compiled.firstDof[joint];
  const pose = own.pose.map((value, d) => (turning.includes(first + d) ? values[first + d] : value));
  const joints = skeleton.joints.map((other, j) => (j === joint ? { ...own, pose } : other));
  return withSkeletonChanged(document, before.id, changedJoints(skeleton, joints));
}

function inFilePose(character: Character): ShownPose {
  const shown = shownAt(character, 0);
  const dofs = Float64Array.from(filePose(character.skeleton, character.morphs.length));
  applyConstraints(shown.compiled, dofs, false);
  const world = new Float64Array(shown.world.length);
  worldMatrices(shown.compiled, dofs, world);
  return { compiled: shown.compiled, dofs, world };
}

/**
 * All DOFs, with those of a joint changed so that it is rotated like a joint of another pose; undefined if its type,
 * limits or links don't allow exactly that, or if it is so already.
 * @param was world matrices of that pose, and the joint there
 */
function dofsAs(
  compiled: CompiledSkeleton,
  joint: Joint,
  j: number,
  dofs: Float64Array,
  was: { readonly world: Float64Array; readonly joint: number },
  clamps: boolean,
): Float64Array | undefined {
  const world = new Float64Array(16 * compiled.jointCount);
  const isTurned = (at: Float64Array, within: number) => {
    for (let k = 0; k < 12; k++) if (Math.abs(at[16 * j + k] - was.world[16 * was.joint + k]) > within) return false;
    return true;
  };
  worldMatrices(compiled, dofs, world);
  if (isTurned(world, THERE)) return undefined;
  const first = compiled.firstDof[j];
  // Prefers angles near the current ones.
  const now = { ...joint, pose: joint.pose.map((_, d) => dofs[first + d]) };
  const fit = jointFit(compiled, now, j, clamps);
  if (!fit) return undefined;
  const wanted = new Float64Array(27);
  writeRotationPart(was.world, 16 * was.joint, wanted, 0, 3);
  if (joint.parent < 0) setIdentity3(wanted, 9);
  else writeRotationPart(world, 16 * joint.parent, wanted, 9, 3);
  backMultiply3(wanted, 9, wanted, 0, wanted, 18);
  const values = dofs.slice();
  fitJoint(compiled, j, fit, wanted.subarray(18), new Float64Array(3), 0, values);
  const settled = values.slice();
  applyConstraints(compiled, settled, clamps);
  worldMatrices(compiled, settled, world);
  return isTurned(world, TURNED) ? values : undefined;
}
