/** The channels that the timeline lists of all selected characters, and which of them are hidden, pinned or isolated. */
import { currentCharacter } from '../../state/actions/action.ts';
import type { TimelineView } from '../../state/timeline.ts';
import type { Uses } from '../../state/workbench.ts';
import { channelCount, type ListedChannel, listedChannels } from './channels.ts';
import {
  changeChannelView,
  channelsOfPart,
  channelViewOf,
  isOfPart,
  isolateOf,
  type TimelinePart,
  timelineTake,
} from './timeline-take.ts';

type Parts = Uses<'store' | 'timeline'>;
type Picked = 'hidden' | 'pinned';
type ShownPart = Pick<TimelinePart, 'character' | 'first' | 'count'>;

/** Those of the timeline, else the current character, which shows no take. */
function shownParts(wb: Uses<'store'>): readonly ShownPart[] {
  const current = timelineTake(wb);
  const character = currentCharacter(wb);
  if (current) return current.parts;
  return character ? [{ character, first: 0, count: channelCount(character) }] : [];
}

/** Those of each character, in the order of the document; named with it if there are several. */
export function listedOfAll(wb: Parts, list?: TimelineView['list']): readonly ListedChannel[] {
  const view = wb.timeline.view.get();
  const parts = shownParts(wb);
  return parts.flatMap(({ character, first }) => {
    const { pinned } = channelViewOf(view, character.id);
    const own = listedChannels(character, wb.store.selection, { ...view, pinned, ...(list && { list }) });
    if (parts.length === 1) return own;
    return own.map((one) => ({ ...one, channel: first + one.channel, character: character.name }));
  });
}

/** The number of channels of all. */
export function countOfAll(wb: Uses<'store'>): number {
  return shownParts(wb).reduce((sum, { count }) => sum + count, 0);
}

/** Which of them are hidden and pinned; isolated ones of any character leave out all others. */
export function viewOfAll(wb: Parts): Pick<TimelineView, Picked | 'isolated'> {
  const view = wb.timeline.view.get();
  const parts = shownParts(wb);
  if (parts.length <= 1) return view;
  const of = (name: Picked | 'isolated') =>
    parts.flatMap(({ character, first }) => (channelViewOf(view, character.id)[name] ?? []).map((c) => first + c));
  const isolated = of('isolated');
  return { hidden: of('hidden'), pinned: of('pinned'), ...(isolated.length > 0 && { isolated }) };
}

/** Isolates channels of all; undefined: of none. */
export function isolateOfAll(wb: Parts, channels: readonly number[] | undefined): void {
  for (const part of shownParts(wb)) {
    const own = channels && channelsOfPart(part, channels);
    isolateOf(wb.timeline, part.character.id, own?.length ? own : undefined);
  }
}

/** Hides or shows a channel, or pins or unpins it. */
export function toggleIn(wb: Parts, what: Picked, channel: number): void {
  const part = shownParts(wb).find((one) => isOfPart(one, channel));
  if (!viewOfAll(wb)[what].includes(channel)) addTo(wb, what, [channel]);
  else if (part) remove(wb, what, part, channel);
}

function remove(wb: Parts, what: Picked, part: ShownPart, channel: number): void {
  const now = channelViewOf(wb.timeline.view.get(), part.character.id)[what];
  changeChannelView(wb.timeline, part.character.id, { [what]: now.filter((c) => c !== channel - part.first) });
}

/** Hides or pins channels of all, too. */
export function addTo(wb: Parts, what: Picked, channels: readonly number[]): void {
  for (const part of shownParts(wb)) {
    const now = channelViewOf(wb.timeline.view.get(), part.character.id)[what];
    const next = [...new Set([...now, ...channelsOfPart(part, channels)])].sort((a, b) => a - b);
    if (next.length > now.length) changeChannelView(wb.timeline, part.character.id, { [what]: next });
  }
}

/** Hides or pins only these channels of all. */
export function setOfAll(wb: Parts, what: Picked, channels: readonly number[]): void {
  for (const part of shownParts(wb))
    changeChannelView(wb.timeline, part.character.id, { [what]: channelsOfPart(part, channels) });
}
