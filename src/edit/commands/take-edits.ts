/**
 * Commands that change the motion of takes, one or several in one step, keyed or sampled. Refused for takes that are
 * retargeted to the character: those are baked first.
 */
import { runToEnd, type Steps, within } from '../../evaluate/steps.ts';
import type { ChannelClip } from '../../model/clip.ts';
import type { Character, Document } from '../../model/document.ts';
import type { Skeleton } from '../../model/skeleton.ts';
import { finiteNumber } from '../arguments.ts';
import { changeCharacter, requireCharacter } from '../characters.ts';
import { refuseMoved } from '../refuse-moved.ts';
import { retiming } from '../samples/speed.ts';
import { mirroringTake } from '../samples/take-mirror.ts';
import { type Command, CommandError } from '../store.ts';
import { withTake } from '../takes.ts';
import { withoutUnkeyed } from '../unkeyed.ts';
import { checkedRefs, nameOfTake, type TakeRef } from './takes.ts';

export interface OfTakes {
  readonly takes: readonly TakeRef[];
}

/** Exchanges left and right; see `samples/take-mirror.ts`. */
export const mirrorTakes: Command<OfTakes> = {
  id: 'takes.mirror',
  label: (document, args) => `Mirror ${namesOfTakes(document, args)}`,
  run: (document, args) => runToEnd(mirrorTakesSteps(document, args)),
};

/** The same in steps, yielding progress every few milliseconds. */
export function mirrorTakesSteps(document: Document, { takes }: OfTakes): Steps<Document> {
  return changingTakes(document, takes, (character, clip) =>
    mirroringTake({ ...character, skeleton: skeletonOf(character) }, clip, character.space?.up),
  );
}

export interface SetSpeed extends OfTakes {
  /** 2 plays twice as fast; greater than 0. */
  readonly factor: number;
}

/** Changes how long takes last; see `samples/speed.ts`. */
export const setTakeSpeed: Command<SetSpeed> = {
  id: 'takes.setSpeed',
  label: (document, args) => `Change speed of ${namesOfTakes(document, args)}`,
  run: (document, args) => runToEnd(setSpeedSteps(document, args)),
};

/** The same in steps, yielding progress every few milliseconds. */
export function setSpeedSteps(document: Document, { takes, factor }: SetSpeed): Steps<Document> {
  if (!(finiteNumber(factor, 'The speed') > 0)) {
    throw new CommandError(`The speed must be greater than 0, found ${factor}.`);
  }
  return changingTakes(document, takes, (character, clip) => retiming(character, clip, factor));
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
  change: (character: Character, clip: ChannelClip) => Steps<ChannelClip>,
): Steps<Document> {
  const refs = takesToChange(document, takes);
  let next = document;
  for (const [done, { characterId, clip }] of refs.entries()) {
    const character = requireCharacter(next, characterId);
    const before = character.clips[clip];
    const after = yield* within(change(character, before), done / refs.length, (done + 1) / refs.length);
    if (after === before) continue;
    next = changeCharacter(next, characterId, (c) =>
      withTake(clip === c.shownClip ? withoutUnkeyed(c) : c, clip, after),
    );
  }
  return next;
}

/** Each take once; refuses those that are hidden by retargeting. */
export function takesToChange(document: Document, takes: readonly TakeRef[]): readonly TakeRef[] {
  const found = new Map<string, TakeRef>();
  for (const ref of checkedRefs(document, takes, 0)) {
    const character = requireCharacter(document, ref.characterId);
    if (ref.clip < 0 || ref.clip === character.shownClip) refuseMoved(character);
    found.set(`${ref.characterId} ${ref.clip}`, ref);
  }
  return [...found.values()];
}
