/**
 * The crawler's tripod gait by phase of a stride: three feet are planted while three step. Feet are placed first; coxa,
 * femur and tibia follow by IK:
 *
 *     coxa turns toward the foot about y; in the plane through it, femur and tibia are the two sides of a triangle
 */

import { add, subtract, type Vec3 } from '../../../src/math/vec3.ts';
import { circlePath } from '../motion/path.ts';
import type { WalkPose } from '../motion/walk.ts';
import { apply, ballRotation, inverse, mixVec, rotationY } from '../shape/vectors.ts';
import { BODY_HEIGHT, COXA, FEMUR, LEGS, type LegPlan, TIBIA } from './skeleton.ts';

export const CRAWL_PATH = circlePath(1, 12, 0.6);

/** Phase at which a foot lifts off; it is planted before. */
export const LIFTS = 0.56;
const MID_STANCE = LIFTS / 2;
/** Horizontal distance from the coxa's pivot to the foot. */
const SPREAD = 0.46;
const STEP_HEIGHT = 0.13;
const TAU = 2 * Math.PI;
const wave = (phase: number, lag = 0): number => Math.sin(TAU * (phase - lag));

/** Position of a leg's foot at its own phase x, in path space. */
function footAt(leg: LegPlan, x: number): Vec3 {
  const out = apply(rotationY(-leg.side * leg.azimuth), [leg.side * SPREAD, 0, 0]);
  const rest: Vec3 = [CRAWL_PATH.middle + leg.hip[0] + out[0], 0, leg.hip[2] + out[2]];
  const planted = (strides: number) => CRAWL_PATH.carriedBack(x - MID_STANCE - strides, rest);
  if (x < LIFTS) return planted(0);
  const s = (x - LIFTS) / (1 - LIFTS);
  const far = s * s * s * (10 - 15 * s + 6 * s * s);
  return add(mixVec(planted(0), planted(1), far), [0, STEP_HEIGHT * 4 * s * (1 - s), 0]);
}

/** The whole pose at a phase of the stride (any real number), in path space. */
export function crawlPose(anyPhase: number): WalkPose {
  const phase = anyPhase - Math.floor(anyPhase);
  const angles = new Map<string, Vec3>();
  const root: Vec3 = [CRAWL_PATH.middle + 0.012 * wave(phase, 0.1), BODY_HEIGHT + 0.014 * wave(2 * phase, 0.1), 0];
  const body: Vec3 = [0.025 * wave(2 * phase, 0.3), 0.05 * wave(phase, 0.05), 0.035 * wave(phase, 0.15) - 0.02];
  angles.set('body', body);
  const turn = ballRotation(body);
  for (const leg of LEGS) {
    const foot = footAt(leg, (phase + 1 - leg.lag) % 1);
    const local = subtract(apply(inverse(turn), subtract(foot, root)), leg.hip);
    const level = Math.hypot(local[0], local[2]);
    const across = level - COXA;
    const far = Math.min(Math.hypot(across, local[1]), 0.999 * (FEMUR + TIBIA));
    const lift =
      Math.acos((FEMUR * FEMUR + far * far - TIBIA * TIBIA) / (2 * FEMUR * far)) + Math.atan2(local[1], across);
    const bend = Math.PI - Math.acos((FEMUR * FEMUR + TIBIA * TIBIA - far * far) / (2 * FEMUR * TIBIA));
    angles.set(`coxa_${leg.name}`, [0, Math.atan2(-leg.side * local[2], leg.side * local[0]), 0]);
    angles.set(`femur_${leg.name}`, [0, 0, leg.side * lift]);
    angles.set(`tibia_${leg.name}`, [0, 0, -leg.side * bend]);
  }
  angles.set('abdomen', [0.05 * wave(2 * phase, 0.45), -0.09 * wave(phase, 0.12), 0]);
  angles.set('head', [-0.05 + 0.04 * wave(2 * phase, 0.5), 0.12 - 0.06 * wave(phase, 0.1), 0.03 * wave(phase, 0.4)]);
  for (const [suffix, side] of [['_l', 1] as const, ['_r', -1] as const]) {
    const own = phase + (side > 0 ? 0 : 0.5);
    angles.set(`feeler_1${suffix}`, [0.1 * wave(2 * own, 0.1), 0, side * 0.1 * wave(own, 0.1)]);
    angles.set(`feeler_2${suffix}`, [0.18 * wave(2 * own, 0.3), 0, side * 0.18 * wave(own, 0.3)]);
  }
  return { root, angles };
}

/** Phases of the stride (0 … 1) at which a leg's motion has a corner: its foot lands or lifts. */
export function cornersOf(leg: LegPlan): number[] {
  return [leg.lag, leg.lag + LIFTS].map((x) => x % 1);
}
