/**
 * Two neighbouring layers as one, or the lowest one and the base. For each DOF that both touch or one does, what is
 * shown is α·v + x of what is beneath, v. A layer has one weight for all its DOFs, so that only those with one α can be
 * merged: additive ones (α = 1), or such that take the place of what is beneath by the same share.
 */

import { touches } from '../../evaluate/layers.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { arranged, clampedWeight, emptyMotion, motionOf, unlayered } from '../../model/takes/layers.ts';
import type { Channel, Layer, Motion, Take } from '../../model/takes/take.ts';
import { CommandError } from '../command-error.ts';
import { flattened } from './flatten.ts';

/**
 * The take with a layer merged into the one beneath, or into the base.
 * @throws CommandError, in a sentence, if no single layer moves the same
 */
export function mergedDown(take: Take, skeleton: Skeleton | undefined, layer: number): Take {
  const { layers } = take;
  if (!layers) throw new CommandError(`${take.name} has no layers.`);
  const upper = layers.list[layer];
  const lower = layers.list[layer - 1];
  for (const one of lower ? [lower, upper] : [upper]) {
    if (one.mute || layers.list.some((other) => other.solo)) {
      throw new CommandError(
        `"${one.name}" can’t be merged while a layer is muted or solo: that would change what is shown.`,
      );
    }
  }
  const rest = layers.list.map((each, i): Layer => ({ ...each, motion: motionOf(take, i) }));
  const kept = rest.filter((_, i) => i !== layer);
  if (!lower) {
    const base = flattened(arranged(take, motionOf(take, -1), [rest[layer]], -1), skeleton).take;
    return kept.length > 0 ? arranged(take, base, kept, -1) : unlayered(take, base);
  }
  const merged = mergedLayer(take, skeleton, [rest[layer - 1], rest[layer]]);
  return arranged(
    take,
    motionOf(take, -1),
    kept.map((each, i) => (i === layer - 1 ? merged : each)),
    layer - 1,
  );
}

function mergedLayer(take: Take, skeleton: Skeleton | undefined, [lower, upper]: readonly [Layer, Layer]): Layer {
  const both = [lower, upper].map((layer) => {
    const touched = touches(layer, skeleton);
    const channels = layer.motion?.channels ?? [];
    return channels.map((channel, dof) => channel.kind === 'keys' && touched(dof));
  });
  const count = both[0].length;
  const shares = new Set<number>();
  for (let dof = 0; dof < count; dof++) {
    const own = [lower, upper].filter((_, i) => both[i][dof]);
    if (own.length > 0) shares.add(own.reduce((share, layer) => share * shareBeneath(layer), 1));
  }
  const [share = 1] = shares;
  if (shares.size > 1 || Number.isNaN(share)) {
    throw new CommandError(
      `"${upper.name}" and "${lower.name}" can’t be one layer: they let through different shares of what is beneath. Flatten all layers instead.`,
    );
  }
  // Over nothing, what both add is their sum.
  const still: Motion = emptyMotion(count);
  const { take: sum } = flattened(arranged(take, still, [lower, upper], -1), skeleton);
  const weight = share < 1 ? 1 - share : 1;
  const channels = sum.channels.map((channel): Channel => (weight === 1 ? channel : scaled(channel, 1 / weight)));
  const { joints: _joints, ofWeight: _ofWeight, ...settings } = lower;
  return {
    ...settings,
    ...{ mode: share < 1 ? 'override' : 'additive', weight, root: false, morphs: false },
    motion: { channels },
  };
}

/** How much of what is beneath a layer lets through; NaN if that changes over time. */
function shareBeneath({ mode, weight }: Layer): number {
  if (mode === 'additive') return 1;
  return typeof weight === 'number' ? 1 - clampedWeight(weight) : Number.NaN;
}

function scaled(channel: Channel, by: number): Channel {
  if (channel.kind !== 'keys') return channel;
  const times = (numbers: Float64Array) => numbers.map((value) => value * by);
  const { values, tangentsIn, tangentsOut } = channel;
  return {
    ...channel,
    values: times(values),
    tangentsIn: { ...tangentsIn, slopes: times(tangentsIn.slopes) },
    tangentsOut: { ...tangentsOut, slopes: times(tangentsOut.slopes) },
  };
}
