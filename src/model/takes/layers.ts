/**
 * Layers of a take: motions above its base, each with a weight, which are summed to what is shown
 * (`evaluate/layers.ts`).
 *
 * One of them is active: its channels are the take's own (`Take.channels`), so that whatever edits a take edits the
 * active layer, and curves, dope sheet and keying need not know of layers. The other motions are in the stack.
 *
 *     take.channels            layer 1, the active one
 *     take.layers.base         the motion beneath all layers
 *     take.layers.list[0]      layer 0, with its motion
 *     take.layers.list[1]      layer 1, without
 */
import {
  baseOf,
  type Channel,
  type Layer,
  type LayerMode,
  type LayerSettings,
  type LayerStack,
  type Motion,
  restChannel,
  type Take,
} from './take.ts';

/** All modes, as files and commands call them. */
export const LAYER_MODES = ['additive', 'override'] as const satisfies readonly LayerMode[];

const NO_MOTION: Motion = { channels: [] };

/** The motion of a layer, or of the base by -1. */
export function motionOf(take: Take, layer: number): Motion {
  const { layers } = take;
  if (!layers || layers.active === layer) return take;
  return (layer < 0 ? layers.base : layers.list[layer]?.motion) ?? NO_MOTION;
}

/** All motions of a take: the base's, then each layer's. */
export function motionsOf(take: Take): readonly Motion[] {
  return [baseOf(take), ...(take.layers?.list.map((_, i) => motionOf(take, i)) ?? [])];
}

/** The active layer; undefined without layers, or if the base is active. */
export function activeLayer({ layers }: Take): Layer | undefined {
  return layers?.list[layers.active];
}

/** The take with another active layer, or the base by -1; the same object if it is active already. */
export function withActive(take: Take, active: number): Take {
  if (!take.layers || take.layers.active === active) return take;
  return arranged(
    take,
    baseOf(take),
    take.layers.list.map((layer, i) => ({ ...layer, motion: motionOf(take, i) })),
    active,
  );
}

/**
 * A take of a base and layers, each with its motion.
 * @param take whose name, range, markers and further facts of the stack are kept
 * @param active the index of the active layer; -1 for the base
 */
export function arranged(take: Take, base: Motion, list: readonly Layer[], active: number): Take {
  const { channels: _channels, samples: _samples, layers, ...head } = take;
  const own = active < 0 ? base : (list[active].motion ?? NO_MOTION);
  const { base: before, ...rest } = layers ?? {};
  const kept = list.map((layer, i) => {
    const { motion = NO_MOTION, ...settings } = layer;
    const made: Layer = i === active ? settings : { ...settings, motion: onlyMotion(motion) };
    // Equal layers stay one object: changes are found by identity.
    return (
      layers?.list.find((other) => isSameBesideMotion(made, other) && isSameMotion(made.motion, other.motion)) ?? made
    );
  });
  const beneath = before && isSameMotion(before, base) ? before : onlyMotion(base);
  return {
    ...head,
    ...onlyMotion(own),
    layers: { ...rest, active, ...(active >= 0 && { base: beneath }), list: kept },
  };
}

/** The take with another motion and no layers. */
export function unlayered(take: Take, motion: Motion): Take {
  const { channels: _channels, samples: _samples, layers: _layers, ...head } = take;
  return { ...head, ...onlyMotion(motion) };
}

/** The take with each of its motions changed, as if it were a take; without layers that is the take itself. */
export function withMotions(take: Take, change: (take: Take, layer: number) => Motion): Take {
  const { layers } = take;
  if (!layers) return { ...take, ...onlyMotion(change(take, -1)) };
  const changed = (layer: number) => change(unlayered(take, motionOf(take, layer)), layer);
  const list = layers.list.map((layer, i) => ({ ...layer, motion: changed(i) }));
  return arranged(take, changed(-1), list, layers.active);
}

/** A motion that leaves that many DOFs alone. */
export function emptyMotion(count: number): Motion {
  return { channels: Array.from({ length: count }, () => NO_KEYS_YET) };
}

const NO_KEYS_YET: Channel = restChannel();

/** Which layers count, by index: not the muted ones, nor others while one is solo. */
export function countingLayers(list: readonly LayerSettings[]): readonly number[] {
  const heard = [...list.keys()].filter((i) => !list[i].mute);
  const solo = heard.filter((i) => list[i].solo);
  return solo.length > 0 ? solo : heard;
}

/** A weight within 0 … 1. */
export function clampedWeight(weight: number): number {
  return Math.min(1, Math.max(0, weight));
}

/** Whether two takes with layers are the same but for their markers and which layer is active. */
export function haveSameFiles(a: Partial<Take>, b: Partial<Take>): boolean {
  if (a.name !== b.name || a.framesPerSecond !== b.framesPerSecond) return false;
  return a.range?.[0] === b.range?.[0] && a.range?.[1] === b.range?.[1] && haveSameLayers(a, b);
}

function haveSameLayers(a: Partial<Take>, b: Partial<Take>): boolean {
  const [one, other] = [a.layers, b.layers];
  if (!one || !other || one.list.length !== other.list.length) return false;
  if (one.others !== other.others || one.baseFile !== other.baseFile) return false;
  const motionIn = (stack: LayerStack, own: Partial<Motion>, layer: number): Partial<Motion> =>
    (stack.active === layer ? own : layer < 0 ? stack.base : stack.list[layer].motion) ?? NO_MOTION;
  const isSame = (layer: number) => isSameMotion(motionIn(one, a, layer), motionIn(other, b, layer));
  return isSame(-1) && one.list.every((layer, i) => isSame(i) && isSameBesideMotion(layer, other.list[i]));
}

function isSameBesideMotion(a: Layer, b: Layer): boolean {
  const [{ motion: _a, ...one }, { motion: _b, ...other }] = [a, b];
  // TypeScript types keys as strings.
  return (Object.keys({ ...one, ...other }) as (keyof typeof one)[]).every((key) => one[key] === other[key]);
}

/** The motion without what else a take has; the same object if it is no take. */
function onlyMotion(motion: Motion): Motion {
  if (!('range' in motion)) return motion;
  const { channels, samples } = motion;
  return samples ? { channels, samples } : { channels };
}

function isSameMotion(a: Partial<Motion> | undefined, b: Partial<Motion> | undefined): boolean {
  return a?.channels === b?.channels && a?.samples === b?.samples;
}
