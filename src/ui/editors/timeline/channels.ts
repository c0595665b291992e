/**
 * Which channels the timeline lists, and which it draws. A pure function of document, selection and timeline settings.
 */
import { keyCountOf } from '../../../edit/keys/selection.ts';
import { dofCountOf } from '../../../evaluate/pose.ts';
import { silentChannels } from '../../../evaluate/retarget/moved-dofs.ts';
import { type Character, shownTake } from '../../../model/document.ts';
import type { Morph } from '../../../model/morph.ts';
import { perPair } from '../../../model/per-object.ts';
import { NOTHING_SELECTED, type Selection } from '../../../model/session.ts';
import { coupleOf } from '../../../model/skeleton/couples.ts';
import {
  type CharacterDof,
  characterDofs,
  firstDofs,
  rootDofCount,
  unitOfChannel,
} from '../../../model/skeleton/dofs.ts';
import { shortJointName } from '../../../model/skeleton/joint-name.ts';
import { arePoints, dofsOf } from '../../../model/skeleton/joint-types.ts';
import { jointsIn, partOf } from '../../../model/skeleton/selected-joints.ts';
import type { DofUnit, Skeleton } from '../../../model/skeleton/skeleton.ts';
import { UNLIMITED } from '../../../model/skeleton/skeleton.ts';
import { withCurvesOfGoals } from '../../../model/takes/layer-code.ts';
import { GOAL_CHANNELS, type Goals, spanOfChannel, type Take } from '../../../model/takes/take.ts';
import type { TimelineView } from '../../state/timeline.ts';

/** A DOF in the list, animated or not. */
export interface ListedChannel {
  readonly channel: number;
  /** Name of its character, where channels of several are listed. */
  readonly character?: string;
  /** Name of its joint, such as `leg_fl`; empty for a morph, or a channel beyond the DOFs. */
  readonly joint: string;
  /** `rx`, a morph's name, `channel 97`. */
  readonly dof: string;
  readonly unit: DofUnit;
  /** Channels without keys or samples are listed in grey, to show what could be animated. */
  readonly keyCount: number;
  /** `leader r`: the DOF that a linked one follows, whatever its keys are. */
  readonly follows?: string;
  /** Number of frames if the channel is sampled; else 0. */
  readonly sampleCount: number;
}

/** Whether it has keys or samples, and so a curve to draw. */
export function isAnimated({ keyCount, sampleCount }: ListedChannel): boolean {
  return keyCount > 0 || sampleCount > 0;
}

/** The settings that determine the list. */
export type ListSettings = Pick<TimelineView, 'list' | 'pinned' | 'filter'>;

const dofLists = perPair((skeleton: Skeleton, morphs: readonly Morph[]) => characterDofs(skeleton, morphs));

/** The DOFs of a character, after them the curves of the goals of its shown take; cached where it has a skeleton. */
export function dofsFor(character: Character): readonly CharacterDof[] {
  const { skeleton, morphs } = character;
  const dofs = skeleton ? dofLists(skeleton, morphs) : characterDofs(skeleton, morphs);
  const goals = shownTake(character)?.goals;
  return goals ? withCurves(dofs, goals) : dofs;
}

/** With curves of goals as DOFs of no joint. */
const withCurves = perPair((dofs: readonly CharacterDof[], { list }: Goals): readonly CharacterDof[] => [
  ...dofs,
  ...list.flatMap(({ limb }) =>
    GOAL_CHANNELS.map((name) => {
      const unit = name.startsWith('r') ? 'angle' : /^[tp]/.test(name) ? 'length' : 'weight';
      // Joints have DOFs of these names, too.
      const label = /^[tr]/.test(name) ? `${limb} goal ${name}` : `${limb} ${name}`;
      return { name: label, unit, rest: 0, joint: GOAL, limit: UNLIMITED, takesLimits: false } as const;
    }),
  ),
]);
/** In place of a joint: DOFs that are curves of goals. */
export const GOAL = -2;

/** The shown take, with the curves of its goals as channels after those of the DOFs. */
export function takeInTimeline(character: Character): Take | undefined {
  const take = shownTake(character);
  return take && withCurvesOfGoals(take, dofCountOf(character));
}

/**
 * The channels of the list in DOF order: those of `selectedChannels`, all, or the pinned ones; filtered by name. For a
 * retargeted character only its morphs, since its own joint channels have no effect.
 */
export function listedChannels(character: Character, selection: Selection, settings: ListSettings): ListedChannel[] {
  const words = settings.filter.toLowerCase().split(/\s+/).filter(Boolean);
  const listed: ListedChannel[] = [];
  const silent = silentChannels(character);
  const add = (channel: number) => {
    if (channel < silent) return;
    const one = namedChannel(character, channel);
    // Of a skin alone: there is no joint to key.
    if (!character.skeleton && one.joint !== '' && !isAnimated(one)) return;
    if (isFound(words, `${one.joint} ${one.dof}`.toLowerCase())) listed.push(one);
  };
  const count = channelCount(character);
  if (settings.list === 'pinned') {
    for (const channel of settings.pinned) if (channel < count) add(channel);
  } else {
    const only = settings.list === 'selected' ? selectedChannels(character, selection) : undefined;
    if (only) for (const channel of only) add(channel);
    else for (let channel = 0; channel < count; channel++) add(channel);
  }
  return listed;
}

/**
 * The channels of the selected joints. Without one, those of the root: where the character goes, without the thicket of
 * all its joints. Undefined if no joint is selected and none of those is animated.
 */
export function selectedChannels(character: Character, selection: Selection): readonly number[] | undefined {
  const joints = jointsIn(partOf(selection, character.id) ?? NOTHING_SELECTED);
  if (joints.length > 0)
    return [...joints]
      .sort((a, b) => a - b)
      .flatMap((joint) => jointChannels(character, joint))
      .concat(goalChannelsOf(character, joints));
  const channels = jointChannels(character, 0);
  const take = takeInTimeline(character);
  const silent = silentChannels(character);
  return channels.some((c) => c >= silent && take && spanOfChannel(take, c)) ? channels : undefined;
}

/** Whether the listed channels are the root's because no joint is selected. */
export function isOfRootOnly(character: Character, selection: Selection): boolean {
  const hasJoint = partOf(selection, character.id)?.joint !== undefined;
  return !hasJoint && selectedChannels(character, selection) !== undefined;
}

/** The curves of the goals of the limbs that joints belong to. */
function goalChannelsOf(character: Character, joints: readonly number[]): number[] {
  const goals = shownTake(character)?.goals?.list ?? [];
  const count = dofCountOf(character);
  return goals.flatMap(({ limb }, g) => {
    const own = character.limbs?.list.find(({ name }) => name === limb)?.joints ?? [];
    const isOf = own.some((joint) => joints.includes(joint));
    return isOf ? GOAL_CHANNELS.map((_, k) => count + GOAL_CHANNELS.length * g + k) : [];
  });
}

function jointChannels(character: Character, joint: number): number[] {
  const [first, end] = channelsOfJoint(character, joint);
  return Array.from({ length: end - first }, (_, i) => first + i);
}

/** Channels of all DOFs, and those of the take past them. */
export function channelCount(character: Character): number {
  return Math.max(dofsFor(character).length, takeInTimeline(character)?.channels.length ?? 0);
}

/** A channel as it would be listed. */
export function namedChannel(character: Character, channel: number): ListedChannel {
  const dofs = dofsFor(character);
  const dof: CharacterDof | undefined = dofs[channel];
  const ofJoint = dof !== undefined && dof.joint >= 0;
  const take = takeInTimeline(character);
  const own = take?.channels[channel];
  const follows = followedName(character, channel);
  return {
    channel,
    ...(follows !== undefined && { follows }),
    joint: ofJoint ? jointOf(character, channel, dof) : '',
    dof: dof?.name ?? `channel ${channel}`,
    unit: unitOfChannel(dofs, channel),
    keyCount: own ? keyCountOf(own) : 0,
    sampleCount: own?.kind === 'samples' ? (take?.samples?.frameCount ?? 0) : 0,
  };
}

/** The root translation of points is nobody's own: it moves all of them. */
function jointOf({ skeleton }: Character, channel: number, { joint }: CharacterDof): string {
  const isOfAll = channel < rootDofCount(skeleton) && arePoints(skeleton);
  return isOfAll ? 'All points' : shortJointName(skeleton, joint);
}

/** `leader r`: the DOF that a channel's linked DOF follows; undefined if not linked. */
export function followedName(character: Character, channel: number): string | undefined {
  const couple = coupleOf(character.skeleton, channel);
  const followed = couple && dofsFor(character)[couple.follows];
  if (!followed) return undefined;
  return channelName({ joint: shortJointName(character.skeleton, followed.joint), dof: followed.name });
}

/** First and end (exclusive) of a joint's channels, for the root including the root translation. */
export function channelsOfJoint({ skeleton }: Character, joint: number): readonly [number, number] {
  const one = skeleton?.joints[joint];
  if (!skeleton || !one) return [0, 0];
  const first = firstDofs(skeleton)[joint];
  return [joint === 0 ? 0 : first, first + dofsOf(one.motion).length];
}

function isFound(words: readonly string[], name: string): boolean {
  return words.every((word) => name.includes(word));
}

/** The drawn channels: listed, with keys or samples, and isolated or not hidden. */
export function drawnChannels(
  listed: readonly ListedChannel[],
  { hidden, isolated }: Pick<TimelineView, 'hidden' | 'isolated'>,
): number[] {
  const keyed = listed.filter(isAnimated);
  const only = isolated && new Set(isolated);
  // If no isolated channel is listed any more, draw all: an empty plot would look like a fault.
  if (only && keyed.some((l) => only.has(l.channel))) {
    return keyed.filter((l) => only.has(l.channel)).map((l) => l.channel);
  }
  const not = new Set(hidden);
  return keyed.filter((l) => !not.has(l.channel)).map((l) => l.channel);
}

type Names = Pick<ListedChannel, 'character' | 'joint' | 'dof'>;

/** `rx of leg_fl`, for sentences. */
export function spokenName({ character, joint, dof }: Names): string {
  return [dof, joint, character].filter(Boolean).join(' of ');
}

/** `leg_fl rx`, `Wasp leg_fl rx`. */
export function channelName({ character, joint, dof }: Names): string {
  return [character, joint, dof].filter(Boolean).join(' ');
}
