/** Commands on the keys and channels of all characters that the timeline shows: one step. */
import type { Change } from '../../../edit/change.ts';
import type { Command } from '../../../edit/command.ts';
import { onEachCharacter } from '../../../edit/in-turn.ts';
import type { CopiedKeys } from '../../../edit/keys/clipboard.ts';
import { rippleRoom } from '../../../edit/keys/ripple.ts';
import { unionKeys } from '../../../edit/keys/selection.ts';
import type { Character, Document } from '../../../model/document.ts';
import type { ChannelKeys } from '../../../model/session.ts';
import { channelsOfPart, keysOfPart, type TimelinePart, type TimelineTake } from './timeline-take.ts';

/** Arguments of commands on keys or channels: of all parts, with times of the active one's take. */
export interface OfAll {
  readonly characterId: string;
  readonly keys?: readonly ChannelKeys[];
  readonly channels?: readonly number[];
  /** One per entry of `keys`. */
  readonly values?: readonly number[] | undefined;
  readonly pivotValues?: readonly number[] | undefined;
  readonly timeSeconds?: number;
  readonly pivotSeconds?: number | undefined;
  readonly offsetSeconds?: number | undefined;
  readonly bakedRange?: readonly [number, number] | undefined;
}

/**
 * A command on keys or channels of one character for those of all that are shown.
 *
 * @param unseen keys that stay selected beside those that the command selects
 */
export function onAllShown<A extends OfAll>(
  current: TimelineTake,
  command: Command<A, Document | Change>,
  unseen: readonly ChannelKeys[] = [],
): Command<A, Change> {
  const each = (args: A) => keyableParts(current, args).flatMap((part) => argsOf(current, part, args) ?? []);
  return {
    ...command,
    label(document, args) {
      const own = each(args);
      const label = command.label(document, own[0] ?? args);
      const verb = label.split(' ', 1)[0];
      const what = command.id.startsWith('keys.') ? 'keys' : 'curves';
      return own.length > 1 ? `${verb} ${what} of ${own.length} characters` : label;
    },
    run(document, args) {
      const change = onEachCharacter(command, '').run(document, each(args));
      const keysOf = new Map(change.keysOf);
      for (const part of current.parts) {
        const own = keysOfPart(part, unseen);
        if (own.length) keysOf.set(part.character.id, unionKeys(keysOf.get(part.character.id) ?? [], own));
      }
      return { ...change, keysOf };
    },
  };
}

/** Parts whose channels are all sampled are left alone among others, as such channels are among others of one take. */
function keyableParts({ parts }: TimelineTake, { channels }: OfAll): readonly TimelinePart[] {
  const isKeyable = (part: TimelinePart) =>
    !channels || channelsOfPart(part, channels).some((c) => part.take.channels[c]?.kind !== 'samples');
  const keyable = parts.filter(isKeyable);
  return keyable.length > 0 ? keyable : parts;
}

/** The arguments for one part; undefined if none of its keys or channels are among them. */
function argsOf<A extends OfAll>({ character: active }: TimelineTake, part: TimelinePart, args: A): A | undefined {
  const { keys = [], channels } = args;
  const { character, first, count } = part;
  const own = keysOfPart(part, keys);
  const ownChannels = channels && channelsOfPart(part, channels);
  if (own.length === 0 && !ownChannels?.length) return undefined;
  const later = laterThan(active, character);
  const isOwn = ({ channel }: ChannelKeys) => channel >= first && channel < first + count;
  const ofKeys = (numbers: readonly number[]) => numbers.filter((_, i) => isOwn(keys[i]));
  const times = Object.entries(args).flatMap(([name, value]) =>
    TIMES.has(name) && typeof value === 'number' ? [[name, value + later] as const] : [],
  );
  // All that differs from the arguments for all has the types that it had.
  return {
    ...args,
    ...Object.fromEntries(times),
    characterId: character.id,
    ...(args.keys && { keys: own }),
    ...(ownChannels && { channels: ownChannels }),
    ...(args.values && { values: ofKeys(args.values) }),
    ...(args.pivotValues && { pivotValues: ofKeys(args.pivotValues) }),
    ...(args.bakedRange && { bakedRange: args.bakedRange.map((time) => time + later) }),
  } as A;
}

const TIMES: ReadonlySet<string> = new Set(['timeSeconds', 'pivotSeconds', 'offsetSeconds']);

/** Seconds by which keys of all parts can ripple: those of all characters by the same. */
export function rippleSeconds({ take }: TimelineTake, keys: readonly ChannelKeys[], seconds: number): number {
  return keys.reduce((by, { channel, indices }) => {
    const own = take.channels[channel];
    return own?.kind === 'keys' ? Math.max(by, rippleRoom(own, indices[0])) : by;
  }, seconds);
}

/** Added to times of the active character's take to have those of another's. */
export function laterThan(active: Character, { timeOffsetSeconds }: Character): number {
  return timeOffsetSeconds - active.timeOffsetSeconds;
}

/** Copied keys of one part, with its own channels. */
export function copiedOfPart({ first, count }: TimelinePart, { seconds, channels }: CopiedKeys): CopiedKeys {
  const own = channels.filter(({ channel }) => channel >= first && channel < first + count);
  return { seconds, channels: own.map((one) => ({ ...one, channel: one.channel - first })) };
}

/** Copied keys of all parts, each channel with its character. */
export function copiedOfAll({ parts }: TimelineTake, copied: CopiedKeys): CopiedKeys {
  if (parts.length === 1) return copied;
  const channels = parts.flatMap((part) =>
    copiedOfPart(part, copied).channels.map((one) => ({ ...one, characterId: part.character.id })),
  );
  return { ...copied, channels };
}

/** Copied keys by character, if they are of several. */
export function copiedByCharacter({ seconds, channels }: CopiedKeys): ReadonlyMap<string, CopiedKeys> {
  const of = new Map<string, CopiedKeys>();
  for (const { characterId, ...one } of channels) {
    if (characterId === undefined) continue;
    of.set(characterId, { seconds, channels: [...(of.get(characterId)?.channels ?? []), one] });
  }
  return of;
}
