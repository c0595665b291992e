/**
 * What the curves of the active layer lie over: the sum of base and other layers, or of all while the base is active.
 * And the layer's weight, if it is keyed.
 */
import { type CompiledTake, compileChannels } from '../../../../evaluate/compiled-take.ts';
import { evaluateChannel } from '../../../../evaluate/curves.ts';
import { evaluateMotion, type TakeMotion, takeMotion } from '../../../../evaluate/take-motion.ts';
import { perPair } from '../../../../model/per-object.ts';
import type { Skeleton } from '../../../../model/skeleton/skeleton.ts';
import type { KeyedChannel, Take } from '../../../../model/takes/take.ts';

export interface RestCurves {
  readonly motion: TakeMotion;
  /** Number of channels. */
  readonly count: number;
  /** The active layer's weight over time. */
  readonly weight?: { readonly name: string; readonly channel: KeyedChannel; readonly curve: CompiledTake };
}

/** Cached; undefined for a take without layers. */
export function restCurves(take: Take, skeleton: Skeleton | undefined): RestCurves | undefined {
  return take.layers && ofTake(take, skeleton ?? NOWHERE);
}

const NOWHERE = {};

const ofTake = perPair((take: Take, of: Skeleton | typeof NOWHERE): RestCurves => {
  const skeleton = 'joints' in of ? of : undefined;
  const { layers } = take;
  const active = layers?.list[layers.active];
  // A layer of no weight still counts, if it is solo.
  const list = layers?.list.map((each) => (each === active ? { ...each, weight: 0 } : each)) ?? [];
  const rest: Take = active && layers ? { ...take, layers: { ...layers, list } } : take;
  const channel = active && typeof active.weight !== 'number' ? active.weight : undefined;
  return {
    motion: takeMotion(rest, skeleton),
    count: take.channels.length,
    ...(active && channel && { weight: { name: active.name, channel, curve: compileChannels([channel]) } }),
  };
});

/** Values at evenly spaced times. */
export interface RestValues {
  readonly from: number;
  readonly step: number;
  /** Times by channels. */
  readonly values: Float64Array;
  readonly timeCount: number;
  /** Of the weight; empty if it isn't keyed. */
  readonly weights: Float64Array;
}

/** Evaluates them all from a time on, every `step` seconds of the take. */
export function restValues(
  { motion, count, weight }: RestCurves,
  from: number,
  step: number,
  timeCount: number,
): RestValues {
  const values = new Float64Array(timeCount * count);
  for (let i = 0; i < timeCount; i++) {
    evaluateMotion(motion, from + i * step, values.subarray(i * count, (i + 1) * count), count);
  }
  const weights = Float64Array.from({ length: weight ? timeCount : 0 }, (_, i) =>
    weight ? Math.min(1, Math.max(0, evaluateChannel(weight.curve, 0, from + i * step))) : 0,
  );
  return { from, step, values, timeCount, weights };
}
