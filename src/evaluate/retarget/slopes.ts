/**
 * Aligns feet. Where both soles are known to be flat in the reference poses, they are made parallel, and bones from
 * ankle to ball then differ by a constant angle δ, up or down:
 *
 *     flat soles        source  ╲ 40°        target  ╲ 10°        δ = 30°, the most that is allowed
 *
 * With a raised heel or a bent knee that stays so. But when the toes come up, the target's would be above the ankle
 * while the source's are still below. So towards the horizontal the angle is taken back, until both bones are alike:
 *
 *     source's slope p       −δ − 1°    …    −1°       …       90°    …    180°
 *     target's               p + δ      −1°            p                   p + δ
 *
 * Where a sole isn't known to be flat, bones are aligned like those of legs.
 */
import { backTurnVector, copy3, multiply3, swing, turnAbout, turnVector } from '../../math/mat3.ts';
import { smoothstep } from '../../math/smoothstep.ts';
import { pitchOf, raisingAxis } from './feet.ts';

/** A foot whose bone slopes otherwise than the source's. */
export interface FootSlope {
  /** Joints of the target: the ankle and all paired joints below it, which turn together. */
  readonly joints: Int32Array;
  /** Unit vectors in the ankle's own space: the source's bone, and the axis about which toes come up. */
  readonly bone: Float64Array;
  readonly axis: Float64Array;
  /** δ: how much higher the target's bone points; radians. */
  readonly raised: number;
}

const DEGREE = Math.PI / 180;
/** Feet of people slope by 10° to 45°: bones that differ by more don't both end at the ball. */
const MOST = 30 * DEGREE;
/** How far below the horizontal a bone still counts as pointing down. */
const BELOW = DEGREE;
/** A foot with less than this fraction of its length along the ground has no heading. */
const HEADS = 0.4;

/**
 * Extends D of a foot that is upright so that it heads like the source's, with both soles flat.
 * @param own unit vectors along the bones of both feet in the reference poses
 */
export function alignSole(own: Float64Array, other: Float64Array, turn: Float64Array): void {
  const turned = new Float64Array(3);
  turnVector(turn, 0, own, 0, turned, 0);
  if (!heads(turned) || !heads(other)) return;
  turnOn(Float64Array.of(turned[0], 0, turned[2]), Float64Array.of(other[0], 0, other[2]), turn, 0);
  const off = pitchOf(turned) - pitchOf(other);
  const axis = raisingAxis(other);
  if (!axis || Math.abs(off) <= MOST) return;
  const angle = Math.sign(off) * MOST - off;
  const back = new Float64Array(9);
  turnAbout(axis[0], 0, axis[2], Math.cos(angle), Math.sin(angle), back, 0);
  turnMore(back, turn, 0);
}

function heads([x, , z]: Float64Array): boolean {
  return Math.hypot(x, z) > HEADS;
}

/** Bones that differ by less are alike; radians. */
const ALIKE = 1e-4;

/**
 * How the bone of an aligned foot slopes; undefined if it does so like the source's.
 * @param own as for `alignSole`
 * @param turn D of the foot
 * @param rest nine numbers at `o`: the ankle's rotation in the target's reference pose
 * @param joints the ankle and all paired joints below it
 */
export function slopeOf(
  own: Float64Array,
  other: Float64Array,
  turn: Float64Array,
  rest: Float64Array,
  o: number,
  joints: Int32Array,
): FootSlope | undefined {
  const turned = new Float64Array(3);
  turnVector(turn, 0, own, 0, turned, 0);
  const raised = pitchOf(turned) - pitchOf(other);
  const scene = raisingAxis(other);
  if (!scene || !heads(other) || Math.abs(raised) < ALIKE) return undefined;
  const wanted = new Float64Array(9);
  multiply3(turn, 0, rest, o, wanted, 0);
  const [bone, axis] = [new Float64Array(3), new Float64Array(3)];
  backTurnVector(wanted, 0, other, 0, bone, 0);
  backTurnVector(wanted, 0, scene, 0, axis, 0);
  return { joints, bone, axis, raised };
}

/** Turns D at `o` on, by the smallest rotation from a direction to another. */
export function turnOn(from: Float64Array, to: Float64Array, turns: Float64Array, o: number): void {
  const s = new Float64Array(9);
  swing(from, 0, to, 0, s, 0);
  turnMore(s, turns, o);
}

function turnMore(turn: Float64Array, turns: Float64Array, o: number): void {
  const before = turns.slice(o, o + 9);
  multiply3(turn, 0, before, 0, turns, o);
}

/** Scratch; never escapes. */
const bone = new Float64Array(3);
const axis = new Float64Array(3);
const turn = new Float64Array(9);
const before = new Float64Array(9);

/** Sine of the angle between the axis and the vertical: a foot on its side has no slope. */
const ON_ITS_SIDE = 0.01;
const UPRIGHT = 0.05;

/**
 * Takes back what slopes differ by where the toes of the target would come up before the source's.
 * @param wanted nine numbers per target joint: its rotation in its own space
 * @param up from the target's space to the scene's axes
 */
export function levelFeet(slopes: readonly FootSlope[], wanted: Float64Array, up: Float64Array): void {
  // The scene's y in the target's own axes is row 1 of Up.
  const x = up[1];
  const y = up[4];
  const z = up[7];
  for (let i = 0; i < slopes.length; i++) {
    const slope = slopes[i];
    const ankle = 9 * slope.joints[0];
    turnVector(wanted, ankle, slope.bone, 0, bone, 0);
    turnVector(wanted, ankle, slope.axis, 0, axis, 0);
    const along = axis[0] * x + axis[1] * y + axis[2] * z;
    const upright = Math.sqrt(Math.max(0, 1 - along * along));
    if (upright < ON_ITS_SIDE) continue;
    // Up and to the front, perpendicular to the axis.
    const u = (x - along * axis[0]) / upright;
    const v = (y - along * axis[1]) / upright;
    const w = (z - along * axis[2]) / upright;
    const height = bone[0] * u + bone[1] * v + bone[2] * w;
    const front =
      bone[0] * (v * axis[2] - w * axis[1]) +
      bone[1] * (w * axis[0] - u * axis[2]) +
      bone[2] * (u * axis[1] - v * axis[0]);
    const back = takenBack(slope.raised, Math.atan2(height, front)) * smoothstep(ON_ITS_SIDE, UPRIGHT, upright);
    if (back === 0) continue;
    const angle = -back * slope.raised;
    turnAbout(axis[0], axis[1], axis[2], Math.cos(angle), Math.sin(angle), turn, 0);
    for (let k = 0; k < slope.joints.length; k++) {
      const o = 9 * slope.joints[k];
      copy3(wanted, o, before, 0);
      multiply3(turn, 0, before, 0, wanted, o);
    }
  }
}

/** The fraction of δ that is taken back at a slope p of the source's bone, -π to π. */
function takenBack(raised: number, p: number): number {
  if (raised < 0) {
    // The same seen from behind: there, what points lower at the front points higher.
    const q = -Math.PI - p;
    return takenBack(-raised, q < -Math.PI ? q + 2 * Math.PI : q);
  }
  if (p > Math.PI / 2) return 2 - (2 * p) / Math.PI;
  return Math.min(1, Math.max(0, (p + raised + BELOW) / raised));
}
