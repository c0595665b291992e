/**
 * Finds when the source's feet are on the ground, and where the target's then belong.
 *
 * A foot is in contact while its ball (the toe joint, or the ankle if no toe is paired) is slow and low:
 *
 *     speed  < 0.35 leg lengths a second        height above its most frequent minimum  < 0.08 leg lengths
 *
 * for at least 0.08 s. The target's ball then follows the source's, in proportion, with an offset that is constant
 * during the contact, so that it slides no more than the source's does. The offset is the difference that rotations
 * alone give in the middle of the contact, so that feet stay as far apart as suits the hips. Between contacts it
 * changes smoothly, while the foot is in the air.
 *
 * The ground level is not constant within takes: inertial suits drift, and a foot may come down decimetres below its
 * previous contact. It would sink into a flat ground, so it is raised during the contact by its average depth. From
 * 0.17 leg lengths, the height of a stair, it counts as really standing lower.
 */
import { smoothstep } from '../../math/smoothstep.ts';
import { worldMatrices } from '../kinematics.ts';
import { type Bodies, driven } from './align.ts';
import type { RetargetFigure } from './figure.ts';
import { legLength } from './leg-length.ts';
import type { FootTrack, RetargetPlan } from './plan.ts';
import { solveFreely } from './solve.ts';
import { sourcePose } from './source-pose.ts';
import { toScene } from './travel.ts';

const SLOW = 0.35;
const LOW = 0.08;
const SHORTEST = 0.08;
/** A foot lower than this below its usual contact stands on something lower. */
const LEVEL = 0.17;
/** Shorter gaps are noise within a contact. */
const SHORTEST_GAP = 0.05;
/** Source samples per second, and the maximum in all. */
const RATE = 60;
const MAX_SAMPLES = 20000;
/** Percentile of all heights that counts as standing. */
const STANDING = 0.12;
/** Number of times in a contact at which the offset is measured. */
const MEASURED = 5;

/** The plan with ankle heights and foot contacts. */
export function footTracks(plain: RetargetPlan, bodies: Bodies, reference: RetargetFigure): RetargetPlan {
  const legs = plain.limbs.filter(({ part }) => part === 'leg');
  const length = legLength(bodies, reference, (t) => bodies.sourceOf[t]);
  if (!legs.length || !(length > 0)) return { ...plain, ground: groundOfHips(plain, bodies, reference) };
  const balls = legs.map((limb) => {
    const toe = driven(bodies, `${limb.side} toe`);
    return toe >= 0 ? toe : limb.end;
  });
  const joints = [...legs.map(({ end }) => bodies.sourceOf[end]), ...balls.map((b) => bodies.sourceOf[b])];
  const ways = sampleWays(plain, joints);
  const heightOf = (columns: readonly number[]) =>
    percentile(
      columns.flatMap((c) =>
        Array.from({ length: ways.count }, (_, f) => ways.points[(f * joints.length + c) * 3 + 1]),
      ),
      STANDING,
    );
  const count = legs.length;
  const columns = [...legs.keys()];
  const plan: RetargetPlan = {
    ...plain,
    ground: {
      carried: plain.ground.carried,
      ownHeight: standingHeight(
        bodies,
        legs.map(({ end }) => end),
      ),
      sourceHeight: heightOf(columns),
    },
  };
  const ownHeight = standingHeight(bodies, balls);
  const tracks = legs.map((limb, i): FootTrack => {
    const sourceHeight = heightOf([count + i]);
    const contacts = contactsOf(ways, count + i, joints.length, sourceHeight, length);
    const track = { limb, ball: balls[i], sourceBall: bodies.sourceOf[balls[i]], ownHeight, sourceHeight, contacts };
    return { ...track, ...offsetsOf(plan, track, length) };
  });
  return { ...plan, feet: tracks };
}

/** Positions of joints over the clip. */
interface Ways {
  readonly count: number;
  readonly start: number;
  readonly step: number;
  /** x y z per joint and sample; metres. */
  readonly points: Float64Array;
}

function sampleWays(plan: RetargetPlan, joints: readonly number[]): Ways {
  const [start, end] = plan.range;
  const count = Math.max(2, Math.min(MAX_SAMPLES, Math.ceil((end - start) * RATE) + 1));
  const step = (end - start) / (count - 1);
  const points = new Float64Array(3 * joints.length * count);
  const p = new Float64Array(3);
  for (let f = 0; f < count; f++) {
    sourcePose(plan.played, start + f * step, plan.dofs);
    worldMatrices(plan.source, plan.dofs, plan.sourceWorld);
    joints.forEach((j, i) => {
      for (let k = 0; k < 3; k++) p[k] = plan.sourceWorld[16 * j + 12 + k];
      toScene(plan.sourceSpace, p);
      points.set(p, 3 * (f * joints.length + i));
    });
  }
  return { count, start, step, points };
}

function contactsOf(ways: Ways, column: number, width: number, height: number, leg: number): Float64Array {
  const { count, start, step, points } = ways;
  if (!(step > 0)) return new Float64Array(0);
  const at = (f: number, k: number) => points[3 * (f * width + column) + k];
  const spans: [number, number][] = [];
  for (let f = 0; f < count; f++) {
    const [a, b] = [Math.max(0, f - 1), Math.min(count - 1, f + 1)];
    const way = Math.hypot(at(b, 0) - at(a, 0), at(b, 1) - at(a, 1), at(b, 2) - at(a, 2));
    const stands = way < SLOW * leg * step * (b - a) && at(f, 1) < height + LOW * leg;
    if (!stands) continue;
    const seconds = start + f * step;
    const last = spans.at(-1);
    if (last && seconds - last[1] <= Math.max(SHORTEST_GAP, 1.5 * step)) last[1] = seconds;
    else spans.push([seconds, seconds]);
  }
  return Float64Array.from(spans.filter(([from, to]) => to - from >= SHORTEST).flat());
}

/** The difference that rotations alone give between the target's ball and the source's, in proportion. */
function offsetsOf(
  plan: RetargetPlan,
  { ball, sourceBall, contacts, sourceHeight }: Omit<FootTrack, 'offsets' | 'rises'>,
  leg: number,
): Pick<FootTrack, 'offsets' | 'rises'> {
  const count = Math.max(1, contacts.length / 2);
  const out = new Float64Array(2 * count);
  const rises = new Float64Array(contacts.length / 2);
  const dofs = Float64Array.from(plan.restDofs);
  const p = new Float64Array(3);
  for (let c = 0; c < count; c++) {
    const from = contacts.length ? contacts[2 * c] : plan.range[0];
    const to = contacts.length ? contacts[2 * c + 1] : plan.range[1];
    let tooLow = 0;
    for (let i = 0; i < MEASURED; i++) {
      solveFreely(plan, from + ((to - from) * (i + 0.5)) / MEASURED, dofs);
      const { up, metres } = plan.targetSpace;
      const w = plan.targetWorld.subarray(16 * ball + 12, 16 * ball + 15);
      for (let k = 0; k < 3; k++) p[k] = plan.sourceWorld[16 * sourceBall + 12 + k];
      toScene(plan.sourceSpace, p);
      for (const [slot, k] of [
        [0, 0],
        [1, 2],
      ]) {
        const own = metres * (up[k] * w[0] + up[3 + k] * w[1] + up[6 + k] * w[2]);
        out[2 * c + slot] += (own - plan.scale * p[k]) / MEASURED;
      }
      tooLow += (sourceHeight - p[1]) / MEASURED;
    }
    if (c < rises.length && tooLow > 0 && tooLow < LEVEL * leg) rises[c] = plan.scale * tooLow;
  }
  return { offsets: out, rises };
}

/** How far a foot is raised at a time, metres: during the contact, fading before and after. */
export function riseAt({ contacts, rises }: FootTrack, seconds: number): number {
  const count = rises.length;
  let next = 0;
  let high = count;
  // The first contact that starts after that time.
  while (next < high) {
    const mid = (next + high) >> 1;
    if (contacts[2 * mid] <= seconds) next = mid + 1;
    else high = mid;
  }
  const past = next > 0 ? 1 - smoothstep(0, FADE, seconds - contacts[2 * next - 1]) : 0;
  const coming = next < count ? (1 - past) * (1 - smoothstep(0, FADE, contacts[2 * next] - seconds)) : 0;
  return (next > 0 ? past * rises[next - 1] : 0) + (next < count ? coming * rises[next] : 0);
}

/** Writes x z of the offset at a time to `out[0]` and `out[1]`. */
export function offsetAt({ contacts, offsets }: FootTrack, seconds: number, out: Float64Array): void {
  const count = contacts.length / 2;
  let next = 0;
  let high = count;
  // The first contact that starts after that time.
  while (next < high) {
    const mid = (next + high) >> 1;
    if (contacts[2 * mid] <= seconds) next = mid + 1;
    else high = mid;
  }
  const before = Math.max(0, next - 1);
  const after = Math.min(next, Math.max(0, count - 1));
  const t = before === after ? 0 : smoothstep(contacts[2 * before + 1], contacts[2 * after], seconds);
  for (let k = 0; k < 2; k++) out[k] = offsets[2 * before + k] + t * (offsets[2 * after + k] - offsets[2 * before + k]);
}

const FADE = 0.12;

/** 1 during a contact, decreasing within 0.12 s of it; 0 in the air. */
export function standing({ contacts }: FootTrack, seconds: number): number {
  let nearest = FADE;
  for (let low = 0, high = contacts.length / 2; low < high; ) {
    const mid = (low + high) >> 1;
    const from = contacts[2 * mid];
    const to = contacts[2 * mid + 1];
    if (seconds >= from && seconds <= to) return 1;
    nearest = Math.min(nearest, seconds < from ? from - seconds : seconds - to);
    if (seconds < from) high = mid;
    else low = mid + 1;
  }
  return 1 - smoothstep(0, FADE, nearest);
}

/** Height of the target's joints above its ground: the scene's, or the level where its feet end. */
function standingHeight({ rest, target }: Bodies, joints: readonly number[]): number {
  const y = (j: number) => rest.points[3 * j + 1];
  const height = Math.min(...joints.map(y));
  let low = Infinity;
  let high = -Infinity;
  target.joints.forEach(({ endSites }, j) => {
    low = Math.min(low, y(j));
    high = Math.max(high, y(j));
    for (const end of endSites ?? []) {
      const o = 9 * j;
      const { rotations: r } = rest;
      low = Math.min(low, y(j) + r[o + 1] * end[0] + r[o + 4] * end[1] + r[o + 7] * end[2]);
    }
  });
  // If the file pose stands on the scene's ground, that is the ground below soles without joints.
  return low > -0.01 * (high - low) && low < 0.1 * (high - low) ? height : height - low;
}

/** Without legs: by the hips, from their position in the reference to that at rest. */
function groundOfHips(plan: RetargetPlan, { rest, sourceOf }: Bodies, reference: RetargetFigure) {
  const [joint] = plan.ground.carried;
  if (joint === undefined) return plan.ground;
  return {
    carried: plan.ground.carried,
    ownHeight: rest.points[3 * joint + 1],
    sourceHeight: reference.points[3 * sourceOf[joint] + 1],
  };
}

/** Of the finite numbers; at least one is. */
function percentile(values: readonly number[], part: number): number {
  const sorted = values.filter(Number.isFinite).sort((a, b) => a - b);
  return sorted[Math.round(part * (sorted.length - 1))] ?? 0;
}
