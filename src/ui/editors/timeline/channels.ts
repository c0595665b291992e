/**
 * Which channels the timeline lists, and which of them it draws. Both follow from the document, the selection and the
 * timeline's settings alone; nothing is remembered here.
 */
import { silentChannels } from '../../../evaluate/retarget/moved-dofs.ts';
import { keysOf } from '../../../model/clip.ts';
import { coupleOf } from '../../../model/couples.ts';
import { type Character, shownClip } from '../../../model/document.ts';
import { type CharacterDof, characterDofs, firstDofs, unitOfChannel } from '../../../model/dofs.ts';
import { jointName } from '../../../model/joint-name.ts';
import { dofsOf } from '../../../model/joint-types.ts';
import type { Morph } from '../../../model/morph.ts';
import { perPair } from '../../../model/per-object.ts';
import type { Selection } from '../../../model/session.ts';
import type { DofUnit, Skeleton } from '../../../model/skeleton.ts';
import type { TimelineView } from '../../state/timeline.ts';

/** A DOF in the list, with or without a channel that is animated. */
export interface ListedChannel {
  readonly channel: number;
  /** Of its joint: `leg_fl`; of a morph or a channel past the DOFs it is empty. */
  readonly joint: string;
  /** `rx`, a morph's name, `channel 97`. */
  readonly dof: string;
  readonly unit: DofUnit;
  /** Without keys or samples it is listed, greyed, so that one sees what could be animated. */
  readonly keyCount: number;
  /** `leader r`: the DOF that this one follows, whatever its keys say. */
  readonly follows?: string;
  /** Frames, where the channel follows the clip's samples; else 0. */
  readonly sampleCount: number;
}

/** Whether it moves by keys or by samples: there is a curve to draw. */
export function isAnimated({ keyCount, sampleCount }: ListedChannel): boolean {
  return keyCount > 0 || sampleCount > 0;
}

/** What of the timeline's settings decides the list. */
export type ListSettings = Pick<TimelineView, 'list' | 'pinned' | 'filter'>;

const dofLists = perPair((skeleton: Skeleton, morphs: readonly Morph[]) => characterDofs(skeleton, morphs));

/** The DOFs of a character, made once for a skeleton. */
export function dofsFor({ skeleton, morphs }: Character): readonly CharacterDof[] {
  return skeleton ? dofLists(skeleton, morphs) : characterDofs(skeleton, morphs);
}

/**
 * The channels of the list, in the order of the DOFs: the selected joint's (the root's translation with the root;
 * everything where no joint is selected), all, or those that were pinned; of them those whose name the filter finds.
 * While another character's take moves it, only its morphs: what its own take has of its joints is not seen.
 */
export function listedChannels(character: Character, selection: Selection, settings: ListSettings): ListedChannel[] {
  const dofs = dofsFor(character);
  const channels = shownClip(character)?.channels ?? [];
  const joint = selection.characterId === character.id ? selection.joint : undefined;
  const words = settings.filter.toLowerCase().split(/\s+/).filter(Boolean);
  const listed: ListedChannel[] = [];
  const silent = silentChannels(character);
  const add = (channel: number) => {
    if (channel < silent) return;
    const one = namedChannel(character, channel);
    if (isFound(words, `${one.joint} ${one.dof}`.toLowerCase())) listed.push(one);
  };
  const count = Math.max(dofs.length, channels.length);
  if (settings.list === 'pinned') {
    for (const channel of settings.pinned) if (channel < count) add(channel);
  } else {
    const [first, end] =
      settings.list === 'selected' && joint !== undefined ? channelsOfJoint(character, joint) : [0, count];
    for (let channel = first; channel < end; channel++) add(channel);
  }
  return listed;
}

/** A channel as it would be listed. */
export function namedChannel(character: Character, channel: number): ListedChannel {
  const dofs = dofsFor(character);
  const dof: CharacterDof | undefined = dofs[channel];
  const ofJoint = dof !== undefined && dof.joint >= 0;
  const clip = shownClip(character);
  const follows = followedName(character, channel);
  return {
    channel,
    ...(follows !== undefined && { follows }),
    joint: ofJoint ? jointName(character.skeleton, dof.joint) : '',
    dof: dof?.name ?? `channel ${channel}`,
    unit: unitOfChannel(dofs, channel),
    keyCount: keysOf(clip?.channels[channel]).times.length,
    sampleCount: clip?.channels[channel]?.kind === 'samples' ? (clip.samples?.frameCount ?? 0) : 0,
  };
}

/** `leader r`: the DOF that a channel's own follows; undefined where it is its own. */
export function followedName(character: Character, channel: number): string | undefined {
  const couple = coupleOf(character.skeleton, channel);
  const followed = couple && dofsFor(character)[couple.follows];
  if (!followed) return undefined;
  return channelName({ joint: jointName(character.skeleton, followed.joint), dof: followed.name });
}

/** First and end (not included) of a joint's channels; the root has its translation too. */
export function channelsOfJoint({ skeleton }: Character, joint: number): readonly [number, number] {
  const one = skeleton?.joints[joint];
  if (!skeleton || !one) return [0, 0];
  const first = firstDofs(skeleton)[joint];
  return [joint === 0 ? 0 : first, first + dofsOf(one.motion).length];
}

function isFound(words: readonly string[], name: string): boolean {
  return words.every((word) => name.includes(word));
}

/** The channels that are drawn: listed with keys or samples, isolated or not hidden. */
export function drawnChannels(
  listed: readonly ListedChannel[],
  { hidden, isolated }: Pick<TimelineView, 'hidden' | 'isolated'>,
): number[] {
  const keyed = listed.filter(isAnimated);
  const only = isolated && new Set(isolated);
  // What was isolated has left the list with the joint: nothing drawn would look like a fault.
  if (only && keyed.some((l) => only.has(l.channel))) {
    return keyed.filter((l) => only.has(l.channel)).map((l) => l.channel);
  }
  const not = new Set(hidden);
  return keyed.filter((l) => !not.has(l.channel)).map((l) => l.channel);
}

/** `rx of leg_fl`: in a sentence. */
export function spokenName({ joint, dof }: Pick<ListedChannel, 'joint' | 'dof'>): string {
  return joint ? `${dof} of ${joint}` : dof;
}

/** `leg_fl rx`. */
export function channelName({ joint, dof }: Pick<ListedChannel, 'joint' | 'dof'>): string {
  return joint ? `${joint} ${dof}` : dof;
}
