/**
 * Operations on the samples of a character's shown take: crop, resample, reverse, smooth, and convert to keys. Seconds
 * are the take's. Refused while another take is retargeted to the character, since the result would be invisible. If
 * nothing changes, the document is the same object and no undo step is made.
 */

import { runToEnd, type Steps } from '../../evaluate/steps.ts';
import { type Character, type Document, shownTake } from '../../model/document.ts';
import { characterDofs } from '../../model/skeleton/dofs.ts';
import type { Take } from '../../model/takes/take.ts';
import { described } from '../arguments.ts';
import type { Edit } from '../change.ts';
import { checkedChannels } from '../channel-edits.ts';
import { changeCharacter, requireCharacter } from '../characters.ts';
import { command } from '../command.ts';
import { CommandError } from '../command-error.ts';
import { cutName } from '../cut-name.ts';
import { sameValue } from '../delta.ts';
import { refuseLayers } from '../layers/refuse-layers.ts';
import { refuseMoved } from '../refuse-moved.ts';
import { type Converted, converting, type Tolerance } from '../samples/convert.ts';
import { cropped, requireSamples, split as splitAt, trimmed } from '../samples/frames.ts';
import { MEDIAN_FRAMES } from '../samples/median.ts';
import { resampling } from '../samples/resample.ts';
import { reversing } from '../samples/reverse.ts';
import { jointRotations } from '../samples/rotations.ts';
import { type SampleFilter, smoothing } from '../samples/smooth.ts';
import { index, number, oneOf, optional, record } from '../schema/shape.ts';
import { CHARACTER, indices, NOW, range } from '../schema/shared-shapes.ts';
import { requireTake, uniqueTakeName, withTake } from '../takes.ts';
import { withoutUnkeyed } from '../unkeyed.ts';

interface OfSamples {
  readonly characterId: string;
}

/** Keeps the frames from one time to another, both included, as the playback range; all keys are kept. */
export const cropSamples = command({
  id: 'samples.crop',
  args: {
    ...CHARACTER,
    from: number,
    to: number,
  },
  label: (document, args) => `Crop ${nameOf(document, args)}`,
  run(document, args) {
    const [from, to] = interval(args.from, args.to);
    return changed(document, args, (take) => cropped(take, from, to));
  },
});

/** Removes one end up to a time; the frame there is kept. */
export const trimSamples = command({
  id: 'samples.trim',
  args: {
    ...NOW,
    /** Which end to remove: before the time or after it. */
    side: oneOf(['start', 'end']),
  },
  label: (document, args) => `Trim the ${args.side} of ${nameOf(document, args)}`,
  run(document, args) {
    return changed(document, args, (take) => trimmed(take, args.side, args.timeSeconds));
  },
});

/** Splits a take in two: the shown one ends before the time, a new one starts there and is shown. */
export const splitSamples = command({
  id: 'samples.split',
  args: NOW,
  label: (document, args) => `Split ${nameOf(document, args)}`,
  run: (document, { characterId, timeSeconds }) =>
    changeCharacter(document, characterId, (character) => {
      const take = ownTake(character);
      const [before, after] = splitAt(take, timeSeconds);
      const named = { ...after, name: uniqueTakeName(character, take.name) };
      const takes = withTake(character, character.shownTake, before).takes;
      return { ...withoutUnkeyed(character), takes: [...takes, named], shownTake: takes.length };
    }),
});

/** Arguments of resampling samples; the rate must be greater than 0. */
export interface ResampleSamples extends OfSamples {
  readonly framesPerSecond: number;
}

/** Changes the frame rate; see `samples/resample.ts`. Keys are kept. */
export const resampleSamples = command({
  id: 'samples.resample',
  args: { ...CHARACTER, framesPerSecond: number },
  label: (document, args) => `Resample ${nameOf(document, args)}`,
  run: (document, args) => runToEnd(resampleSteps(document, args)),
});

/**
 * Runs `resampleSamples` in steps, yielding progress every few milliseconds.
 * @throws CommandError if the rate is not greater than 0, or the take has no samples
 */
export function* resampleSteps(document: Document, args: ResampleSamples): Steps<Document> {
  const rate = args.framesPerSecond;
  if (!(rate > 0)) throw new CommandError(`The frame rate must be greater than 0, found ${rate}.`);
  const character = requireCharacter(document, args.characterId);
  return withNewTake(document, args, yield* resampling(character, ownTake(character), rate));
}

/** Reverses samples and keys. */
export const reverseSamples = command({
  id: 'samples.reverse',
  args: CHARACTER,
  label: (document, args) => `Reverse ${nameOf(document, args)}`,
  run: (document, args) => runToEnd(reverseSteps(document, args)),
});

/** Runs `reverseSamples` in steps, yielding progress every few milliseconds. */
export function* reverseSteps(document: Document, args: OfSamples): Steps<Document> {
  return withNewTake(document, args, yield* reversing(ownTake(requireCharacter(document, args.characterId))));
}

/** Arguments of smoothing samples, or removing their spikes. */
export interface SmoothSamples extends OfSamples {
  /** Default: all sampled channels. */
  readonly channels?: readonly number[];
  /** Default `gaussian`; a `median` removes spikes. See `samples/smooth.ts`. */
  readonly filter?: SampleFilter['kind'];
  /** σ of the Gaussian, seconds; greater than 0. */
  readonly sigmaSeconds?: number;
  /** Window of the median: 3, 5 or 7. */
  readonly frames?: number;
  /** Seconds of the take, both included: frames outside are kept. Default: the whole take. */
  readonly range?: readonly [number, number];
}

/** Smooths sampled channels, or removes their spikes; see `samples/smooth.ts`. */
export const smoothSamples = command({
  id: 'samples.smooth',
  args: {
    ...CHARACTER,
    channels: optional(indices),
    filter: optional(oneOf(['gaussian', 'median'])),
    sigmaSeconds: optional(number),
    frames: optional(index),
    range: optional(range),
  },
  label: (document, args) =>
    args.filter === 'median' ? `Remove spikes from ${nameOf(document, args)}` : `Smooth ${nameOf(document, args)}`,
  run: (document, args) => runToEnd(smoothSteps(document, args)),
});

/** Runs `smoothSamples` in steps, yielding progress every few milliseconds. */
export function* smoothSteps(document: Document, args: SmoothSamples): Steps<Document> {
  const filter = checkedFilter(args);
  const character = requireCharacter(document, args.characterId);
  const { skeleton, morphs } = character;
  const take = ownTake(character);
  const rotations = skeleton ? jointRotations(skeleton) : [];
  const channels = sampledChannels(take, args.channels);
  const dofs = characterDofs(skeleton, morphs);
  const smooth = yield* smoothing(take, dofs, rotations, channels, filter, args.range);
  return withNewTake(document, args, smooth);
}

function checkedFilter({ filter: kind = 'gaussian', sigmaSeconds, frames }: SmoothSamples): SampleFilter {
  if (kind === 'median') {
    if (frames !== undefined && MEDIAN_FRAMES.includes(frames)) return { kind, frames };
    const widths = MEDIAN_FRAMES.join(', ');
    throw new CommandError(`The width of a median must be one of ${widths} frames, found ${described(frames)}.`);
  }
  if (sigmaSeconds !== undefined && sigmaSeconds > 0) return { kind, sigmaSeconds };
  throw new CommandError(`The width of a filter must be greater than 0, found ${described(sigmaSeconds)}.`);
}

function interval(from: number, to: number): readonly [number, number] {
  if (from <= to) return [from, to];
  throw new CommandError(`The range ends at ${to} s, before its start at ${from} s.`);
}

/** Arguments of converting samples to keys. */
export interface ConvertToKeys extends OfSamples {
  /** Default: all sampled channels; others are skipped. */
  readonly channels?: readonly number[];
  readonly tolerance: Tolerance;
}

/** Replaces samples by keys; see `samples/convert.ts`. Nothing is selected afterwards. */
export const convertToKeys = command({
  id: 'samples.convertToKeys',
  args: {
    ...CHARACTER,
    channels: optional(indices),
    tolerance: record({ position: number, angle: number }),
  },
  label: (document, args) => `Convert ${nameOf(document, args)} to keys`,
  run: (document, args) => runToEnd(convertSteps(document, args)).edit,
});

/** The result of the conversion, with the document after it. */
export interface Conversion {
  readonly edit: Edit;
  readonly report: Converted;
}

/**
 * Runs `convertToKeys` in steps, yielding progress every few milliseconds.
 * @throws CommandError if a tolerance is not greater than 0, or the take has no samples
 */
export function* convertSteps(document: Document, args: ConvertToKeys): Steps<Conversion> {
  const { characterId, tolerance } = args;
  const { position, angle } = tolerance;
  const character = requireCharacter(document, characterId);
  const take = ownTake(character);
  if (!(position > 0 && angle > 0)) {
    throw new CommandError(`A tolerance must be greater than 0, found ${Math.min(position, angle)}.`);
  }
  requireSamples(take);
  const report = yield* converting(character, take, sampledChannels(take, args.channels), { position, angle });
  return { edit: { document: withNewTake(document, args, report.take), keys: [] }, report };
}

/** The sampled ones of the given channels, or all sampled channels. */
function sampledChannels(take: Take, channels: readonly number[] | undefined): readonly number[] {
  const given = channels === undefined ? [...take.channels.keys()] : checkedChannels(take, channels);
  const sampled = given.filter((channel) => take.channels[channel]?.kind === 'samples');
  if (sampled.length > 0) return sampled;
  throw new CommandError(channels ? 'None of these curves is sampled.' : 'This take has no samples.');
}

function changed(document: Document, args: OfSamples, change: (take: Take) => Take): Document {
  return withNewTake(document, args, change(ownTake(requireCharacter(document, args.characterId))));
}

function withNewTake(document: Document, { characterId }: OfSamples, take: Take): Document {
  return changeCharacter(document, characterId, (c) =>
    sameValue(take, shownTake(c)) ? c : withTake(c, c.shownTake, take),
  );
}

/** The shown take; refuses, before any work is done, while another take is retargeted to the character. */
function ownTake(character: Character): Take {
  refuseMoved(character);
  const take = requireTake(character);
  refuseLayers(take);
  return take;
}

function nameOf(document: Document, { characterId }: OfSamples): string {
  return cutName(shownTake(requireCharacter(document, characterId))?.name ?? 'take');
}
