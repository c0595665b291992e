/**
 * What the timeline shows of several selected characters: their takes as one, so that rows, curves and selected keys
 * name a channel by one number whoever it belongs to. The channels of the active character come first and keep their
 * numbers; those of others follow, with times as the transport has them beside the active one's.
 *
 * Selection, settings of channels and commands know each character's own channels (`edit-all.ts`). With one character
 * selected this is its take itself.
 */
import { NO_KEY_SELECTION } from '../../../edit/keys/selection.ts';
import type { Store } from '../../../edit/store.ts';
import type { Character } from '../../../model/document.ts';
import type { ChannelKeys, Selection } from '../../../model/session.ts';
import { partOf } from '../../../model/skeleton/selected-joints.ts';
import { type Channel, restChannel, type Take } from '../../../model/takes/take.ts';
import { selectedCharacters } from '../../state/actions/action.ts';
import { type ChannelView, NOTHING_PICKED, type Timeline, type TimelineView } from '../../state/timeline.ts';
import type { Uses } from '../../state/workbench.ts';
import { channelCount, type ListedChannel, namedChannel, takeInTimeline } from './channels.ts';

/** One character of those that the timeline shows. */
export interface TimelinePart {
  readonly character: Character;
  /** The take that it shows. */
  readonly take: Take;
  /** Number of its first channel among those of all; 0 for the active character. */
  readonly first: number;
  /** Number of its channels. */
  readonly count: number;
}

export interface TimelineTake {
  /** The active one, if it shows a take. */
  readonly character: Character;
  /** Its take, with the channels of all parts, in its own time. */
  readonly take: Take;
  /** In the order of the document. */
  readonly parts: readonly TimelinePart[];
}

const last = new WeakMap<Store, { readonly of: readonly Character[]; readonly made: TimelineTake | undefined }>();

/** Undefined if no selected character shows a take. The same object for the same characters. */
export function timelineTake(wb: Uses<'store'>): TimelineTake | undefined {
  const of = selectedCharacters(wb).toReversed();
  const known = last.get(wb.store);
  if (known && known.of.length === of.length && of.every((one, i) => one === known.of[i])) return known.made;
  const made = takesAsOne(of, wb.store.document.characters);
  last.set(wb.store, { of, made });
  return made;
}

/** @param of the active one first */
function takesAsOne(of: readonly Character[], inOrder: readonly Character[]): TimelineTake | undefined {
  const parts: TimelinePart[] = [];
  let first = 0;
  for (const character of of) {
    const take = takeInTimeline(character);
    if (!take) continue;
    const count = channelCount(character);
    parts.push({ character, take, first, count });
    first += count;
  }
  const [active] = parts;
  if (!active) return undefined;
  const take = parts.length === 1 ? active.take : together(parts);
  const place = ({ character }: TimelinePart) => inOrder.indexOf(character);
  return { character: active.character, take, parts: parts.toSorted((a, b) => place(a) - place(b)) };
}

interface Together {
  readonly of: readonly Channel[];
  readonly take: Take;
}
const takes = new WeakMap<Take, Together>();

/** The same take for the same channels, so that what is made of it is made once. */
function together([active, ...others]: readonly TimelinePart[]): Take {
  const of = [active, ...others].flatMap(({ character, take, count }) => {
    const later = active.character.timeOffsetSeconds - character.timeOffsetSeconds;
    return Array.from({ length: count }, (_, c) => {
      const channel = take.channels[c] ?? REST;
      return character === active.character ? channel : laterBy(channel, later);
    });
  });
  const known = takes.get(active.take);
  if (known?.of.length === of.length && of.every((channel, i) => channel === known.of[i])) return known.take;
  const take = { ...active.take, channels: of };
  takes.set(active.take, { of, take });
  return take;
}

const REST = restChannel();
const moved = new WeakMap<Channel, { readonly seconds: number; readonly channel: Channel }>();

/** A channel of another character at the active one's times. Samples of several takes can't be in one: they rest. */
function laterBy(channel: Channel, seconds: number): Channel {
  if (channel.kind === 'samples') return REST;
  if (channel.kind === 'rest' || seconds === 0) return channel;
  const known = moved.get(channel);
  if (known?.seconds === seconds) return known.channel;
  const made = { ...channel, times: channel.times.map((time) => time + seconds) };
  moved.set(channel, { seconds, channel: made });
  return made;
}

/** Whether a channel is one of a part. */
export function isOfPart({ first, count }: Pick<TimelinePart, 'first' | 'count'>, channel: number): boolean {
  return channel >= first && channel < first + count;
}

/** The part that a channel belongs to. */
export function partWith({ parts }: TimelineTake, channel: number): TimelinePart {
  return parts.find((part) => isOfPart(part, channel)) ?? activePart({ parts });
}

/** A channel as it would be listed, with its character if there are several. */
export function namedIn(current: TimelineTake, channel: number): ListedChannel {
  const { character, first } = partWith(current, channel);
  const own = namedChannel(character, channel - first);
  return current.parts.length === 1 ? own : { ...own, channel, character: character.name };
}

/** The part whose channels come first. */
export function activePart({ parts }: Pick<TimelineTake, 'parts'>): TimelinePart {
  return parts.find(({ first }) => first === 0) ?? parts[0];
}

/** The keys of a part among those of all, in its own numbers. */
export function keysOfPart(part: TimelinePart, keys: readonly ChannelKeys[]): readonly ChannelKeys[] {
  const { first } = part;
  const own = keys.filter(({ channel }) => isOfPart(part, channel));
  if (first === 0) return own.length === keys.length ? keys : own;
  return own.map(({ channel, indices }) => ({ channel: channel - first, indices }));
}

/** The channels of a part among those of all, in its own numbers. */
export function channelsOfPart(
  part: Pick<TimelinePart, 'first' | 'count'>,
  channels: readonly number[],
): readonly number[] {
  return channels.filter((one) => isOfPart(part, one)).map((one) => one - part.first);
}

/** Keys of each part's own selection, in the numbers of all. The same array for the same selection. */
export function keysOfAll({ store }: Uses<'store'>, { parts }: TimelineTake): readonly ChannelKeys[] {
  const { selection } = store;
  const of = ({ character: { id } }: TimelinePart) => partOf(selection, id)?.keys ?? NO_KEY_SELECTION;
  if (parts.length === 1) return of(parts[0]);
  const known = selectedKeys.get(selection);
  if (known?.parts === parts) return known.keys;
  const keys = parts
    .toSorted((a, b) => a.first - b.first)
    .flatMap((part) => of(part).map(({ channel, indices }) => ({ channel: part.first + channel, indices })));
  selectedKeys.set(selection, { parts, keys });
  return keys;
}

const selectedKeys = new WeakMap<Selection, Pick<TimelineTake, 'parts'> & { readonly keys: readonly ChannelKeys[] }>();

/** Pinned, hidden, isolated and expanded channels of one character. */
export function channelViewOf(view: TimelineView, characterId: string): ChannelView {
  const isShown = view.characterId === undefined || view.characterId === characterId;
  return isShown ? view : (view.others[characterId] ?? NOTHING_PICKED);
}

/** Changes them. */
export function changeChannelView(timeline: Timeline, characterId: string, change: Partial<ChannelView>): void {
  const view = timeline.view.get();
  const own = channelViewOf(view, characterId);
  if (own === view) timeline.change(change);
  else timeline.change({ others: { ...view.others, [characterId]: { ...own, ...change } } });
}

/** Isolates channels of one character; undefined: none. */
export function isolateOf(timeline: Timeline, characterId: string, isolated: readonly number[] | undefined): void {
  const view = timeline.view.get();
  const { isolated: _before, ...own } = channelViewOf(view, characterId);
  if (channelViewOf(view, characterId) === view) timeline.isolate(isolated);
  else timeline.change({ others: { ...view.others, [characterId]: isolated ? { ...own, isolated } : own } });
}
