/**
 * A take with layers as a take without, DOF by DOF (`evaluate/layers.ts` has the formula):
 *
 *     no layer touches it                   the base's channel as it was
 *     keys under constant weights           their exact sum (`sum-curves.ts`)
 *     keys under a weight over time         fitted (`fit-sum.ts`)
 *     samples                               the sum at each of their frames
 */

import { evaluateChannel } from '../../evaluate/curves.ts';
import { type CompiledLayer, compileLayers, weightAt } from '../../evaluate/layers.ts';
import { frameRateOf } from '../../evaluate/samples/frame-rate.ts';
import type { Character } from '../../model/document.ts';
import { characterDofs } from '../../model/skeleton/dofs.ts';
import { restExtent } from '../../model/skeleton/rest-extent.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { motionOf, unlayered } from '../../model/takes/layers.ts';
import { columnOf, type Samples } from '../../model/takes/samples.ts';
import {
  baseOf,
  type Channel,
  type KeyedChannel,
  type Motion,
  type Take,
  USUAL_FRAMES_PER_SECOND,
} from '../../model/takes/take.ts';
import { fittedSum, type WeightedCurve } from './fit-sum.ts';
import { FLATTEN_TOLERANCE, type FlattenOptions } from './flatten-options.ts';
import { sumOfCurves, type Term } from './sum-curves.ts';

/** A take whose layers are part of its channels. */
export interface Flattened {
  readonly take: Take;
  /** Number of channels whose extrapolation became keys. */
  readonly bakedCount: number;
  /** For each channel, whether it was fitted: it is within the tolerance, not exact. */
  readonly isFitted: readonly boolean[];
}

/**
 * The take without layers, which moves the same; the same object if it has none.
 * @throws CommandError if repetitions would take too many keys
 */
export function flattened(take: Take, skeleton: Skeleton | undefined, options: FlattenOptions = {}): Flattened {
  if (!take.layers) return { take, bakedCount: 0, isFitted: take.channels.map(() => false) };
  const sum = new LayerSum(take, skeleton, options);
  const { channels, samples } = baseOf(take);
  const made = channels.map((channel, dof) => (channel.kind === 'samples' ? channel : sum.channelAt(channel, dof)));
  const summed = samples && sum.samplesOf(samples);
  const motion: Motion = { channels: made, ...(summed && { samples: summed }) };
  return { take: unlayered(take, motion), bakedCount: sum.bakedCount, isFitted: sum.isFitted };
}

/** The character with takes without layers, which move it the same; the same object if none has layers. */
export function withFlattenedTakes(character: Character, options: FlattenOptions = {}): Character {
  const { takes, skeleton } = character;
  if (!takes.some(({ layers }) => layers)) return character;
  return { ...character, takes: takes.map((take) => flattened(take, skeleton, options).take) };
}

class LayerSum {
  bakedCount = 0;
  readonly isFitted: boolean[];
  private readonly layers: readonly CompiledLayer[];
  /** The layers that touch each DOF, and the place of its channel in each. */
  private readonly above = new Map<number, (readonly [CompiledLayer, number])[]>();
  private readonly tolerances: readonly number[];
  private readonly framesPerSecond: number;

  constructor(
    private readonly take: Take,
    skeleton: Skeleton | undefined,
    options: FlattenOptions,
  ) {
    const { tolerance = FLATTEN_TOLERANCE, framesPerSecond } = options;
    const base = baseOf(take);
    this.layers = compileLayers(take, skeleton);
    for (const layer of this.layers) {
      layer.dofs.forEach((dof, i) => {
        const above = this.above.get(dof);
        if (above) above.push([layer, i]);
        else this.above.set(dof, [[layer, i]]);
      });
    }
    const size = (skeleton && restExtent(skeleton)) || 1;
    const dofs = characterDofs(skeleton, []);
    this.tolerances = base.channels.map((_, dof) => tolerance * (dofs[dof]?.unit === 'length' ? Math.min(1, size) : 1));
    this.framesPerSecond = framesPerSecond ?? frameRateOf(unlayered(take, base)) ?? USUAL_FRAMES_PER_SECOND;
    this.isFitted = base.channels.map(() => false);
  }

  /** @param base the channel beneath, without samples */
  channelAt(base: Channel, dof: number): Channel {
    const above = this.above.get(dof);
    if (!above) return base;
    const channelIn = ({ index }: CompiledLayer) => motionOf(this.take, index).channels[dof] as KeyedChannel;
    if (above.some(([layer]) => layer.weightCurve)) {
      this.isFitted[dof] = true;
      const curves = above.map(
        ([layer]): WeightedCurve => ({
          channel: channelIn(layer),
          weight: weightChannel(this.take, layer),
          isAdditive: layer.isAdditive,
        }),
      );
      return fittedSum(base, curves, this.take.range, this.framesPerSecond, this.tolerances[dof]);
    }
    let terms: Term[] = base.kind === 'keys' ? [{ factor: 1, channel: base }] : [];
    let constant = base.kind === 'rest' ? base.value : 0;
    for (const [layer] of above) {
      if (!layer.isAdditive) {
        const left = 1 - layer.weight;
        constant *= left;
        terms = terms.flatMap(({ factor, channel }) => (left === 0 ? [] : [{ factor: factor * left, channel }]));
      }
      terms.push({ factor: layer.weight, channel: channelIn(layer) });
    }
    const { channel, isBaked } = sumOfCurves(terms, constant, this.take.range);
    if (isBaked) this.bakedCount++;
    return channel;
  }

  samplesOf(samples: Samples): Samples {
    const { frameCount, frameSeconds, startSeconds, scales } = samples;
    const width = scales.length;
    const columns = [...this.above].flatMap(([dof, above]) => {
      const column = baseOf(this.take).channels[dof]?.kind === 'samples' ? columnOf(samples, dof) : -1;
      return column < 0 ? [] : [{ column, above }];
    });
    if (columns.length === 0) return samples;
    const values = samples.values.slice();
    for (let f = 0; f < frameCount; f++) {
      const time = startSeconds + f * frameSeconds;
      for (const { column, above } of columns) {
        const at = f * width + column;
        let value = values[at] * scales[column];
        for (const [layer, i] of above) {
          const weight = weightAt(layer, time);
          const x = evaluateChannel(layer.curves, i, time);
          value = layer.isAdditive ? value + weight * x : (1 - weight) * value + weight * x;
        }
        values[at] = value / scales[column];
      }
    }
    return { ...samples, values };
  }
}

function weightChannel({ layers }: Take, { index, weight }: CompiledLayer): number | KeyedChannel {
  const own = layers?.list[index].weight;
  return own === undefined || typeof own === 'number' ? weight : own;
}
