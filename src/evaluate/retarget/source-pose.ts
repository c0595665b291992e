/**
 * The pose of a source at a take time: as in `pose.ts`, without what sources lack (morphs, unkeyed changes, a driver of
 * their own).
 */
import type { DriverSource } from '../../model/document.ts';
import { type CompiledTake, compileTake } from '../compiled-take.ts';
import { evaluateTake } from '../curves.ts';
import { applyConstraints, type CompiledSkeleton, compileSkeleton } from '../kinematics.ts';
import { type SampledJoints, sampledJoints } from '../samples/sampled-joints.ts';
import { samplePose } from '../samples/sampled-pose.ts';

/** A source of retargeting, compiled. */
export interface PlayedSource {
  readonly skeleton: CompiledSkeleton;
  readonly pose: readonly number[];
  readonly clampsToLimits: boolean;
  readonly curves: CompiledTake;
  readonly joints: SampledJoints;
  /** Number of DOFs of root and joints. */
  readonly dofCount: number;
  /** Number of leading DOFs that have a channel. */
  readonly driven: number;
}

/** Compiles what is needed to pose a source at any time of its take. */
export function playedSource({
  skeleton,
  take,
  pose,
  clampsToLimits,
}: Pick<DriverSource, 'skeleton' | 'take' | 'pose' | 'clampsToLimits'>): PlayedSource {
  const compiled = compileSkeleton(skeleton);
  const curves = compileTake(take);
  const dofCount = compiled.firstDof[compiled.jointCount];
  return {
    skeleton: compiled,
    pose,
    clampsToLimits,
    curves,
    joints: sampledJoints(curves, skeleton),
    dofCount,
    driven: Math.min(take.channels.length, dofCount),
  };
}

/** Writes `dofCount` values to `out`. */
export function sourcePose(source: PlayedSource, takeSeconds: number, out: Float64Array): void {
  const { pose, curves, joints, dofCount, driven } = source;
  for (let d = 0; d < dofCount; d++) out[d] = pose[d] ?? 0;
  evaluateTake(curves, takeSeconds, out, driven);
  if (curves.samples) samplePose(curves.samples, curves, joints, takeSeconds, out, driven);
  applyConstraints(source.skeleton, out, source.clampsToLimits);
}
