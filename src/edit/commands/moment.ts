/** Keying a pose for a moment, over motion that continues. */
import { inTakes } from '../../evaluate/in-takes.ts';
import { dofCountOf, poseAt } from '../../evaluate/pose.ts';
import { silentChannels } from '../../evaluate/retarget/moved-dofs.ts';
import { type Character, type Document, shownTake } from '../../model/document.ts';
import { characterDofs } from '../../model/skeleton/dofs.ts';
import { activeLayer } from '../../model/takes/layers.ts';
import { columnOf } from '../../model/takes/samples.ts';
import type { Take } from '../../model/takes/take.ts';
import { indexIn } from '../arguments.ts';
import type { Edit } from '../change.ts';
import { changeCharacter, requireCharacter } from '../characters.ts';
import { command } from '../command.ts';
import { CommandError } from '../command-error.ts';
import { isOnCurve } from '../keys/keyed-pose.ts';
import { type Moment, samplesWithMoment, withMoment } from '../keys/moment.ts';
import { findKey } from '../keys/same-time.ts';
import { layerValues } from '../layers/layer-values.ts';
import { openValues } from '../pose/locks.ts';
import { refuseMoved } from '../refuse-moved.ts';
import { index, list, number, optional, record } from '../schema/shape.ts';
import { NOW, range } from '../schema/shared-shapes.ts';
import { dofsIn } from '../step-names.ts';
import { requireTake, withChannels, withTake } from '../takes.ts';
import { unkeyedAt, withUnkeyed } from '../unkeyed.ts';
import { withinLimit } from './pose.ts';

/** Shortest easing, in seconds: less is a jump. */
const MIN_EASE = 1e-3;

/**
 * Keys DOFs at a time for a moment: the take is offset by what was posed, eased in and out around that time, and is
 * what it was outside. Repetitions that the moment is in become keys first. Also over samples, whose frames change.
 */
export const keyForMoment = command({
  id: 'keys.forMoment',
  args: {
    ...NOW,
    /** Values to be keyed, by index into the character's DOFs; default: the unkeyed changes at that time. */
    dofs: optional(list(record({ index, value: number }))),
    /** Seconds before and after the time. */
    easeIn: number,
    easeOut: number,
    /** Playback range, in seconds of the transport: repetitions become keys over at least this. */
    playedRange: optional(range),
  },
  label: (document, { characterId, dofs, timeSeconds }) => {
    const character = requireCharacter(document, characterId);
    const indices = dofs?.map((dof) => dof.index) ?? [...unkeyedAt(character, timeSeconds).keys()];
    return `Key ${ofMoment(character, indices)}`;
  },
  run(document, { characterId, dofs, timeSeconds, easeIn, easeOut, playedRange }): Document | Edit {
    if (!(easeIn >= MIN_EASE && easeOut >= MIN_EASE && easeIn + easeOut < Infinity)) {
      throw new CommandError('"easeIn" and "easeOut" must be seconds, at least 0.001 each.');
    }
    const character = requireCharacter(document, characterId);
    const wanted = valuesOf(character, timeSeconds, dofs);
    if (wanted.size === 0) return document;
    const { open: values, locked } = openValues(character, wanted);
    if ([...values.keys()].some((dof) => dof < silentChannels(character))) refuseMoved(character);
    const offset = character.timeOffsetSeconds;
    const at = timeSeconds + offset;
    const moment = { at, easeIn, easeOut };
    const { range: own } = requireTake(character);
    const baked = playedRange ? ([playedRange[0] + offset, playedRange[1] + offset] as const) : own;
    const { character: changed, keys } = changedFor(character, values, moment, timeSeconds, baked);
    const next = changeCharacter(document, characterId, () => changed);
    const done = `Keyed ${ofMoment(character, [...wanted.keys()])}.`;
    return { document: next, keys, done, ...(locked > 0 && { locked }) };
  },
});

function ofMoment(character: Character, dofs: readonly number[]): string {
  return `${dofsIn(character, dofs)} for a moment`;
}

function valuesOf(
  character: Character,
  timeSeconds: number,
  dofs: readonly { readonly index: number; readonly value: number }[] | undefined,
): ReadonlyMap<number, number> {
  const all = characterDofs(character.skeleton, character.morphs);
  // Only DOFs are keyed for a moment: values of goals stay unkeyed.
  if (!dofs) return new Map([...unkeyedAt(character, timeSeconds)].filter(([dof]) => dof < all.length));
  return new Map(
    dofs.map(({ index: dof, value }) => {
      indexIn(dof, 0, all.length, 'DOF');
      return [dof, character.clampsToLimits ? withinLimit(all[dof], value) : value];
    }),
  );
}

/** What such a layer has outside the moment would take the place of the motion below it. */
function refuseOverride(take: Take): void {
  const layer = activeLayer(take);
  if (layer?.mode !== 'override') return;
  throw new CommandError(
    `Layer "${layer.name}" overrides the motion below it, so no pose in it can be for a moment. Make it additive, or key its weight.`,
  );
}

function changedFor(
  character: Character,
  values: ReadonlyMap<number, number>,
  moment: Moment,
  timeSeconds: number,
  baked: readonly [number, number],
) {
  const taking = withChannels(character, baked);
  const take = shownTake(taking);
  if (!take) return { character, keys: [] };
  refuseOverride(take);
  const channels = [...take.channels];
  const sampled = new Map<number, number>();
  const keys = [];
  const own = layerValues(taking, values, timeSeconds);
  for (const [dof, value] of [...own].sort(([a], [b]) => a - b)) {
    const channel = channels[dof];
    if (isOnCurve(channel, moment.at, value)) continue;
    if (channel.kind === 'samples' && take.samples && columnOf(take.samples, dof) >= 0) sampled.set(dof, value);
    else {
      const keyed = withMoment(channel, moment, value, baked);
      channels[dof] = keyed;
      keys.push({ channel: dof, indices: [findKey(keyed, moment.at)] });
    }
  }
  if (keys.length + sampled.size === 0) return { character, keys };
  const driven = new Float64Array(dofCountOf(taking));
  if (sampled.size > 0) poseAt(inTakes(taking), timeSeconds, driven);
  const samples = take.samples && samplesWithMoment(take.samples, moment, sampled, (dof) => driven[dof]);
  const next = { ...take, channels, ...(samples && sampled.size > 0 && { samples }) };
  const byHand = unkeyedAt(taking, timeSeconds);
  for (const [dof, value] of byHand)
    if (values.has(dof) || (dof < driven.length && isOnCurve(channels[dof], moment.at, value))) byHand.delete(dof);
  return { character: withUnkeyed(withTake(taking, taking.shownTake, next), timeSeconds, byHand), keys };
}
