/**
 * Layers over the motion of a take: from the lowest up, at a time t and for each DOF that a layer has keys for,
 *
 *     w           weight(t), clamped to 0 … 1
 *     x           the layer's value at t
 *     additive    v := v + w·x
 *     override    v := (1 − w)·v + w·x
 *
 * Limits and linked DOFs come after. Every DOF is treated alike, quaternions by their components.
 *
 * `takeMotion` is the one place where what controls a take becomes values of DOFs: its base, then its layers.
 */
import { perObject } from '../model/per-object.ts';
import { jointReferred } from '../model/skeleton/joint-reference.ts';
import type { Skeleton } from '../model/skeleton/skeleton.ts';
import { baseOf, clampedWeight, countingLayers, motionOf } from '../model/takes/layers.ts';
import type { KeyedChannel, Layer, LayerSettings, Motion, Take } from '../model/takes/take.ts';
import { type CompiledTake, compileChannels, compileTake } from './compiled-take.ts';
import { evaluateChannel, evaluateTake } from './curves.ts';
import { compileSkeleton } from './kinematics.ts';
import type { PoseRotations } from './rotations/pose-rotations.ts';
import { type SampledJoints, sampledJoints } from './samples/sampled-joints.ts';
import { samplePose } from './samples/sampled-pose.ts';

/** A take with its layers, ready for evaluation. */
export interface TakeMotion {
  /** Of the motion beneath the layers. */
  readonly curves: CompiledTake;
  /** If samples drive it, and there is a skeleton. */
  readonly joints: SampledJoints | undefined;
  /** Those that count, from the lowest up; empty without layers. */
  readonly layers: readonly CompiledLayer[];
}

/** A layer ready for evaluation. */
export interface CompiledLayer {
  /** Its index in the take's list. */
  readonly index: number;
  readonly isAdditive: boolean;
  /** Clamped; NaN if it is a curve. */
  readonly weight: number;
  /** The channel of a weight over time. */
  readonly weightCurve: CompiledTake | undefined;
  /** The DOFs that it touches and has keys for, ascending. */
  readonly dofs: Int32Array;
  /** A channel for each of `dofs`. */
  readonly curves: CompiledTake;
  /** Scratch for their values. */
  readonly values: Float64Array;
}

const NO_LAYERS: readonly CompiledLayer[] = [];
const NOWHERE = {};

/** Compiles a take with its layers; cached. Without a skeleton, layers with joints touch nothing but what follows. */
export function takeMotion(take: Take, skeleton: Skeleton | undefined): TakeMotion {
  const curves = compileTake(baseOf(take));
  return {
    curves,
    joints: curves.samples && skeleton && sampledJoints(curves, skeleton),
    layers: take.layers ? compiledLayers(take)(skeleton ?? NOWHERE) : NO_LAYERS,
  };
}

const compiledLayers = perObject((take: Take) =>
  perObject((of: Skeleton | typeof NOWHERE): readonly CompiledLayer[] => {
    const skeleton = 'joints' in of ? of : undefined;
    const { list } = take.layers ?? { list: [] };
    return countingLayers(list).flatMap((i) => compileLayer(list[i], i, motionOf(take, i), skeleton) ?? []);
  }),
);

/** Undefined if it has no effect at any time. */
function compileLayer(
  layer: Layer,
  index: number,
  { channels }: Motion,
  skeleton: Skeleton | undefined,
): CompiledLayer | undefined {
  const touched = touches(layer, skeleton);
  const dofs = [...channels.keys()].filter((dof) => channels[dof].kind === 'keys' && touched(dof));
  const weight = typeof layer.weight === 'number' ? clampedWeight(layer.weight) : Number.NaN;
  if (dofs.length === 0 || weight === 0) return undefined;
  return {
    index,
    isAdditive: layer.mode === 'additive',
    weight,
    weightCurve: typeof layer.weight === 'number' ? undefined : compiledWeight(layer.weight),
    dofs: Int32Array.from(dofs),
    curves: compileChannels(dofs.map((dof) => channels[dof])),
    values: new Float64Array(dofs.length),
  };
}

const compiledWeight = perObject((weight: KeyedChannel) => compileChannels([weight]));

/** Whether a layer touches a DOF, by its joints, `root` and `morphs`. */
export function touches(layer: LayerSettings, skeleton: Skeleton | undefined): (dof: number) => boolean {
  const { joints, root, morphs } = layer;
  if (!joints) return () => true;
  const within = skeleton && jointOfDofs(skeleton);
  const indexOf = jointReferred(skeleton?.joints ?? []);
  const named = new Set(joints.map(indexOf));
  return (dof) => {
    if (!within) return false;
    const joint = within[dof];
    if (joint === undefined) return morphs;
    return joint === ROOT ? root : named.has(joint);
  };
}

/** In place of a joint: the translation of the root. */
const ROOT = -1;

/** For each DOF of root and joints, the joint. */
const jointOfDofs = perObject((skeleton: Skeleton): Int32Array => {
  const { firstDof, jointCount, travel } = compileSkeleton(skeleton);
  const joints = new Int32Array(firstDof[jointCount]).fill(ROOT);
  for (let j = 0; j < jointCount; j++) joints.fill(j, firstDof[j], firstDof[j + 1]);
  for (const dof of travel) if (dof >= 0) joints[dof] = ROOT;
  return joints;
});

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
  for (const layer of layers) addLayer(layer, timeSeconds, out, count);
}

function addLayer(layer: CompiledLayer, timeSeconds: number, out: Float64Array, count: number): void {
  const { dofs, curves, values, isAdditive } = layer;
  const weight = weightAt(layer, timeSeconds);
  // Nothing changes, not even the sign of a zero.
  if (weight === 0) return;
  evaluateTake(curves, timeSeconds, values);
  for (let i = 0; i < dofs.length; i++) {
    const dof = dofs[i];
    if (dof >= count) break;
    out[dof] = isAdditive ? out[dof] + weight * values[i] : (1 - weight) * out[dof] + weight * values[i];
  }
}

/** A layer's weight at a time, within 0 … 1. */
export function weightAt({ weight, weightCurve }: CompiledLayer, timeSeconds: number): number {
  return weightCurve ? clampedWeight(evaluateChannel(weightCurve, 0, timeSeconds)) : weight;
}

/** A DOF's value as a function of one layer's value x there: a + b·x. */
export interface LayerShare {
  readonly a: number;
  readonly b: number;
}

/**
 * The share that one layer has in what is shown of a DOF, before limits.
 * @param take with layers
 * @param layer its index; -1 for the base
 * @param base the values beneath the layers at that time
 */
export function shareOf(
  take: Take,
  skeleton: Skeleton | undefined,
  layer: number,
  timeSeconds: number,
  base: ArrayLike<number>,
): (dof: number) => LayerShare {
  const { list } = take.layers ?? { list: [] };
  const counting = new Set(countingLayers(list));
  const { layers } = takeMotion(take, skeleton);
  const compiled = new Map(layers.map((each) => [each.index, each]));
  const weights = list.map((one) => layerWeight(one, timeSeconds));
  for (const each of layers) evaluateTake(each.curves, timeSeconds, each.values);
  const touched = touches(list[layer] ?? NO_MASK, skeleton);
  return (dof) => {
    let a = layer < 0 ? 0 : (base[dof] ?? 0);
    let b = layer < 0 ? 1 : 0;
    list.forEach(({ mode }, i) => {
      const weight = weights[i];
      const isOwn = i === layer;
      if (isOwn && counting.has(i) && touched(dof)) {
        if (mode === 'override') a *= 1 - weight;
        b = weight;
        return;
      }
      const other = isOwn ? undefined : compiled.get(i);
      const at = other ? other.dofs.indexOf(dof) : -1;
      if (!other || at < 0 || weight === 0) return;
      if (mode === 'override') {
        a *= 1 - weight;
        b *= 1 - weight;
      }
      a += weight * other.values[at];
    });
    return { a, b };
  };
}

const NO_MASK: LayerSettings = {
  name: '',
  mode: 'additive',
  weight: 1,
  mute: false,
  solo: false,
  root: false,
  morphs: false,
};

/** A layer's weight at a time, within 0 … 1, whether it counts or not. */
export function layerWeight({ weight }: Layer, timeSeconds: number): number {
  return clampedWeight(typeof weight === 'number' ? weight : evaluateChannel(compiledWeight(weight), 0, timeSeconds));
}
