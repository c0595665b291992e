/**
 * Commands that put takes together from frames: join, cut out, insert. What follows is carried on over the ground from
 * what precedes it (`samples/join.ts`). Joining samples takes that have keys; cutting and inserting are for samples.
 */

import { runToEnd, type Steps, within } from '../../evaluate/steps.ts';
import type { Character, Document } from '../../model/document.ts';
import type { Marker } from '../../model/takes/markers.ts';
import { rangeOfSamples, type Samples } from '../../model/takes/samples.ts';
import type { Take } from '../../model/takes/take.ts';
import { withMarkers } from '../../model/takes/with-markers.ts';
import { described } from '../arguments.ts';
import { changeCharacter, requireCharacter } from '../characters.ts';
import { command } from '../command.ts';
import { CommandError } from '../command-error.ts';
import { markersWithin, retimed, rippledMarkers } from '../markers.ts';
import { firstFrameFrom, framesBetween, lastFrameTo } from '../samples/frames.ts';
import { JOIN_ALIGNMENTS, type JoinAlignment, joining } from '../samples/join.ts';
import { refuseTooMany } from '../samples/most-frames.ts';
import { resampling } from '../samples/resample.ts';
import { inChannelsOf } from '../samples/same-channels.ts';
import { framesOnly, takeFrames, takeOfFrames } from '../samples/take-frames.ts';
import { boolean, filledText, number, oneOf, optional } from '../schema/shape.ts';
import { TAKES, takeRef } from '../schema/shared-shapes.ts';
import { uniqueTakeName } from '../takes.ts';
import { withoutUnkeyed } from '../unkeyed.ts';
import { changingTakes, namesOfTakes, type OfTakes, skeletonOf, takesToChange } from './take-edits.ts';
import { nameOfTake, type TakeRef } from './takes.ts';

const HOW_JOINED = { overlapSeconds: optional(number), align: optional(oneOf(JOIN_ALIGNMENTS)) } as const;

/** How one piece continues from another. */
export interface HowJoined {
  /** Cross-fade; default 0.25. Whole frames, at most those of the shorter piece. */
  readonly overlapSeconds?: number;
  /** Default `root`. */
  readonly align?: JoinAlignment;
}

/** Arguments of joining takes, in the order in which they follow each other. */
export interface JoinTakes extends OfTakes, HowJoined {
  /** Default: the first one's, with `_joined`. */
  readonly name?: string;
}

interface Joined {
  readonly overlapSeconds: number;
  readonly align: JoinAlignment;
}

const OVERLAP_SECONDS = 0.25;

/** Joins takes of the same skeleton in this order: a new take of the first one's character, which is shown. */
export const joinTakes = command({
  id: 'takes.join',
  args: { ...TAKES, ...HOW_JOINED, name: optional(filledText) },
  label: (document, args) => `Join ${namesOfTakes(document, args)}`,
  run: (document, args) => runToEnd(joinSteps(document, args)),
});

/**
 * Runs `joinTakes` in steps, yielding progress every few milliseconds.
 * @throws CommandError for fewer than two takes
 */
export function* joinSteps(document: Document, args: JoinTakes): Steps<Document> {
  const refs = takesToChange(document, args.takes);
  if (refs.length < 2)
    throw new CommandError('Joining needs at least two takes. They are joined in the order of the list.');
  const how = checkedHow(args);
  const character = requireCharacter(document, refs[0].characterId);
  const skeleton = skeletonOf(character);
  const first = character.takes[refs[0].take];
  let made = takeFrames(character, first);
  let markers: readonly Marker[] = markersWithin(first.markers, ...rangeOfSamples(made));
  for (const [i, ref] of refs.slice(1).entries()) {
    const from = i / (refs.length - 1);
    const to = (i + 1) / (refs.length - 1);
    const next = framesLike(character, document, ref, made);
    const overlap = framesOfOverlap(how, made, next);
    const joined = { character: { ...character, skeleton }, take: first, alignment: how.align };
    const start = made.startSeconds + (made.frameCount - overlap) * made.frameSeconds;
    const theirs = requireCharacter(document, ref.characterId).takes[ref.take];
    const range = rangeOfSamples(next);
    const moved = retimed(markersWithin(theirs.markers, ...range), (seconds) => seconds - range[0] + start);
    markers = [...markers, ...moved, ...fadeOf(made, start, overlap, theirs.name)];
    made = yield* within(joining(joined, made, next, overlap), from, to);
  }
  const name = uniqueTakeName(character, args.name?.trim() || `${first.name}_joined`);
  const take = withMarkers({ ...takeOfFrames(first, made), name }, markers);
  return changeCharacter(document, character.id, (c) => ({
    ...withoutUnkeyed(c),
    takes: [...c.takes, take],
    shownTake: c.takes.length,
  }));
}

/** The span of a cross-fade, so that the timeline shows where it is. */
function fadeOf({ frameSeconds }: Samples, start: number, overlap: number, name: string): readonly Marker[] {
  if (overlap === 0) return [];
  return [{ timeSeconds: start, endSeconds: start + (overlap - 1) * frameSeconds, label: `to ${name}` }];
}

/** Arguments of cutting frames out of takes. */
export interface CutOut extends OfTakes, HowJoined {
  /** The first second of the take that is removed, and the last. */
  readonly from: number;
  readonly to: number;
  /** They are seconds of the transport: characters start at different times. */
  readonly areOfTransport?: boolean;
}

/** Removes the frames from one time to another, both included, and closes the gap. */
export const cutOutOfTakes = command({
  id: 'takes.cutOut',
  args: { ...TAKES, ...HOW_JOINED, from: number, to: number, areOfTransport: optional(boolean) },
  label: (document, args) => `Cut out of ${namesOfTakes(document, args)}`,
  run: (document, args) => runToEnd(cutOutSteps(document, args)),
});

/**
 * Runs `cutOutOfTakes` in steps, yielding progress every few milliseconds.
 * @throws CommandError if the range ends before it starts, or has all frames of a take
 */
export function cutOutSteps(document: Document, args: CutOut): Steps<Document> {
  const how = checkedHow(args);
  const [from, to] = [args.from, args.to];
  if (from > to) throw new CommandError(`The range ends at ${to} s, before its start at ${from} s.`);
  return changingTakes(document, args.takes, function* (character, take) {
    const samples = framesOnly(character, take);
    const offset = args.areOfTransport ? character.timeOffsetSeconds : 0;
    const first = firstFrameFrom(samples, from + offset);
    const end = lastFrameTo(samples, to + offset) + 1;
    if (first >= end) return take;
    if (first === 0 && end === samples.frameCount) {
      throw new CommandError(`All frames of ${take.name} are in that range. Remove the take instead.`);
    }
    const before = framesBetween(samples, 0, first);
    const after = framesBetween(samples, end, samples.frameCount);
    const removed = (frames: number) =>
      rippledMarkers(take.markers, samples.startSeconds + first * samples.frameSeconds, -frames * samples.frameSeconds);
    if (first === 0) {
      return withMarkers(takeOfFrames(take, { ...after, startSeconds: samples.startSeconds }), removed(end - first));
    }
    if (end === samples.frameCount) return withMarkers(takeOfFrames(take, before), removed(end - first));
    const joined = { character: { ...character, skeleton: skeletonOf(character) }, take, alignment: how.align };
    const overlap = framesOfOverlap(how, before, after);
    const made = yield* joining(joined, before, after, overlap);
    return withMarkers(takeOfFrames(take, made), removed(end - first + overlap));
  });
}

/** Arguments of inserting a take, or a held pose, into another take. */
export interface InsertInto extends HowJoined {
  readonly into: TakeRef;
  /** Seconds of the take; what is there continues after it. */
  readonly atSeconds: number;
  /** The take to insert; absent: the pose at that time is held. */
  readonly take?: TakeRef;
  /** How long the pose is held. */
  readonly holdSeconds?: number;
}

/** Inserts another take, or holds the pose at a time. */
export const insertIntoTake = command({
  id: 'takes.insert',
  args: {
    into: takeRef,
    atSeconds: number,
    take: optional(takeRef),
    holdSeconds: optional(number),
    ...HOW_JOINED,
  },
  label: (document, { into, take: inserted }) =>
    inserted
      ? `Insert ${nameOfTake(document, inserted)} into ${nameOfTake(document, into)}`
      : `Hold pose in ${nameOfTake(document, into)}`,
  run: (document, args) => runToEnd(insertSteps(document, args)),
});

/** Runs `insertIntoTake` in steps, yielding progress every few milliseconds. */
export function insertSteps(document: Document, args: InsertInto): Steps<Document> {
  const how = checkedHow(args);
  return changingTakes(document, [args.into], (character, take) =>
    args.take
      ? insertingTake(document, character, take, args.take, args.atSeconds, how)
      : holding(character, take, args.atSeconds, args.holdSeconds),
  );
}

function* insertingTake(
  document: Document,
  character: Character,
  take: Take,
  inserted: TakeRef,
  atSeconds: number,
  how: Joined,
): Steps<Take> {
  const [ref] = takesToChange(document, [inserted]);
  const samples = framesOnly(character, take);
  const middle = framesLike(character, document, ref, samples);
  const at = firstFrameFrom(samples, atSeconds);
  const joined = { character: { ...character, skeleton: skeletonOf(character) }, take, alignment: how.align };
  const parts = [framesBetween(samples, 0, at), middle, framesBetween(samples, at, samples.frameCount)];
  const [first, ...others] = parts.filter(({ frameCount }) => frameCount > 0);
  let made = first;
  let lead = 0;
  for (const [i, part] of others.entries()) {
    const overlap = framesOfOverlap(how, made, part);
    if (i === 0 && at > 0) lead = overlap;
    made = yield* within(joining(joined, made, part, overlap), i / others.length, (i + 1) / others.length);
  }
  const start = samples.startSeconds + at * samples.frameSeconds;
  const added = (made.frameCount - samples.frameCount) * samples.frameSeconds;
  const other = requireCharacter(document, ref.characterId).takes[ref.take];
  const range = rangeOfSamples(middle);
  // Its first frames are faded into what precedes it.
  const begin = start - lead * samples.frameSeconds;
  const theirs = retimed(markersWithin(other.markers, ...range), (seconds) => seconds - range[0] + begin);
  return withMarkers(takeOfFrames(take, { ...made, startSeconds: samples.startSeconds }), [
    ...rippledMarkers(take.markers, start, added),
    ...theirs,
  ]);
}

/** The frame at or after a time, repeated. */
function* holding(character: Character, take: Take, atSeconds: number, holdSeconds?: number): Steps<Take> {
  if (holdSeconds === undefined || !(holdSeconds >= 0)) {
    throw new CommandError(`The time to hold must not be negative, found ${described(holdSeconds)}.`);
  }
  const samples = framesOnly(character, take);
  const count = Math.round(holdSeconds / samples.frameSeconds);
  if (count === 0) return take;
  const at = Math.min(samples.frameCount - 1, firstFrameFrom(samples, atSeconds));
  const width = samples.scales.length;
  const frameCount = samples.frameCount + count;
  refuseTooMany(frameCount, width, samples.frameCount);
  const values = new Float64Array(frameCount * width);
  const row = samples.values.subarray(at * width, (at + 1) * width);
  values.set(samples.values.subarray(0, at * width));
  for (let f = 0; f <= count; f++) values.set(row, (at + f) * width);
  values.set(samples.values.subarray((at + 1) * width), (at + 1 + count) * width);
  yield 1;
  const start = samples.startSeconds + (at + 0.5) * samples.frameSeconds;
  const moved = rippledMarkers(take.markers, start, count * samples.frameSeconds);
  return withMarkers(takeOfFrames(take, { ...samples, frameCount, values }), moved);
}

/** The frames of another take, at one's own frame rate and in one's own channels. */
function framesLike(character: Character, document: Document, ref: TakeRef, own: Samples): Samples {
  const other = requireCharacter(document, ref.characterId);
  const take = other.takes[ref.take];
  const frames = takeFrames(other, take, 1 / own.frameSeconds);
  const rated = runToEnd(resampling(other, takeOfFrames(take, frames), 1 / own.frameSeconds));
  return inChannelsOf(character, other, rated.samples ?? frames);
}

function framesOfOverlap({ overlapSeconds }: Joined, a: Samples, b: Samples): number {
  return Math.min(a.frameCount, b.frameCount, Math.round(overlapSeconds / a.frameSeconds));
}

function checkedHow({ overlapSeconds = OVERLAP_SECONDS, align = 'root' }: HowJoined): Joined {
  if (!(overlapSeconds >= 0)) {
    throw new CommandError(`The cross-fade must not be negative, found ${overlapSeconds} s.`);
  }
  return { overlapSeconds, align };
}
