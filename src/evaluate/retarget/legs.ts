/**
 * Two-bone IK for the legs, to place the feet: two bones of known lengths between two known points leave one free angle
 * about the line between them; the knee stays on the side to which it pointed.
 *
 *     hip ─ l₁ ─ knee ─ l₂ ─ ankle        knee = hip + x·u + y·k        x = (l₁² − l₂² + D²)/2D        y = √(l₁² − x²)
 *
 * with u the direction to the ankle at distance D, and k perpendicular to it. The foot keeps its rotation. If a foot in
 * contact is out of reach, the hips are lowered; a foot in the air is not placed instead. A leg whose foot is in place
 * already is left exactly as it is.
 */
import { copy3, multiply3, swing, turnVector } from '../../math/mat3.ts';
import { offsetAt, riseAt, standing } from './contacts.ts';
import { type Limb, rollLimb } from './limbs.ts';
import type { FootTrack, RetargetPlan } from './plan.ts';
import { fitRange } from './solve.ts';
import { fromScene, inProportion, moveBy, toScene } from './travel.ts';

/** Fraction of the leg's length: never quite straight, or the knee would snap at the end; unless the source's is. */
const REACH = 0.9995;
/**
 * How far a foot may be above or below where it belongs, as a fraction of the leg's length: 5 mm, to reach which a straight
 * knee would have to bend by 12°.
 */
const SLACK = 0.006;
/** How far the front of the thigh counts for the side of a knee that has to bend, in lengths of the thigh. */
const FRONT = 0.02;

/** Scratch; never escapes: target positions of ankles, x y z per leg. */
const ankles = new Float64Array(6);
const point = new Float64Array(3);
const offset = new Float64Array(3);
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
    if (!bendLeg(plan, feet[i], 3 * i)) continue;
    rollLimb(limb, bones, wanted);
    fitRange(plan, limb.upper, target.subtreeEnd[limb.upper], out);
  }
}

/** The target of the ball, and from it that of the ankle; the foot's rotation must be final. */
function ankleOf(plan: RetargetPlan, foot: FootTrack, seconds: number, o: number): void {
  const { sourceWorld, targetWorld } = plan;
  const { up } = plan.targetSpace;
  for (let i = 0; i < 3; i++) point[i] = sourceWorld[16 * foot.sourceBall + 12 + i];
  toScene(plan.sourceSpace, point);
  inProportion(plan, point);
  offsetAt(foot, seconds, offset);
  for (let i = 0; i < 3; i++) point[i] += offset[i];
  point[1] += riseAt(foot, seconds);
  fromScene(plan.targetSpace, point);
  const ball = 16 * foot.ball + 12;
  const ankle = 16 * foot.limb.end + 12;
  let off = 0;
  for (let i = 0; i < 3; i++) {
    point[i] -= targetWorld[ball + i];
    off += point[i] * up[3 * i + 1];
  }
  // What is nearly high enough stays as high as it is.
  const { upper, lower: knee, end } = foot.limb;
  const slack = SLACK * (lengthOf(targetWorld, upper, knee) + lengthOf(targetWorld, knee, end));
  const kept = Math.min(slack, Math.max(-slack, off));
  for (let i = 0; i < 3; i++) ankles[o + i] = targetWorld[ankle + i] + point[i] - kept * up[3 * i + 1];
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

/** Lowers the hips until feet in contact can be reached. */
function lower(plan: RetargetPlan, seconds: number, out: Float64Array): void {
  const { feet, targetWorld, targetSpace } = plan;
  const up = targetSpace.up;
  let drop = 0;
  for (let i = 0; i < feet.length; i++) {
    const stands = standing(feet[i], seconds);
    if (stands === 0) continue;
    const { upper, lower: knee, end } = feet[i].limb;
    const length = lengthOf(targetWorld, upper, knee) + lengthOf(targetWorld, knee, end);
    const reach = reachOf(plan, feet[i].limb) * length;
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

/** A foot closer than this to where it belongs is there; fraction of the leg's length. */
const THERE = 1e-9;

/** Whether the leg changes. */
function bendLeg(plan: RetargetPlan, { limb }: FootTrack, o: number): boolean {
  const { wanted, targetWorld } = plan;
  const { upper, lower: shin, end } = limb;
  const hip = 16 * upper + 12;
  const l1 = lengthOf(targetWorld, upper, shin);
  const l2 = lengthOf(targetWorld, shin, end);
  let off = 0;
  for (let i = 0; i < 3; i++) off = Math.max(off, Math.abs(ankles[o + i] - targetWorld[16 * end + 12 + i]));
  if (off < THERE * (l1 + l2)) return false;
  let far = 0;
  for (let i = 0; i < 3; i++) {
    u[i] = ankles[o + i] - targetWorld[hip + i];
    far += u[i] * u[i];
  }
  far = Math.sqrt(far);
  if (!(far > 0 && l1 > 0 && l2 > 0)) return false;
  for (let i = 0; i < 3; i++) u[i] /= far;
  const reached = Math.min(reachOf(plan, limb) * (l1 + l2), Math.max(Math.abs(l1 - l2) * (2 - REACH), far));
  const x = (l1 * l1 - l2 * l2 + reached * reached) / (2 * reached);
  const y = Math.sqrt(Math.max(0, l1 * l1 - x * x));
  // The knee's side: where it pointed.
  boneNow(plan, upper, shin, l1, bone);
  boneNow(plan, shin, end, l2, toBone);
  for (let i = 0; i < 3; i++) k[i] = l1 * bone[i];
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
  }
  let across = clear(k);
  // A knee that has to bend further than it did does so towards the front: a nearly straight leg shows no other side.
  const more = Math.min(FRONT * l1, y - across);
  if (more > 0) {
    frontOf(plan, limb.upper);
    clear(point);
    for (let i = 0; i < 3; i++) k[i] += more * point[i];
    across = clear(k);
  }
  if (!(across > 0)) return false;
  for (let i = 0; i < 3; i++) point[i] = x * u[i] + (y / across) * k[i];
  turnTo(wanted, upper, bone, point);
  for (let i = 0; i < 3; i++) point[i] = reached * u[i] - point[i];
  turnTo(wanted, shin, toBone, point);
  return true;
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
