/**
 * Two-bone IK for the legs, to place the feet: two bones of known lengths between two known points leave one free angle
 * about the line between them; the knee stays on the side to which it pointed.
 *
 *     hip ─ l₁ ─ knee ─ l₂ ─ ankle        knee = hip + x·u + y·k        x = (l₁² − l₂² + D²)/2D        y = √(l₁² − x²)
 *
 * with u the direction to the ankle at distance D, and k perpendicular to it. The foot keeps its rotation. If a foot in
 * contact is out of reach, the hips are lowered; a foot in the air is not placed instead.
 */
import { copy3, multiply3, swing, turnVector } from '../../math/mat3.ts';
import { offsetAt, riseAt, standing } from './contacts.ts';
import { rollLimb } from './limbs.ts';
import type { FootTrack, RetargetPlan } from './plan.ts';
import { fitRange } from './solve.ts';
import { fromScene, inProportion, moveBy, toScene } from './travel.ts';

/** Fraction of the leg's length: never quite straight, or the knee would snap at the end. */
const REACH = 0.9995;

/** Scratch; never escapes: target positions of ankles, x y z per leg. */
const ankles = new Float64Array(6);
const point = new Float64Array(3);
const offset = new Float64Array(2);
const u = new Float64Array(3);
const k = new Float64Array(3);
const bone = new Float64Array(3);
const toBone = new Float64Array(3);
const turn = new Float64Array(9);
const before = new Float64Array(9);

/** Adjusts the DOFs of the legs and the height of the hips, after a pose without foot placement. */
export function plantFeet(plan: RetargetPlan, clipSeconds: number, out: Float64Array): void {
  const { feet, wanted, bones, target } = plan;
  for (let i = 0; i < feet.length; i++) ankleOf(plan, feet[i], clipSeconds, 3 * i);
  lower(plan, clipSeconds, out);
  for (let i = 0; i < feet.length; i++) {
    const { limb } = feet[i];
    bendLeg(plan, feet[i], 3 * i);
    rollLimb(limb, bones, wanted);
    fitRange(plan, limb.upper, target.subtreeEnd[limb.upper], out);
  }
}

/** The target of the ball, and from it that of the ankle; the foot's rotation must be final. */
function ankleOf(plan: RetargetPlan, foot: FootTrack, seconds: number, o: number): void {
  const { sourceWorld, targetWorld } = plan;
  for (let i = 0; i < 3; i++) point[i] = sourceWorld[16 * foot.sourceBall + 12 + i];
  toScene(plan.sourceSpace, point);
  inProportion(plan, point, foot.ownHeight, foot.sourceHeight);
  offsetAt(foot, seconds, offset);
  point[0] += offset[0];
  point[1] += riseAt(foot, seconds);
  point[2] += offset[1];
  fromScene(plan.targetSpace, point);
  const ball = 16 * foot.ball + 12;
  const ankle = 16 * foot.limb.end + 12;
  for (let i = 0; i < 3; i++) ankles[o + i] = point[i] + targetWorld[ankle + i] - targetWorld[ball + i];
}

function lengthOf(plan: RetargetPlan, from: number, to: number): number {
  const w = plan.targetWorld;
  const a = 16 * from + 12;
  const b = 16 * to + 12;
  return Math.sqrt((w[b] - w[a]) ** 2 + (w[b + 1] - w[a + 1]) ** 2 + (w[b + 2] - w[a + 2]) ** 2);
}

/** Lowers the hips until feet in contact can be reached. */
function lower(plan: RetargetPlan, seconds: number, out: Float64Array): void {
  const { feet, targetWorld, targetSpace } = plan;
  const up = targetSpace.up;
  let drop = 0;
  for (let i = 0; i < feet.length; i++) {
    const stands = standing(feet[i], seconds);
    if (stands === 0) continue;
    const { upper, lower: knee, end } = feet[i].limb;
    const reach = REACH * (lengthOf(plan, upper, knee) + lengthOf(plan, knee, end));
    let height = 0;
    let square = 0;
    for (let c = 0; c < 3; c++) {
      const way = targetWorld[16 * upper + 12 + c] - ankles[3 * i + c];
      // The scene's y in the target's own axes is row 1 of Up.
      height += way * up[3 * c + 1];
      square += way * way;
    }
    const across = square - height * height;
    if (square <= reach * reach || across >= reach * reach || height <= 0) continue;
    drop = Math.max(drop, stands * (height - Math.sqrt(reach * reach - across)));
  }
  if (drop > 0) moveBy(plan, -drop * up[1], -drop * up[4], -drop * up[7], out);
}

function bendLeg(plan: RetargetPlan, { limb }: FootTrack, o: number): void {
  const { wanted, bones, targetWorld } = plan;
  const { upper, lower: shin, end } = limb;
  const hip = 16 * upper + 12;
  const l1 = lengthOf(plan, upper, shin);
  const l2 = lengthOf(plan, shin, end);
  let far = 0;
  for (let i = 0; i < 3; i++) {
    u[i] = ankles[o + i] - targetWorld[hip + i];
    far += u[i] * u[i];
  }
  far = Math.sqrt(far);
  if (!(far > 0 && l1 > 0 && l2 > 0)) return;
  for (let i = 0; i < 3; i++) u[i] /= far;
  const reached = Math.min(REACH * (l1 + l2), Math.max(Math.abs(l1 - l2) * (2 - REACH), far));
  // The knee's side: where it pointed; for a straight leg, the front of the thigh.
  turnVector(wanted, 9 * upper, bones, 3 * upper, bone, 0);
  turnVector(wanted, 9 * shin, bones, 3 * shin, toBone, 0);
  let across = 0;
  for (let i = 0; i < 3; i++) k[i] = l1 * bone[i];
  frontOf(plan, limb.upper);
  for (let i = 0; i < 3; i++) k[i] += 0.02 * l1 * point[i];
  let along = k[0] * u[0] + k[1] * u[1] + k[2] * u[2];
  // Relative to the previous line from hip to ankle.
  const wasX = l1 * bone[0] + l2 * toBone[0];
  const wasY = l1 * bone[1] + l2 * toBone[1];
  const wasZ = l1 * bone[2] + l2 * toBone[2];
  const was = Math.sqrt(wasX * wasX + wasY * wasY + wasZ * wasZ);
  if (was > 0) {
    const t = (k[0] * wasX + k[1] * wasY + k[2] * wasZ) / (was * was);
    k[0] -= t * wasX;
    k[1] -= t * wasY;
    k[2] -= t * wasZ;
    along = k[0] * u[0] + k[1] * u[1] + k[2] * u[2];
  }
  for (let i = 0; i < 3; i++) {
    k[i] -= along * u[i];
    across += k[i] * k[i];
  }
  across = Math.sqrt(across);
  if (!(across > 0)) return;
  const x = (l1 * l1 - l2 * l2 + reached * reached) / (2 * reached);
  const y = Math.sqrt(Math.max(0, l1 * l1 - x * x)) / across;
  for (let i = 0; i < 3; i++) point[i] = x * u[i] + y * k[i];
  turnTo(wanted, upper, bone, point);
  for (let i = 0; i < 3; i++) point[i] = reached * u[i] - point[i];
  turnTo(wanted, shin, toBone, point);
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
