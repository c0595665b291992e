/** The way of a DOF from what sets it to the value that the joint uses: limits first, then what it follows. */
import { applyConstraints, type CompiledSkeleton, compileSkeleton } from '../../evaluate/kinematics.ts';
import { channelOf, dofCountOf, poseAt } from '../../evaluate/pose.ts';
import { movedDofs } from '../../evaluate/retarget/moved-dofs.ts';
import type { Character } from '../../model/document.ts';
import { couplesOf, type DofCouple } from '../../model/skeleton/couples.ts';
import type { DofUnit } from '../../model/skeleton/skeleton.ts';

/** The source of a DOF's value. */
export type DofSource = 'channel' | 'pose' | 'unkeyed' | 'retargeted' | 'link';

/** The steps by which a DOF gets its value, in its unit. */
export interface DofStep {
  /** Into the character's DOFs. */
  readonly dof: number;
  readonly name: string;
  readonly unit: DofUnit;
  readonly source: DofSource;
  /** Before limits; of a linked DOF gain·φ + offset. */
  readonly given: number;
  /** Undefined if it has none, or if the character does not enforce them. */
  readonly limit?: readonly [number, number];
  /** The value that the joint uses. */
  readonly value: number;
  /** With the final value of the DOF that it follows. */
  readonly link?: DofCouple & { readonly followed: number };
}

/** A pose before and after limits and linked DOFs. */
export interface PoseSteps {
  readonly character: Character;
  readonly timeSeconds: number;
  /** Values of each DOF; those of linked DOFs mean nothing. */
  readonly given: Float64Array;
  /** As `poseAt` gives them. */
  readonly dofs: Float64Array;
}

/**
 * The values of all DOFs of a pose, with where they come from.
 * @param timeSeconds of the transport
 */
export function stepsOfPose(character: Character, timeSeconds: number): PoseSteps {
  const given = new Float64Array(dofCountOf(character));
  poseAt({ ...character, clampsToLimits: false }, timeSeconds, given);
  const dofs = given.slice();
  if (character.skeleton) applyConstraints(compileSkeleton(character.skeleton), dofs, character.clampsToLimits);
  return { character, timeSeconds, given, dofs };
}

/**
 * The steps by which one DOF gets its value.
 * @param name as formats spell it
 */
export function stepsOfDof(pose: PoseSteps, dof: number, name: string, unit: DofUnit): DofStep {
  const { character, given, dofs } = pose;
  const { skeleton } = character;
  const couple = skeleton && couplesOf(skeleton).ordered.find((one) => one.dof === dof);
  const limit = skeleton && character.clampsToLimits ? limitOf(compileSkeleton(skeleton), dof) : undefined;
  const own = { dof, name, unit, value: dofs[dof], ...(limit && { limit }) };
  if (!couple) return { ...own, source: sourceOf(pose, dof), given: given[dof] };
  const followed = dofs[couple.follows];
  return { ...own, source: 'link', given: couple.gain * followed + couple.offset, link: { ...couple, followed } };
}

function limitOf({ firstDof, lower, upper, jointCount }: CompiledSkeleton, dof: number) {
  const own = dof - firstDof[0];
  if (own < 0 || dof >= firstDof[jointCount]) return undefined;
  const isLimited = lower[own] > Number.NEGATIVE_INFINITY || upper[own] < Number.POSITIVE_INFINITY;
  return isLimited ? ([lower[own], upper[own]] as const) : undefined;
}

function sourceOf({ character, timeSeconds }: PoseSteps, dof: number): DofSource {
  const { unkeyed } = character;
  // As close as `poseAt` takes for the same time.
  if (unkeyed?.dofs.includes(dof) && Math.abs(timeSeconds - unkeyed.timeSeconds) <= 1e-9) return 'unkeyed';
  if (movedDofs(character)?.has(dof)) return 'retargeted';
  return channelOf(character, dof) ? 'channel' : 'pose';
}
