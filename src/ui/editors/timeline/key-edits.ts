/** Edits of the selected keys: each is one command and one undo step. */
import type { ArgsOf } from '../../../edit/command.ts';
import { setExtrapolation } from '../../../edit/commands/extrapolation.ts';
import { insertKeys, moveKeys, removeKeys, rippleKeys, snapKeys } from '../../../edit/commands/keys.ts';
import { pasteKeys } from '../../../edit/commands/paste.ts';
import { breakTangents, setTangents, unifyTangents } from '../../../edit/commands/tangents.ts';
import { onEachCharacter } from '../../../edit/in-turn.ts';
import { type CopiedKeys, copyKeys } from '../../../edit/keys/clipboard.ts';
import { countKeys } from '../../../edit/keys/selection.ts';
import type { TangentSide } from '../../../edit/keys/tangents.ts';
import type { ChannelKeys } from '../../../model/session.ts';
import { type Extrapolation, keysOf } from '../../../model/takes/take.ts';
import type { TangentChoice } from '../../../model/takes/tangent-kinds.ts';
import { addKeys } from '../../state/add-keys.ts';
import { pausePlayback } from '../../state/pause-playback.ts';
import type { Uses } from '../../state/workbench.ts';
import { plural, shown } from '../../widgets/numbers/number-text.ts';
import { channelName, namedChannel } from './channels.ts';
import {
  channelsInView,
  channelsToEdit,
  keyPlacing,
  onAllInHand,
  selectedKeysInView,
  selectKeys,
  takeTime,
} from './current-take.ts';
import { copiedByCharacter, copiedOfAll, rippleSeconds } from './edit-all.ts';
import { pastableChannels, pasteTargets } from './paste-targets.ts';
import { frameNumber, nudgeStep } from './snapping.ts';
import { activePart, channelsOfPart, namedIn, partWith, timelineTake } from './timeline-take.ts';

/** Inserts a key at the playhead on each curve in view; does nothing if there is none. */
export function insertAtPlayhead(
  wb: Uses<'store' | 'transport' | 'timeline' | 'settings'>,
  channels: readonly number[] = channelsInView(wb),
): void {
  const current = timelineTake(wb);
  if (!current || !channels.length) return;
  pausePlayback(wb);
  const { character } = current;
  const inserted = { characterId: character.id, channels, timeSeconds: takeTime(wb, character) };
  const placing = keyPlacing(wb, character);
  addKeys(wb, onAllInHand(wb, insertKeys), (outsideCycle) => ({ ...inserted, ...placing, outsideCycle }));
}

export function deleteKeys(wb: Uses<'store' | 'transport' | 'timeline'>): void {
  const current = timelineTake(wb);
  const keys = selectedKeysInView(wb);
  if (!current || !keys.length) return;
  const timeSeconds = takeTime(wb, current.character);
  wb.store.apply(onAllInHand(wb, removeKeys), { characterId: current.character.id, keys, timeSeconds });
}

export function copyToTray(wb: Uses<'store' | 'timeline' | 'messages'>): boolean {
  const current = timelineTake(wb);
  const keys = selectedKeysInView(wb);
  if (!current || !keys.length) return false;
  wb.timeline.copied = copiedOfAll(current, copyKeys(current.take, keys));
  const count = countKeys(current.take.channels, keys);
  wb.messages.note(`${plural(count, 'key')} copied from ${plural(keys.length, 'channel')}.`);
  return true;
}

/**
 * Pastes at the playhead.
 *
 * @param mode `insert` ripples later keys instead of merging
 * @param into other channels than the keys were copied from, in the numbers of all
 */
export function paste(
  wb: Uses<'store' | 'transport' | 'timeline' | 'settings' | 'messages'>,
  mode: 'merge' | 'insert',
  into?: readonly number[],
  keys = wb.timeline.copied,
): void {
  if (!keys) return;
  const by = copiedByCharacter(keys);
  if (pasteOnEach(wb, mode, by, keys, into)) return;
  const current = timelineTake(wb);
  // Those of one may be pasted on another.
  const [copied = keys] = by.values();
  if (by.size > 1) wb.messages.note('These keys are from several characters. Select one of these, or more.');
  if (!current || by.size > 1) return;
  const targets = pasteTargets(current.character, copied, channelsOfPart(activePart(current), pastableChannels(wb)));
  if (!targets) {
    const names = copied.channels.map(({ channel }) => channelName(namedChannel(current.character, channel)));
    const from = names.length === 1 ? names[0] : `${names[0]} and ${plural(names.length - 1, 'more channel')}`;
    wb.messages.note(
      `These keys are from ${from}, and no listed channel matches it. Select its joint, or list all channels.`,
    );
    return;
  }
  pausePlayback(wb);
  const { character } = current;
  const pasted: ArgsOf<typeof pasteKeys> = {
    characterId: character.id,
    copied,
    timeSeconds: takeTime(wb, character),
    mode,
    into: [...targets],
  };
  // Pushing later keys on lengthens a cycle anyway, and is meant to.
  if (mode === 'insert') wb.store.apply(pasteKeys, pasted);
  else addKeys(wb, pasteKeys, (outsideCycle) => ({ ...pasted, ...keyPlacing(wb, character), outsideCycle }));
}

/**
 * Pastes keys into the same channels of each of their characters that is selected, or into given ones of each.
 *
 * @param by the keys by character, if they are of several
 * @returns false if there are none for any
 */
function pasteOnEach(
  wb: Uses<'store' | 'transport' | 'timeline'>,
  mode: 'merge' | 'insert',
  by: ReadonlyMap<string, CopiedKeys>,
  keys: CopiedKeys,
  into?: readonly number[],
): boolean {
  const each = (timelineTake(wb)?.parts ?? []).flatMap((part) => {
    const { character } = part;
    const own = into && channelsOfPart(part, into);
    // Those of one may be pasted on another.
    const copied = by.get(character.id) ?? (into && by.size <= 1 ? ([...by.values()][0] ?? keys) : undefined);
    const at = { characterId: character.id, timeSeconds: takeTime(wb, character), mode, ...(own && { into: own }) };
    return copied && own?.length !== 0 ? [{ ...at, ...(mode === 'merge' && keyPlacing(wb, character)), copied }] : [];
  });
  if (each.length === 0) return false;
  pausePlayback(wb);
  const command = onEachCharacter(pasteKeys, `Paste keys on ${each.length} characters`);
  if (mode === 'insert') wb.store.apply(command, each);
  else addKeys(wb, command, (outsideCycle) => each.map((one) => ({ ...one, outsideCycle })));
  return true;
}

/** Duplicates the selected keys at the playhead, without the clipboard. */
export function duplicate(wb: Uses<'store' | 'transport' | 'timeline' | 'settings' | 'messages'>): void {
  const current = timelineTake(wb);
  const keys = selectedKeysInView(wb);
  if (!current || !keys.length) return;
  const copied = copiedOfAll(current, copyKeys(current.take, keys));
  paste(wb, 'merge', undefined, copied);
}

/** Moves the selected keys by frames and by steps of displayed values. */
export function nudge(
  wb: Uses<'store' | 'transport' | 'timeline' | 'settings'>,
  frames: number,
  valueSteps: number,
): void {
  const current = timelineTake(wb);
  const keys = selectedKeysInView(wb);
  if (!current || !keys.length) return;
  const { framesPerSecond } = wb.transport.get();
  const { tab, ripples } = wb.timeline.view.get();
  // In the dope sheet, arrow keys ripple like the mouse.
  if (ripples && tab === 'dope' && valueSteps === 0) {
    wb.store.apply(onAllInHand(wb, rippleKeys), {
      characterId: current.character.id,
      keys,
      seconds: rippleSeconds(current, keys, frames / framesPerSecond),
    });
    return;
  }
  const degrees = wb.settings.get().angles === 'degrees';
  wb.store.apply(onAllInHand(wb, moveKeys), {
    characterId: current.character.id,
    keys,
    seconds: frames / framesPerSecond,
    values: keys.map(({ channel }) => {
      const { skeleton } = partWith(current, channel).character;
      return valueSteps * nudgeStep(namedIn(current, channel).unit, degrees, skeleton);
    }),
    onCollision: wb.timeline.view.get().onCollision,
  });
}

export function snapToFrames(wb: Uses<'store' | 'transport' | 'timeline'>): void {
  const current = timelineTake(wb);
  const keys = selectedKeysInView(wb);
  if (!current || !keys.length) return;
  const { framesPerSecond } = wb.transport.get();
  const { id: characterId, timeOffsetSeconds: offsetSeconds } = current.character;
  wb.store.apply(onAllInHand(wb, snapKeys), { characterId, keys, framesPerSecond, offsetSeconds });
}

export function makeTangents(wb: Uses<'store' | 'timeline'>, kind: TangentChoice, side: TangentSide): void {
  const current = timelineTake(wb);
  const keys = selectedKeysInView(wb);
  if (current && keys.length)
    wb.store.apply(onAllInHand(wb, setTangents), { characterId: current.character.id, keys, side, kind });
}

/**
 * The formats can't store broken tangents: broken means different slopes. Equal ones would move together again, so
 * handles then move separately until tangents are unified.
 */
export function joinTangents(wb: Uses<'store' | 'timeline' | 'messages'>, how: 'unify' | 'break'): void {
  const current = timelineTake(wb);
  const keys = selectedKeysInView(wb);
  if (!current || !keys.length) return;
  const handles = how === 'break' ? 'alone' : 'auto';
  if (how === 'break' && wb.timeline.view.get().handles !== 'alone') {
    wb.messages.note('Tangents broken. Each handle now moves on its own; U unifies them.');
  }
  wb.timeline.change({ handles });
  const command = how === 'unify' ? unifyTangents : breakTangents;
  wb.store.apply(onAllInHand(wb, command), { characterId: current.character.id, keys });
}

/** Of the channels with selected keys, or of those in view. */
export function extrapolate(
  wb: Uses<'store' | 'timeline'>,
  side: TangentSide,
  extrapolation: Extrapolation,
  channels: readonly number[] = channelsToEdit(wb),
): void {
  const current = timelineTake(wb);
  if (!current || !channels.length) return;
  const args = { characterId: current.character.id, channels: [...channels], side, extrapolation };
  wb.store.apply(onAllInHand(wb, setExtrapolation), args);
}

/** Selects all keys of these channels that pass a test on the transport's seconds. */
export function selectWhere(
  wb: Uses<'store'>,
  channels: readonly number[],
  test: (timeSeconds: number) => boolean,
): void {
  const current = timelineTake(wb);
  if (!current) return;
  const { timeOffsetSeconds } = current.character;
  const keys: ChannelKeys[] = [];
  for (const channel of [...channels].sort((a, b) => a - b)) {
    const { times } = keysOf(current.take.channels[channel]);
    const indices: number[] = [];
    for (let i = 0; i < times.length; i++) if (test(times[i] - timeOffsetSeconds)) indices.push(i);
    if (indices.length) keys.push({ channel, indices });
  }
  selectKeys(wb, keys);
}

/** Inverts the selection among the keys in view. */
export function invertSelection(wb: Uses<'store' | 'timeline'>): void {
  const current = timelineTake(wb);
  if (!current) return;
  const held = new Map(selectedKeysInView(wb).map((k) => [k.channel, new Set(k.indices)]));
  const keys: ChannelKeys[] = [];
  for (const channel of [...channelsInView(wb)].sort((a, b) => a - b)) {
    const count = keysOf(current.take.channels[channel]).times.length;
    const indices: number[] = [];
    for (let i = 0; i < count; i++) if (!held.get(channel)?.has(i)) indices.push(i);
    if (indices.length) keys.push({ channel, indices });
  }
  selectKeys(wb, keys);
}

/** `3 keys of 2 channels, 0.4 s to 1.2 s`, for screen readers. */
export function selectedText(
  wb: Uses<'store' | 'transport' | 'timeline' | 'settings'>,
  keys: readonly ChannelKeys[] = selectedKeysInView(wb),
): string {
  const current = timelineTake(wb);
  if (!current || !keys.length) return 'No key is selected.';
  const count = countKeys(current.take.channels, keys);
  const inFrames = wb.settings.get().timeDisplay === 'frames';
  const { framesPerSecond } = wb.transport.get();
  const text = (takeSeconds: number) => {
    const at = takeSeconds - current.character.timeOffsetSeconds;
    return inFrames ? `frame ${frameNumber(at, framesPerSecond)}` : `${shown(at)} s`;
  };
  let first = Number.POSITIVE_INFINITY;
  let last = Number.NEGATIVE_INFINITY;
  for (const { channel, indices } of keys) {
    const { times } = keysOf(current.take.channels[channel]);
    first = Math.min(first, times[indices[0]]);
    last = Math.max(last, times[indices[indices.length - 1]]);
  }
  const of = keys.length === 1 ? channelName(namedIn(current, keys[0].channel)) : `${keys.length} channels`;
  const when = first === last ? `at ${text(first)}` : `from ${text(first)} to ${text(last)}`;
  return `${plural(count, 'key')} of ${of}, ${when}`;
}
