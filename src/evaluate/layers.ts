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
 * What moves takes calls this code without loading it (`take-motion.ts`).
 */
import { perObject } from '../model/per-object.ts';
import { jointReferred } from '../model/skeleton/joint-reference.ts';
import type { Skeleton } from '../model/skeleton/skeleton.ts';
import { remapGoals, takeOfChannels, withGoalChannels } from '../model/takes/goals.ts';
import { type LayerInfo, type LayersOverBase, provideLayerCode } from '../model/takes/layer-code.ts';
import { unknownJoints } from '../model/takes/layer-joints.ts';
import { clampedWeight, countingLayers, haveSameFiles, motionOf, withMotions } from '../model/takes/layers.ts';
import {
  baseOf,
  type KeyedChannel,
  type Layer,
  type LayerSettings,
  type Motion,
  type Take,
} from '../model/takes/take.ts';
import { overPose } from './attached.ts';
import { type CompiledTake, compileChannels } from './compiled-take.ts';
import { evaluateChannel, evaluateTake } from './curves.ts';
import { compileSkeleton } from './kinematics.ts';
import { limbRows } from './limbs/infos.ts';
import { goalProblems, takeLimbs } from './limbs/over-pose.ts';
import { goalPlaces } from './limbs/places.ts';
import { posedByGoals } from './limbs/posed.ts';
import { PieceSums, type PieceTerm } from './piece-sums.ts';

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

/** Passes this code on to what moves and edits takes; called before there is a take with layers, goals or attachments. */
export function provideLayers(): void {
  provideLayerCode({
    ...{ goalProblems, haveSameFiles, infos, limbRows, overBase, overPose, takeLimbs, unknownJoints, withMotions },
    ...{ goalPlaces, posedByGoals, remapGoals, takeOfChannels, withGoalChannels },
  });
}

/** A take's layers that count, from the lowest up; cached. */
export function compileLayers(take: Take, skeleton: Skeleton | undefined): readonly CompiledLayer[] {
  return compiled(take)(skeleton ?? NOWHERE).layers;
}

function overBase(take: Take, skeleton: Skeleton | undefined): LayersOverBase {
  return compiled(take)(skeleton ?? NOWHERE);
}

interface CompiledLayers extends LayersOverBase {
  readonly layers: readonly CompiledLayer[];
}

const NOWHERE = {};

const compiled = perObject((take: Take) =>
  perObject((of: Skeleton | typeof NOWHERE): CompiledLayers => {
    const skeleton = 'joints' in of ? of : undefined;
    const { list } = take.layers ?? { list: [] };
    const layers = countingLayers(list).flatMap((i) => compileLayer(list[i], i, motionOf(take, i), skeleton) ?? []);
    return { base: baseOf(take), layers, add: adding(layers) };
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
 * What adds layers to a pose. DOFs under constant weights alone are of the form A·v + B(t), where B is one sum over all
 * of their layers; others take the layers one by one.
 */
function adding(layers: readonly CompiledLayer[]): LayersOverBase['add'] {
  const isFaded = new Set(layers.flatMap(({ weightCurve, dofs }) => (weightCurve ? [...dofs] : [])));
  const steady = new Map<number, { keep: number; readonly terms: PieceTerm[] }>();
  for (const { dofs, isAdditive, weight, curves } of layers) {
    for (const [channel, dof] of dofs.entries()) {
      if (isFaded.has(dof)) continue;
      const { keep, terms } = steady.get(dof) ?? { keep: 1, terms: [] };
      const left = isAdditive ? 1 : 1 - weight;
      const beneath = terms.flatMap((term) => (left === 0 ? [] : [{ ...term, factor: left * term.factor }]));
      steady.set(dof, { keep: left * keep, terms: [...beneath, { curves, channel, factor: weight }] });
    }
  }
  const all = [...steady].sort(([a], [b]) => a - b);
  const dofs = Int32Array.from(all, ([dof]) => dof);
  const keeps = Float64Array.from(all, ([, { keep }]) => keep);
  const sums = new PieceSums(all.map(([, { terms }]) => terms));
  const faded = isFaded.size > 0 ? layers.flatMap((layer) => fadedLayer(layer, isFaded) ?? []) : [];
  return (timeSeconds, out, count) => {
    sums.evaluate(timeSeconds);
    const { values } = sums;
    for (let i = 0; i < dofs.length; i++) {
      const dof = dofs[i];
      if (dof >= count) break;
      out[dof] = keeps[i] * out[dof] + values[i];
    }
    for (const layer of faded) addFaded(layer, timeSeconds, out, count);
  };
}

/** The part of a layer over DOFs of which some layer's weight changes. */
interface FadedLayer {
  readonly layer: CompiledLayer;
  readonly dofs: Int32Array;
  readonly sums: PieceSums;
}

function fadedLayer(layer: CompiledLayer, isFaded: ReadonlySet<number>): FadedLayer | undefined {
  const { curves } = layer;
  const channels = [...layer.dofs.keys()].filter((channel) => isFaded.has(layer.dofs[channel]));
  if (channels.length === 0) return undefined;
  return {
    layer,
    dofs: Int32Array.from(channels, (channel) => layer.dofs[channel]),
    sums: new PieceSums(channels.map((channel) => [{ curves, channel, factor: 1 }])),
  };
}

function addFaded({ layer, dofs, sums }: FadedLayer, timeSeconds: number, out: Float64Array, count: number): void {
  const weight = weightAt(layer, timeSeconds);
  // Nothing changes, not even the sign of a zero.
  if (weight === 0) return;
  sums.evaluate(timeSeconds);
  const { values } = sums;
  const keep = layer.isAdditive ? 1 : 1 - weight;
  for (let i = 0; i < dofs.length; i++) {
    const dof = dofs[i];
    if (dof >= count) break;
    out[dof] = keep * out[dof] + weight * values[i];
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
  const layers = compileLayers(take, skeleton);
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
function layerWeight({ weight }: Layer, timeSeconds: number): number {
  return clampedWeight(typeof weight === 'number' ? weight : evaluateChannel(compiledWeight(weight), 0, timeSeconds));
}

function infos({ layers }: Take, timeSeconds: number): LayerInfo[] {
  return (layers?.list ?? []).map((layer, i) => ({
    ...{ name: layer.name, mode: layer.mode, weight: layerWeight(layer, timeSeconds) },
    ...{ mute: layer.mute, solo: layer.solo, active: layers?.active === i },
    ...(layer.joints && { joints: layer.joints }),
    ...{ root: layer.root, morphs: layer.morphs },
  }));
}
