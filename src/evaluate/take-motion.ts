/**
 * The one place where what controls a take becomes values of DOFs: its base, then its layers. The code for layers
 * (`layers.ts`) is passed on once there are any: see `model/takes/layer-code.ts`. The goals of limbs come after limits.
 */
import type { Limbs } from '../model/limbs.ts';
import type { Skeleton } from '../model/skeleton/skeleton.ts';
import { type Follower, type LayersOverBase, layerCode, type OverPose } from '../model/takes/layer-code.ts';
import type { Take } from '../model/takes/take.ts';
import { type CompiledTake, compileTake } from './compiled-take.ts';
import { evaluateTake } from './curves.ts';
import type { PoseRotations } from './rotations/pose-rotations.ts';
import { type SampledJoints, sampledJoints } from './samples/sampled-joints.ts';
import { samplePose } from './samples/sampled-pose.ts';

/** A take with its layers, ready for evaluation. */
export interface TakeMotion {
  /** Of the motion beneath the layers. */
  readonly curves: CompiledTake;
  /** If samples drive it, and there is a skeleton. */
  readonly joints: SampledJoints | undefined;
  /** Absent without any. */
  readonly layers: LayersOverBase | undefined;
}

/**
 * Compiles a take with its layers; cached. Without a skeleton, layers with joints touch nothing but what follows.
 * @throws Error for a take with layers whose code was not provided
 */
export function takeMotion(take: Take, skeleton: Skeleton | undefined): TakeMotion {
  const layers = take.layers && layerCode(take).overBase(take, skeleton);
  const curves = compileTake(layers?.base ?? take);
  return {
    curves,
    joints: curves.samples && skeleton && sampledJoints(curves, skeleton),
    layers,
  };
}

/**
 * The limbs that a take moves to its goals; undefined without any.
 * @throws Error for a take with goals whose code was not provided
 */
export function limbsOf(
  take: Take | undefined,
  { limbs, skeleton }: { readonly limbs?: Limbs; readonly skeleton?: Skeleton },
): OverPose | undefined {
  return take?.goals && limbs && skeleton && layerCode(take).takeLimbs(take.goals, limbs, skeleton);
}

/**
 * The last part of posing by a take, once poses are within the limits: the root goes where it is attached, then limbs
 * go to their goals. Undefined if that is nothing.
 * @throws Error for a take with either whose code was not provided
 */
export function overPoseOf(take: Take | undefined, character: Follower): OverPose | undefined {
  return take?.attached ? layerCode(take).overPose(take, character) : limbsOf(take, character);
}

/**
 * Writes the take's values of the first `count` DOFs to `out`; other ones are left alone. Allocates nothing.
 * @param rotations receives the rotations that samples give to joints
 */
export function evaluateMotion(
  { curves, joints, layers }: TakeMotion,
  timeSeconds: number,
  out: Float64Array,
  count: number,
  rotations?: PoseRotations,
): void {
  // A base may have fewer channels than the take that is edited.
  evaluateTake(curves, timeSeconds, out, Math.min(count, curves.channelCount));
  if (curves.samples && joints) samplePose(curves.samples, curves, joints, timeSeconds, out, count, rotations);
  layers?.add(timeSeconds, out, count);
}
