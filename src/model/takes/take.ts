import type { Vec3 } from '../../math/vec3.ts';
import type { OtherFields } from '../other-fields.ts';
import type { Marker } from './markers.ts';
import { columnOf, rangeOfSamples, type Samples } from './samples.ts';

/**
 * A take: the content of an animation file. Its channels drive a character's DOFs, in the order of `dofs.ts`: root
 * translation, the DOFs of every joint, morph weights.
 *
 * A channel has keys, follows its column of samples, or rests at a value. So motion capture and keys coexist in one
 * take: a channel converted to keys becomes an ordinary keyed channel while its neighbours stay sampled.
 */
export interface Take {
  readonly name: string;
  /** First and last second played; independent of the keys, and may be negative. */
  readonly range: readonly [number, number];
  readonly channels: readonly Channel[];
  /** As the file states, or as its keys had it when they were read; absent: as the keys have it (`frame-rate.ts`). */
  readonly framesPerSecond?: number;
  /** Drives the sampled channels. A channel with a column here is sampled or keyed, never at rest. */
  readonly samples?: Samples;
  /** Labels of times and spans, by time; absent rather than empty. */
  readonly markers?: readonly Marker[];
  /** Layers over a base; `channels` and `samples` are those of the active one. */
  readonly layers?: LayerStack;
  /** Goals of the character's limbs, above all channels; absent rather than empty. */
  readonly goals?: Goals;
  /** Spans in which the root follows a joint of another character; absent rather than empty. */
  readonly attached?: Attachments;
}

/** Where neither a file nor a take states a frame rate. */
export const USUAL_FRAMES_PER_SECOND = 30;

/** How a layer's values meet those beneath: added to them, or in their place. */
export type LayerMode = 'additive' | 'override';

/** Channels and the samples that drive them: what a take and a layer move by. */
export type Motion = Pick<Take, 'channels' | 'samples'>;

/** How a layer takes part, without its motion. */
export interface LayerSettings {
  /** Unique in its take, whatever the case. */
  readonly name: string;
  readonly mode: LayerMode;
  /** Constant, or over time; clamped to 0 … 1 where it is used. */
  readonly weight: number | KeyedChannel;
  readonly mute: boolean;
  /** While an unmuted layer is solo, only such layers count. */
  readonly solo: boolean;
  /**
   * The joints that it touches, by name or `#index` as in files; absent: everything. With it, the root translation is
   * touched only if `root`, and morphs only if `morphs`.
   */
  readonly joints?: readonly string[];
  readonly root: boolean;
  readonly morphs: boolean;
  /** Fields of its weight that are not known, as its file has them. */
  readonly ofWeight?: OtherFields;
  readonly others?: OtherFields;
}

/** A layer of a take. */
export interface Layer extends LayerSettings {
  /** Channels at rest leave their DOFs alone. Absent of the active layer, whose channels are the take's. */
  readonly motion?: Motion;
  /** The name of its file; absent: not saved yet. */
  readonly file?: string;
}

/** The layers of a take, from the lowest up. */
export interface LayerStack {
  /** The index of the layer whose channels are the take's; -1 for the base. */
  readonly active: number;
  /** The motion beneath; absent while the base is active. */
  readonly base?: Motion;
  readonly list: readonly Layer[];
  /** The name of the base's file; absent: not saved yet. */
  readonly baseFile?: string;
  /** Fields that are not known, as the file has them: of its plain file, and its own. */
  readonly ofFlattened?: OtherFields;
  readonly others?: OtherFields;
}

/**
 * The curves of a goal: the share of IK; the goal's place and rotation, Rz·Ry·Rx; the point to which the limb bends;
 * and to which side.
 */
export const GOAL_CHANNELS = ['blend', 'tx', 'ty', 'tz', 'rx', 'ry', 'rz', 'px', 'py', 'pz', 'bend'] as const;
/** The name of a curve of a goal: see `GOAL_CHANNELS`. */
export type GoalChannel = (typeof GOAL_CHANNELS)[number];

/** A curve, or its constant value, with the fields of its object that are not known. */
export interface GoalCurve {
  readonly curve: number | KeyedChannel;
  readonly others?: OtherFields;
}

/** From a time on, in seconds, a space: `world`, `parent`, or a joint by name or `#index`. */
export type SpaceKey = readonly [number, string];

/** The goal of one limb. */
export interface Goal {
  /** The name of the limb. */
  readonly limb: string;
  /** The space of goal and pole: one, or one from each time on, by time, the first before it too. */
  readonly space: string | readonly SpaceKey[];
  /**
   * Those that the file has: `blend` is 1 without, `bend` the limb's sign, the others 0; without px py pz there is no
   * pole.
   */
  readonly channels: Readonly<Partial<Record<GoalChannel, GoalCurve>>>;
  /** Fields that are not known, of the channels and its own. */
  readonly ofChannels?: OtherFields;
  readonly others?: OtherFields;
}

/** The goals of a take. */
export interface Goals {
  /** At most one for each limb. */
  readonly list: readonly Goal[];
  /** The name of the base's file; absent: not saved yet. */
  readonly baseFile?: string;
  /** Fields that are not known, as the file has them: of its plain file, and its own. */
  readonly ofFlattened?: OtherFields;
  readonly others?: OtherFields;
}

/** Where the root is in the space of a joint that it follows. */
export interface AttachmentOffset {
  readonly position: Vec3;
  /** Radians about x, y and z: Rz·Ry·Rx. */
  readonly rotation: Vec3;
  readonly others?: OtherFields;
}

/** A span of a take in which the root follows a joint of another character (`evaluate/attached.ts`). */
export interface Attachment {
  /** The id of the one that is followed, among `Character.leaders`. */
  readonly leaderId: string;
  /** Index among the leader's joints. */
  readonly joint: number;
  /** From the first second of the take up to (excluding) the second one. */
  readonly span: readonly [number, number];
  readonly offset: AttachmentOffset;
  readonly others?: OtherFields;
}

/** The joints of other characters that the root follows in a take. */
export interface Attachments {
  /** By their starts; at a time the last one that has begun counts, if it has not ended. */
  readonly list: readonly Attachment[];
  /** The name of the base's file; absent: not saved yet. */
  readonly baseFile?: string;
  /** Fields that are not known, as the file has them: of its plain file, and its own. */
  readonly ofFlattened?: OtherFields;
  readonly others?: OtherFields;
}

/** The motion beneath all layers; the take itself while that is active, or without layers. */
export function baseOf(take: Take): Motion {
  return take.layers?.base ?? take;
}

/** The source of one DOF's values, told by `kind`. */
export type Channel = KeyedChannel | SampledChannel | RestChannel;

/**
 * Extrapolation outside the keys. Channels without keys have it too, for keys added later and to preserve what the file
 * says.
 */
export interface Extrapolated {
  readonly extrapolateIn: Extrapolation;
  readonly extrapolateOut: Extrapolation;
}

/** Keys with what comes before and after them: all that determines a curve. */
export interface KeyedCurve extends Extrapolated, Keys {}

/** With at least one key. */
export interface KeyedChannel extends KeyedCurve {
  readonly kind: 'keys';
}

/** Columns, sorted by time. Two keys at the same time are a step; the later one applies from that time on. */
export interface Keys {
  /** Seconds. */
  readonly times: Float64Array;
  readonly values: Float64Array;
  readonly tangentsIn: Tangents;
  readonly tangentsOut: Tangents;
}

/** Follows its column in the take's samples: `columnOf(samples, channel)`. */
export interface SampledChannel extends Extrapolated {
  readonly kind: 'samples';
}

/**
 * Rests at a value: a channel with neither keys nor samples. Files have no such channel: one without keys is read as 0,
 * and 0 is written without keys; any other value is written as a single key. In an editor, a channel without keys keeps
 * the value it was given.
 */
export interface RestChannel extends Extrapolated {
  readonly kind: 'rest';
  readonly value: number;
}

/** The in or the out tangents of a channel's keys, as columns. */
export interface Tangents {
  /** Index into TANGENT_KINDS (`tangent-kinds.ts`) for each key. */
  readonly kinds: Uint8Array;
  /** Value per second for keys of kind `fixed`; of `auto`, other digits of a file (`autoNumber`); 0 elsewhere. */
  readonly slopes: Float64Array;
}

/**
 * Behaviour of a channel before its first and after its last key: keeps the value, continues its slope, repeats,
 * repeats with the difference of its ends added, or runs to and fro.
 */
export const EXTRAPOLATIONS = ['constant', 'linear', 'cycle', 'cycle_offset', 'bounce'] as const;
/** The extrapolation at one end of a channel; see `EXTRAPOLATIONS`. */
export type Extrapolation = (typeof EXTRAPOLATIONS)[number];

/** Whether the keys are repeated beyond their end, in whichever way. */
export function repeats(extrapolation: Extrapolation): boolean {
  return extrapolation !== 'constant' && extrapolation !== 'linear';
}

/** The extrapolation of a channel that holds its first and last value. */
export const NO_EXTRAPOLATION = { extrapolateIn: 'constant', extrapolateOut: 'constant' } as const;

/**
 * Shared by all sampled channels of captures, so that a message to the page with thousands of channels contains it
 * once.
 */
export const SAMPLED: SampledChannel = { kind: 'samples', ...NO_EXTRAPOLATION };

/** A channel without keys that rests at `value`, in the DOF's unit; -0 becomes 0. */
export function restChannel(value = 0): RestChannel {
  // Adding 0 turns −0 into 0.
  return { kind: 'rest', value: value + 0, ...NO_EXTRAPOLATION };
}

const NO_NUMBERS = new Float64Array(0);
const NO_TANGENTS: Tangents = { kinds: new Uint8Array(0), slopes: NO_NUMBERS };
/** The columns of a channel without keys; shared, it must not be mutated. */
export const NO_KEYS: KeyedCurve = {
  ...NO_EXTRAPOLATION,
  times: NO_NUMBERS,
  values: NO_NUMBERS,
  tangentsIn: NO_TANGENTS,
  tangentsOut: NO_TANGENTS,
};

/** The keys of a channel; empty columns if it has none or there is no channel. */
export function keysOf(channel: Channel | undefined): KeyedCurve {
  return channel?.kind === 'keys' ? channel : NO_KEYS;
}

/** First to last key, or first to last frame, of one of the take's channels; undefined if it is at rest. */
export function spanOfChannel(
  { channels, samples }: Pick<Take, 'channels' | 'samples'>,
  index: number,
): readonly [number, number] | undefined {
  const channel = channels[index];
  if (channel?.kind === 'keys') return [channel.times[0], channel.times[channel.times.length - 1]];
  return channel?.kind === 'samples' && samples ? rangeOfSamples(samples) : undefined;
}

/** The channels of a take with these samples: resting channels that have a column become sampled. */
export function followingSamples(channels: readonly Channel[], samples: Samples | undefined): readonly Channel[] {
  const follows = ({ kind }: Channel, c: number) => kind === 'rest' && columnOf(samples, c) >= 0;
  if (!samples || !channels.some(follows)) return channels;
  return channels.map((channel, c): Channel => {
    if (!follows(channel, c)) return channel;
    const { extrapolateIn, extrapolateOut } = channel;
    return { ...SAMPLED, extrapolateIn, extrapolateOut };
  });
}

/** Whether more than its own channels moves a take: layers, goals of limbs, attachments. */
export function hasControls({ layers, goals, attached }: Partial<Take>): boolean {
  return (layers ?? goals ?? attached) !== undefined;
}
