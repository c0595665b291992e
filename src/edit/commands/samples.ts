/**
 * What is done to the samples of the take that a character shows: cutting, another rate, backwards, smoothed, and made
 * into keys. Seconds are the clip's. Refused while another character's take moves the character: nobody would see it.
 * Where nothing changes the document is the very same, and no step is made.
 */

import { runToEnd, type Steps } from '../../evaluate/steps.ts';
import type { ChannelClip } from '../../model/clip.ts';
import { type Character, type Document, shownClip } from '../../model/document.ts';
import { characterDofs } from '../../model/dofs.ts';
import { finiteNumber, listOf, oneOf } from '../arguments.ts';
import { checkedChannels } from '../channel-edits.ts';
import { changeCharacter, requireCharacter } from '../characters.ts';
import { sameValue } from '../delta.ts';
import { refuseMoved } from '../refuse-moved.ts';
import { type Converted, converting, type Tolerance } from '../samples/convert.ts';
import { cropped, requireSamples, split as splitAt, trimmed } from '../samples/frames.ts';
import { MEDIAN_FRAMES } from '../samples/median.ts';
import { resampling } from '../samples/resample.ts';
import { reversing } from '../samples/reverse.ts';
import { jointRotations } from '../samples/rotations.ts';
import { type SampleFilter, smoothing } from '../samples/smooth.ts';
import { type Command, CommandError, type Edit } from '../store.ts';
import { requireTake, uniqueTakeName, withTake } from '../takes.ts';
import { withoutUnkeyed } from '../unkeyed.ts';

interface OfSamples {
  readonly characterId: string;
}

export interface CropSamples extends OfSamples {
  readonly from: number;
  readonly to: number;
}

/** Frames from one time to another stay, both included, and are what is played; keys stay all. */
export const cropSamples: Command<CropSamples> = {
  id: 'samples.crop',
  label: (document, args) => `Crop ${nameOf(document, args)}`,
  run(document, args) {
    const [from, to] = interval(finiteNumber(args.from, '"from"'), finiteNumber(args.to, '"to"'));
    return changed(document, args, (clip) => cropped(clip, from, to));
  },
};

export interface TrimSamples extends OfSamples {
  /** Which end goes: what lies before the time, or after it. */
  readonly side: 'start' | 'end';
  readonly timeSeconds: number;
}

/** One end goes, up to a time; the frame there stays. */
export const trimSamples: Command<TrimSamples> = {
  id: 'samples.trim',
  label: (document, args) => `Trim the ${args.side} of ${nameOf(document, args)}`,
  run(document, args) {
    const side = oneOf<TrimSamples['side']>(args.side, ['start', 'end'], '"side"');
    const seconds = finiteNumber(args.timeSeconds, '"timeSeconds"');
    return changed(document, args, (clip) => trimmed(clip, side, seconds));
  },
};

export interface SplitSamples extends OfSamples {
  readonly timeSeconds: number;
}

/** Two takes: the one that is shown ends before the time, one more begins there and is shown then. */
export const splitSamples: Command<SplitSamples> = {
  id: 'samples.split',
  label: (document, args) => `Split ${nameOf(document, args)}`,
  run: (document, { characterId, timeSeconds }) =>
    changeCharacter(document, characterId, (character) => {
      const clip = ownTake(character);
      const [before, after] = splitAt(clip, finiteNumber(timeSeconds, '"timeSeconds"'));
      const named = { ...after, name: uniqueTakeName(character, clip.name) };
      const clips = withTake(character, character.shownClip, before).clips;
      return { ...withoutUnkeyed(character), clips: [...clips, named], shownClip: clips.length };
    }),
};

export interface ResampleSamples extends OfSamples {
  readonly framesPerSecond: number;
}

/** Another frame rate; see `samples/resample.ts`. Keys stay. */
export const resampleSamples: Command<ResampleSamples> = {
  id: 'samples.resample',
  label: (document, args) => `Resample ${nameOf(document, args)}`,
  run: (document, args) => runToEnd(resampleSteps(document, args)),
};

/** The same, pausing every few milliseconds with the part that is done. */
export function* resampleSteps(document: Document, args: ResampleSamples): Steps<Document> {
  const rate = finiteNumber(args.framesPerSecond, '"framesPerSecond"');
  if (!(rate > 0)) throw new CommandError(`The frame rate must be greater than 0, found ${rate}.`);
  const character = requireCharacter(document, args.characterId);
  return withClip(document, args, yield* resampling(character, ownTake(character), rate));
}

/** Backwards, keys too. */
export const reverseSamples: Command<OfSamples> = {
  id: 'samples.reverse',
  label: (document, args) => `Reverse ${nameOf(document, args)}`,
  run: (document, args) => runToEnd(reverseSteps(document, args)),
};

/** The same, pausing every few milliseconds with the part that is done. */
export function* reverseSteps(document: Document, args: OfSamples): Steps<Document> {
  return withClip(document, args, yield* reversing(ownTake(requireCharacter(document, args.characterId))));
}

export interface SmoothSamples extends OfSamples {
  /** All that follow the samples, where absent. */
  readonly channels?: readonly number[] | undefined;
  /** `gaussian` where absent; a `median` takes out spikes. See `samples/smooth.ts`. */
  readonly filter?: SampleFilter['kind'] | undefined;
  /** σ of the Gaussian, seconds; above 0. */
  readonly sigmaSeconds?: number | undefined;
  /** That the median is taken of: 3, 5 or 7. */
  readonly frames?: number | undefined;
  /** Seconds of the clip, both included: frames outside stay. The whole take where absent. */
  readonly range?: readonly [number, number] | undefined;
}

export const smoothSamples: Command<SmoothSamples> = {
  id: 'samples.smooth',
  label: (document, args) =>
    args.filter === 'median' ? `Remove spikes from ${nameOf(document, args)}` : `Smooth ${nameOf(document, args)}`,
  run: (document, args) => runToEnd(smoothSteps(document, args)),
};

/** The same, pausing every few milliseconds with the part that is done. */
export function* smoothSteps(document: Document, args: SmoothSamples): Steps<Document> {
  const filter = checkedFilter(args);
  const character = requireCharacter(document, args.characterId);
  const { skeleton, morphs } = character;
  const clip = ownTake(character);
  const rotations = skeleton ? jointRotations(skeleton) : [];
  const channels = sampledChannels(clip, args.channels);
  const dofs = characterDofs(skeleton, morphs);
  const smooth = yield* smoothing(clip, dofs, rotations, channels, filter, checkedRange(args.range));
  return withClip(document, args, smooth);
}

function checkedFilter({ filter, sigmaSeconds, frames }: SmoothSamples): SampleFilter {
  const kind = oneOf<SampleFilter['kind']>(filter ?? 'gaussian', ['gaussian', 'median'], '"filter"');
  if (kind === 'median') {
    const given = finiteNumber(frames, '"frames"');
    if (MEDIAN_FRAMES.includes(given)) return { kind, frames: given };
    throw new CommandError(`The width of a median must be one of ${MEDIAN_FRAMES.join(', ')} frames, found ${given}.`);
  }
  const sigma = finiteNumber(sigmaSeconds, '"sigmaSeconds"');
  if (!(sigma > 0)) throw new CommandError(`The width of a filter must be greater than 0, found ${sigma}.`);
  return { kind, sigmaSeconds: sigma };
}

function checkedRange(range: unknown): readonly [number, number] | undefined {
  if (range === undefined) return undefined;
  const [from, to] = listOf(range, '"range"').map((seconds) => finiteNumber(seconds, '"range"'));
  return interval(finiteNumber(from, '"range"'), finiteNumber(to, '"range"'));
}

function interval(from: number, to: number): readonly [number, number] {
  if (from <= to) return [from, to];
  throw new CommandError(`The range ends at ${to} s, before it begins at ${from} s.`);
}

export interface ConvertToKeys extends OfSamples {
  /** All that follow the samples, where absent; those that don't are passed over. */
  readonly channels?: readonly number[] | undefined;
  readonly tolerance: Tolerance;
}

/** Keys in place of samples; see `samples/convert.ts`. Nothing is selected after it. */
export const convertToKeys: Command<ConvertToKeys, Edit> = {
  id: 'samples.convertToKeys',
  label: (document, args) => `Convert ${nameOf(document, args)} to keys`,
  run: (document, args) => runToEnd(convertSteps(document, args)).edit,
};

/** What the conversion came to, with the document as it is after it. */
export interface Conversion {
  readonly edit: Edit;
  readonly report: Converted;
}

/** The same, pausing every few milliseconds with the part that is done. */
export function* convertSteps(document: Document, args: ConvertToKeys): Steps<Conversion> {
  const { characterId, tolerance } = args;
  const character = requireCharacter(document, characterId);
  const clip = ownTake(character);
  // Beyond its type on purpose: a console gives what it likes.
  const given: { position?: unknown; angle?: unknown } = tolerance ?? {};
  const position = finiteNumber(given.position, 'The position tolerance');
  const angle = finiteNumber(given.angle, 'The rotation tolerance');
  if (!(position > 0 && angle > 0)) {
    throw new CommandError(`A tolerance must be greater than 0, found ${Math.min(position, angle)}.`);
  }
  requireSamples(clip);
  const report = yield* converting(character, clip, sampledChannels(clip, args.channels), { position, angle });
  return { edit: { document: withClip(document, args, report.clip), keys: [] }, report };
}

/** Those of the given channels that follow the samples, or all that do. */
function sampledChannels(clip: ChannelClip, channels: readonly number[] | undefined): readonly number[] {
  const given = channels === undefined ? [...clip.channels.keys()] : checkedChannels(clip, channels);
  const sampled = given.filter((channel) => clip.channels[channel]?.kind === 'samples');
  if (sampled.length > 0) return sampled;
  throw new CommandError(channels ? 'None of these curves is sampled.' : 'This take has no samples.');
}

function changed(document: Document, args: OfSamples, change: (clip: ChannelClip) => ChannelClip): Document {
  return withClip(document, args, change(ownTake(requireCharacter(document, args.characterId))));
}

function withClip(document: Document, { characterId }: OfSamples, clip: ChannelClip): Document {
  return changeCharacter(document, characterId, (c) =>
    sameValue(clip, shownClip(c)) ? c : withTake(c, c.shownClip, clip),
  );
}

/** The take that is shown; refuses, before any work is done, while another character's take moves the character. */
function ownTake(character: Character): ChannelClip {
  refuseMoved(character);
  return requireTake(character);
}

function nameOf(document: Document, { characterId }: OfSamples): string {
  return shownClip(requireCharacter(document, characterId))?.name ?? 'take';
}
