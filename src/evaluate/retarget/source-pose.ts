/**
 * The pose of a source at a take time: as in `pose.ts`, without what sources lack (morphs, unkeyed changes, a driver of
 * their own).
 */
import { DEFAULT_PLACEMENT, type DriverSource } from '../../model/document.ts';
import type { OverPose } from '../../model/takes/layer-code.ts';
import { inTakes } from '../in-takes.ts';
import { applyConstraints, type CompiledSkeleton, compileSkeleton } from '../kinematics.ts';
import { evaluateMotion, overPoseOf, type TakeMotion, takeMotion } from '../take-motion.ts';

/** A source of retargeting, compiled. */
export interface PlayedSource {
  readonly skeleton: CompiledSkeleton;
  readonly pose: readonly number[];
  readonly clampsToLimits: boolean;
  readonly motion: TakeMotion;
  readonly over: OverPose | undefined;
  /** Number of DOFs of root and joints. */
  readonly dofCount: number;
  /** Number of leading DOFs that have a channel. */
  readonly driven: number;
}

/** Compiles what is needed to pose a source at any time of its take. */
export function playedSource(source: Omit<DriverSource, 'name' | 'timeOffsetSeconds'>): PlayedSource {
  const { skeleton, take, pose, clampsToLimits, placements = [DEFAULT_PLACEMENT], leaders = [] } = source;
  const compiled = compileSkeleton(skeleton);
  const dofCount = compiled.firstDof[compiled.jointCount];
  return {
    skeleton: compiled,
    pose,
    clampsToLimits,
    motion: takeMotion(take, skeleton),
    over: overPoseOf(take, { ...source, placements, leaders: leaders.map(inTakes) }),
    dofCount,
    driven: Math.min(take.channels.length, dofCount),
  };
}

/** Writes `dofCount` values to `out`. */
export function sourcePose(source: PlayedSource, takeSeconds: number, out: Float64Array): void {
  const { pose, motion, dofCount, driven } = source;
  for (let d = 0; d < dofCount; d++) out[d] = pose[d] ?? 0;
  evaluateMotion(motion, takeSeconds, out, driven);
  applyConstraints(source.skeleton, out, source.clampsToLimits);
  source.over?.solve(takeSeconds, out, source.clampsToLimits);
}
