/**
 * Finds when the source's feet are on the ground (`foot-contacts.ts`), and where the target's then belong.
 *
 * The target's ball (the toe joint, or the ankle if no toe is paired) then follows the source's, in proportion, with an
 * offset that is constant during the contact, so that it slides no more than the source's does. Over the ground the
 * offset is the difference that rotations alone give during the contact, so that feet stay as far apart as suits the
 * hips; upwards it makes soles equally high. Between contacts it changes smoothly, while the foot is in the air.
 *
 * The ground level is not constant within takes: inertial suits drift, and a foot may come down decimetres below its
 * previous contact. It would sink into a flat ground, so it is raised during the contact by its average depth. From
 * 0.17 leg lengths, the height of a stair, it counts as really standing lower. On its own skeleton a take stays as it
 * is, drift included.
 */
import { smoothstep } from '../../math/smoothstep.ts';
import { contactSpans, type JointPaths, standingHeight } from '../foot-contacts.ts';
import { worldMatrices } from '../kinematics.ts';
import { type Bodies, driven, sourceBody } from './align.ts';
import type { RetargetBody } from './body.ts';
import { depthOfLowest, median, type Soles, shiftOfHips, soleHeight, soleOf } from './ground.ts';
import { legLength } from './leg-length.ts';
import type { FootTrack, RetargetPlan } from './plan.ts';
import { solveFreely } from './solve.ts';
import { sourcePose } from './source-pose.ts';
import { toScene } from './travel.ts';

/** A foot lower than this below its usual contact stands on something lower. */
const LEVEL = 0.17;
/** Legs of unequal lengths in a file make one foot stand higher than the other: by up to this, of a leg's length. */
const LEVEL_FEET = 0.02;
/** Source samples per second, and the maximum in all. */
const RATE = 60;
const MAX_SAMPLES = 20000;
/** Number of times in a contact at which the offset is measured. */
const MEASURED = 5;

/** The plan with its height above the ground and foot contacts. */
export function footTracks(plain: RetargetPlan, bodies: Bodies, reference: RetargetBody): RetargetPlan {
  const legs = plain.limbs.filter(({ part }) => part === 'leg');
  const length = legLength(bodies, reference, (t) => bodies.sourceOf[t]);
  if (!legs.length || !(length > 0)) return { ...plain, shift: shiftOfHips(plain, bodies, reference) };
  const soles = legs.map(({ end }): Soles => {
    const { source, sourceSpace, target, targetSpace, sourceOf } = bodies;
    return {
      own: soleOf(target, targetSpace, bodies.roles.rest, end),
      source: soleOf(source, sourceSpace, sourceBody(bodies), sourceOf[end]),
    };
  });
  const balls = legs.map((limb) => {
    const toe = driven(bodies, `${limb.side} toe`);
    return toe >= 0 ? toe : limb.end;
  });
  const joints = balls.map((b) => bodies.sourceOf[b]);
  const ways = sampleWays(plain, joints);
  const depths: number[] = [];
  const standing = legs.flatMap((limb, i) => {
    const sourceHeight = standingHeight(ways, i);
    const contacts = contactSpans(ways, i, sourceHeight, length);
    if (contacts.length === 0) return [];
    return [{ track: { limb, ball: balls[i], sourceBall: joints[i], sourceHeight, contacts }, soles: soles[i] }];
  });
  const areSame = plain.sameBones.lengths;
  const usual = standing.map(({ track, soles }) => usualHeight(plain, track.contacts, soles.source));
  const raised = areSame ? usual.map(() => 0) : unevenness(usual, LEVEL_FEET * length);
  const feet = standing.map(({ track, soles }, i): FootTrack => {
    const level = areSame ? 0 : LEVEL * length;
    return { ...track, ...offsetsOf(plain, track, soles, raised[i], level, depths), turns: Math.PI };
  });
  return { ...plain, feet, shift: feet.length ? median(depths) : depthOfLowest(plain, soles) };
}

/** The height of the source's sole in contacts: the median. */
function usualHeight(plan: RetargetPlan, contacts: Float64Array, sole: Soles['source']): number {
  return median(
    Array.from({ length: contacts.length / 2 }, (_, c) => {
      sourcePose(plan.played, (contacts[2 * c] + contacts[2 * c + 1]) / 2, plan.dofs);
      worldMatrices(plan.source, plan.dofs, plan.sourceWorld);
      return soleHeight(sole, plan.sourceWorld, plan.sourceSpace);
    }),
  );
}

/** How much each foot stands above the middle of both; 0 if they don't stand on one level. */
function unevenness(heights: readonly number[], most: number): readonly number[] {
  const middle = (Math.min(...heights) + Math.max(...heights)) / 2;
  return heights.map((height) => (Math.abs(height - middle) < most ? height - middle : 0));
}

function sampleWays(plan: RetargetPlan, joints: readonly number[]): JointPaths {
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
  return { count, start, step, width: joints.length, points };
}

/**
 * The difference that rotations alone give between the target's ball and the source's, in proportion; but soles are
 * equally high.
 * @param plan without a shift
 * @param raised metres by which the source's foot usually stands above the middle of both
 * @param level metres; a foot that is this much lower than usual is not raised
 * @param depths receives how much too low the target's sole is in these poses; metres
 */
function offsetsOf(
  plan: RetargetPlan,
  { ball, sourceBall, contacts, sourceHeight }: Omit<FootTrack, 'offsets' | 'rises' | 'turns'>,
  soles: Soles,
  raised: number,
  level: number,
  depths: number[],
): Pick<FootTrack, 'offsets' | 'rises'> {
  const count = contacts.length / 2;
  const out = new Float64Array(3 * count);
  const rises = new Float64Array(count);
  const dofs = Float64Array.from(plan.restDofs);
  const own = new Float64Array(3);
  const other = new Float64Array(3);
  for (let c = 0; c < count; c++) {
    const [from, to] = [contacts[2 * c], contacts[2 * c + 1]];
    let tooLow = 0;
    for (let i = 0; i < MEASURED; i++) {
      solveFreely(plan, from + ((to - from) * (i + 0.5)) / MEASURED, dofs);
      for (let k = 0; k < 3; k++) {
        own[k] = plan.targetWorld[16 * ball + 12 + k];
        other[k] = plan.sourceWorld[16 * sourceBall + 12 + k];
      }
      toScene(plan.targetSpace, own);
      toScene(plan.sourceSpace, other);
      tooLow += (sourceHeight - other[1]) / MEASURED;
      const sole = soleHeight(soles.own, plan.targetWorld, plan.targetSpace);
      const sourceSole = soleHeight(soles.source, plan.sourceWorld, plan.sourceSpace) - raised;
      depths.push(plan.scale * sourceSole - sole);
      own[1] -= sole;
      other[1] -= sourceSole;
      for (let k = 0; k < 3; k++) out[3 * c + k] += (own[k] - plan.scale * other[k]) / MEASURED;
    }
    if (tooLow > 0 && tooLow < level) rises[c] = plan.scale * tooLow;
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

/** Writes x y z of the offset at a time. */
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
  const after = Math.min(next, count - 1);
  const t = before === after ? 0 : smoothstep(contacts[2 * before + 1], contacts[2 * after], seconds);
  for (let k = 0; k < 3; k++) out[k] = offsets[3 * before + k] + t * (offsets[3 * after + k] - offsets[3 * before + k]);
}

const FADE = 0.12;

/** 1 during a contact, decreasing within some seconds of it, 0.12 by default; 0 in the air. */
export function standing({ contacts }: FootTrack, seconds: number, fade = FADE): number {
  let nearest = fade;
  for (let low = 0, high = contacts.length / 2; low < high; ) {
    const mid = (low + high) >> 1;
    const from = contacts[2 * mid];
    const to = contacts[2 * mid + 1];
    if (seconds >= from && seconds <= to) return 1;
    nearest = Math.min(nearest, seconds < from ? from - seconds : seconds - to);
    if (seconds < from) high = mid;
    else low = mid + 1;
  }
  return 1 - smoothstep(0, fade, nearest);
}
