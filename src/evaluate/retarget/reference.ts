/**
 * Chooses the pose of the source to compare with the target's rest pose.
 *
 * A standing file pose (T, A, arms down) tells best how joints are meant to be rotated. Some files have none: in LAFAN1
 * all bones are along x. Then the frame of the take that looks most like the target at rest is used: the one with the
 * smallest sum of angles between their bones.
 */
import { turnVector } from '../../math/mat3.ts';
import type { RetargetOptions } from '../../model/retarget.ts';
import { aims, type Bodies, bodyTurn, driven, sourceFigure } from './align.ts';
import type { RetargetFigure } from './figure.ts';
import { LIMB_SIDES } from './roles.ts';
import { type PlayedSource, sourcePose } from './source-pose.ts';

/** Number of times examined, evenly over the clip. */
const MAX_MOMENTS = 64;
/** Within 45° of upright. */
const STANDS = Math.SQRT1_2;

export function referenceFigure(
  bodies: Bodies,
  played: PlayedSource,
  range: readonly [number, number],
  reference: RetargetOptions['reference'],
): RetargetFigure {
  const dofs = new Float64Array(played.dofCount);
  const at = (seconds: number) => {
    sourcePose(played, seconds, dofs);
    return sourceFigure(bodies, dofs);
  };
  if (typeof reference === 'number') return at(reference);
  const rest = sourceFigure(bodies);
  if (reference === 'rest' || stands(bodies, rest)) return rest;
  let best = rest;
  let least = Infinity;
  const [start, end] = range;
  for (let i = 0; i < MAX_MOMENTS; i++) {
    const figure = at(start + ((end - start) * i) / (MAX_MOMENTS - 1));
    const off = unlikeness(bodies, figure);
    if (off >= least) continue;
    least = off;
    best = figure;
    if (end <= start) break;
  }
  return best;
}

/** Whether legs point down and the trunk up, with distinct left and right. Bodies without legs are accepted. */
export function stands(bodies: Bodies, figure: RetargetFigure): boolean {
  const at = (role: Parameters<typeof driven>[1]) => {
    const joint = driven(bodies, role);
    return joint < 0 ? undefined : bodies.sourceOf[joint];
  };
  const { points } = figure;
  const isSteep = (low: number, high: number) => {
    const d = [0, 1, 2].map((k) => points[3 * high + k] - points[3 * low + k]);
    return d[1] > STANDS * Math.hypot(...d);
  };
  const legs = LIMB_SIDES.map((side) => [at(`${side} foot`), at(`${side} thigh`)] as const);
  for (const [foot, thigh] of legs) {
    if (foot !== undefined && thigh !== undefined && !isSteep(foot, thigh)) return false;
  }
  const [left, right] = legs.map(([, thigh]) => thigh);
  if (
    left !== undefined &&
    right !== undefined &&
    !(
      Math.abs(points[3 * left + 1] - points[3 * right + 1]) <
      0.5 * Math.hypot(points[3 * left] - points[3 * right], points[3 * left + 2] - points[3 * right + 2])
    )
  )
    return false;
  const hips = at('hips');
  const head = at('head');
  return hips === undefined || head === undefined || isSteep(hips, head);
}

/** Sum of the angles between the target's bones at rest, turned to face like the figure, and the figure's. */
function unlikeness(bodies: Bodies, figure: RetargetFigure): number {
  const turn = bodyTurn(bodies, figure);
  const own = new Float64Array(3);
  let sum = 0;
  for (const { joint, to } of aims(bodies)) {
    const [s, e] = [bodies.sourceOf[joint], bodies.sourceOf[to]];
    for (let k = 0; k < 3; k++) own[k] = bodies.rest.points[3 * to + k] - bodies.rest.points[3 * joint + k];
    turnVector(turn, 0, own, 0, own, 0);
    let dot = 0;
    let square = 0;
    for (let k = 0; k < 3; k++) {
      const other = figure.points[3 * e + k] - figure.points[3 * s + k];
      dot += own[k] * other;
      square += other * other;
    }
    const length = Math.hypot(...own) * Math.sqrt(square);
    if (length > 0) sum += Math.acos(Math.min(1, Math.max(-1, dot / length)));
  }
  // A figure that lies or bows is not at rest, however its limbs are.
  const tilt = Math.acos(Math.min(1, Math.max(-1, turn[4])));
  return sum + 4 * tilt;
}
