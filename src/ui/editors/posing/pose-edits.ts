/**
 * Posing and keying at the current time: shared by sliders, marks, menus and keys. Everything that changes DOFs uses
 * `autoKey`, so that none forgets it.
 */
import { keyPose } from '../../../edit/commands/keying.ts';
import { removeKeys } from '../../../edit/commands/keys.ts';
import { setDofs } from '../../../edit/commands/pose.ts';
import { onEachCharacter } from '../../../edit/in-turn.ts';
import type { KeyOptions } from '../../../edit/key-dofs.ts';
import { findKey } from '../../../edit/keys/same-time.ts';
import { keysAtTime } from '../../../edit/keys/selection.ts';
import { channelOf, isDriven } from '../../../evaluate/pose.ts';
import { silentChannels } from '../../../evaluate/retarget/moved-dofs.ts';
import { type Character, findCharacter, shownTake } from '../../../model/document.ts';
import type { ChannelKeys } from '../../../model/session.ts';
import { type DofValue, jointDofCount, rootDofCount } from '../../../model/skeleton/dofs.ts';
import { keysOf } from '../../../model/takes/take.ts';
import { selectedCharacters } from '../../state/actions/action.ts';
import { addKeys } from '../../state/add-keys.ts';
import { selectedJointsOf } from '../../state/joints/selected-joint.ts';
import { onDemand } from '../../state/on-demand.ts';
import { pausePlayback } from '../../state/pause-playback.ts';
import type { PosingCommand } from '../../state/posing.ts';
import type { Uses } from '../../state/workbench.ts';
import { channelsOfJoint, takeInTimeline } from '../timeline/channels.ts';
import { takeTime } from '../timeline/current-take.ts';

/** Options for new keys. */
function keyOptions(wb: Uses<'transport' | 'timeline' | 'settings'>): KeyOptions {
  const outsideCycle = wb.timeline.outsideCycle.get();
  return {
    tangents: wb.settings.get().newKeyTangents,
    playedRange: wb.transport.get().range,
    // What is keyed is what is shown.
    ...(wb.settings.get().display.stepped && { stepped: true }),
    ...(outsideCycle !== 'ask' && { outsideCycle }),
  };
}

/** For commands that set DOFs: how to key them, or undefined while auto-key is off. */
export function autoKey(wb: Uses<'transport' | 'timeline' | 'settings'>): KeyOptions | undefined {
  return wb.timeline.autoKey.get() ? keyOptions(wb) : undefined;
}

/** What sets DOFs by hand: with live mirror on, those of their partners, too. */
export function posingCommand({ posing }: Uses<'posing'>): PosingCommand {
  return posing.mirrored.get() ?? setDofs;
}

/** Sets DOFs with those that change with them (`Posing.beside`); the undo label names only the former. */
export function setOwn({ posing }: Uses<'posing'>, dofs: readonly DofValue[]): PosingCommand {
  const command = posingCommand({ posing });
  return { ...command, label: (document, args) => command.label(document, { ...args, dofs }) };
}

/** Stops what would take a pose set by hand back with the next frame; with auto-key, so that the shown frame is keyed. */
export function standStillToPose(
  wb: Uses<'store' | 'transport' | 'timeline' | 'settings'>,
  character: Character,
): void {
  const count = rootDofCount(character.skeleton) + jointDofCount(character.skeleton);
  let plays = wb.timeline.autoKey.get();
  for (let dof = 0; dof < count && !plays; dof++) plays = isDriven(character, dof);
  if (plays) pausePlayback(wb);
}

/** Some DOFs of a character; without `dofs` all of them. */
export interface OfCharacter {
  readonly character: Character;
  readonly dofs?: readonly number[];
}

/**
 * Keys DOFs as shown, as one step. Stops playback. For sampled ones, which take no single keys, it offers to convert
 * them.
 *
 * @returns whether it offers that
 */
export function keyNow(
  wb: Uses<'store' | 'transport' | 'timeline' | 'settings' | 'messages'>,
  each: readonly OfCharacter[],
): boolean {
  pausePlayback(wb);
  const { timeSeconds } = wb.transport.get();
  const options = keyOptions(wb);
  const found = each.flatMap(({ character: { id }, dofs }) => {
    const character = findCharacter(wb.store.document, id);
    return character ? { character, dofs, sampled: sampledDofs(character, dofs) } : [];
  });
  const keyed = found.filter(({ sampled }) => !sampled || sampled.keyable);
  const label = `Key pose of ${keyed.length} characters`;
  if (keyed.length > 0) {
    addKeys(wb, onEachCharacter(keyPose, label), (outsideCycle) =>
      keyed.map(({ character: { id: characterId }, dofs }) => ({
        ...{ characterId, dofs, timeSeconds, ...options, outsideCycle },
      })),
    );
  }
  const all = found.flatMap(({ character, sampled }) => (sampled ? { character, dofs: sampled.dofs } : []));
  const last = all.pop();
  if (!last) return false;
  const load = () => import('./key-samples.ts');
  void onDemand(wb.messages, 'Keying samples', load).then((module) => {
    module?.offerToConvert(wb, last, options, all);
  });
  return true;
}

/** Those of a character's DOFs that are sampled, and whether any others take keys; undefined if none are. */
function sampledDofs(
  character: Character,
  dofs: readonly number[] | undefined,
): { readonly dofs: readonly number[]; readonly keyable: boolean } | undefined {
  const take = shownTake(character);
  // Retargeted joints are refused, whatever their own take has.
  if (!take || silentChannels(character) > 0) return undefined;
  const given = dofs ?? [...take.channels.keys()];
  const sampled = given.filter((dof) => isSampled(character, dof));
  return sampled.length > 0 ? { dofs: sampled, keyable: sampled.length < given.length } : undefined;
}

/** Whether a DOF's channel has samples, and so takes no single keys. */
export function isSampled(character: Character, dof: number): boolean {
  return channelOf(character, dof)?.kind === 'samples';
}

/** A character's keys at the current time; of these DOFs, or of all. */
export function keysNow(wb: Uses<'transport'>, character: Character, dofs?: readonly number[]): readonly ChannelKeys[] {
  const take = character.skeleton && takeInTimeline(character);
  const silent = silentChannels(character);
  const keys = take ? keysAtTime(take, dofs, takeTime(wb, character)) : [];
  return silent ? keys.filter(({ channel }) => channel >= silent) : keys;
}

/** Deletes them, as one step. A channel without any key left keeps its value. */
export function deleteKeysNow(wb: Uses<'store' | 'transport'>, each: readonly OfCharacter[]): void {
  const args = each.flatMap(({ character, dofs }) => {
    const keys = keysNow(wb, character, dofs);
    return keys.length ? { characterId: character.id, keys, timeSeconds: takeTime(wb, character) } : [];
  });
  if (args.length) wb.store.apply(onEachCharacter(removeKeys, `Delete keys of ${args.length} characters`), args);
}

/** Deletes every key of these DOFs, which keep their values. */
export function deleteAllKeys(wb: Uses<'store' | 'transport'>, character: Character, dofs: readonly number[]): void {
  const each = [...dofs].sort((a, b) => a - b);
  const keys = each.flatMap((channel) => {
    const indices = [...keysOf(channelOf(character, channel)).times.keys()];
    return indices.length ? [{ channel, indices }] : [];
  });
  if (!keys.length) return;
  wb.store.apply(removeKeys, { characterId: character.id, keys, timeSeconds: takeTime(wb, character) });
}

/** Whether a DOF has a key at the current time. Cheap enough for every row in every frame. */
export function isKeyedNow(wb: Uses<'transport'>, character: Character, dof: number): boolean {
  const channel = channelOf(character, dof);
  return channel?.kind === 'keys' && findKey(channel, takeTime(wb, character)) >= 0;
}

/** The DOFs of several joints, ascending. */
export function dofsOfJoints(character: Character, joints: readonly number[]): readonly number[] {
  return [...joints].sort((a, b) => a - b).flatMap((joint) => jointDofs(character, joint));
}

/** The DOFs of a joint, for the root including the root translation, as in inspector and timeline. */
export function jointDofs(character: Character, joint: number): readonly number[] {
  const [first, end] = channelsOfJoint(character, joint);
  return Array.from({ length: end - first }, (_, i) => first + i);
}

/** The DOFs of the selected joints, of each selected character. */
export function jointsOfEach(wb: Uses<'store'>): readonly OfCharacter[] {
  return selectedCharacters(wb).flatMap((character) => {
    const joints = selectedJointsOf(wb, character.id);
    return joints.length ? { character, dofs: dofsOfJoints(character, joints) } : [];
  });
}

/** All DOFs of each selected character with a skeleton. */
export function posesOfEach(wb: Uses<'store'>): readonly OfCharacter[] {
  return selectedCharacters(wb).flatMap((character) => (character.skeleton ? { character } : []));
}

/** DOFs of the selected joints, of all characters, else of the whole of each. */
export function meantOfEach(wb: Uses<'store'>): readonly OfCharacter[] {
  const each = jointsOfEach(wb);
  return each.length ? each : posesOfEach(wb);
}
