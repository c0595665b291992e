/**
 * Operations on whole curves. Each selects all keys of the channels that it changed: few of those selected before still
 * exist, and the changes are what one wants to see. If nothing changes, the document is the same object and no undo
 * step is made.
 */

import { runToEnd, type Steps } from '../../evaluate/steps.ts';
import type { Document } from '../../model/document.ts';
import { characterDofs, unitOfChannel } from '../../model/skeleton/dofs.ts';
import type { DofUnit } from '../../model/skeleton/skeleton.ts';
import type { Channel, KeyedChannel } from '../../model/takes/take.ts';
import { described } from '../arguments.ts';
import type { Edit } from '../change.ts';
import { checkedChannels, editedChannels, type OfChannels, takeOf } from '../channel-edits.ts';
import { type Baked, withExtrapolationBaked } from '../channels/bake-extrapolation.ts';
import { keepsOffset, withLoop } from '../channels/make-loop.ts';
import { type Reduction, reductionOf } from '../channels/report.ts';
import { type Resampling, resampleChannel } from '../channels/resample.ts';
import { type Simplified, simplifyChannel } from '../channels/simplify.ts';
import { changeCharacter, requireCharacter } from '../characters.ts';
import { command } from '../command.ts';
import { CommandError } from '../command-error.ts';
import { allKeys } from '../keys/selection.ts';
import { refuseMoved } from '../refuse-moved.ts';
import { filteringAngles } from '../samples/euler-filter.ts';
import { boolean, either, number, oneOf, optional, record } from '../schema/shape.ts';
import { CHANNELS, indices, range } from '../schema/shared-shapes.ts';
import { curvesIn } from '../step-names.ts';
import { withTake } from '../takes.ts';

/**
 * How far a curve may deviate, in its own unit (`unitOfChannel`): radians, the file's lengths, weights. Units that none
 * of the channels has can be omitted; if a needed one is missing, the command refuses.
 */
export type Tolerances = Readonly<Partial<Record<DofUnit, number>>>;

/** Arguments of simplifying channels: fewer keys, within a tolerance in each channel's unit. */
export interface Simplify extends OfChannels {
  /** Greater than 0: one per unit, to combine half a degree with a millimetre, or one for all. */
  readonly tolerance: number | Tolerances;
  /** Seconds of the take: keys outside are kept, with the curve there. Default: all keys. */
  readonly range?: readonly [number, number];
}

/** Fewer keys, with the curve within tolerance everywhere; see `channels/simplify.ts` for the method. */
export const simplify = command({
  id: 'channels.simplify',
  args: {
    ...CHANNELS,
    tolerance: either(
      number,
      record({
        angle: optional(number),
        length: optional(number),
        factor: optional(number),
        weight: optional(number),
      }),
    ),
    range: optional(range),
  },
  label: (document, { characterId, channels }) => `Simplify ${curvesIn(document, characterId, channels)}`,
  run: (document, args) => edited(document, args, simplified(document, args)),
});

/** The result of `simplify` in advance. Called on every move of a slider, so measured channels are cached. */
export function simplifyPreview(document: Document, args: Simplify): Reduction {
  return reduction(document, args, simplified(document, args));
}

/** Arguments of resampling channels. */
export interface Resample extends OfChannels, Resampling {}

/** A key on every frame; see `channels/resample.ts`. */
export const resample = command({
  id: 'channels.resample',
  args: {
    ...CHANNELS,
    framesPerSecond: number,
    offsetSeconds: optional(number),
    from: number,
    to: number,
    tangents: oneOf(['linear', 'smooth']),
  },
  label: (document, { characterId, channels }) => `Resample ${curvesIn(document, characterId, channels)}`,
  run: (document, args) => edited(document, args, resampled(document, args)),
});

/** The result of `resample` in advance. */
export function resamplePreview(document: Document, args: Resample): Reduction {
  return reduction(document, args, resampled(document, args));
}

/** Removes jumps of angles, in keys and samples, keeping the rotations; see `samples/euler-filter.ts`. */
export const eulerFilter = command({
  id: 'channels.eulerFilter',
  args: CHANNELS,
  label: (document, { characterId, channels }) => `Euler filter on ${curvesIn(document, characterId, channels)}`,
  run: (document, args) => runToEnd(eulerFilterSteps(document, args)).edit,
});

/** The result of the filter. */
export interface EulerFiltering {
  readonly edit: Edit;
  /** Channels that changed. */
  readonly changed: readonly number[];
  /** Keys whose values changed; frames of samples are not counted. */
  readonly keysChanged: number;
  /** Sentences on what was not done, and why. */
  readonly notes: readonly string[];
}

/** Runs `eulerFilter` in steps, yielding progress every few milliseconds. */
export function* eulerFilterSteps(document: Document, args: OfChannels): Steps<EulerFiltering> {
  const { characterId } = args;
  const take = takeOf(document, characterId);
  const character = requireCharacter(document, characterId);
  const given = checkedChannels(take, args.channels);
  if (given.some((channel) => take.channels[channel]?.kind === 'samples')) refuseMoved(character);
  const { take: filtered, ...result } = yield* filteringAngles(character, take, given);
  const keys = allKeys(filtered, result.changed);
  if (filtered.samples === take.samples) {
    return { ...result, edit: editedChannels(document, characterId, filtered.channels, keys) };
  }
  const after = changeCharacter(document, characterId, (c) => withTake(c, c.shownTake, filtered));
  return { ...result, edit: { document: after, keys } };
}

/** Arguments of baking the extrapolation of channels. */
export interface BakeExtrapolation extends OfChannels {
  /** Seconds of the take. */
  readonly from: number;
  readonly to: number;
}

/** Bakes extrapolation to keys; see `channels/bake-extrapolation.ts`. */
export const bakeExtrapolation = command({
  id: 'channels.bakeExtrapolation',
  args: { ...CHANNELS, from: number, to: number },
  label: (document, { characterId, channels }) => `Bake extrapolation of ${curvesIn(document, characterId, channels)}`,
  run: (document, args) => edited(document, args, baked(document, args)),
});

/** The outcome of baking the extrapolation, in numbers of keys. */
export interface BakePreview {
  readonly keysBefore: number;
  readonly keysAfter: number;
  /** Channels that still repeat on the side that is not baked, with a changed period. */
  readonly periodsChanged: readonly number[];
}

/** The result of `bakeExtrapolation` in advance. */
export function bakePreview(document: Document, args: BakeExtrapolation): BakePreview {
  const results = [...baked(document, args)];
  return {
    keysBefore: results.reduce((sum, [, r]) => sum + r.keysBefore, 0),
    keysAfter: results.reduce((sum, [, r]) => sum + r.keysAfter, 0),
    periodsChanged: results.filter(([, r]) => r.periodChanged).map(([index]) => index),
  };
}

/** Makes the end meet the start, `cycle` on both sides; see `channels/make-loop.ts`. */
export const makeLoop = command({
  id: 'channels.makeLoop',
  args: {
    ...CHANNELS,
    /**
     * Channels that continue from their end (`cycle_offset`), like a root that moves; true for all. Default: those that
     * do so already, and lengths that travel (`travels`).
     */
    keepOffset: optional(either(boolean, indices)),
  },
  label: (document, { characterId, channels }) => `Make ${curvesIn(document, characterId, channels)} loop`,
  run(document, args) {
    const take = takeOf(document, args.characterId);
    const { keepOffset } = args;
    const { skeleton, morphs } = requireCharacter(document, args.characterId);
    const dofs = characterDofs(skeleton, morphs);
    const named = typeof keepOffset === 'object' ? new Set(checkedChannels(take, keepOffset)) : undefined;
    const keeps = (channel: KeyedChannel, index: number) => {
      if (named) return named.has(index);
      if (typeof keepOffset === 'boolean') return keepOffset;
      return keepsOffset(channel, unitOfChannel(dofs, index) === 'length');
    };
    return edited(
      document,
      args,
      results(document, args, (channel, index) => withLoop(channel, keeps(channel, index))),
    );
  },
});

type Result = Channel | { readonly channel: Channel };

/** Results for those of the given channels that have keys. */
function results<R>(
  document: Document,
  args: OfChannels,
  of: (channel: KeyedChannel, index: number) => R,
): Map<number, R> {
  const { channels } = takeOf(document, args.characterId);
  const made = new Map<number, R>();
  for (const index of checkedChannels({ channels }, args.channels)) {
    const channel = channels[index];
    if (channel.kind === 'keys') made.set(index, of(channel, index));
  }
  return made;
}

function edited(document: Document, { characterId }: OfChannels, made: ReadonlyMap<number, Result>): Edit {
  const take = takeOf(document, characterId);
  const changed: number[] = [];
  const channels = take.channels.map((channel, index) => {
    const result = made.get(index) ?? channel;
    const next = 'channel' in result ? result.channel : result;
    if (next !== channel) changed.push(index);
    return next;
  });
  return editedChannels(document, characterId, channels, allKeys({ ...take, channels }, changed));
}

/** The last simplification of each channel: the preview and the command after it need the same. */
const simplifiedBefore = new WeakMap<KeyedChannel, { readonly key: string; readonly result: Simplified }>();

function simplified(document: Document, args: Simplify): Map<number, Simplified> {
  const { tolerance, range } = args;
  const unitOf = units(document, args);
  const toleranceOf = (unit: DofUnit) => {
    const own = typeof tolerance === 'object' ? tolerance[unit] : tolerance;
    if (own !== undefined && own > 0) return own;
    throw new CommandError(`The tolerance of ${unit}s must be greater than 0, found ${described(own)}.`);
  };
  const [from, to] = range ? interval(range[0], range[1]) : [Number.NEGATIVE_INFINITY, Number.POSITIVE_INFINITY];
  return results(document, args, (channel, index) => {
    const own = toleranceOf(unitOf(index));
    const key = `${own} ${from} ${to}`;
    const known = simplifiedBefore.get(channel);
    if (known?.key === key) return known.result;
    const result = simplifyChannel(channel, own, [from, to]);
    simplifiedBefore.set(channel, { key, result });
    return result;
  });
}

function resampled(document: Document, args: Resample) {
  const [from, to] = interval(args.from, args.to);
  const { framesPerSecond, offsetSeconds = 0, tangents } = args;
  if (!(framesPerSecond > 0)) {
    throw new CommandError(`The frame rate must be greater than 0, found ${framesPerSecond}.`);
  }
  return results(document, args, (channel) =>
    resampleChannel(channel, { framesPerSecond, offsetSeconds, from, to, tangents }),
  );
}

function baked(document: Document, args: BakeExtrapolation): Map<number, Baked> {
  const [from, to] = interval(args.from, args.to);
  return results(document, args, (channel) => withExtrapolationBaked(channel, from, to));
}

function reduction(
  document: Document,
  args: OfChannels,
  made: ReadonlyMap<number, Simplified | ReturnType<typeof resampleChannel>>,
): Reduction {
  const take = takeOf(document, args.characterId);
  const list = [...made].map(([index, result]) => ({
    index,
    changed: result.channel !== take.channels[index],
    result,
  }));
  return reductionOf(list, units(document, args));
}

function units(document: Document, { characterId }: OfChannels): (channel: number) => DofUnit {
  const { skeleton, morphs } = requireCharacter(document, characterId);
  const dofs = characterDofs(skeleton, morphs);
  return (channel) => unitOfChannel(dofs, channel);
}

function interval(start: number, end: number): readonly [number, number] {
  if (start > end) throw new CommandError(`The range ends at ${end} s, before its start at ${start} s.`);
  return [start, end];
}
