/**
 * The pose of a source at a take time: as in `pose.ts`, without what sources lack (morphs, unkeyed changes, a driver of
 * their own, attachments).
 */
import type { DriverSource } from '../../model/document.ts';
import type { OverPose } from '../../model/takes/layer-code.ts';
import { applyConstraints, type CompiledSkeleton, compileSkeleton } from '../kinematics.ts';
import { evaluateMotion, limbsOf, type TakeMotion, takeMotion } from '../take-motion.ts';

/** A source of retargeting, compiled. */
export interface PlayedSource {
  readonly skeleton: CompiledSkeleton;
  readonly pose: readonly number[];
  readonly clampsToLimits: boolean;
  readonly motion: TakeMotion;
  readonly limbs: OverPose | undefined;
  /** Number of DOFs of root and joints. */
  readonly dofCount: number;
  /** Number of leading DOFs that have a channel. */
  readonly driven: number;
}

/** Compiles what is needed to pose a source at any time of its take. */
export function playedSource(
  source: Pick<DriverSource, 'skeleton' | 'take' | 'limbs' | 'pose' | 'clampsToLimits'>,
): PlayedSource {
  const { skeleton, take, pose, clampsToLimits } = source;
  const compiled = compileSkeleton(skeleton);
  const dofCount = compiled.firstDof[compiled.jointCount];
  return {
    skeleton: compiled,
    pose,
    clampsToLimits,
    motion: takeMotion(take, skeleton),
    limbs: limbsOf(take, source),
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
  source.limbs?.solve(takeSeconds, out, source.clampsToLimits);
}
