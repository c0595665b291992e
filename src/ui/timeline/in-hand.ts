/** What the timeline's actions are about: the take that is shown, its selected keys, and the channels in view. */
import { withKeys } from '../../edit/store.ts';
import type { ChannelClip } from '../../model/clip.ts';
import { type Character, shownClip } from '../../model/document.ts';
import type { ChannelKeys } from '../../model/session.ts';
import { currentCharacter } from '../actions/action.ts';
import { keyedChannels } from '../dope/rows.ts';
import type { Workbench } from '../workbench.ts';
import { drawnChannels, listedChannels } from './channels.ts';

export interface Take {
  readonly character: Character;
  readonly clip: ChannelClip;
}

export const NO_KEYS: readonly ChannelKeys[] = [];

/** The take of the character that is meant; undefined where it has none. */
export function takeInHand(wb: Workbench): Take | undefined {
  const character = currentCharacter(wb);
  const clip = character && shownClip(character);
  return character && clip && { character, clip };
}

/** The selected keys of that take; of another character's there are none. */
export function keysInHand(wb: Workbench): readonly ChannelKeys[] {
  const { selection } = wb.store;
  return (selection.keys && selection.characterId === currentCharacter(wb)?.id && selection.keys) || NO_KEYS;
}

/** Selects these keys and no others; joint and character stay. */
export function selectKeys(wb: Workbench, keys: readonly ChannelKeys[]): void {
  const character = currentCharacter(wb);
  if (!character) return;
  const { selection } = wb.store;
  if (keys.length === 0 && !selection.keys) return;
  // Keys belong to a character: selecting some of one that was only meant selects it.
  const own = selection.characterId === character.id ? selection : { characterId: character.id };
  wb.store.select(withKeys(own, keys));
}

/** Channels that the timeline draws now. */
export function channelsInView(wb: Workbench): number[] {
  const character = currentCharacter(wb);
  if (!character) return [];
  const view = wb.timeline.view.get();
  // The dope sheet draws every key there is, or those of the names that are looked for.
  if (view.tab === 'dope') return keyedChannels(character, view.filter);
  return drawnChannels(listedChannels(character, wb.store.selection, view), view);
}

/** Channels that a tool for whole channels takes: those with selected keys, else those in view. */
export function channelsInHand(wb: Workbench): number[] {
  const keys = keysInHand(wb);
  return keys.length ? keys.map((k) => k.channel) : channelsInView(wb);
}

/** Seconds of the clip at the transport's time. */
export function clipTime(wb: Workbench, character: Character): number {
  return wb.transport.get().timeSeconds + character.timeOffsetSeconds;
}
