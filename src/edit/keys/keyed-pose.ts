/**
 * What a step has keyed at a time: for doing the same for a moment (`moment.ts`), and for telling what it will look
 * like.
 */
import { compileChannels } from '../../evaluate/compiled-take.ts';
import { evaluateChannel } from '../../evaluate/curves.ts';
import type { LayerShare } from '../../evaluate/layers.ts';
import { type Character, type Document, findCharacter, shownTake } from '../../model/document.ts';
import type { DofValue } from '../../model/skeleton/dofs.ts';
import { activeLayer } from '../../model/takes/layers.ts';
import { type Channel, type KeyedChannel, keysOf, repeats } from '../../model/takes/take.ts';
import { activeShare } from '../layers/layer-values.ts';
import { period } from './cycle.ts';
import { findKey } from './same-time.ts';

/** Values nearer than this to the curve are on it. */
const ON_CURVE = 1e-12;
/** Seconds to a neighbour within which a new value is a jump. */
const JUMPS_WITHIN = 0.1;

/** The DOFs of one character that a step has keyed off their curves. */
export interface KeyedPose {
  readonly characterId: string;
  /** By index into the character's DOFs: those keyed off their curve, with the values that are displayed. */
  readonly dofs: readonly DofValue[];
}

/**
 * The DOFs of one character that were keyed at one time, and have another value there than before; undefined if none
 * were, or if more than that changed.
 *
 * @param timeSeconds of the transport
 */
export function keyedPose(before: Document, after: Document, timeSeconds: number): KeyedPose | undefined {
  const changed = after.characters.filter((character) => findCharacter(before, character.id) !== character);
  if (changed.length !== 1) return undefined;
  const [now] = changed;
  const was = findCharacter(before, now.id);
  const [took, takes] = [was && shownTake(was), shownTake(now)];
  if (!was || !took || !takes || was.shownTake !== now.shownTake || was.skeleton !== now.skeleton) return undefined;
  if (took.channels.length !== takes.channels.length) return undefined;
  const at = timeSeconds + now.timeOffsetSeconds;
  const dofs: DofValue[] = [];
  for (const [index, channel] of takes.channels.entries()) {
    const old = took.channels[index];
    if (channel === old) continue;
    if (channel.kind !== 'keys' || channel.times.length > keysOf(old).times.length + 1) return undefined;
    const key = findKey(channel, at);
    if (key < 0) return undefined;
    const value = channel.values[key];
    if (!isOnCurve(old, at, value)) dofs.push({ index, value });
  }
  const share = activeShare(now, timeSeconds);
  if (dofs.length === 0) return undefined;
  return { characterId: now.id, dofs: share ? dofs.map((dof) => displayed(dof, share(dof.index))) : dofs };
}

/** What a layer's own value shows. */
function displayed({ index, value }: DofValue, { a, b }: LayerShare): DofValue {
  return { index, value: a + b * value };
}

/** Whether a channel has a value at a time of the take already, up to rounding. */
export function isOnCurve(channel: Channel, at: number, value: number): boolean {
  if (channel.kind === 'samples') return false;
  const now = channel.kind === 'rest' ? channel.value : evaluateChannel(compileChannels([channel]), 0, at);
  return Math.abs(value - now) <= ON_CURVE;
}

/** Why a key isn't one of a moment. */
export type Abrupt =
  /** Seconds to the nearer neighbour. */
  | { readonly kind: 'jumps'; readonly dof: number; readonly seconds: number }
  /** Seconds between repetitions, each of which shows it. */
  | { readonly kind: 'repeats'; readonly dof: number; readonly seconds: number }
  /** The only key of an additive layer's channel, which so shows it at all times. */
  | { readonly kind: 'holds'; readonly dof: number };

/** The first of these DOFs whose key at that time makes a jump, or shows at other times too; undefined if none does. */
export function abruptKey(character: Character, dofs: readonly DofValue[], timeSeconds: number): Abrupt | undefined {
  const take = shownTake(character);
  const channels = take?.channels ?? [];
  const isAdded = take !== undefined && activeLayer(take)?.mode === 'additive';
  const at = timeSeconds + character.timeOffsetSeconds;
  for (const { index: dof } of dofs) {
    const channel = channels[dof];
    if (channel?.kind !== 'keys') continue;
    if (isAdded && channel.times.length === 1) return { kind: 'holds', dof };
    const seconds = nearestNeighbour(channel, at);
    if (seconds < JUMPS_WITHIN) return { kind: 'jumps', dof, seconds };
    const isRepeating = repeats(channel.extrapolateIn) || repeats(channel.extrapolateOut);
    if (isRepeating && period(channel) > 0) return { kind: 'repeats', dof, seconds: period(channel) };
  }
  return undefined;
}

/** Seconds from the key at a time to the nearer of two neighbours; infinite without one on each side. */
function nearestNeighbour({ times }: KeyedChannel, at: number): number {
  const key = times.findIndex((time) => Math.abs(time - at) <= 1e-9 * Math.max(1, Math.abs(at)));
  if (key <= 0 || key >= times.length - 1) return Infinity;
  return Math.min(times[key] - times[key - 1], times[key + 1] - times[key]);
}
