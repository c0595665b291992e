/**
 * The keys that the transport shows and jumps between: those of the selected character's take, or of all takes that are
 * shown; with a joint selected, its own are the ones that count.
 *
 * Times on the transport are a clip's times less the character's offset. Nothing is merged or sorted beforehand: a clip
 * of millions of keys costs a binary search a channel here, and one pass over its times when drawn (`key-buckets.ts`).
 */
import { firstNotBelow } from '../../math/search.ts';
import type { Channel } from '../../model/clip.ts';
import { type Character, type Document, findCharacter, rangeOfClips, shownClip } from '../../model/document.ts';
import { firstDofs } from '../../model/dofs.ts';
import { dofsOf } from '../../model/joint-types.ts';
import type { Selection } from '../../model/session.ts';
import { silentChannels } from '../retarget/moved-dofs.ts';

/** A channel's key times, and what is taken off them to have the transport's. */
export interface ShownChannel {
  /** Seconds, ascending. */
  readonly times: Float64Array;
  readonly offsetSeconds: number;
  /** Of the selected joint, or of everything where no joint is selected. */
  readonly meant: boolean;
}

/** Channels that have keys at all. */
export function shownKeys(document: Document, selection: Selection): ShownChannel[] {
  const selected = findCharacter(document, selection.characterId);
  const characters = selected && shownClip(selected) ? [selected] : document.characters;
  const shown: ShownChannel[] = [];
  for (const character of characters) {
    const clip = shownClip(character);
    if (!clip) continue;
    const isMeant = meantChannels(character, character === selected ? selection.joint : undefined, clip.channels);
    const silent = silentChannels(character);
    clip.channels.forEach((channel, i) => {
      if (channel.kind === 'keys' && i >= silent)
        shown.push({ times: channel.times, offsetSeconds: character.timeOffsetSeconds, meant: isMeant(i) });
    });
  }
  return shown;
}

function meantChannels(character: Character, joint: number | undefined, channels: readonly Channel[]) {
  const all = () => true;
  const selected = joint === undefined ? undefined : character.skeleton?.joints[joint];
  if (!selected || !character.skeleton || joint === undefined) return all;
  // The root translation is the root joint's, as it is in the inspector.
  const first = joint === 0 ? 0 : firstDofs(character.skeleton)[joint];
  const end = firstDofs(character.skeleton)[joint] + dofsOf(selected.motion).length;
  const isMeant = (channel: number) => channel >= first && channel < end;
  // A joint without a single key would leave nothing to jump to.
  return channels.some((c, i) => isMeant(i) && c.kind === 'keys') ? isMeant : all;
}

/** Two times nearer than this are one: a key is not found again from where it was jumped to. */
const SAME_SECONDS = 1e-7;

/** The transport's time of the last meant key before `timeSeconds`. */
export function previousKey(channels: readonly ShownChannel[], timeSeconds: number): number | undefined {
  let best: number | undefined;
  for (const { times, offsetSeconds, meant } of channels) {
    if (!meant) continue;
    const index = firstNotBelow(times, timeSeconds + offsetSeconds - SAME_SECONDS) - 1;
    if (index < 0) continue;
    const time = times[index] - offsetSeconds;
    if (best === undefined || time > best) best = time;
  }
  return best;
}

/** The transport's time of the first meant key after `timeSeconds`. */
export function nextKey(channels: readonly ShownChannel[], timeSeconds: number): number | undefined {
  let best: number | undefined;
  for (const { times, offsetSeconds, meant } of channels) {
    if (!meant) continue;
    const index = firstNotBelow(times, timeSeconds + offsetSeconds + SAME_SECONDS);
    if (index >= times.length) continue;
    const time = times[index] - offsetSeconds;
    if (best === undefined || time < best) best = time;
  }
  return best;
}

/** From the first start to the last end of all takes that play, on the transport. */
export const clipsRange = rangeOfClips;
