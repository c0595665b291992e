/**
 * Locks the feet of a take: during each contact with the ground (`evaluate/foot-contacts.ts`) the ball of the foot is
 * held still at its mean place, by the legs alone (`hold.ts`), with ease in and out while the foot is in the air. A
 * foot that hardly slides is left exactly as it is.
 */

import { contactSpans, feetOf, type JointPaths, standingHeight } from '../../evaluate/foot-contacts.ts';
import { compileSkeleton, worldMatrices } from '../../evaluate/kinematics.ts';
import { dofCountOf, poseFrom, poseSource } from '../../evaluate/pose.ts';
import { partsOf } from '../../evaluate/retarget/roles.ts';
import { metresPerUnit } from '../../evaluate/space/metres.ts';
import { applySpace } from '../../evaluate/space/space.ts';
import { type Steps, within } from '../../evaluate/steps.ts';
import type { Vec3 } from '../../math/vec3.ts';
import type { Character } from '../../model/document.ts';
import type { IkSetup } from '../../model/ik.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import type { Take } from '../../model/takes/take.ts';
import { CommandError } from '../command-error.ts';
import { takeAlone } from '../samples/take-alone.ts';
import { holding } from './hold.ts';

/** Options of locking feet. */
export interface FootLockOptions {
  /** Ease in before a contact and ease out after it, at most half of the time in the air. */
  readonly easeSeconds: number;
  /** A foot that stays within this distance of its place slides no further; metres. */
  readonly toleranceMetres: number;
  /** Frames to solve per second, for takes with keys. */
  readonly framesPerSecond: number;
}

/** One time that a foot is on the ground. */
export interface LockedContact {
  readonly joint: number;
  /** Seconds of the take. */
  readonly from: number;
  readonly to: number;
  /** How far the foot gets from its mean place; metres. */
  readonly slidesBefore: number;
}

/** A take with locked feet, and what was done. */
export interface LockedFeet {
  /** The same object if no foot slides. */
  readonly take: Take;
  /** All contacts, those that were left alone too. */
  readonly contacts: readonly LockedContact[];
  readonly locked: number;
  /** Frames in which a foot is out of reach of the leg, and only comes as near as it can. */
  readonly unreached: number;
}

/** Refuses a skeleton without legs, as a `CommandError`. */
export function* lockingFeet(
  character: Character,
  skeleton: Skeleton,
  take: Take,
  { easeSeconds, toleranceMetres, framesPerSecond }: FootLockOptions,
): Steps<LockedFeet> {
  const { balls, leg } = feetOf(skeleton, character.space);
  if (balls.length === 0) {
    throw new CommandError(`No legs were recognised in ${character.name}: each needs a thigh, a shin and a foot.`);
  }
  const paths = yield* within(trackingFeet(character, take, balls, framesPerSecond), 0, 0.1);
  const contacts = balls.map((joint, column) => {
    const spans = contactSpans(paths.metres, column, standingHeight(paths.metres, column), leg);
    return Array.from({ length: spans.length / 2 }, (_, i) =>
      contactOf(paths, column, joint, spans[2 * i], spans[2 * i + 1]),
    );
  });
  const all = contacts.flat();
  const sliding = all.filter(({ slidesBefore }) => slidesBefore > toleranceMetres);
  const ik = legsOnly(skeleton, character, balls);
  let made = take;
  let done = 0;
  let unreached = 0;
  for (const [column, own] of contacts.entries()) {
    for (const [i, contact] of own.entries()) {
      if (!sliding.includes(contact)) continue;
      const before = i > 0 ? contact.from - own[i - 1].to : Infinity;
      const after = i + 1 < own.length ? own[i + 1].from - contact.to : Infinity;
      const options = {
        range: [contact.from, contact.to] as const,
        framesPerSecond,
        // What eases into one contact may not move the foot in another.
        easeSeconds: Math.min(easeSeconds, before / 2, after / 2),
        tolerance: toleranceMetres / paths.metresPerUnit,
      };
      const pin = { id: 1, joint: balls[column], point: [0, 0, 0] as const, weight: 1, holdsOrientation: false };
      const holder = { ...takeAlone({ ...character, ik }, made), skeleton };
      const held = holding(holder, skeleton, made, [pin], [{ position: contact.place }], options);
      const from = 0.1 + (0.9 * done) / sliding.length;
      const result = yield* within(held, from, from + 0.9 / sliding.length);
      made = result.take;
      unreached += result.unreached;
      done++;
    }
  }
  return { take: made, contacts: all.toSorted((a, b) => a.from - b.from), locked: sliding.length, unreached };
}

interface FootPaths {
  readonly metres: JointPaths;
  /** The same points in the character's own space. */
  readonly own: Float64Array;
  readonly metresPerUnit: number;
}

const STEP_FRAMES = 128;

function* trackingFeet(
  character: Character,
  take: Take,
  balls: readonly number[],
  framesPerSecond: number,
): Steps<FootPaths> {
  const alone = takeAlone(character, take);
  const source = poseSource(alone);
  const compiled = source.skeleton ?? compileSkeleton({ name: '', joints: [] });
  const { samples } = take;
  const step = samples?.frameSeconds ?? 1 / framesPerSecond;
  const start = samples?.startSeconds ?? take.range[0];
  const count = samples?.frameCount ?? Math.floor((take.range[1] - start) / step + 1e-6) + 1;
  const points = new Float64Array(3 * count * balls.length);
  const own = new Float64Array(points.length);
  const dofs = new Float64Array(dofCountOf(alone));
  const world = new Float64Array(16 * compiled.jointCount);
  const p = new Float64Array(3);
  for (let f = 0; f < count; f++) {
    poseFrom(source, start + f * step, dofs);
    worldMatrices(compiled, dofs, world);
    balls.forEach((j, i) => {
      const at = 3 * (f * balls.length + i);
      own.set(world.subarray(16 * j + 12, 16 * j + 15), at);
      applySpace(character.space, own[at], own[at + 1], own[at + 2], p);
      points.set(p, at);
    });
    if (f % STEP_FRAMES === STEP_FRAMES - 1) yield f / count;
  }
  const metresPer = character.space ? metresPerUnit(character.space) : 1;
  return { metres: { count, start, step, width: balls.length, points }, own, metresPerUnit: metresPer };
}

function contactOf(
  { metres: { start, step, width }, own, metresPerUnit: metresPer }: FootPaths,
  column: number,
  joint: number,
  from: number,
  to: number,
): LockedContact & { readonly place: Vec3 } {
  const [first, last] = [from, to].map((seconds) => Math.round((seconds - start) / step));
  const at = (f: number, k: number) => own[3 * (f * width + column) + k];
  const place = [0, 0, 0];
  for (let f = first; f <= last; f++) for (let k = 0; k < 3; k++) place[k] += at(f, k) / (last - first + 1);
  let most = 0;
  for (let f = first; f <= last; f++) most = Math.max(most, Math.hypot(...place.map((v, k) => at(f, k) - v)));
  return { joint, from, to, slidesBefore: most * metresPer, place: [place[0], place[1], place[2]] };
}

/** IK in which only the legs move: everything above the thighs is locked. */
function legsOnly(skeleton: Skeleton, { space }: Character, balls: readonly number[]): IkSetup {
  const { single } = partsOf(skeleton, space?.up);
  const thighs = new Set([single.get('left thigh'), single.get('right thigh')]);
  const locked = new Set<number>();
  for (const ball of balls) {
    let isAbove = false;
    for (let j = ball; j >= 0; j = skeleton.joints[j].parent) {
      if (isAbove) locked.add(j);
      isAbove ||= thighs.has(j);
    }
  }
  return { pins: [], stiff: [...locked].sort((a, b) => a - b).map((joint) => ({ joint })), rootIsFree: false };
}
