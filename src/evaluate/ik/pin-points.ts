/**
 * Characteristic points of a joint for pinning: a click snaps to them, and one is used if no point was picked. All are
 * in the joint's space, so they move with it.
 */
import { invertAffine, isSingular } from '../../math/mat4.ts';
import { transformPoint, type Vec3, ZERO } from '../../math/vec3.ts';
import type { Character } from '../../model/document.ts';
import { shownSkin } from '../../model/document.ts';
import { tipOf } from '../../model/skeleton/bone-ends.ts';
import { hasBox } from '../../model/skeleton/boxes.ts';
import type { Joint, Skeleton } from '../../model/skeleton/skeleton.ts';
import { type Attachments, bindingCount, type Skin } from '../../model/skin.ts';
import { compileSkin } from '../skin/deform.ts';

/** `boxEnd`: the centre of a face of the joint's box. `skinEnd`: the farthest vertex attached to the joint. */
export type PinPointKind = 'origin' | 'tip' | 'endSite' | 'boxEnd' | 'skinEnd';

/** A point of a joint to which pins snap. */
export interface PinPoint {
  readonly kind: PinPointKind;
  /** In the joint's space. */
  readonly point: Vec3;
  /** For users: "origin", "tip", "End Site 2", "box end −y", "end of the skin". */
  readonly name: string;
}

/** Points closer than this fraction of the farthest one's distance are the same. */
const SAME_POINT = 1e-6;
/** A box has an end if one face is farther from the pivot than all others by this factor. */
const END_RATIO = 1.25;

const FACES = [
  [0, 'min', 'box end −x'],
  [0, 'max', 'box end +x'],
  [1, 'min', 'box end −y'],
  [1, 'max', 'box end +y'],
  [2, 'min', 'box end −z'],
  [2, 'max', 'box end +z'],
] as const;

/**
 * The points of a joint that a click may snap to: its origin, tip, End Sites, the centres of its box's faces, the end
 * of its skin. Of coinciding points the first in that order is kept.
 *
 * @param skin the skeleton's skin, to include its end
 */
export function pinPoints(skeleton: Skeleton, joint: number, skin?: Skin): readonly PinPoint[] {
  const own = skeleton.joints[joint];
  const tip = tipOf(own);
  const end = skin && skinEnd(skin, joint);
  return withoutDoubles([
    ORIGIN,
    ...(tip ? [tipPoint(tip)] : []),
    ...endSitePoints(own),
    ...boxEndPoints(own),
    ...(end ? [end] : []),
  ]);
}

/**
 * The point to pin if only a joint was picked. A joint with children is pinned at its origin, where it visibly bends. A
 * leaf is pinned at its end, since that is what should stay in place: a foot stands on its sole. In order of
 * preference:
 *
 *     1. the tip, for a joint with a length of its own, with or without children (as `marrow ik` does)
 *     2. the farthest End Site
 *     3. the end of the skin, if given
 *     4. the end of the box, if one face is much farther from the pivot than the others; a box around the pivot,
 *        as in files without boxes, has no end
 *     5. the origin
 */
export function defaultPinPoint(skeleton: Skeleton, joint: number, skin?: Skin): PinPoint {
  const own = skeleton.joints[joint];
  const tip = tipOf(own);
  if (tip) return distance(tip) > 0 ? tipPoint(tip) : ORIGIN;
  if (skeleton.joints.some(({ parent }) => parent === joint)) return ORIGIN;
  const site = furthest(endSitePoints(own));
  if (site && distance(site.point) > 0) return site;
  return (skin && skinEnd(skin, joint)) ?? boxEnd(own) ?? ORIGIN;
}

/** Joints that move a vertex by at least this much of the largest weight move it as well as that one does. */
const AS_WELL = 0.5;

/**
 * The current position of a vertex of the shown skin as a point of a joint that moves it. Undefined if none does, or
 * the joint's matrix is singular. Of joints that move it about as much it is the one whose pivot is nearest: what is
 * picked at the knee is the shin's, which bends there, not the thigh's.
 *
 * @param world from `worldMatrices`
 * @param deformed the vertex's position in the same space
 */
export function skinPinPoint(
  character: Character,
  vertex: number,
  world: Float64Array,
  deformed: Vec3,
): { readonly joint: number; readonly point: Vec3 } | undefined {
  const skin = shownSkin(character);
  const jointCount = character.skeleton?.joints.length ?? 0;
  if (!skin || jointCount === 0) return undefined;
  const joint = skin.attachments ? nearestOfHeaviest(skin.attachments, vertex, world, deformed, jointCount) : 0;
  if (joint < 0 || isSingular(world, 16 * joint)) return undefined;
  const inverse = new Float64Array(16);
  invertAffine(world, 16 * joint, inverse, 0);
  return { joint, point: transformPoint(inverse, deformed) };
}

const ORIGIN: PinPoint = { kind: 'origin', point: ZERO, name: 'origin' };

function tipPoint(point: Vec3): PinPoint {
  return { kind: 'tip', point, name: 'tip' };
}

function endSitePoints({ endSites = [] }: Joint): PinPoint[] {
  const name = (i: number) => (endSites.length > 1 ? `End Site ${i + 1}` : 'End Site');
  return endSites.map((point, i) => ({ kind: 'endSite', point, name: name(i) }));
}

/** Empty if the box is only the default one. */
function boxEndPoints(joint: Joint): PinPoint[] {
  if (!hasBox(joint)) return [];
  const { min, max } = joint.box;
  return FACES.map(([axis, side, name]) => {
    const at = (k: number) => (k === axis ? joint.box[side][k] : min[k] + (max[k] - min[k]) / 2);
    return { kind: 'boxEnd', point: [at(0), at(1), at(2)], name };
  });
}

/** The face that is farther than the others, if any. */
function boxEnd(joint: Joint): PinPoint | undefined {
  const faces = boxEndPoints(joint);
  const end = furthest(faces);
  if (!end) return undefined;
  const length = distance(end.point);
  return faces.every((face) => face === end || distance(face.point) * END_RATIO <= length) ? end : undefined;
}

/** The vertex farthest from the joint's pivot among those that the joint moves most, in the binding pose. */
function skinEnd(skin: Skin, joint: number): PinPoint | undefined {
  const { attachments, positions } = skin;
  if (!attachments || joint >= bindingCount(skin)) return undefined;
  const { inverseBindings, vertexCount } = compileSkin(skin);
  let best: Vec3 | undefined;
  let most = 0;
  for (let v = 0; v < vertexCount; v++) {
    if (heaviestJoint(attachments, v, bindingCount(skin)) !== joint) continue;
    const at: Vec3 = [positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]];
    const point = transformPoint(inverseBindings, at, 16 * joint);
    const length = distance(point);
    if (!(length > most && length < Infinity)) continue;
    best = point;
    most = length;
  }
  return best && { kind: 'skinEnd', point: best, name: 'end of the skin' };
}

/** The joint that moves a vertex most, among the first `jointCount`; the first of equals, -1 if none does. */
function heaviestJoint({ start, joints, weights }: Attachments, vertex: number, jointCount: number): number {
  let joint = -1;
  let most = 0;
  for (let i = start[vertex]; i < start[vertex + 1]; i++) {
    if (!(weights[i] > most) || joints[i] >= jointCount) continue;
    joint = joints[i];
    most = weights[i];
  }
  return joint;
}

/**
 * The joint whose pivot is nearest to a vertex, among those that move it about as much as any other; -1 if none does.
 */
function nearestOfHeaviest(
  attachments: Attachments,
  vertex: number,
  world: Float64Array,
  at: Vec3,
  jointCount: number,
): number {
  const { start, joints, weights } = attachments;
  const heaviest = heaviestJoint(attachments, vertex, jointCount);
  const own = [...joints.subarray(start[vertex], start[vertex + 1])];
  const most = Math.max(0, ...own.map((joint, a) => (joint === heaviest ? weights[start[vertex] + a] : 0)));
  const away = (joint: number) => apart([world[16 * joint + 12], world[16 * joint + 13], world[16 * joint + 14]], at);
  return own
    .filter((joint, a) => joint < jointCount && weights[start[vertex] + a] >= AS_WELL * most)
    .reduce((best, joint) => (away(joint) < away(best) ? joint : best), heaviest);
}

function withoutDoubles(points: readonly PinPoint[]): PinPoint[] {
  const size = Math.max(...points.map(({ point }) => distance(point)));
  const kept: PinPoint[] = [];
  for (const point of points) {
    if (!kept.some((other) => apart(other.point, point.point) <= SAME_POINT * size)) kept.push(point);
  }
  return kept;
}

function furthest(points: readonly PinPoint[]): PinPoint | undefined {
  let best: PinPoint | undefined;
  for (const point of points) if (!best || distance(point.point) > distance(best.point)) best = point;
  return best;
}

function distance(point: Vec3): number {
  return Math.hypot(...point);
}

function apart(a: Vec3, b: Vec3): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}
