/**
 * The keys that the transport shows and steps through: those of the selected characters' takes, or of all shown takes;
 * if joints are selected, their own keys are the ones that count.
 *
 * Transport times are take times minus the character's offset. Nothing is merged or sorted beforehand: for a take with
 * millions of keys this costs a binary search per channel, and one pass over its times when drawn (`key-buckets.ts`).
 */
import { firstNotBelow } from '../../math/search.ts';
import { type Character, type Document, findCharacter, rangeOfTakes, shownTake } from '../../model/document.ts';
import type { Selection } from '../../model/session.ts';
import { firstDofs } from '../../model/skeleton/dofs.ts';
import { dofsOf } from '../../model/skeleton/joint-types.ts';
import { jointsIn, partOf, partsOf } from '../../model/skeleton/selected-joints.ts';
import { withCurvesOfGoals } from '../../model/takes/layer-code.ts';
import type { Channel } from '../../model/takes/take.ts';
import { dofCountOf } from '../pose.ts';
import { silentChannels } from '../retarget/moved-dofs.ts';

/** A channel's key times, and the offset to subtract for transport times. */
export interface ShownChannel {
  /** Seconds, ascending. */
  readonly times: Float64Array;
  readonly offsetSeconds: number;
  /** Whether the channel is one of the selected joints, or everything if none is selected. */
  readonly meant: boolean;
}

/** Only channels with keys. */
export function shownKeys(document: Document, selection: Selection): ShownChannel[] {
  const parts = partsOf(selection);
  const selected = parts.flatMap(({ characterId }) => findCharacter(document, characterId) ?? []);
  const playing = selected.filter(shownTake);
  const characters = playing.length ? playing : document.characters;
  const shown: ShownChannel[] = [];
  for (const character of characters) {
    const own = shownTake(character);
    if (!own) continue;
    const take = withCurvesOfGoals(own, dofCountOf(character));
    const isMeant = meantChannels(character, jointsIn(partOf(selection, character.id) ?? {}), take.channels);
    const silent = silentChannels(character);
    take.channels.forEach((channel, i) => {
      if (channel.kind === 'keys' && i >= silent)
        shown.push({ times: channel.times, offsetSeconds: character.timeOffsetSeconds, meant: isMeant(i) });
    });
  }
  return shown;
}

function meantChannels(character: Character, joints: readonly number[], channels: readonly Channel[]) {
  const all = () => true;
  const { skeleton } = character;
  if (!skeleton || joints.length === 0) return all;
  const firsts = firstDofs(skeleton);
  const meant = new Set<number>();
  for (const joint of joints) {
    const selected = skeleton.joints[joint];
    if (!selected) continue;
    // Root translation belongs to the root joint, as in the inspector.
    const end = firsts[joint] + dofsOf(selected.motion).length;
    for (let channel = joint === 0 ? 0 : firsts[joint]; channel < end; channel++) meant.add(channel);
  }
  // If the joints have no keys, all keys count.
  return channels.some((c, i) => meant.has(i) && c.kind === 'keys') ? (channel: number) => meant.has(channel) : all;
}

/** Times closer than this are the same, so that stepping does not find its own starting key. */
const SAME_SECONDS = 1e-7;

/** The transport time of the last key that counts before `timeSeconds`. */
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

/** The transport time of the first key that counts after `timeSeconds`. */
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

/** From the first start to the last end of all playing takes, in transport time. */
export const takesRange = rangeOfTakes;
