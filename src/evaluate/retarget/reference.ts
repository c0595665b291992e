/**
 * Chooses the poses in which the two skeletons are compared.
 *
 * A standing file pose (T, A, arms down) tells best how joints are meant to be rotated. Some files have none: in LAFAN1
 * all bones are along x. Then a frame of the character's own take is used. For the target it is the most upright one, if
 * the target has a take; for the source, the one that looks most like the target: the one with the smallest sum of
 * angles between their bones. Such a frame may be one of a step, so its feet are turned flat: as they are, on average,
 * in the frames in which they are lowest.
 *
 * Skeletons with the same bones are compared in their file poses, whatever these are and whatever was chosen: they match
 * joint by joint.
 */
import { copy3, multiply3, swing, turnVector } from '../../math/mat3.ts';
import type { RetargetOptions } from '../../model/retarget.ts';
import type { Skeleton } from '../../model/skeleton.ts';
import { aims, type Bodies, bodyFrame, bodyTurn, driven, sourceFigure } from './align.ts';
import { figureOf, type RetargetFigure } from './figure.ts';
import { LIMB_SIDES, type Role } from './roles.ts';
import { type PlayedSource, sourcePose } from './source-pose.ts';

/** Number of times examined, evenly over the clip. */
const MAX_MOMENTS = 64;
/** Within 45° of upright. */
const STANDS = Math.SQRT1_2;

/** A take with its range in seconds. */
export interface PlayedTake {
  readonly played: PlayedSource;
  readonly range: readonly [number, number];
}

/** The target's pose to compare: its file pose if it is a standing one, else the most upright frame of its take. */
export function ownReference(bodies: Bodies, take: PlayedTake | undefined): RetargetFigure {
  const { target, targetSpace, rest } = bodies;
  const at = (t: number) => t;
  if (!take || stands(bodies, rest, at)) return rest;
  return closest(
    take,
    rest,
    (dofs) => figureOf(target, targetSpace, dofs),
    (figure) => slant(bodies, figure, at),
    feetOf(bodies, target, at),
  );
}

/** The source's pose that matches the one of `bodies.rest`. */
export function sourceReference(
  bodies: Bodies,
  take: PlayedTake,
  reference: RetargetOptions['reference'],
): RetargetFigure {
  if (typeof reference === 'number') {
    const dofs = new Float64Array(take.played.dofCount);
    sourcePose(take.played, reference, dofs);
    return sourceFigure(bodies, dofs);
  }
  const rest = sourceFigure(bodies);
  if (reference === 'rest' || stands(bodies, rest, (t) => bodies.sourceOf[t])) return rest;
  return closest(
    take,
    rest,
    (dofs) => sourceFigure(bodies, dofs),
    (figure) => unlikeness(bodies, figure),
    feetOf(bodies, bodies.source, (t) => bodies.sourceOf[t]),
  );
}

/** Each foot's joint, followed by all below it. */
function feetOf(bodies: Bodies, { joints }: Skeleton, at: (target: number) => number): number[][] {
  return LIMB_SIDES.flatMap((side) => {
    const foot = driven(bodies, `${side} foot`);
    if (foot < 0) return [];
    const own = [at(foot)];
    joints.forEach(({ parent }, j) => {
      if (own.includes(parent)) own.push(j);
    });
    return [own];
  });
}

/** Fraction of the frames in which a foot counts as flat. */
const FLAT = 0.25;

/** The figure with its feet as flat as they are in those of the figures in which they are lowest. */
function withFlatFeet(
  figure: RetargetFigure,
  all: readonly RetargetFigure[],
  feet: readonly (readonly number[])[],
): RetargetFigure {
  const out = { points: figure.points.slice(), rotations: figure.rotations.slice() };
  const turn = new Float64Array(9);
  const turned = new Float64Array(9);
  for (const foot of feet) {
    const height = ({ points }: RetargetFigure) => Math.min(...foot.map((j) => points[3 * j + 1]));
    const sorted = [...all].sort((a, b) => height(a) - height(b));
    const [ankle] = foot;
    // Down, in the foot's own space.
    const down = new Float64Array(3);
    for (const { rotations } of sorted.slice(0, Math.max(1, Math.round(FLAT * sorted.length)))) {
      for (let k = 0; k < 3; k++) down[k] -= rotations[9 * ankle + 3 * k + 1];
    }
    turnVector(out.rotations, 9 * ankle, down, 0, down, 0);
    swing(down, 0, DOWN, 0, turn, 0);
    const [x, y, z] = out.points.subarray(3 * ankle, 3 * ankle + 3);
    for (const j of foot) {
      multiply3(turn, 0, out.rotations, 9 * j, turned, 0);
      copy3(turned, 0, out.rotations, 9 * j);
      const p = Float64Array.of(out.points[3 * j] - x, out.points[3 * j + 1] - y, out.points[3 * j + 2] - z);
      turnVector(turn, 0, p, 0, p, 0);
      out.points.set([p[0] + x, p[1] + y, p[2] + z], 3 * j);
    }
  }
  return out;
}

const DOWN = Float64Array.of(0, -1, 0);

/** The frame of a take with the least of something, its feet flat; `otherwise` if none has any. */
function closest(
  { played, range: [start, end] }: PlayedTake,
  otherwise: RetargetFigure,
  figureAt: (dofs: Float64Array) => RetargetFigure,
  measure: (figure: RetargetFigure) => number,
  feet: readonly (readonly number[])[],
): RetargetFigure {
  const dofs = new Float64Array(played.dofCount);
  const all: RetargetFigure[] = [];
  let best = otherwise;
  let least = Infinity;
  for (let i = 0; i < MAX_MOMENTS; i++) {
    sourcePose(played, start + ((end - start) * i) / (MAX_MOMENTS - 1), dofs);
    const figure = figureAt(dofs);
    all.push(figure);
    const off = measure(figure);
    if (off >= least) continue;
    least = off;
    best = figure;
    if (end <= start) break;
  }
  return withFlatFeet(best, all, feet);
}

/** Whether legs point down and the trunk up, with distinct left and right. Bodies without legs are accepted. */
export function stands(bodies: Bodies, { points }: RetargetFigure, jointAt: (target: number) => number): boolean {
  const at = (role: Role) => {
    const joint = driven(bodies, role);
    return joint < 0 ? undefined : jointAt(joint);
  };
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

/** Sum of the angles of thighs, shins and trunk to the vertical. */
function slant(bodies: Bodies, figure: RetargetFigure, at: (target: number) => number): number {
  const { points } = figure;
  let sum = 0;
  for (const { joint, to, role } of aims(bodies)) {
    if (!/thigh|shin/.test(role)) continue;
    const d = [0, 1, 2].map((k) => points[3 * at(joint) + k] - points[3 * at(to) + k]);
    sum += Math.acos(Math.min(1, Math.max(-1, d[1] / (Math.hypot(...d) || 1))));
  }
  return sum + 4 * Math.acos(Math.min(1, Math.max(-1, bodyFrame(figure, bodies, at)[4])));
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
