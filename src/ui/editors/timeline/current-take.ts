/**
 * What the timeline's actions apply to: the shown take, its selected keys, and the channels in view.
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
import type { Take } from '../../../model/takes/take.ts';
import { currentCharacter } from '../../state/actions/action.ts';
import { HandEdit } from '../../state/actions/hand-edit.ts';
import { shownTabs } from '../../state/timeline.ts';
import type { Uses } from '../../state/workbench.ts';
import { drawnChannels, listedChannels, takeInTimeline } from './channels.ts';
import { keyedChannels } from './dope-rows.ts';

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

/**
 * The selected keys of that take, in view or not, for adding and removing. Empty if another character's are selected.
 */
export function selectedKeys(wb: Uses<'store'>): readonly ChannelKeys[] {
  const { selection } = wb.store;
  return (selection.keys && selection.characterId === currentCharacter(wb)?.id && selection.keys) || NO_KEY_SELECTION;
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

/** Wraps a command on the visible selected keys so that the invisible ones stay selected. */
export function aboutKeysInHand<A, R extends Document | Change>(
  wb: Uses<'store' | 'timeline'>,
  command: Command<A, R>,
): Command<A, R | Edit> {
  const inHand = new Set(selectedKeysInView(wb));
  const unseen = selectedKeys(wb).filter((k) => !inHand.has(k));
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

/** A drag of keys of this take: ends if anything else changes the take or shows another. */
export function editOfTake(
  { store, messages }: Uses<'store' | 'messages'>,
  { character, take }: CurrentTake,
): HandEdit {
  return new HandEdit(store, messages, () => {
    const now = findCharacter(store.document, character.id);
    return now !== undefined && takeInTimeline(now) === take;
  });
}

/** Selects exactly these keys, steps as one; joint and character stay. */
export function selectKeys(wb: Uses<'store'>, keys: readonly ChannelKeys[]): void {
  const character = currentCharacter(wb);
  if (!character) return;
  const { selection } = wb.store;
  if (keys.length === 0 && !selection.keys) return;
  // Keys belong to a character: selecting some selects the character too.
  const own = selection.characterId === character.id ? selection : { characterId: character.id };
  const channels = takeInTimeline(character)?.channels ?? [];
  wb.store.select(withSelectedKeys(own, withWholeSteps(channels, keys)));
}

/** Channels that the timeline draws now. Cached, since every row and menu entry asks. */
export function channelsInView(wb: Uses<'store' | 'timeline'>): readonly number[] {
  const character = currentCharacter(wb);
  if (!character) return [];
  const { selection } = wb.store;
  const view = wb.timeline.view.get();
  const { last } = wb.timeline;
  const { inView } = last;
  if (inView?.character === character && inView.selection === selection && inView.view === view) return inView.channels;
  // The dope sheet draws all keys, or those that match the filter.
  const channels = shownTabs(view).includes('dope')
    ? keyedChannels(character, view.filter)
    : drawnChannels(listedChannels(character, selection, view), view);
  last.inView = { character, selection, view, channels };
  return channels;
}

/** Channels for tools on whole curves: those with selected keys, else those in view. */
export function channelsToEdit(wb: Uses<'store' | 'timeline'>): readonly number[] {
  const keys = selectedKeysInView(wb);
  return keys.length ? keys.map((k) => k.channel) : channelsInView(wb);
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
