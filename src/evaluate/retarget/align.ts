/**
 * Aligns two skeletons with different rest poses and axes: one constant rotation K per pair, so that
 *
 *     T(t) = V · S(t) · K        K = S(ref)⁻¹ · D · T(rest)        V = U_t⁻¹ · U_s
 *
 * with S and T a joint's world rotation in source and target, S(ref) and T(rest) each in its reference pose
 * (`reference.ts`), and U the rotation from each one's axes to the scene's (`Space`; omitted on the right, where
 * everything is in scene axes). At the reference, S(t)·K is D·T(rest): the target's rest pose, corrected by D, which
 * makes the target's bones point like the source's:
 *
 *     trunk, neck, head, collars     D = B, which turns the target's front and up into the source's
 *     arm, thigh                     D = swing · B             swing: the smallest rotation from the bone's direction
 *     forearm, shin                  D = swing · D(above)             to that of the source's bone
 *     hand                           D(forearm)
 *     foot, toe                      B, and about the vertical to the heading of the source's foot: both soles are flat
 *     fingers and others             D(above), with a swing if one bone follows another
 *
 * Trunks and collars are not aligned bone by bone: the positions of spine joints in a body differ between files, and
 * the same pose does not mean bending one spine to the anatomy of the other.
 */
import { backMultiply3, copy3, multiply3, setIdentity3, swing, turnVector } from '../../math/mat3.ts';
import type { JointPair } from '../../model/retarget.ts';
import type { Skeleton } from '../../model/skeleton.ts';
import type { Space } from '../../model/space.ts';
import { figureOf, type RetargetFigure } from './figure.ts';
import { type BodySide, LIMB_SIDES, type Role, type Roles, rolesOf } from './roles.ts';

/** Data of the two skeletons that doesn't depend on the reference pose. */
export interface Bodies {
  readonly source: Skeleton;
  readonly sourceSpace: Space | undefined;
  readonly target: Skeleton;
  readonly targetSpace: Space | undefined;
  /** The source's joint by target joint; -1 for none. */
  readonly sourceOf: Int32Array;
  readonly roles: Roles;
  /** The target in its reference pose: usually its file pose (`reference.ts`). */
  readonly rest: RetargetFigure;
}

export function bodiesOf(
  source: Skeleton,
  sourceSpace: Space | undefined,
  target: Skeleton,
  targetSpace: Space | undefined,
  pairs: readonly JointPair[],
): Bodies {
  const sourceOf = new Int32Array(target.joints.length).fill(-1);
  for (const pair of pairs) {
    if (pair.target < sourceOf.length && pair.source < source.joints.length) sourceOf[pair.target] = pair.source;
  }
  const roles = rolesOf(target, targetSpace);
  return { source, sourceSpace, target, targetSpace, sourceOf, roles, rest: roles.rest };
}

/** The target's joint of that role if it is paired; else -1. */
export function driven({ roles, sourceOf }: Bodies, role: Role): number {
  const joint = roles.single.get(role) ?? -1;
  return joint >= 0 && sourceOf[joint] >= 0 ? joint : -1;
}

const UP: readonly number[] = [0, 1, 0];
/** A trunk that leans less than this is upright; the lean is anatomy. */
const UPRIGHT = Math.cos(Math.PI / 9);

/** Nine numbers: x from right to left, y up from the hips, z to the front, for the joints given by `at`. */
export function bodyFrame({ points }: RetargetFigure, bodies: Bodies, at: (target: number) => number): Float64Array {
  const sideways = new Float64Array(3);
  const upward = new Float64Array(3);
  const between = (a: number, b: number, out: Float64Array) => {
    for (let k = 0; k < 3; k++) out[k] += points[3 * at(a) + k] - points[3 * at(b) + k];
  };
  const both = (part: 'thigh' | 'arm' | 'collar' | 'foot') => {
    const pair = LIMB_SIDES.map((side) => driven(bodies, `${side} ${part}`));
    return pair.every((j) => j >= 0) ? pair : undefined;
  };
  const across = both('thigh') ?? both('arm');
  if (across) between(across[0], across[1], sideways);
  if (!(Math.hypot(...sideways) > 0)) sideways.set([1, 0, 0]);
  const hips = driven(bodies, 'hips');
  const shoulders = both('arm') ?? both('collar');
  if (hips >= 0 && shoulders) for (const top of shoulders) between(top, hips, upward);
  else if (hips >= 0 && driven(bodies, 'head') >= 0) between(driven(bodies, 'head'), hips, upward);
  const length = Math.hypot(...upward);
  if (!(length > 0) || upward[1] > UPRIGHT * length) upward.set(UP);
  return frameOf(sideways, upward);
}

/** x as given, y perpendicular to it and as close to `up` as possible. */
function frameOf(x: Float64Array, up: Float64Array): Float64Array {
  const y = Float64Array.from(up);
  normalize(y);
  const along = x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
  const across = Float64Array.from(x, (v, k) => v - along * y[k]);
  if (!normalize(across)) across.set(Math.abs(y[0]) < 0.9 ? [1, 0, 0] : [0, 0, 1]);
  const [a, b, c] = across;
  return Float64Array.of(a, b, c, y[0], y[1], y[2], b * y[2] - c * y[1], c * y[0] - a * y[2], a * y[1] - b * y[0]);
}

function normalize(v: Float64Array): boolean {
  const length = Math.hypot(...v);
  if (!(length > 1e-9)) return false;
  for (let k = 0; k < v.length; k++) v[k] /= length;
  return true;
}

/** B: from the target's front and up to the source's. */
export function bodyTurn(bodies: Bodies, reference: RetargetFigure): Float64Array {
  const own = bodyFrame(bodies.rest, bodies, (t) => t);
  const other = bodyFrame(reference, bodies, (t) => bodies.sourceOf[t]);
  const back = new Float64Array(9);
  for (let r = 0; r < 3; r++) for (let c = 0; c < 3; c++) back[3 * c + r] = own[3 * r + c];
  const out = new Float64Array(9);
  multiply3(other, 0, back, 0, out, 0);
  return out;
}

const NEXT = { arm: 'forearm', forearm: 'hand', thigh: 'shin', shin: 'foot' } as const;
type Aiming = keyof typeof NEXT;
const ABOVE: Partial<Record<Aiming, Aiming>> = { forearm: 'arm', shin: 'thigh' };

/** Joint and the one that its bone points to, in the target, for arms and legs. */
export function aims(bodies: Bodies): readonly { readonly joint: number; readonly to: number; readonly role: Role }[] {
  return LIMB_SIDES.flatMap((side) =>
    (['arm', 'forearm', 'thigh', 'shin'] as const).flatMap((part) => {
      const joint = driven(bodies, `${side} ${part}`);
      const to = driven(bodies, `${side} ${NEXT[part]}`);
      return joint >= 0 && to >= 0 ? [{ joint, to, role: `${side} ${part}` as const }] : [];
    }),
  );
}

/** K of every pair, nine numbers per target joint; the identity if it is not paired. */
export function alignment(bodies: Bodies, reference: RetargetFigure): Float64Array {
  const { target, sourceOf, roles, rest } = bodies;
  const count = target.joints.length;
  const body = bodyTurn(bodies, reference);
  const turns = new Float64Array(9 * count);
  const done = new Uint8Array(count);
  const put = (j: number, from: Float64Array, o: number) => {
    copy3(from, o, turns, 9 * j);
    done[j] = 1;
  };
  for (const role of ['hips', 'head', 'left collar', 'right collar'] as const) {
    const j = driven(bodies, role);
    if (j >= 0) put(j, body, 0);
  }
  for (const j of [...roles.spine, ...roles.neck]) if (sourceOf[j] >= 0) put(j, body, 0);
  for (const side of LIMB_SIDES) {
    for (const part of ['arm', 'forearm', 'thigh', 'shin'] as const) {
      const j = driven(bodies, `${side} ${part}`);
      if (j < 0) continue;
      const above = ABOVE[part] ? driven(bodies, `${side} ${ABOVE[part]}`) : -1;
      put(j, above >= 0 ? turns : body, above >= 0 ? 9 * above : 0);
      const to = driven(bodies, `${side} ${NEXT[part]}`);
      if (to >= 0) swingTo(bodies, reference, j, to, turns);
    }
    const hand = driven(bodies, `${side} hand`);
    const forearm = driven(bodies, `${side} forearm`);
    if (hand >= 0) put(hand, forearm >= 0 ? turns : body, forearm >= 0 ? 9 * forearm : 0);
    alignFoot(bodies, reference, side, body, put);
  }
  const following = onlyFollowers(bodies);
  for (let j = 0; j < count; j++) {
    if (sourceOf[j] < 0 || done[j]) continue;
    let above = target.joints[j].parent;
    while (above >= 0 && !done[above]) above = target.joints[above].parent;
    put(j, above >= 0 ? turns : body, above >= 0 ? 9 * above : 0);
    if (following[j] >= 0) swingTo(bodies, reference, j, following[j], turns);
  }
  const out = new Float64Array(9 * count);
  const corrected = new Float64Array(9);
  for (let j = 0; j < count; j++) {
    setIdentity3(out, 9 * j);
    if (sourceOf[j] < 0) continue;
    multiply3(turns, 9 * j, rest.rotations, 9 * j, corrected, 0);
    backMultiply3(reference.rotations, 9 * sourceOf[j], corrected, 0, out, 9 * j);
  }
  return out;
}

/** Extends D of a joint so that its bone to another points like the source's. */
function swingTo(
  { rest, sourceOf }: Bodies,
  reference: RetargetFigure,
  j: number,
  to: number,
  turns: Float64Array,
): void {
  const own = new Float64Array(3);
  const other = new Float64Array(3);
  for (let k = 0; k < 3; k++) {
    own[k] = rest.points[3 * to + k] - rest.points[3 * j + k];
    other[k] = reference.points[3 * sourceOf[to] + k] - reference.points[3 * sourceOf[j] + k];
  }
  turnVector(turns, 9 * j, own, 0, own, 0);
  turnOn(own, other, turns, 9 * j);
}

function turnOn(from: Float64Array, to: Float64Array, turns: Float64Array, o: number): void {
  const s = new Float64Array(9);
  const before = turns.slice(o, o + 9);
  swing(from, 0, to, 0, s, 0);
  multiply3(s, 0, before, 0, turns, o);
}

/** A foot with less than this fraction of its length along the ground has no heading. */
const HEADS = 0.4;

function alignFoot(
  bodies: Bodies,
  reference: RetargetFigure,
  side: BodySide,
  body: Float64Array,
  put: (j: number, from: Float64Array, o: number) => void,
): void {
  const foot = driven(bodies, `${side} foot`);
  const toe = driven(bodies, `${side} toe`);
  if (foot < 0) return;
  const turn = Float64Array.from(body);
  const own = heading(bodies.target, bodies.rest, foot, toe);
  const other = heading(bodies.source, reference, bodies.sourceOf[foot], toe >= 0 ? bodies.sourceOf[toe] : -1);
  if (own && other) {
    turnVector(body, 0, own, 0, own, 0);
    own[1] = 0;
    turnOn(own, other, turn, 0);
  }
  put(foot, turn, 0);
  if (toe >= 0) put(toe, turn, 0);
}

/** Direction of a foot over the ground, to its toe or the joint below; undefined if it mostly points down. */
function heading(skeleton: Skeleton, figure: RetargetFigure, foot: number, toe: number): Float64Array | undefined {
  const tip = toe >= 0 ? toe : skeleton.joints.findIndex((joint) => joint.parent === foot);
  const out = new Float64Array(3);
  if (tip >= 0) for (let k = 0; k < 3; k++) out[k] = figure.points[3 * tip + k] - figure.points[3 * foot + k];
  else {
    const [end] = skeleton.joints[foot].endSites ?? [];
    if (!end) return undefined;
    turnVector(figure.rotations, 9 * foot, Float64Array.from(end), 0, out, 0);
  }
  const length = Math.hypot(...out);
  out[1] = 0;
  return Math.hypot(...out) > HEADS * length ? out : undefined;
}

/** For each joint the one that follows it, if it is the only one and the same holds for the source's. */
function onlyFollowers({ target, source, sourceOf }: Bodies): Int32Array {
  const out = new Int32Array(target.joints.length).fill(-1);
  const seen = new Uint8Array(target.joints.length);
  target.joints.forEach((joint, j) => {
    if (sourceOf[j] < 0) return;
    let above = joint.parent;
    while (above >= 0 && sourceOf[above] < 0) above = target.joints[above].parent;
    if (above < 0) return;
    let s = sourceOf[j];
    while (s >= 0 && s !== sourceOf[above]) s = source.joints[s].parent;
    out[above] = !seen[above] && s >= 0 && sourceOf[j] !== s ? j : -1;
    seen[above] = 1;
  });
  return out;
}

export function sourceFigure({ source, sourceSpace }: Bodies, dofs?: Float64Array): RetargetFigure {
  return figureOf(source, sourceSpace, dofs);
}
