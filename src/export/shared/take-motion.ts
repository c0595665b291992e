/**
 * A take as a function of time, whatever drives it: keys with extrapolation, samples, a retargeted take. Limits and
 * linked DOFs are applied.
 */

import { playedTake } from '../../evaluate/bake.ts';
import { inTakes } from '../../evaluate/in-takes.ts';
import { compileSkeleton } from '../../evaluate/kinematics.ts';
import { dofCountOf, poseFrom, poseSource } from '../../evaluate/pose.ts';
import type { Character } from '../../model/document.ts';
import { dofsOf } from '../../model/skeleton/joint-types.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { goalCurves, spacesOf } from '../../model/takes/goals.ts';
import { motionsOf } from '../../model/takes/layers.ts';
import type { Samples } from '../../model/takes/samples.ts';
import { baseOf, type KeyedChannel, repeats, type Take } from '../../model/takes/take.ts';
import { UserError } from '../../model/user-error.ts';
import type { WriteNodes } from './joint-nodes.ts';

/** A take by its numbers at any time. */
export interface TakeMotion {
  readonly name: string;
  /** Seconds of the take. */
  readonly start: number;
  readonly end: number;
  /** Times at which curves change their shape, ascending, from start to end. */
  readonly breaks: Float64Array;
  /** Those at which values may jump. */
  readonly jumps: ReadonlySet<number>;
  /** Whether joints move straight, or along an arc, between breaks: samples interpolated linearly, and nothing else. */
  readonly isStraight: boolean;
  /** Whether every channel is piecewise a cubic: driven by keys only. */
  readonly isKeyed: boolean;
  /** Frames per second of its samples; undefined without them. */
  readonly framesPerSecond: number | undefined;
  /** Writes the nodes' numbers and the morph weights at a time. */
  write(seconds: number, row: Float64Array): void;
}

/** The motion is too long or too dense to be written; a sentence that says what to do. */
export class TakeError extends UserError {
  override readonly name = 'TakeError';
}

/**
 * The character with each of its takes shown, or with the one of a name; with what is retargeted to it in place of
 * them.
 * @param only the name of the one that is written; undefined: all
 * @throws TakeError if there is none of that name
 */
export function playedTakes(character: Character, only: string | undefined): readonly Character[] {
  const { driver, takes } = character;
  const every = driver ? [character] : takes.map((_, shown) => ({ ...character, shownTake: shown }));
  const names = driver ? [driver.source.take.name] : takes.map(({ name }) => name);
  const played = every.filter((_, i) => only === undefined || names[i] === only);
  if (only !== undefined && played.length === 0) {
    const known = names.length ? `its takes are ${names.join(', ')}` : 'it has none';
    throw new TakeError(`${character.name} has no take ${only}; ${known}.`);
  }
  return played;
}

/** More breaks than this are a mistake: a cycle of a microsecond over an hour. */
const MAX_BREAKS = 4_000_000;

/**
 * The motion of the character's shown take, or of the take that is retargeted to it; undefined if it has none.
 * @param nodes writes a pose's joints
 * @param weightsAt where morph weights begin in a row
 */
export function takeMotion(character: Character, nodes: WriteNodes, weightsAt: number): TakeMotion | undefined {
  const take = playedTake(character);
  if (!take || !character.skeleton) return undefined;
  const source = poseSource({ ...inTakes(character), timeOffsetSeconds: 0 });
  const shift = character.driver?.source.timeOffsetSeconds ?? 0;
  const dofs = new Float64Array(dofCountOf(character));
  const firstWeight = dofs.length - character.morphs.length;
  const [start, end] = take.range;
  const { times, jumps } = breakTimes(character, take, start, end);
  const drives = character.driver !== undefined;
  const motions = motionsOf(take);
  const { samples } = baseOf(take);
  // A weight over time times a cubic is none.
  const isFaded = take.layers?.list.some(({ weight }) => typeof weight !== 'number') ?? false;
  // Limbs that are solved, and a root that follows another character, move along no cubics.
  const isOver = (take.goals ?? take.attached) !== undefined;
  const isKeyed = !drives && samples === undefined && !isFaded && !isOver;
  const hasKeys = motions.some(({ channels }) => channels.some(({ kind }) => kind === 'keys'));
  return {
    name: take.name,
    start,
    end,
    breaks: times,
    jumps,
    isStraight:
      !drives && !hasKeys && samples?.interpolation === 'linear' && !isOver && turnAsAWhole(character.skeleton),
    isKeyed,
    framesPerSecond: samples && 1 / samples.frameSeconds,
    write(seconds, row) {
      poseFrom(source, seconds - shift, dofs);
      nodes(dofs, row, 0);
      for (let m = firstWeight; m < dofs.length; m++) row[weightsAt + m - firstWeight] = dofs[m];
    },
  };
}

/** Whether each joint's rotation is interpolated along an arc, rather than two angles on their own. */
function turnAsAWhole(skeleton: Skeleton): boolean {
  const { turns } = compileSkeleton(skeleton);
  return skeleton.joints.every(({ motion, couples }, j) => {
    const angles = dofsOf(motion).filter(({ unit }) => unit === 'angle').length;
    return !couples && (angles < 2 || turns[3 * j] >= 0);
  });
}

interface Breaks {
  readonly times: Float64Array;
  readonly jumps: ReadonlySet<number>;
}

function breakTimes(character: Character, take: Take, start: number, end: number): Breaks {
  const found: number[] = [start, end];
  const jumps = new Set<number>();
  const see = (time: number, mayJump: boolean) => {
    if (!(time >= start && time <= end)) return;
    found.push(time);
    if (mayJump) jumps.add(time);
    if (found.length > MAX_BREAKS) {
      throw new TakeError(
        `${take.name} repeats its keys more than ${MAX_BREAKS.toLocaleString('en')} times in its range; shorten the range, or lengthen the cycle.`,
      );
    }
  };
  const seen: KeyedChannel[] = [];
  const weights = take.layers?.list.flatMap(({ weight }) => (typeof weight === 'number' ? [] : [weight])) ?? [];
  for (const channel of [...motionsOf(take).flatMap(({ channels }) => channels), ...weights, ...goalCurves(take)]) {
    if (channel.kind !== 'keys' || seen.some((other) => hasSameTimes(channel, other))) continue;
    seen.push(channel);
    seeKeys(channel, start, end, see);
  }
  // Goals may jump where their space changes.
  for (const [time] of take.goals?.list.flatMap(spacesOf) ?? []) see(time, true);
  // What is put down may jump, too, and between moves as its leader does.
  for (const time of take.attached?.list.flatMap(({ span }) => span) ?? []) see(time, true);
  for (const leader of take.attached ? (character.leaders ?? []) : []) {
    const own = playedTake(leader);
    const shift = leader.timeOffsetSeconds;
    if (!own) continue;
    const { times, jumps: jumping } = breakTimes(leader, own, start + shift, end + shift);
    for (const time of times) see(time - shift, jumping.has(time));
  }
  const { samples, channels } = baseOf(take);
  if (samples && channels.some(({ kind }) => kind === 'samples')) seeFrames(samples, start, end, see);
  return merged(Float64Array.from(new Set(found)).sort(), jumps);
}

/** Seconds: times that are nearer are one, computed in several ways. */
export const SAME_TIME = 1e-9;

/** The same without times that differ by rounding only; the first and the last one stay as they are. */
function merged(times: Float64Array, jumps: ReadonlySet<number>): Breaks {
  const last = times.length - 1;
  const own: number[] = [];
  const ownJumps = new Set<number>();
  times.forEach((time, i) => {
    const before = own.at(-1);
    if (before === undefined || time - before > SAME_TIME) own.push(time);
    else if (i === last && own.length > 1) {
      own[own.length - 1] = time;
      if (ownJumps.delete(before)) ownJumps.add(time);
    }
    if (jumps.has(time)) ownJumps.add(own[own.length - 1]);
  });
  return { times: Float64Array.from(own), jumps: ownJumps };
}

function hasSameTimes(a: KeyedChannel, b: KeyedChannel): boolean {
  if (a.extrapolateIn !== b.extrapolateIn || a.extrapolateOut !== b.extrapolateOut) return false;
  return a.times === b.times || (a.times.length === b.times.length && a.times.every((t, k) => t === b.times[k]));
}

type See = (time: number, mayJump: boolean) => void;

function seeKeys({ times, extrapolateIn, extrapolateOut }: KeyedChannel, start: number, end: number, see: See): void {
  const first = times[0];
  const last = times[times.length - 1];
  const isStep = (k: number) => times[k + 1] === times[k] || times[k - 1] === times[k];
  times.forEach((time, k) => {
    see(time, isStep(k));
  });
  const length = last - first;
  if (!(length > 0)) return;
  // The repetitions that the range covers, 0 being the keys themselves.
  const from = repeats(extrapolateIn) ? Math.floor((start - first) / length) : 0;
  const to = repeats(extrapolateOut) ? Math.ceil((end - last) / length) : 0;
  for (let period = from; period <= to; period++) {
    if (period === 0) continue;
    const mirrors = (period < 0 ? extrapolateIn : extrapolateOut) === 'bounce' && period % 2 !== 0;
    const shift = first + period * length;
    times.forEach((time, k) => {
      const since = mirrors ? last - time : time - first;
      see(shift + since, isStep(k) || k === 0 || k === times.length - 1);
    });
  }
  // A cycle may jump where it begins again.
  if (from < 0) see(first, true);
  if (to > 0) see(last, true);
}

function seeFrames(samples: Samples, start: number, end: number, see: See): void {
  const { frameCount, frameSeconds, startSeconds, interpolation } = samples;
  const isNearest = interpolation === 'nearest';
  const shift = isNearest ? 0.5 : 0;
  const first = Math.max(0, Math.floor((start - startSeconds) / frameSeconds) - 1);
  const last = Math.min(frameCount - 1, Math.ceil((end - startSeconds) / frameSeconds) + 1);
  for (let f = first; f <= last; f++) see(startSeconds + (f + shift) * frameSeconds, isNearest);
}
