/** What the curve editor shows: everything that drawing and hit testing need, read-only. */

import type { CompiledTake } from '../../../../evaluate/compiled-take.ts';
import { extremesOfColumn } from '../../../../evaluate/plot/sample-extremes.ts';
import type { Character } from '../../../../model/document.ts';
import { perObject } from '../../../../model/per-object.ts';
import type { ChannelKeys } from '../../../../model/session.ts';
import { coupleOf } from '../../../../model/skeleton/couples.ts';
import { axisOfDof } from '../../../../model/skeleton/dof-axis.ts';
import { type CharacterDof, unitOfChannel } from '../../../../model/skeleton/dofs.ts';
import { jointName } from '../../../../model/skeleton/joint-name.ts';
import { type DofUnit, isUnlimited, type Limit } from '../../../../model/skeleton/skeleton.ts';
import { columnOf } from '../../../../model/takes/samples.ts';
import type { KeyedChannel, Take } from '../../../../model/takes/take.ts';
import { dofsFor, takeInTimeline } from '../../timeline/channels.ts';
import { axisColour, followingColour, type LineColour, otherColour } from './colours.ts';
import type { RestCurves } from './rest-curves.ts';
import type { AxisName, CurveSpace, Normalise } from './space.ts';
import type { TheirChannels } from './their-channels.ts';

/** A channel that is drawn. */
export interface CurveLine {
  /** Index in the take. */
  readonly channel: number;
  /** `leg_fl rx`, or a morph's own name. */
  readonly name: string;
  /** Unit of its values. */
  readonly unit: DofUnit;
  /** Its axis: its unit's, or `normalised`. */
  readonly axis: AxisName;
  readonly colour: LineColour;
  /** Limit of the DOF; absent without one. */
  readonly limit?: Limit;
  readonly normalise?: Normalise;
}

export interface CurveScene {
  readonly take: Take;
  /** The same take, compiled. */
  readonly curves: CompiledTake;
  /** Take time = transport time + this. */
  readonly offsetSeconds: number;
  /** Back to front. */
  readonly lines: readonly CurveLine[];
  readonly selected: readonly ChannelKeys[];
  /**
   * Channels in front where many are drawn: the others are faint, and their keys appear under the pointer only. Those
   * with selected keys are never faint. Absent: all are alike.
   */
  readonly emphasised?: ReadonlySet<number>;
  /** Of a take with layers: what is below those of the active one, and the channels of which it is drawn. */
  readonly rest?: { readonly curves: RestCurves; readonly lines: readonly CurveLine[] };
  /** Another program's values that are compared, drawn over the lines. */
  readonly theirs?: TheirChannels;
  readonly space: CurveSpace;
  /** Playback range, seconds of the transport. */
  readonly range: readonly [number, number];
  readonly framesPerSecond: number;
  readonly inFrames: boolean;
  /** Angles are labelled in degrees. */
  readonly degrees: boolean;
}

/** What is at a point of the plot (`hit.ts`). */
export type CurveHit =
  | { readonly kind: 'key'; readonly channel: number; readonly index: number }
  | { readonly kind: 'handle'; readonly channel: number; readonly index: number; readonly side: HandleSide }
  /** The curve itself, at a time of the take and the value there. */
  | { readonly kind: 'curve'; readonly channel: number; readonly timeSeconds: number; readonly value: number }
  | { readonly kind: 'empty' };

export type HandleSide = 'in' | 'out';

export const NO_CHANNELS: readonly number[] = [];

/**
 * Lines of these channels of the shown take, in the given order; channels that the take doesn't have are left out.
 * Channels beyond the character's DOFs are named by number.
 *
 * @param kept lines whose scale normalised lines keep: nothing may be rescaled during a drag
 * @param place index of the character among those shown together
 */
export function sceneLines(
  character: Character,
  channels: readonly number[],
  normalised: boolean,
  kept: readonly CurveLine[] = [],
  place = 0,
): CurveLine[] {
  const take = takeInTimeline(character);
  if (!take) return [];
  const dofs = dofsFor(character);
  const ordinals = new Map<string, number>();
  let others = place;
  const lines: CurveLine[] = [];
  for (const channel of channels) {
    const held = take.channels[channel];
    if (!held) continue;
    const dof: CharacterDof | undefined = dofs[channel];
    const axis = dof && axisOfDof(character.skeleton, dof);
    const group = dof ? `${dof.joint}` : '';
    if (axis && !ordinals.has(group)) ordinals.set(group, place + ordinals.size);
    const unit = unitOfChannel(dofs, channel);
    const colour = axis ? axisColour(axis, ordinals.get(group) ?? 0, unit === 'length') : otherColour(others++);
    lines.push({
      channel,
      name: lineName(character, channel, dof),
      unit,
      axis: normalised ? 'normalised' : unit,
      colour: coupleOf(character.skeleton, channel) ? followingColour(colour) : colour,
      ...(dof && isLimited(dof.limit) && { limit: dof.limit }),
      ...(normalised && {
        normalise: kept.find((line) => line.channel === channel)?.normalise ?? normalisation(take, channel),
      }),
    });
  }
  return lines;
}

/** `hips rx`, `root tx`, a morph's name, or `channel 12`. */
function lineName(character: Character, channel: number, dof: CharacterDof | undefined): string {
  if (!dof) return `channel ${channel}`;
  if (dof.joint < 0) return dof.name;
  return `${jointName(character.skeleton, dof.joint)} ${dof.name}`;
}

function isLimited(limit: Limit): boolean {
  return !isUnlimited(limit) && limit.min <= limit.max && (Number.isFinite(limit.min) || Number.isFinite(limit.max));
}

const normalisations = new WeakMap<KeyedChannel, Normalise>();

/** Maps the smallest key or sample to −1 and the largest to 1; a constant channel to 0. */
function normalisation(take: Take, index: number): Normalise {
  const channel = take.channels[index];
  if (take.samples && channel.kind === 'samples') {
    const { low, high } = extremesOfColumn(take.samples, columnOf(take.samples, index));
    return normaliseBetween(low, high);
  }
  if (channel.kind === 'rest') return normaliseBetween(channel.value, channel.value);
  if (channel.kind !== 'keys') return normaliseBetween(0, 0);
  const known = normalisations.get(channel);
  if (known) return known;
  let low = Number.POSITIVE_INFINITY;
  let high = Number.NEGATIVE_INFINITY;
  for (const value of channel.values) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
  const made = normaliseBetween(low, high);
  normalisations.set(channel, made);
  return made;
}

function normaliseBetween(low: number, high: number): Normalise {
  const scale = high > low && Number.isFinite(2 / (high - low)) ? 2 / (high - low) : 1;
  return { scale, shift: -scale * (low + (high - low) / 2) };
}

/** Whether a line is faint, behind those that are emphasised. */
export function isFaint(scene: CurveScene, { channel }: CurveLine): boolean {
  return scene.emphasised !== undefined && !inFront(scene).has(channel);
}

const inFront = perObject(
  ({ emphasised, selected }: CurveScene) => new Set([...(emphasised ?? []), ...selected.map((keys) => keys.channel)]),
);

/** The line of a channel. */
export function lineOf(scene: Pick<CurveScene, 'lines'>, channel: number): CurveLine | undefined {
  return scene.lines.find((line) => line.channel === channel);
}
