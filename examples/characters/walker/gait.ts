/**
 * The walk as a function of the stride's phase: the left heel strikes at 0, the right one at 0.5.
 *
 *     foot's own phase   0 ── heel strike ── 0.1 ── flat ── 0.34 ── heel lifts, toes planted ── 0.6 ── swing ── 1
 *
 * Feet come first: while planted they rotate about the heel, then about the toe joint, which don't move in the world;
 * in the air the pivot moves from one to the other. Hips move above them, legs follow by analytic two-bone IK, and the
 * upper body counters the hips: chest against pelvis, arms against legs, the head nearly still.
 */

import { add, cross, scaled, subtract, type Vec3 } from '../../../src/math/vec3.ts';
import { straightPath } from '../motion/path.ts';
import type { WalkPose } from '../motion/walk.ts';
import {
  apply,
  ballAngles,
  ballRotation,
  fromAxes,
  inverse,
  length,
  type Mat3,
  mixVec,
  normalise,
  rotate,
  rotationX,
  rotationY,
  rotationZ,
} from '../shape/vectors.ts';
import { ANKLE_HEIGHT, HEEL_CONTACT, HIP_HEIGHT, SHIN, THIGH, THIGH_OFFSET, TOE_OFFSET } from './skeleton.ts';

/** Seven metres, a multiple of the grid's numbered lines: where the take begins anew, the floor looks the same. */
export const WALK_PATH = straightPath(7, 8, 0.8);

/** Phases of a foot's own stride; the tests measure foot sliding between them. */
export const FLAT_FROM = 0.1;
export const HEEL_LIFTS = 0.34;
export const TOE_LEAVES = 0.6;
const MID_STANCE = 0.3;

const TAU = 2 * Math.PI;
const STRIKE_PITCH = -0.42;
const LEAVE_PITCH = 0.8;
const STANCE_WIDTH = 0.092;
const TOE_OUT = 0.1;
const CLEARANCE = 0.12;
/** Of thigh + shin: legs are never fully straight, so that knees don't pop. */
const LONGEST_REACH = 0.988;

const wave = (phase: number, lag = 0): number => Math.sin(TAU * (phase - lag));

interface Foot {
  readonly ankle: Vec3;
  readonly turn: Mat3;
  readonly toe: number;
}

/** A foot at its own phase x, in path space. side: 1 left, −1 right. */
function footAt(x: number, side: number): Foot {
  const yaw = TOE_OUT * side;
  const ankleFlat: Vec3 = [WALK_PATH.middle + STANCE_WIDTH * side, ANKLE_HEIGHT, -0.02];
  const planted = (local: Vec3, strides: number) =>
    WALK_PATH.carriedBack(x - MID_STANCE - strides, add(ankleFlat, apply(rotationY(yaw), local)));
  const turnFor = (strides: number, pitch: number) =>
    rotate(rotationY(yaw - WALK_PATH.heading((x - MID_STANCE - strides) * WALK_PATH.strideSeconds)), rotationX(pitch));

  if (x < FLAT_FROM) {
    const pitch = STRIKE_PITCH * (1 - x / FLAT_FROM) ** 2;
    return pivoted(planted(HEEL_CONTACT, 0), HEEL_CONTACT, turnFor(0, pitch), 0);
  }
  if (x < TOE_LEAVES) {
    const pitch = LEAVE_PITCH * liftAt(x);
    return pivoted(planted(TOE_OFFSET, 0), TOE_OFFSET, turnFor(0, pitch), -pitch);
  }
  // In the air. s: 0 … 1 over the swing; rates are per unit of s.
  const swing = 1 - TOE_LEAVES;
  const s = (x - TOE_LEAVES) / swing;
  const leaveRate = (LEAVE_PITCH * LIFT_POWER * swing) / (TOE_LEAVES - HEEL_LIFTS);
  const pitch =
    s < LEVEL_AT
      ? hermite(s / LEVEL_AT, LEAVE_PITCH, leaveRate * LEVEL_AT, 0.08, -1.1 * LEVEL_AT)
      : hermite((s - LEVEL_AT) / (1 - LEVEL_AT), 0.08, -1.1 * (1 - LEVEL_AT), STRIKE_PITCH, 0);
  const toe = hermite(Math.min(1, s / 0.55), -LEAVE_PITCH, -leaveRate * 0.55, 0, 0);
  const far = s * s * s * (10 - 15 * s + 6 * s * s);
  const pivotLocal = mixVec(TOE_OFFSET, HEEL_CONTACT, far);
  const level = mixVec(planted(TOE_OFFSET, 0), planted(HEEL_CONTACT, 1), far);
  const lifted = add(level, [0, CLEARANCE * 4 * s * (1 - s) * (1.25 - 0.5 * s), 0]);
  return pivoted(lifted, pivotLocal, turnFor(far, pitch), toe);
}

/** Part of the swing at which the foot is nearly level, so that its toes clear the ground. */
const LEVEL_AT = 0.5;
const LIFT_POWER = 1.8;
const liftAt = (x: number) => Math.max(0, (x - HEEL_LIFTS) / (TOE_LEAVES - HEEL_LIFTS)) ** LIFT_POWER;

function pivoted(pivot: Vec3, pivotLocal: Vec3, turn: Mat3, toe: number): Foot {
  return { ankle: subtract(pivot, apply(turn, pivotLocal)), turn, toe };
}

function hermite(t: number, a: number, slopeA: number, b: number, slopeB: number): number {
  const [t2, t3] = [t * t, t * t * t];
  return (2 * t3 - 3 * t2 + 1) * a + (t3 - 2 * t2 + t) * slopeA + (3 * t2 - 2 * t3) * b + (t3 - t2) * slopeB;
}

/** Thigh and shin that bring the ankle to the foot; the knee points like the toes. */
function legAngles(hipsTurn: Mat3, hip: Vec3, foot: Foot): { thigh: Vec3; shin: number; ankle: Vec3 } {
  const reach = subtract(foot.ankle, hip);
  const far = Math.min(length(reach), (THIGH + SHIN) * 0.999);
  const down = normalise(reach);
  const forward = add(apply(foot.turn, [0, 0.35, 0.65]), apply(hipsTurn, [0, 0, 0.6]));
  const side = normalise(cross(scaled(down, -1), forward));
  const ahead = cross(down, side);
  const bendAtHip = Math.acos((THIGH * THIGH + far * far - SHIN * SHIN) / (2 * THIGH * far));
  const knee = Math.PI - Math.acos((THIGH * THIGH + SHIN * SHIN - far * far) / (2 * THIGH * SHIN));
  const along = add(scaled(down, Math.cos(bendAtHip)), scaled(ahead, Math.sin(bendAtHip)));
  const up = scaled(along, -1);
  const thighTurn = fromAxes(side, up, cross(side, up));
  const shinTurn = rotate(thighTurn, rotationX(knee));
  return {
    thigh: ballAngles(rotate(inverse(hipsTurn), thighTurn)),
    shin: knee,
    ankle: ballAngles(rotate(inverse(shinTurn), foot.turn)),
  };
}

/** Hips before the correction for reach: sway over the planted foot, bob twice a stride. */
function hipsAt(phase: number): { at: Vec3; turn: Mat3; angles: Vec3 } {
  const sway = 0.03 * wave(phase, 0.05);
  const bob = 0.02 * -Math.cos(2 * TAU * (phase - 0.05));
  const surge = 0.012 * wave(2 * phase, 0.1);
  const angles: Vec3 = [
    0.05 + 0.03 * wave(2 * phase, 0.15),
    -0.16 * Math.cos(TAU * (phase - 0.02)),
    -0.03 + 0.075 * wave(phase, 0.02),
  ];
  return { at: [WALK_PATH.middle + sway, HIP_HEIGHT - 0.032 + bob, surge], turn: ballRotation(angles), angles };
}

const SIDES = [
  { side: 1, suffix: '_l', lag: 0 },
  { side: -1, suffix: '_r', lag: 0.5 },
] as const;

const hipOf = (at: Vec3, turn: Mat3, side: number) =>
  add(at, apply(turn, [THIGH_OFFSET[0] * side, THIGH_OFFSET[1], THIGH_OFFSET[2]]));

/** How far the hips have to be lowered for both legs to reach at any phase, computed once. */
const settle = (() => {
  const longest = LONGEST_REACH * (THIGH + SHIN);
  let drop = 0;
  for (let i = 0; i < 400; i++) {
    const { at, turn } = hipsAt(i / 400);
    for (const { side, lag } of SIDES) {
      const reach = subtract(footAt((i / 400 + lag) % 1, side).ankle, hipOf(at, turn, side));
      const level = Math.hypot(reach[0], reach[2]);
      drop = Math.max(drop, -reach[1] - Math.sqrt(longest * longest - level * level));
    }
  }
  return drop;
})();

/** The whole pose at a phase of the stride (any real number), in path space. */
export function walkPose(anyPhase: number): WalkPose {
  const phase = anyPhase - Math.floor(anyPhase);
  const angles = new Map<string, Vec3>();
  const hips = hipsAt(phase);
  const root: Vec3 = [hips.at[0], hips.at[1] - settle, hips.at[2]];
  angles.set('hips', hips.angles);

  for (const { side, suffix, lag } of SIDES) {
    const foot = footAt((phase + lag) % 1, side);
    const leg = legAngles(hips.turn, hipOf(root, hips.turn, side), foot);
    angles.set(`thigh${suffix}`, leg.thigh);
    angles.set(`shin${suffix}`, [leg.shin, 0, 0]);
    angles.set(`foot${suffix}`, leg.ankle);
    angles.set(`toe${suffix}`, [foot.toe, 0, 0]);
  }

  // Spine and chest overcompensate the pelvis, slightly late.
  const twist = 0.17 * Math.cos(TAU * (phase - 0.05));
  const tilt = -0.05 * wave(phase, 0.06);
  const nod = 0.035 * wave(2 * phase, 0.3);
  const spine: Vec3 = [-0.01 - nod * 0.6, twist, 0.02 + tilt];
  const chest: Vec3 = [0.02 - nod * 0.6, 0.09 + twist * 0.8, tilt * 0.9];
  const neck: Vec3 = [-0.04 + nod * 0.3, -twist * 0.4, -tilt * 0.3];
  angles.set('spine', spine);
  angles.set('chest', chest);
  angles.set('neck', neck);
  // The head looks slightly aside, to where the page first looks from, and keeps only a trace of the body's motion.
  const carried = rotate(hips.turn, ballRotation(spine), ballRotation(chest), ballRotation(neck));
  const gaze = ballRotation([-0.02 + 0.028 * wave(2 * phase, 0.32), 0.22, 0.045 * wave(phase, 0.12)]);
  angles.set('head', ballAngles(rotate(inverse(carried), gaze)));

  for (const { side, suffix, lag } of SIDES) {
    const own = phase + lag;
    const forward = -Math.cos(TAU * (own - 0.04));
    const swing = rotate(rotationX(-0.05 - 0.52 * forward), rotationZ(-side * (1.16 - 0.04 * wave(2 * phase, 0.1))));
    angles.set(`upper_arm${suffix}`, ballAngles(rotate(swing, rotationX(0.25))));
    const bend = 0.55 - 0.3 * Math.cos(TAU * (own - 0.1));
    angles.set(`forearm${suffix}`, [0, -side * bend, 0]);
    angles.set(`hand${suffix}`, [
      0,
      -side * 0.18 * -Math.cos(TAU * (own - 0.2)),
      side * (-0.1 + 0.1 * wave(own, 0.15)),
    ]);
    // Ears lag behind the bobbing head.
    angles.set(`ear${suffix}`, [-0.06 + 0.13 * wave(2 * phase, 0.5), 0, side * (-0.03 + 0.06 * wave(2 * phase, 0.42))]);
  }
  for (let i = 0; i < 4; i++) {
    const size = 0.1 + 0.04 * i;
    angles.set(`tail_${i + 1}`, [
      0.07 * wave(2 * phase, 0.15 + 0.11 * i),
      -0.06 + size * wave(phase, 0.02 + 0.1 * i),
      0.04 * wave(phase, 0.1 + 0.1 * i),
    ]);
  }
  angles.set('pack', [0.05 * wave(2 * phase, 0.42), 0, 0.05 * wave(phase, 0.14)]);
  angles.set('scarf_1', [-0.12 + 0.16 * wave(2 * phase, 0.4), 0, 0.14 * wave(phase, 0.2)]);
  angles.set('scarf_2', [-0.05 + 0.22 * wave(2 * phase, 0.53), 0, 0.16 * wave(phase, 0.32)]);
  return { root, angles };
}
