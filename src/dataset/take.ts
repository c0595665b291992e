/** A take ready to be made numbers of: what is sampled, in which space, at which frames. */

import { CommandError } from '../edit/command-error.ts';
import { retargetedTo } from '../edit/commands/retarget.ts';
import { mirroringTake } from '../edit/samples/take-mirror.ts';
import { type Frames, framesOf, MAX_FRAMES, ownFrames, playedTake } from '../evaluate/bake.ts';
import { frameRateOf } from '../evaluate/samples/frame-rate.ts';
import { framesOfTake } from '../evaluate/samples/key-frames.ts';
import { runToEnd } from '../evaluate/steps.ts';
import type { Character } from '../model/document.ts';
import type { Skeleton } from '../model/skeleton/skeleton.ts';
import type { Space } from '../model/space.ts';
import { type JointMap, pairsOf } from './joint-map.ts';

/** Seconds of the take; absent: its start or end. */
export interface Crop {
  readonly from?: number;
  readonly to?: number;
}

/** The character that takes are retargeted to. */
export interface RetargetTarget {
  readonly character: Character;
  /** Absent: matched by name and shape. */
  readonly map?: JointMap;
}

/** Changes made to a take before its numbers are made. */
export interface TakeOptions {
  /** Frames per second; absent: the take's own, or 60 for keys at uneven times. */
  readonly fps?: number;
  readonly crop?: Crop;
  /** Exchanges left and right, before anything else. */
  readonly isMirrored?: boolean;
  readonly target?: RetargetTarget;
  /** Keeps the file's unit, axes and origin. */
  readonly isRaw?: boolean;
}

/** A take that is ready to be sampled. */
export interface ArrayTake {
  readonly character: Character;
  readonly skeleton: Skeleton;
  /** Absent: as in the file. */
  readonly space?: Space;
  /** Frames of the whole take, in seconds of its take. */
  readonly frames: Frames;
  /** The frames to export: the first, and how many. */
  readonly first: number;
  readonly count: number;
  /** Frames per second as meant: 120 for a frame time of 0.0083333. */
  readonly fps: number;
}

/** For keys at uneven times. */
const DEFAULT_FPS = 60;
/** Relative difference of frame rates that are the same. */
const SAME_RATE = 1e-6;
/** Fraction of a frame that is none. */
const SAME_FRAME = 1e-6;

/**
 * The take that a character plays, with the options applied: mirrored first, then retargeted, sampled, and cropped.
 * @throws CommandError, in a sentence, if there is nothing to export
 */
export function takeOf(source: Character, options: TakeOptions): ArrayTake {
  const played = options.isMirrored ? mirrored(source) : source;
  const character = options.target ? retargeted(played, options.target) : played;
  const { skeleton, space } = character;
  const take = playedTake(character);
  if (!skeleton) throw new CommandError(`${source.name} has no skeleton.`);
  if (!take) throw new CommandError(`${source.name} has no motion: no frames and no keys.`);
  const { frames, fps } = sampledAt(character, options.fps);
  if (frames.frameCount > Math.max(MAX_FRAMES, ownFrames(character)?.frameCount ?? 0)) {
    const count = frames.frameCount.toLocaleString('en');
    throw new CommandError(
      `The take would have ${count} frames, but the maximum is ${MAX_FRAMES.toLocaleString('en')}.`,
    );
  }
  return {
    character,
    skeleton,
    ...(space && !options.isRaw && { space }),
    frames,
    fps,
    ...croppedTo(frames, options.crop),
  };
}

/** The character with its shown take mirrored, over the ground of its space. @throws CommandError if it can't be */
function mirrored(character: Character): Character {
  const { skeleton, morphs, pose, takes, shownTake, space } = character;
  if (!skeleton || !takes[shownTake]) return character;
  const take = runToEnd(mirroringTake({ skeleton, morphs, pose }, takes[shownTake], space?.up));
  return { ...character, takes: takes.map((each, i) => (i === shownTake ? take : each)) };
}

/** @throws CommandError */
function retargeted(from: Character, { character, map }: RetargetTarget): Character {
  const { skeleton } = from;
  const pairs = map && skeleton && character.skeleton && pairsOf(map, character.skeleton, skeleton);
  const moved = retargetedTo(character, from, pairs);
  if (moved.driver?.pairs.length === 0) {
    throw new CommandError(
      `No joint of ${from.name} matches one of ${character.name}. Name the pairs in a map (--map).`,
    );
  }
  return moved;
}

function sampledAt(character: Character, asked: number | undefined): { readonly frames: Frames; readonly fps: number } {
  const take = playedTake(character);
  const rate = take && frameRateOf(take);
  if (!take || rate === undefined) {
    const fps = asked ?? DEFAULT_FPS;
    return { frames: framesOf(take?.range ?? [0, 0], fps), fps };
  }
  const own = framesOfTake(take, rate);
  if (asked === undefined) return { frames: own, fps: rate };
  // Frames of the file in a frame: whole where the rates allow it, so that nothing is interpolated. Not counted in
  // seconds: frames of 0.0333333 s are meant to be a thirtieth, and the last of them is part of the take.
  const whole = Math.max(1, Math.round(rate / asked));
  const step = Math.abs(rate / asked - whole) <= SAME_RATE * whole ? whole : rate / asked;
  const frameCount = Math.floor((own.frameCount - 1) / step + SAME_FRAME) + 1;
  return {
    frames: { startSeconds: own.startSeconds, frameSeconds: step * own.frameSeconds, frameCount },
    fps: asked,
  };
}

/** Times are of the nearest frames, both of which are part of the take. @throws CommandError if none is left */
function croppedTo(
  { startSeconds, frameSeconds, frameCount }: Frames,
  crop: Crop = {},
): Pick<ArrayTake, 'first' | 'count'> {
  const frameAt = (seconds: number | undefined, otherwise: number) =>
    seconds === undefined ? otherwise : Math.round((seconds - startSeconds) / frameSeconds);
  const first = Math.max(0, frameAt(crop.from, 0));
  const last = Math.min(frameCount - 1, frameAt(crop.to, frameCount - 1));
  if (last >= first) return { first, count: last - first + 1 };
  const seconds = (time: number) => `${Number(time.toFixed(3))} s`;
  throw new CommandError(
    `Nothing is left after cropping: the take is from ${seconds(startSeconds)} to ` +
      `${seconds(startSeconds + (frameCount - 1) * frameSeconds)}.`,
  );
}
