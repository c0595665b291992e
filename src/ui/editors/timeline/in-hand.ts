/**
 * What the timeline's actions are about: the take that is shown, its selected keys, and the channels in view.
 *
 * What can't be seen is not in hand. Keys of a curve that is hidden, filtered out, not isolated or not listed are not
 * touched by anything that is done to selected keys: drags, nudges, typed numbers, tangents, copying, deleting. (As in
 * Maya. That a key moves which nobody sees is how work gets broken unnoticed.) They stay selected through all of that,
 * and are in hand again once they are in view; selecting something else lets them go with the rest.
 */
import { NO_KEY_SELECTION, unionKeys } from '../../../edit/keys/selection.ts';
import { type Command, type Edit, withSelectedKeys } from '../../../edit/store.ts';
import type { ChannelClip } from '../../../model/clip.ts';
import { type Character, findCharacter, shownClip } from '../../../model/document.ts';
import type { ChannelKeys } from '../../../model/session.ts';
import { currentCharacter } from '../../state/action.ts';
import { HandEdit } from '../../state/hand-edit.ts';
import type { Uses } from '../../state/workbench.ts';
import { drawnChannels, listedChannels } from './channels.ts';
import { keyedChannels } from './dope-rows.ts';

export interface Take {
  readonly character: Character;
  readonly clip: ChannelClip;
}

/** The take of the character that is meant; undefined where it has none. */
export function takeInHand(wb: Uses<'store'>): Take | undefined {
  const character = currentCharacter(wb);
  const clip = character && shownClip(character);
  return character && clip && { character, clip };
}

/** The selected keys of that take, in view or not: what is added to, or taken from. Of another character's, none. */
export function selectedKeys(wb: Uses<'store'>): readonly ChannelKeys[] {
  const { selection } = wb.store;
  return (selection.keys && selection.characterId === currentCharacter(wb)?.id && selection.keys) || NO_KEY_SELECTION;
}

/** Those of them that are in view. The same array for as long as they are the same keys. */
export function keysInHand(wb: Uses<'store' | 'timeline'>): readonly ChannelKeys[] {
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

/** A command about the keys in hand, after which those that are selected out of view are so still. */
export function aboutKeysInHand<A>(wb: Uses<'store' | 'timeline'>, command: Command<A, Edit>): Command<A, Edit> {
  const inHand = new Set(keysInHand(wb));
  const unseen = selectedKeys(wb).filter((k) => !inHand.has(k));
  if (!unseen.length) return command;
  return {
    ...command,
    run(document, args) {
      // Of other channels than the command is about: their indices are the same afterwards.
      const edit = command.run(document, args);
      return { document: edit.document, keys: unionKeys(edit.keys, unseen) };
    },
  };
}

/** A drag of keys of this take: it ends where anything else changes the take or shows another. */
export function editOfTake({ store, messages }: Uses<'store' | 'messages'>, { character, clip }: Take): HandEdit {
  return new HandEdit(store, messages, () => {
    const now = findCharacter(store.document, character.id);
    return now !== undefined && shownClip(now) === clip;
  });
}

/** Selects these keys and no others; joint and character stay. */
export function selectKeys(wb: Uses<'store'>, keys: readonly ChannelKeys[]): void {
  const character = currentCharacter(wb);
  if (!character) return;
  const { selection } = wb.store;
  if (keys.length === 0 && !selection.keys) return;
  // Keys belong to a character: selecting some of one that was only meant selects it.
  const own = selection.characterId === character.id ? selection : { characterId: character.id };
  wb.store.select(withSelectedKeys(own, keys));
}

/** Channels that the timeline draws now. Asked for by every row and entry: found once for what they follow from. */
export function channelsInView(wb: Uses<'store' | 'timeline'>): readonly number[] {
  const character = currentCharacter(wb);
  if (!character) return [];
  const { selection } = wb.store;
  const view = wb.timeline.view.get();
  const { last } = wb.timeline;
  const { inView } = last;
  if (inView?.character === character && inView.selection === selection && inView.view === view) return inView.channels;
  // The dope sheet draws every key there is, or those of the names that are looked for.
  const channels =
    view.tab === 'dope'
      ? keyedChannels(character, view.filter)
      : drawnChannels(listedChannels(character, selection, view), view);
  last.inView = { character, selection, view, channels };
  return channels;
}

/** Channels that a tool for whole channels takes: those with selected keys, else those in view. */
export function channelsInHand(wb: Uses<'store' | 'timeline'>): readonly number[] {
  const keys = keysInHand(wb);
  return keys.length ? keys.map((k) => k.channel) : channelsInView(wb);
}

/** Seconds of the clip at the transport's time. */
export function clipTime(wb: Uses<'transport'>, character: Character): number {
  return wb.transport.get().timeSeconds + character.timeOffsetSeconds;
}
