/** The first wrong number in some of several dumps, which are compared together. */

import type { Character } from '../../model/document.ts';
import type { DumpKind } from '../../model/dump.ts';
import { nameOfChannel } from './channel-name.ts';
import type { Comparison, FirstWrong } from './compare.ts';
import { FRAME_KINDS, type FrameKind, type Targets } from './targets.ts';

/** A first wrong item, and what it is of. */
export interface PlacedFirst {
  readonly first: FirstWrong;
  /** Into the frames; −1 for channels. */
  readonly frame: number;
  /** Into the names of the dumps; 0 if there is one. */
  readonly dump: number;
  /** Kinds of the numbers that it may be in. */
  readonly kinds: readonly DumpKind[];
}

const KINDS: Readonly<Record<FirstWrong['what'], readonly FrameKind[]>> = {
  joint: ['world', 'local', 'positions'],
  vertex: ['vertices'],
  normal: ['normals'],
  channel: [],
};

/** A comparison, with what it was made from. */
export interface FirstWrongInput {
  readonly comparison: Comparison;
  readonly targets: Targets;
  readonly character: Character;
  readonly tolerance: number;
}

/**
 * The first wrong item of these dumps: that of a frame before others, then by frame, kind and index, channels last.
 *
 * @param dumps into the names; undefined: all
 * @param preferred index of a frame; −1: none
 * @returns undefined if they agree
 */
export function firstWrongOf(
  { comparison, targets, character, tolerance }: FirstWrongInput,
  dumps: ReadonlySet<number> | undefined,
  preferred: number,
): PlacedFirst | undefined {
  const { frames } = comparison;
  const { origins } = targets;
  const isAsked = (dump: number) => dumps?.has(dump) ?? true;
  const order = [...frames.keys()];
  if (preferred >= 0 && preferred < order.length) order.unshift(preferred);
  for (const frame of order) {
    for (const first of frames[frame].firsts) {
      const kinds = FRAME_KINDS.filter((kind) => KINDS[first.what].includes(kind) && targets.frames[frame][kind]);
      const dump = kinds.map((kind) => origins?.frames[frame][kind] ?? 0).find(isAsked);
      if (dump !== undefined) return { first, frame, dump, kinds };
    }
  }
  let found: PlacedFirst | undefined;
  const { channels, times, values } = targets.channels;
  channels.forEach((index, i) => {
    const dump = origins?.samples[i] ?? 0;
    const error = Math.abs(comparison.ourChannels[i] - values[i]);
    if (error <= tolerance || !isAsked(dump)) return;
    const before = found?.first;
    if (before && (before.index < index || (before.index === index && (before.time ?? 0) <= times[i]))) return;
    const first: FirstWrong = {
      what: 'channel',
      index,
      ...nameOfChannel(character, index),
      error: Number.isNaN(error) ? Number.POSITIVE_INFINITY : error,
      time: times[i],
    };
    found = { first, frame: -1, dump, kinds: ['channels'] };
  });
  return found;
}
