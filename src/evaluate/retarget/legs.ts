/**
 * Two-bone IK for the legs, to place the feet: two bones of known lengths between two known points leave one free angle
 * about the line between them; the knee stays on the side to which it pointed.
 *
 *     hip ─ l₁ ─ knee ─ l₂ ─ ankle        knee = hip + x·u + y·k        x = (l₁² − l₂² + D²)/2D        y = √(l₁² − x²)
 *
 * with u the direction to the ankle at distance D, and k perpendicular to it. The foot keeps its rotation. The hips
 * have gone to meet both feet before (`hips.ts`). A leg whose foot is in place already is left exactly as it is.
 */
import { copy3, multiply3, swing, turnVector } from '../../math/mat3.ts';
import { smoothstep } from '../../math/smoothstep.ts';
import { riseAt, standing } from './contacts.ts';
import { median } from './ground.ts';
import { hipsMovedAt } from './hips.ts';
import { type Limb, rollLimb } from './limbs.ts';
import { wayOfFoot } from './places.ts';
import type { FootTrack, RetargetPlan } from './plan.ts';
import { fitRange, solveFreely } from './solve.ts';
import { moveBy } from './travel.ts';

/** Fraction of the leg's length: never quite straight, or the knee would snap at the end; unless the source's is. */
const REACH = 0.9995;
/** How far the front of the thigh counts for the side of a knee that has to bend, in lengths of the thigh. */
const FRONT = 0.02;

/** To which fraction of its way a foot is brought as far as that allows. */
const EXACTLY = 1e-4;

/** Scratch; never escapes. */
const point = new Float64Array(3);
/** From where the foot is to where it belongs. */
const off = new Float64Array(3);
const u = new Float64Array(3);
const k = new Float64Array(3);
const bone = new Float64Array(3);
const toBone = new Float64Array(3);
let thighLength = 0;
let shinLength = 0;
/** Unit vectors along thigh and shin, as they have to be. */
const thighWay = new Float64Array(3);
const shinWay = new Float64Array(3);
const turn = new Float64Array(9);
const before = new Float64Array(9);

/** Moves the hips and bends the legs, after a pose without foot placement. */
export function plantFeet(plan: RetargetPlan, takeSeconds: number, out: Float64Array): void {
  const { feet, wanted, bones, target } = plan;
  moveHips(plan, takeSeconds, out);
  for (let i = 0; i < feet.length; i++) {
    const { limb } = feet[i];
    if (!bendLeg(plan, feet[i], takeSeconds)) continue;
    rollLimb(limb, bones, wanted);
    fitRange(plan, limb.upper, target.subtreeEnd[limb.upper], out);
  }
}

function moveHips(plan: RetargetPlan, seconds: number, out: Float64Array): void {
  if (!plan.hips) return;
  hipsMovedAt(plan.hips, seconds, point);
  moveBy(plan, point[0], point[1], point[2], out);
}

/** Number of times examined, evenly over the take. */
const MOMENTS = 128;
/** The angle that thighs and shins may be off in half of a take, and for a foot that stands once in a while; radians. */
const USUAL = Math.PI / 36;
const MOST = Math.PI / 4;
/** In the air, where a foot has no place to keep. */
const IN_THE_AIR = Math.PI / 60;
/** Seconds in which it becomes that: a leg that let go sooner would put its foot down again before that has swung. */
const LIFTING = 0.2;

/**
 * The feet, each with how far the bones of its leg may turn for it: the less the more they would have to all the time.
 * Once in a while a knee may bend for a foot; one that did so in half of the take would be another way of walking.
 * @param plan with its hips
 */
export function limitedTurns(plan: RetargetPlan): readonly FootTrack[] {
  const [start, end] = plan.range;
  const count = end > start ? MOMENTS : 1;
  const dofs = Float64Array.from(plan.restDofs);
  const turned = plan.feet.map(() => new Float64Array(count));
  for (let i = 0; i < count; i++) {
    const seconds = start + ((end - start) * i) / Math.max(1, count - 1);
    solveFreely(plan, seconds, dofs);
    moveHips(plan, seconds, dofs);
    plan.feet.forEach((foot, f) => {
      const angle = measureLeg(plan, foot, seconds) ? Math.acos(Math.min(1, aim(plan, foot.limb, 1))) : 0;
      turned[f][i] = standing(foot, seconds) > 0 ? angle : Math.min(IN_THE_AIR, angle);
    });
  }
  return plan.feet.map((foot, f) => {
    const usual = median(Array.from(turned[f]));
    return { ...foot, turns: USUAL + (MOST - USUAL) * (1 - smoothstep(IN_THE_AIR, USUAL, usual)) };
  });
}

function lengthOf(w: Float64Array, from: number, to: number): number {
  const a = 16 * from + 12;
  const b = 16 * to + 12;
  return Math.sqrt((w[b] - w[a]) ** 2 + (w[b + 1] - w[a + 1]) ** 2 + (w[b + 2] - w[a + 2]) ** 2);
}

/** How far the leg may be straightened, as a fraction of its length. */
function reachOf({ sourceOf, sourceWorld }: RetargetPlan, { upper, lower: knee, end }: Limb): number {
  const [a, b, c] = [sourceOf[upper], sourceOf[knee], sourceOf[end]];
  const length = lengthOf(sourceWorld, a, b) + lengthOf(sourceWorld, b, c);
  return length > 0 ? Math.max(REACH, lengthOf(sourceWorld, a, c) / length) : REACH;
}

/** A foot closer than this to where it belongs is there; fraction of the leg's length. */
const THERE = 1e-9;

/** Whether the leg changes. */
function bendLeg(plan: RetargetPlan, foot: FootTrack, seconds: number): boolean {
  const { wanted } = plan;
  const { limb } = foot;
  if (!measureLeg(plan, foot, seconds)) return false;
  const turns = Math.cos(IN_THE_AIR + standing(foot, seconds, LIFTING) * (foot.turns - IN_THE_AIR));
  if (aim(plan, limb, 1) < turns) {
    // Part of the straight way there: over the ground first and then up, small changes would make knees jump.
    let way = 0;
    for (let step = 0.5; step > EXACTLY; step /= 2) if (aim(plan, limb, way + step) >= turns) way += step;
    aim(plan, limb, way);
  }
  turnTo(wanted, limb.upper, bone, thighWay);
  turnTo(wanted, limb.lower, toBone, shinWay);
  return true;
}

/** Finds the bones of a leg, and its foot's way; false if there is none to go. */
function measureLeg(plan: RetargetPlan, foot: FootTrack, seconds: number): boolean {
  const { targetWorld } = plan;
  const { upper, lower: shin, end } = foot.limb;
  thighLength = lengthOf(targetWorld, upper, shin);
  shinLength = lengthOf(targetWorld, shin, end);
  if (!(thighLength > 0 && shinLength > 0)) return false;
  wayOfFoot(plan, foot, seconds, riseAt(foot, seconds), off);
  if (norm(off) < THERE * (thighLength + shinLength)) return false;
  boneNow(plan, upper, shin, thighLength, bone);
  boneNow(plan, shin, end, shinLength, toBone);
  return true;
}

/**
 * Finds the directions of thigh and shin that bring the ankle of a measured leg nearer to its place.
 * @param way the fraction of the way to there
 * @returns the cosine of the angle of the one that turns further
 */
function aim(plan: RetargetPlan, limb: Limb, way: number): number {
  const { targetWorld } = plan;
  const [l1, l2] = [thighLength, shinLength];
  const { upper, end } = limb;
  for (let i = 0; i < 3; i++) {
    u[i] = targetWorld[16 * end + 12 + i] + way * off[i] - targetWorld[16 * upper + 12 + i];
    thighWay[i] = bone[i];
    shinWay[i] = toBone[i];
  }
  const far = norm(u);
  if (!(far > 0)) return 1;
  for (let i = 0; i < 3; i++) u[i] /= far;
  const reached = Math.min(reachOf(plan, limb) * (l1 + l2), Math.max(Math.abs(l1 - l2) * (2 - REACH), far));
  const x = (l1 * l1 - l2 * l2 + reached * reached) / (2 * reached);
  const y = Math.sqrt(Math.max(0, l1 * l1 - x * x));
  // The knee's side: where it pointed, relative to the previous line from hip to ankle.
  const wasX = l1 * bone[0] + l2 * toBone[0];
  const wasY = l1 * bone[1] + l2 * toBone[1];
  const wasZ = l1 * bone[2] + l2 * toBone[2];
  const was = wasX * wasX + wasY * wasY + wasZ * wasZ;
  const t = was > 0 ? (l1 * (bone[0] * wasX + bone[1] * wasY + bone[2] * wasZ)) / was : 0;
  k[0] = l1 * bone[0] - t * wasX;
  k[1] = l1 * bone[1] - t * wasY;
  k[2] = l1 * bone[2] - t * wasZ;
  let across = clear(k);
  // A knee that has to bend further than it did does so towards the front: a nearly straight leg shows no other side.
  const more = Math.min(FRONT * l1, y - across);
  if (more > 0) {
    frontOf(plan, upper);
    clear(point);
    for (let i = 0; i < 3; i++) k[i] += more * point[i];
    across = clear(k);
  }
  if (!(across > 0)) return 1;
  let thighCos = 0;
  let shinCos = 0;
  for (let i = 0; i < 3; i++) {
    const knee = x * u[i] + (y / across) * k[i];
    thighWay[i] = knee / l1;
    shinWay[i] = (reached * u[i] - knee) / l2;
    thighCos += thighWay[i] * bone[i];
    shinCos += shinWay[i] * toBone[i];
  }
  return Math.min(thighCos, shinCos);
}

function norm(v: Float64Array): number {
  return Math.sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/** Makes a vector perpendicular to `u`, and returns its length. */
function clear(v: Float64Array): number {
  const along = v[0] * u[0] + v[1] * u[1] + v[2] * u[2];
  for (let i = 0; i < 3; i++) v[i] -= along * u[i];
  return Math.sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/** Direction in which the wanted rotation points the bone from one joint to another, by where that one is now. */
function boneNow(
  { wanted, targetWorld: w }: RetargetPlan,
  from: number,
  to: number,
  length: number,
  out: Float64Array,
) {
  const a = 16 * from;
  const b = 16 * to + 12;
  const x = (w[b] - w[a + 12]) / length;
  const y = (w[b + 1] - w[a + 13]) / length;
  const z = (w[b + 2] - w[a + 14]) / length;
  for (let i = 0; i < 3; i++) out[i] = w[a + 4 * i] * x + w[a + 4 * i + 1] * y + w[a + 4 * i + 2] * z;
  // A scaled joint's columns are as long as its scale.
  const along = Math.sqrt(out[0] * out[0] + out[1] * out[1] + out[2] * out[2]);
  for (let i = 0; i < 3; i++) out[i] /= along;
  turnVector(wanted, 9 * from, out, 0, out, 0);
}

/** The front of the body as rotated by the thigh, to `point`: z in the scene when the target is at rest. */
function frontOf(plan: RetargetPlan, thigh: number): void {
  turnVector(plan.wanted, 9 * thigh, plan.fronts, 3 * thigh, point, 0);
}

function turnTo(wanted: Float64Array, j: number, from: Float64Array, to: Float64Array): void {
  swing(from, 0, to, 0, turn, 0);
  copy3(wanted, 9 * j, before, 0);
  multiply3(turn, 0, before, 0, wanted, 9 * j);
}
