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
 *     hand                           D(forearm), with a swing to the fingers if both have some
 *     foot, toe                      B, and about the vertical to the heading of the source's foot: both soles are flat
 *                                    (`slopes.ts`); like shins where that isn't known
 *     fingers and others             D(above), with a swing if one bone follows another
 *
 * Trunks and collars are not aligned bone by bone: the positions of spine joints in a body differ between files, and
 * the same pose does not mean bending one spine to the anatomy of the other.
 */
import { backMultiply3, copy3, multiply3, setIdentity3, turnVector } from '../../math/mat3.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import type { Space } from '../../model/space.ts';
import type { JointPair } from '../../model/takes/retarget.ts';
import { type RetargetBody, retargetBody } from './body.ts';
import { type Foot, footDirection, footOf } from './feet.ts';
import { fingerBases } from './fingers.ts';
import { type BodyParts, type BodySide, LIMB_SIDES, partsOf, type Role, type Roles, rolesOf } from './roles.ts';
import { alignSole, type FootSlope, slopeOf, turnOn } from './slopes.ts';

/** Data of the two skeletons that doesn't depend on the reference pose. */
export interface Bodies {
  readonly source: Skeleton;
  readonly sourceSpace: Space | undefined;
  readonly target: Skeleton;
  readonly targetSpace: Space | undefined;
  /** The source's joint by target joint; -1 for none. */
  readonly sourceOf: Int32Array;
  readonly roles: Roles;
  readonly sourceParts: BodyParts;
  readonly feet: readonly FeetPair[];
  /** The target in its reference pose: usually its file pose (`reference.ts`). */
  readonly rest: Reference;
}

/** A skeleton in its reference pose. */
export interface Reference extends RetargetBody {
  /** Whether its soles are known to be flat. */
  readonly soles: boolean;
}

/** A foot and the one that it follows. */
export interface FeetPair {
  readonly side: BodySide;
  readonly own: Foot;
  readonly source: Foot;
}

/**
 * Recognises the parts of both bodies, and prepares everything that doesn't depend on the reference pose.
 * @param pairs which joints of the target follow which of the source; indices that don't exist are ignored
 */
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
  const sourceParts = partsOf(source, sourceSpace?.up);
  const sourceRest = retargetBody(source, sourceSpace);
  const feet = LIMB_SIDES.flatMap((side): FeetPair[] => {
    const ankle = driven({ roles, sourceOf }, `${side} foot`);
    const own = ankle < 0 ? undefined : footOf(target, targetSpace, roles.rest, roles, ankle);
    const other = own && footOf(source, sourceSpace, sourceRest, sourceParts, sourceOf[ankle]);
    return own && other ? [{ side, own, source: other }] : [];
  });
  const rest = { ...roles.rest, soles: true };
  return { source, sourceSpace, target, targetSpace, sourceOf, roles, sourceParts, feet, rest };
}

/** The target's joint of that role if it is paired; else -1. */
export function driven({ roles, sourceOf }: Pick<Bodies, 'roles' | 'sourceOf'>, role: Role): number {
  const joint = roles.single.get(role) ?? -1;
  return joint >= 0 && sourceOf[joint] >= 0 ? joint : -1;
}

const UP: readonly number[] = [0, 1, 0];
/** A trunk that leans less than this is upright; the lean is anatomy. */
const UPRIGHT = Math.cos(Math.PI / 9);

/** Nine numbers: x from right to left, y up from the hips, z to the front, for the joints given by `at`. */
export function bodyFrame({ points }: RetargetBody, bodies: Bodies, at: (target: number) => number): Float64Array {
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
export function bodyTurn(bodies: Bodies, reference: RetargetBody): Float64Array {
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

/** The constant rotations that turn the source's joints into the target's. */
export interface Alignment {
  /** K of every pair, nine numbers per target joint; the identity if it is not paired. */
  readonly corrections: Float64Array;
  readonly slopes: readonly FootSlope[];
}

/** Aligns a target with its source at a reference pose of the source, by the rule at the top of this file. */
export function alignment(bodies: Bodies, reference: Reference): Alignment {
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
  const slopes: FootSlope[] = [];
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
    if (hand >= 0) {
      put(hand, forearm >= 0 ? turns : body, forearm >= 0 ? 9 * forearm : 0);
      alignHand(bodies, reference, hand, turns);
    }
    const foot = driven(bodies, `${side} foot`);
    const toe = driven(bodies, `${side} toe`);
    const pair = bodies.feet.find((feet) => feet.side === side);
    const { turn, slope } = pair ? alignFoot(bodies, reference, pair, turns, body) : { turn: body };
    for (const j of [foot, toe]) if (j >= 0) put(j, turn, 0);
    if (slope) slopes.push(slope);
  }
  const following = onlyFollowers(bodies);
  for (let j = 0; j < count; j++) {
    if (sourceOf[j] < 0 || done[j]) continue;
    let above = target.joints[j].parent;
    while (above >= 0 && !done[above]) above = target.joints[above].parent;
    put(j, above >= 0 ? turns : body, above >= 0 ? 9 * above : 0);
    if (following[j] >= 0) swingTo(bodies, reference, j, following[j], turns);
  }
  const corrections = new Float64Array(9 * count);
  const corrected = new Float64Array(9);
  for (let j = 0; j < count; j++) {
    setIdentity3(corrections, 9 * j);
    if (sourceOf[j] < 0) continue;
    multiply3(turns, 9 * j, rest.rotations, 9 * j, corrected, 0);
    backMultiply3(reference.rotations, 9 * sourceOf[j], corrected, 0, corrections, 9 * j);
  }
  return { corrections, slopes };
}

/** Extends D of a joint so that its bone to another points like the source's. */
function swingTo(
  { rest, sourceOf }: Bodies,
  reference: RetargetBody,
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

/** Extends D of a hand so that its fingers point like the source's, where both have fingers of one name. */
function alignHand(
  { target, roles, source, sourceParts, sourceOf, rest }: Bodies,
  reference: Reference,
  j: number,
  turns: Float64Array,
) {
  const own = fingerBases(target, roles, j);
  const other = fingerBases(source, sourceParts, sourceOf[j]);
  const shared = [...own.keys()].filter((finger) => other.has(finger));
  // The middle one says best where a hand points to.
  const fingers = shared.includes('middle') ? (['middle'] as const) : shared;
  const [from, to] = [new Float64Array(3), new Float64Array(3)];
  const add = ({ points }: RetargetBody, hand: number, finger: number | undefined, out: Float64Array) => {
    if (finger === undefined) return;
    for (let k = 0; k < 3; k++) out[k] += points[3 * finger + k] - points[3 * hand + k];
  };
  for (const finger of fingers) {
    add(rest, j, own.get(finger), from);
    add(reference, sourceOf[j], other.get(finger), to);
  }
  turnVector(turns, 9 * j, from, 0, from, 0);
  turnOn(from, to, turns, 9 * j);
}

/** D of a foot and its toe, and how it slopes. */
function alignFoot(bodies: Bodies, reference: Reference, pair: FeetPair, turns: Float64Array, body: Float64Array) {
  const { rest, sourceOf } = bodies;
  const { own: foot, source, side } = pair;
  const shin = driven(bodies, `${side} shin`);
  const own = footDirection(rest, foot);
  const other = footDirection(reference, source);
  const isFlat = rest.soles && reference.soles;
  const turn = isFlat || shin < 0 ? Float64Array.from(body) : turns.slice(9 * shin, 9 * shin + 9);
  if (isFlat) alignSole(own, other, turn);
  else {
    const from = new Float64Array(3);
    turnVector(turn, 0, own, 0, from, 0);
    turnOn(from, other, turn, 0);
  }
  const joints = Int32Array.from(foot.joints.filter((j) => sourceOf[j] >= 0));
  return { turn, slope: isFlat ? slopeOf(own, other, turn, rest.rotations, 9 * joints[0], joints) : undefined };
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

/**
 * The source in the scene, in a pose or in its file pose.
 * @param dofs all of the source's; absent: its file pose
 */
export function sourceBody({ source, sourceSpace }: Bodies, dofs?: Float64Array): RetargetBody {
  return retargetBody(source, sourceSpace, dofs);
}
