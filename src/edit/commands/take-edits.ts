/**
 * Commands that change the motion of takes, one or several in one step, keyed or sampled. Refused for takes that are
 * retargeted to the character: those are baked first.
 */

import { runToEnd, type Steps, within } from '../../evaluate/steps.ts';
import type { Character, Document } from '../../model/document.ts';
import { characterDofs, unitOfChannel } from '../../model/skeleton/dofs.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import type { Take } from '../../model/takes/take.ts';
import { withMarkers } from '../../model/takes/with-markers.ts';
import { keepsOffset, withLoop } from '../channels/make-loop.ts';
import { changeCharacter, requireCharacter } from '../characters.ts';
import { command } from '../command.ts';
import { CommandError } from '../command-error.ts';
import { type LockedContact, lockingFeet } from '../hold/foot-lock.ts';
import { refuseLayers } from '../layers/refuse-layers.ts';
import { markersWithin } from '../markers.ts';
import { refuseMoved } from '../refuse-moved.ts';
import { looping } from '../samples/loop.ts';
import { retiming } from '../samples/speed.ts';
import { framesOnly, KEYED_RATE, takeOfFrames } from '../samples/take-frames.ts';
import { mirroringTake } from '../samples/take-mirror.ts';
import { number, optional } from '../schema/shape.ts';
import { TAKES } from '../schema/shared-shapes.ts';
import { withTake } from '../takes.ts';
import { withoutUnkeyed } from '../unkeyed.ts';
import { checkedRefs, nameOfTake, type TakeRef } from './takes.ts';

/** Takes as arguments of commands; they may belong to different characters. */
export interface OfTakes {
  readonly takes: readonly TakeRef[];
}

/** Exchanges left and right; see `samples/take-mirror.ts`. */
export const mirrorTakes = command({
  id: 'takes.mirror',
  args: TAKES,
  label: (document, args) => `Mirror ${namesOfTakes(document, args)}`,
  run: (document, args) => runToEnd(mirrorTakesSteps(document, args)),
});

/** Runs `mirrorTakes` in steps, yielding progress every few milliseconds. */
export function mirrorTakesSteps(document: Document, { takes }: OfTakes): Steps<Document> {
  return changingTakes(document, takes, (character, take) =>
    mirroringTake({ ...character, skeleton: skeletonOf(character) }, take, character.space?.up),
  );
}

/** Arguments of changing the speed of takes. */
export interface SetSpeed extends OfTakes {
  /** 2 plays twice as fast; greater than 0. */
  readonly factor: number;
}

/** Changes how long takes last; see `samples/speed.ts`. */
export const setTakeSpeed = command({
  id: 'takes.setSpeed',
  args: { ...TAKES, factor: number },
  label: (document, args) => `Change speed of ${namesOfTakes(document, args)}`,
  run: (document, args) => runToEnd(setSpeedSteps(document, args)),
});

/**
 * Runs `setTakeSpeed` in steps, yielding progress every few milliseconds.
 * @throws CommandError if the factor is not greater than 0
 */
export function setSpeedSteps(document: Document, { takes, factor }: SetSpeed): Steps<Document> {
  if (!(factor > 0)) {
    throw new CommandError(`The speed must be greater than 0, found ${factor}.`);
  }
  return changingTakes(document, takes, (character, take) => retiming(character, take, factor));
}

/** Arguments of making takes loop. */
export interface LoopTakes extends OfTakes {
  /** Length of the cross-fade; default 0.25, at most half of the take. */
  readonly blendSeconds?: number;
}

const BLEND_SECONDS = 0.25;

/** Makes takes loop, all of the body: frames by `samples/loop.ts`, keys by `channels/make-loop.ts`. */
export const loopTakes = command({
  id: 'takes.makeLoop',
  args: { ...TAKES, blendSeconds: optional(number) },
  label: (document, args) => `Make ${namesOfTakes(document, args)} loop`,
  run: (document, args) => runToEnd(loopTakesSteps(document, args)),
});

/**
 * Runs `loopTakes` in steps, yielding progress every few milliseconds.
 * @throws CommandError if the cross-fade is negative
 */
export function loopTakesSteps(
  document: Document,
  { takes, blendSeconds = BLEND_SECONDS }: LoopTakes,
): Steps<Document> {
  if (!(blendSeconds >= 0)) {
    throw new CommandError(`The blend must not be negative, found ${blendSeconds} s.`);
  }
  return changingTakes(document, takes, function* (character, take) {
    const skeleton = skeletonOf(character);
    if (!take.samples) return loopedKeys(character, take);
    const samples = framesOnly(character, take);
    const wanted = Math.max(1, Math.round(blendSeconds / samples.frameSeconds));
    const overlap = Math.min(wanted, Math.floor(samples.frameCount / 2));
    const made = yield* looping({ character: { ...character, skeleton }, take }, samples, overlap);
    if (made === samples) return take;
    const round = takeOfFrames(take, made);
    return withMarkers(round, markersWithin(take.markers, ...round.range));
  });
}

function loopedKeys({ skeleton, morphs }: Character, take: Take): Take {
  const dofs = characterDofs(skeleton, morphs);
  const channels = take.channels.map((channel, c) =>
    channel.kind === 'keys'
      ? withLoop(channel, keepsOffset(channel, unitOfChannel(dofs, c) === 'length')).channel
      : channel,
  );
  return channels.every((channel, c) => channel === take.channels[c]) ? take : { ...take, channels };
}

/** Arguments of locking feet. */
export interface LockFeet extends OfTakes {
  /** Default 0.1. */
  readonly easeSeconds?: number;
  /** How far a foot may slide without being locked, in metres; default 0.0005. */
  readonly toleranceMetres?: number;
}

const EASE_SECONDS = 0.1;
const TOLERANCE_METRES = 5e-4;

/** Holds feet still while they are on the ground; see `hold/foot-lock.ts`. */
export const lockFeet = command({
  id: 'takes.lockFeet',
  args: { ...TAKES, easeSeconds: optional(number), toleranceMetres: optional(number) },
  label: (document, args) => `Lock feet of ${namesOfTakes(document, args)}`,
  run: (document, args) => runToEnd(lockFeetSteps(document, args)).document,
});

/** The feet that were locked, in all takes together. */
export interface FeetReport {
  readonly document: Document;
  readonly contacts: readonly LockedContact[];
  readonly locked: number;
  readonly unreached: number;
}

/**
 * Runs `lockFeet` in steps, yielding progress every few milliseconds.
 * @throws CommandError if the ease is negative, or the tolerance not greater than 0
 */
export function* lockFeetSteps(document: Document, args: LockFeet): Steps<FeetReport> {
  const easeSeconds = args.easeSeconds ?? EASE_SECONDS;
  if (!(easeSeconds >= 0)) throw new CommandError(`The ease must not be negative, found ${easeSeconds} s.`);
  const toleranceMetres = args.toleranceMetres ?? TOLERANCE_METRES;
  if (!(toleranceMetres > 0)) throw new CommandError(`The tolerance must be greater than 0, found ${toleranceMetres}.`);
  const options = { easeSeconds, toleranceMetres, framesPerSecond: KEYED_RATE };
  const contacts: LockedContact[] = [];
  let [locked, unreached] = [0, 0];
  const next = yield* changingTakes(document, args.takes, function* (character, take) {
    const made = yield* lockingFeet(character, skeletonOf(character), take, options);
    contacts.push(...made.contacts);
    locked += made.locked;
    unreached += made.unreached;
    return made.take;
  });
  return { document: next, contacts, locked, unreached };
}

/** `walk`, or `3 takes`. */
export function namesOfTakes(document: Document, { takes }: OfTakes): string {
  return takes.length === 1 ? nameOfTake(document, takes[0]) : `${takes.length} takes`;
}

/** The skeleton of a character; refuses if it has none. */
export function skeletonOf({ name, skeleton }: Character): Skeleton {
  if (skeleton) return skeleton;
  throw new CommandError(`${name} has no skeleton, so its takes move nothing.`);
}

/** The document with each of these takes changed; the same object if none is. */
export function* changingTakes(
  document: Document,
  takes: readonly TakeRef[],
  change: (character: Character, take: Take) => Steps<Take>,
): Steps<Document> {
  const refs = takesToChange(document, takes);
  let next = document;
  for (const [done, { characterId, take }] of refs.entries()) {
    const character = requireCharacter(next, characterId);
    const before = character.takes[take];
    const after = yield* within(change(character, before), done / refs.length, (done + 1) / refs.length);
    if (after === before) continue;
    next = changeCharacter(next, characterId, (c) =>
      withTake(take === c.shownTake ? withoutUnkeyed(c) : c, take, after),
    );
  }
  return next;
}

/** Each take once; refuses those that are hidden by retargeting, and those with layers. */
export function takesToChange(document: Document, takes: readonly TakeRef[]): readonly TakeRef[] {
  const found = new Map<string, TakeRef>();
  for (const ref of checkedRefs(document, takes, 0)) {
    const character = requireCharacter(document, ref.characterId);
    if (ref.take < 0 || ref.take === character.shownTake) refuseMoved(character);
    if (ref.take >= 0) refuseLayers(character.takes[ref.take]);
    found.set(`${ref.characterId} ${ref.take}`, ref);
  }
  return [...found.values()];
}
