/**
 * Keying DOFs, for K, auto-key and scripts. Creates the take or its missing channels as needed; unkeyed changes that
 * are keyed are no longer unkeyed.
 */
import { dofCountOf } from '../evaluate/pose.ts';
import { silentChannels } from '../evaluate/retarget/moved-dofs.ts';
import { steppedCharacter } from '../evaluate/stepped-take.ts';
import { type Character, shownTake } from '../model/document.ts';
import type { ChannelKeys } from '../model/session.ts';
import { withChannelsOf } from '../model/takes/channels-with-goals.ts';
import { withCurvesOfGoals } from '../model/takes/layer-code.ts';
import { type NewKeyTangents, TANGENT_KINDS } from '../model/takes/tangent-kinds.ts';
import { type KeyPlacing, type OutsideCycle, placeOf } from './keys/cycle.ts';
import { putKeyAt } from './keys/put-key.ts';
import { withNearerSigns } from './keys/quaternion-signs.ts';
import { layerValues } from './layers/layer-values.ts';
import { refuseMoved } from './refuse-moved.ts';
import { withChannels, withTake } from './takes.ts';
import { unkeyedAt, withUnkeyed } from './unkeyed.ts';

/** Options for new keys, as commands take them. */
export interface KeyOptions {
  /** On both sides of new keys, default smooth; existing keys keep their own. */
  readonly tangents?: NewKeyTangents;
  /**
   * Playback range of a take that has to be created, in seconds of the transport; if absent or empty, from 0 to the
   * key, at least 1 s. Repetitions are baked over at least this range.
   */
  readonly playedRange?: readonly [number, number];
  /** For keys outside the cycle of a repeating channel (`keys/cycle.ts`); default `lengthen`. */
  readonly outsideCycle?: OutsideCycle;
  /** Values are those that the stepped preview displays. */
  readonly stepped?: boolean;
}

/** A character after keying, and its new keys. */
export interface Keyed {
  readonly character: Character;
  /** The keys of these DOFs at this time. */
  readonly keys: readonly ChannelKeys[];
}

/**
 * Keys DOFs at a time; the same character if all of them had these keys. Sampled channels are skipped: one key would
 * replace all their frames. Refuses joints that a retargeted take drives.
 *
 * @param values by DOF, as they should be displayed; the active layer gets those with which they are. Goals of limbs
 *   are keyed by the indices of their channels (`withGoalChannels`)
 * @param timeSeconds of the transport
 */
export function keyDofs(
  character: Character,
  values: ReadonlyMap<number, number>,
  timeSeconds: number,
  { tangents = 'smooth', playedRange, outsideCycle = 'lengthen', stepped }: KeyOptions = {},
): Keyed {
  const silent = silentChannels(character);
  if ([...values.keys()].some((dof) => dof < silent)) refuseMoved(character);
  const time = timeSeconds + character.timeOffsetSeconds;
  const taking = withChannels(character, newRange(character, time, playedRange));
  const take = shownTake(taking);
  if (!take) return { character, keys: [] };

  const count = dofCountOf(taking);
  const channels = [...withCurvesOfGoals(take, count).channels];
  const keys: ChannelKeys[] = [];
  let changed = false;
  const placing: KeyPlacing = {
    outsideCycle,
    bakedRange: playedRange && [
      playedRange[0] + character.timeOffsetSeconds,
      playedRange[1] + character.timeOffsetSeconds,
    ],
  };
  const keyable = [...values.keys()].filter((dof) => channels[dof]?.kind !== 'samples');
  const wanted = new Map([...values].filter(([dof]) => dof < count && keyable.includes(dof)));
  // What a layer adds to a quaternion is none.
  const signed = take.layers
    ? layerValues(stepped ? steppedCharacter(taking) : taking, wanted, timeSeconds)
    : withNearerSigns(character, values, (dof) => placeOf(channels[dof], time, placing));
  for (const dof of keyable.sort((a, b) => a - b)) {
    const before = channels[dof];
    // Goals hold between equal keys.
    const kind = dof >= count && tangents === 'smooth' ? 'auto' : tangents;
    const value = (dof < count ? signed : values).get(dof) ?? 0;
    const { channel, index } = putKeyAt(before, time, value, TANGENT_KINDS.indexOf(kind), placing);
    changed ||= channel !== before;
    channels[dof] = channel;
    keys.push({ channel: dof, indices: [index] });
  }
  const keyed = changed ? withTake(taking, taking.shownTake, withChannelsOf(take, channels, count)) : taking;
  const byHand = unkeyedAt(keyed, timeSeconds);
  if (byHand.size === 0) return { character: keyed, keys };
  for (const dof of keyable) byHand.delete(dof);
  return { character: withUnkeyed(keyed, timeSeconds, byHand), keys };
}

function newRange(
  { timeOffsetSeconds }: Character,
  time: number,
  played: readonly [number, number] | undefined,
): readonly [number, number] {
  if (played && played[1] > played[0]) return [played[0] + timeOffsetSeconds, played[1] + timeOffsetSeconds];
  return [Math.min(0, time), Math.max(1, time)];
}
