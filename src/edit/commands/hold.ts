/**
 * Holds pins over a time range and bakes that into the take: *foot lock*. The pinned points keep their positions at one
 * time in every frame of the range, by inverse kinematics on each frame's own pose; see `hold/`.
 */

import { ikOf } from '../../evaluate/ik/set-up.ts';
import { runToEnd, type Steps } from '../../evaluate/steps.ts';
import { type Character, type Document, shownTake } from '../../model/document.ts';
import type { Pin } from '../../model/ik.ts';
import type { ChannelKeys } from '../../model/session.ts';
import { keysOf, type Take } from '../../model/takes/take.ts';
import type { Edit } from '../change.ts';
import { changeCharacter, requireCharacter } from '../characters.ts';
import { command } from '../command.ts';
import { CommandError } from '../command-error.ts';
import { type HeldTake, holding, placesAt } from '../hold/hold.ts';
import type { HoldWindow } from '../hold/window.ts';
import { refuseLayers } from '../layers/refuse-layers.ts';
import { refuseMoved } from '../refuse-moved.ts';
import { number, optional } from '../schema/shape.ts';
import { CHARACTER, indices, range } from '../schema/shared-shapes.ts';
import { requireTake, withChannels, withTake } from '../takes.ts';
import { withUnkeyed } from '../unkeyed.ts';
import { pinnedNames, requirePin } from './ik.ts';

/** Arguments of holding pins over a range. */
export interface HoldPins {
  readonly characterId: string;
  /** Ids; the character's other pins are ignored. */
  readonly pins: readonly number[];
  /** The range to hold, both ends included; seconds of the transport. Clipped to the playback range of the take. */
  readonly range: readonly [number, number];
  /** The time whose displayed pose gives the positions; seconds of the transport, inside the range or not. */
  readonly atSeconds: number;
  /** Frames to solve; a sampled take has frames of its own. */
  readonly framesPerSecond: number;
  /** Duration of the ease in before the range and the ease out after it; default 0.1. */
  readonly easeSeconds?: number;
  /** How far joints and pins may deviate to save keys, in lengths; default a thousandth of the reach. */
  readonly tolerance?: number;
}

const EASE_SECONDS = 0.1;

/** Adds keys, or changes frames of a sampled take, so that the pins stay in place. The new keys are selected. */
export const holdPins = command({
  id: 'hold.pins',
  args: {
    ...CHARACTER,
    pins: indices,
    range,
    atSeconds: number,
    framesPerSecond: number,
    easeSeconds: optional(number),
    tolerance: optional(number),
  },
  label: (document, { characterId, pins }) => `Hold ${pinnedNames(requireCharacter(document, characterId), pins)}`,
  run: (document, args) => runToEnd(holdSteps(document, args)).edit,
});

/** The result of a hold, with the document after it. */
export interface Held {
  readonly edit: Edit;
  readonly report: HeldTake;
}

/**
 * Runs `holdPins` in steps, yielding progress every few milliseconds.
 * @throws CommandError if there is no skeleton, no take or no such pin, if the take has layers, if another take is
 * retargeted to the character, or for numbers out of range
 */
export function* holdSteps(document: Document, args: HoldPins): Steps<Held> {
  const { characterId } = args;
  const character = requireCharacter(document, characterId);
  const { skeleton } = character;
  if (!skeleton) throw new CommandError(`${character.name} has no skeleton, so there is nothing to hold.`);
  refuseMoved(character);
  const shown = shownTake(character);
  if (!shown) throw new CommandError(`${character.name} has no current take, so there is no motion to hold pins in.`);
  refuseLayers(shown);
  const pins = checkedPins(character, args.pins);
  const [from, to] = args.range;
  const { atSeconds: at, easeSeconds = EASE_SECONDS } = args;
  const framesPerSecond = above0(args.framesPerSecond, 'Frames per second');
  if (!(easeSeconds >= 0)) throw new CommandError(`"easeSeconds" must be 0 or more, found ${easeSeconds}.`);
  const tolerance = args.tolerance === undefined ? undefined : above0(args.tolerance, 'A tolerance');

  const range = [from + character.timeOffsetSeconds, to + character.timeOffsetSeconds] as const;
  const { unkeyed: _byHand, ...taken } = withChannels(character, range);
  const places = placesAt(character, skeleton, pins, at);
  const options = { range, framesPerSecond, easeSeconds, tolerance };
  const report = yield* holding(taken, skeleton, requireTake(taken), pins, places, options);
  const { take, channels, window } = report;
  if (channels.length === 0) return { edit: { document, keys: [] }, report };
  const held = changeCharacter(document, characterId, () =>
    withoutUnkeyedOnHold(withTake(taken, taken.shownTake, take), character, channels, window),
  );
  return { edit: { document: held, keys: keysIn(take, channels, window) }, report };
}

function checkedPins(character: Character, given: readonly number[]): readonly Pin[] {
  const ik = ikOf(character);
  const ids = new Set(given.map((id) => requirePin(ik, id)));
  if (ids.size === 0) throw new CommandError('Give at least one pin to hold.');
  return ik.pins.filter((pin) => ids.has(pin));
}

function above0(value: number, what: string): number {
  if (value > 0) return value;
  throw new CommandError(`${what} must be greater than 0, found ${value}.`);
}

/** Keeps unkeyed changes except where the hold has changed the pose at that time, since the hold started from them. */
function withoutUnkeyedOnHold(
  held: Character,
  { unkeyed }: Character,
  channels: readonly number[],
  { times }: HoldWindow,
): Character {
  if (!unkeyed) return held;
  const seconds = unkeyed.timeSeconds + held.timeOffsetSeconds;
  const isInside = seconds >= times[0] && seconds <= times[times.length - 1];
  const gone = new Set(isInside ? channels : []);
  const left = unkeyed.dofs.map((dof, i) => [dof, unkeyed.values[i]] as const).filter(([dof]) => !gone.has(dof));
  return withUnkeyed(held, unkeyed.timeSeconds, new Map(left));
}

/** The keys of these channels in the window. */
function keysIn(
  { channels }: Take,
  changed: readonly number[],
  { times: [from], times }: HoldWindow,
): readonly ChannelKeys[] {
  const to = times[times.length - 1];
  return changed.flatMap((channel) => {
    const own = keysOf(channels[channel]).times;
    const indices = [...own.keys()].filter((k) => own[k] >= from && own[k] <= to);
    return indices.length > 0 ? [{ channel, indices }] : [];
  });
}
