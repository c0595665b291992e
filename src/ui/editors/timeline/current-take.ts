/**
 * What the timeline's actions apply to: the shown take, or those of all selected characters as one, their selected keys,
 * and the channels in view.
 *
 * Only visible keys are edited. Keys of a curve that is hidden, filtered out, not isolated or not listed are left alone
 * by all edits of selected keys: drags, nudges, typed numbers, tangents, copying, deleting. (As in Maya: moving
 * invisible keys would break work unnoticed.) They stay selected meanwhile, and are edited again once they are in view;
 * selecting something else deselects them with the rest.
 */

import type { Change, Edit } from '../../../edit/change.ts';
import type { Command } from '../../../edit/command.ts';
import type { KeyPlacing } from '../../../edit/keys/cycle.ts';
import { NO_KEY_SELECTION, unionKeys } from '../../../edit/keys/selection.ts';
import { withWholeSteps } from '../../../edit/keys/steps.ts';
import { withSelectedKeys } from '../../../edit/store.ts';
import { type Character, type Document, findCharacter } from '../../../model/document.ts';
import type { ChannelKeys } from '../../../model/session.ts';
import { withEachPart } from '../../../model/skeleton/selected-joints.ts';
import type { Take } from '../../../model/takes/take.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import { HandEdit } from '../../state/actions/hand-edit.ts';
import { shownTabs } from '../../state/timeline.ts';
import type { Uses } from '../../state/workbench.ts';
import { drawnChannels, takeInTimeline } from './channels.ts';
import { keyedChannels } from './dope-rows.ts';
import { type OfAll, onAllShown } from './edit-all.ts';
import { listedOfAll, viewOfAll } from './listed-of-all.ts';
import { activePart, channelsOfPart, keysOfAll, keysOfPart, timelineTake } from './timeline-take.ts';

export interface CurrentTake {
  readonly character: Character;
  readonly take: Take;
}

/** The take of the current character; undefined if it has none. */
export function currentTake(wb: Uses<'store'>): CurrentTake | undefined {
  const character = currentCharacter(wb);
  const take = character && takeInTimeline(character);
  return character && take && { character, take };
}

/** The selected keys of the takes that are shown, in view or not, for adding and removing. */
export function selectedKeys(wb: Uses<'store'>): readonly ChannelKeys[] {
  const current = timelineTake(wb);
  return current ? keysOfAll(wb, current) : NO_KEY_SELECTION;
}

/** Those in view. The same array as long as they are the same keys. */
export function selectedKeysInView(wb: Uses<'store' | 'timeline'>): readonly ChannelKeys[] {
  const selected = selectedKeys(wb);
  if (!selected.length) return NO_KEY_SELECTION;
  const inView = new Set(channelsInView(wb));
  const keys = selected.filter((k) => inView.has(k.channel));
  if (keys.length === selected.length) return selected;
  const { last } = wb.timeline;
  if (last.keys?.length === keys.length && last.keys.every((k, i) => k === keys[i])) return last.keys;
  last.keys = keys;
  return keys;
}

/** Wraps a command on the current character so that its invisible selected keys stay selected. */
export function aboutKeysInHand<A, R extends Document | Change>(
  wb: Uses<'store' | 'timeline'>,
  command: Command<A, R>,
): Command<A, R | Edit> {
  const current = timelineTake(wb);
  const unseen = current ? keysOfPart(activePart(current), unseenKeys(wb)) : NO_KEY_SELECTION;
  if (!unseen.length) return command;
  return {
    ...command,
    run(document, args) {
      // They belong to other channels than the command changes, so their indices stay valid.
      const edit = command.run(document, args);
      return 'document' in edit ? { ...edit, keys: unionKeys(edit.keys ?? [], unseen) } : edit;
    },
  };
}

/** The same for a command on the visible keys or channels of all selected characters. */
export function onAllInHand<A extends OfAll, R extends Document | Change>(
  wb: Uses<'store' | 'timeline'>,
  command: Command<A, R>,
): Command<A, R | Change> {
  const current = timelineTake(wb);
  const isOwn = current?.parts.length === 1 && current.character === currentCharacter(wb);
  if (!current || isOwn) return aboutKeysInHand(wb, command);
  return onAllShown(current, command, unseenKeys(wb));
}

function unseenKeys(wb: Uses<'store' | 'timeline'>): readonly ChannelKeys[] {
  const inHand = new Set(selectedKeysInView(wb).map(({ channel }) => channel));
  return selectedKeys(wb).filter(({ channel }) => !inHand.has(channel));
}

/** A drag of keys of these takes: ends if anything else changes one or shows another. */
export function editOfTakes({ store, messages }: Uses<'store' | 'messages'>, parts: readonly CurrentTake[]): HandEdit {
  return new HandEdit(store, messages, () =>
    parts.every(({ character, take }) => {
      const now = findCharacter(store.document, character.id);
      return now !== undefined && takeInTimeline(now) === take;
    }),
  );
}

/** Selects exactly these keys, steps as one; joints and characters stay. */
export function selectKeys(wb: Uses<'store'>, keys: readonly ChannelKeys[]): void {
  const character = currentCharacter(wb);
  if (!character) return;
  const { selection } = wb.store;
  const current = timelineTake(wb);
  if (!current || (keys.length === 0 && selectedKeys(wb).length === 0)) return;
  // Keys belong to a character: selecting some selects the character too.
  const own = selection.characterId === character.id ? selection : { characterId: character.id };
  wb.store.select(
    withEachPart(own, (selected) => {
      const part = current.parts.find((one) => one.character.id === selected.characterId);
      return part ? withSelectedKeys(selected, withWholeSteps(part.take.channels, keysOfPart(part, keys))) : selected;
    }),
  );
}

/** Channels that the timeline draws now. Cached, since every row and menu entry asks. */
export function channelsInView(wb: Uses<'store' | 'timeline'>): readonly number[] {
  const current = timelineTake(wb);
  if (!current) return [];
  const { selection } = wb.store;
  const view = wb.timeline.view.get();
  const { last } = wb.timeline;
  const { inView } = last;
  if (inView?.current === current && inView.selection === selection && inView.view === view) return inView.channels;
  // The dope sheet draws all keys, or those that match the filter.
  const channels = shownTabs(view).includes('dope')
    ? current.parts.flatMap(({ character, first }) => keyedChannels(character, view.filter).map((c) => first + c))
    : drawnChannels(listedOfAll(wb), viewOfAll(wb));
  last.inView = { current, selection, view, channels };
  return channels;
}

/** Channels for edits of whole curves: those with selected keys, else those in view. */
export function channelsToEdit(wb: Uses<'store' | 'timeline'>): readonly number[] {
  const keys = selectedKeysInView(wb);
  return keys.length ? keys.map((k) => k.channel) : channelsInView(wb);
}

/** The same for tools that are for one character: those of the current one. */
export function ownChannelsToEdit(wb: Uses<'store' | 'timeline'>): readonly number[] {
  const current = timelineTake(wb);
  return current ? channelsOfPart(activePart(current), channelsToEdit(wb)) : [];
}

/** The visible selected keys of the current character. */
export function ownKeysInView(wb: Uses<'store' | 'timeline'>): readonly ChannelKeys[] {
  const current = timelineTake(wb);
  return current ? keysOfPart(activePart(current), selectedKeysInView(wb)) : NO_KEY_SELECTION;
}

/** Where keys of a character's take go that are added now. */
export function keyPlacing(wb: Uses<'transport' | 'timeline'>, { timeOffsetSeconds }: Character): KeyPlacing {
  const [from, to] = wb.transport.get().range;
  const outsideCycle = wb.timeline.outsideCycle.get();
  return {
    bakedRange: [from + timeOffsetSeconds, to + timeOffsetSeconds],
    ...(outsideCycle !== 'ask' && { outsideCycle }),
  };
}

/** Seconds of the take at the transport's time. */
export function takeTime(wb: Uses<'transport'>, character: Character): number {
  return wb.transport.get().timeSeconds + character.timeOffsetSeconds;
}
