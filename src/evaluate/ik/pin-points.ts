/**
 * The points of a joint that a person means when pinning it: what a click snaps to, and what is pinned where no point was
 * picked. All are in the joint's space, so they go with it.
 */
import { invertAffine, isSingular } from '../../math/mat4.ts';
import { transformPoint, type Vec3, ZERO } from '../../math/vec3.ts';
import { tipOf } from '../../model/bone-ends.ts';
import { hasBox } from '../../model/boxes.ts';
import type { Character } from '../../model/document.ts';
import { shownSkin } from '../../model/document.ts';
import type { Joint, Skeleton } from '../../model/skeleton.ts';
import { type Attachments, bindingCount, type Skin } from '../../model/skin.ts';
import { compileSkin } from '../deform.ts';

/** `boxEnd`: the middle of a face of the joint's box. `skinEnd`: the vertex of what hangs on it that is furthest out. */
export type PinPointKind = 'origin' | 'tip' | 'endSite' | 'boxEnd' | 'skinEnd';

export interface PinPoint {
  readonly kind: PinPointKind;
  /** In the joint's space. */
  readonly point: Vec3;
  /** For people: "origin", "tip", "End Site 2", "box end −y", "end of the skin". */
  readonly name: string;
}

/** Points that are nearer to each other than that part of what is furthest out are one. */
const SAME_POINT = 1e-6;
/** A box has an end where one of its faces is so much further from the pivot than any other. */
const STANDS_OUT = 1.25;

const FACES = [
  [0, 'min', 'box end −x'],
  [0, 'max', 'box end +x'],
  [1, 'min', 'box end −y'],
  [1, 'max', 'box end +y'],
  [2, 'min', 'box end −z'],
  [2, 'max', 'box end +z'],
] as const;

/**
 * The points of a joint that a click may snap to: its origin, its tip, its End Sites, the middles of its box's faces,
 * the end of its skin. Of several in one place the first of that order.
 *
 * @param skin what hangs on the skeleton, where it is to be asked
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
 * The point that is pinned where only a joint was picked. A joint that others hang on is pinned at its origin: that is
 * where it is seen to bend. A last one is pinned where it ends, for that is what should stay where it is: a foot stands
 * on its sole. In that order:
 *
 *     1. the tip, of a joint with a length of its own, whatever hangs on it (`marrow ik` does so too)
 *     2. the End Site furthest out
 *     3. the end of the skin, where one is given
 *     4. the box's end, if one of its faces is much further from the pivot than the others: a box around the pivot,
 *        which files without boxes have too, has no end
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

/**
 * The point of a joint that a vertex of the shown skin is at now: of the joint that moves the vertex most. Undefined
 * where none does, or where it is flattened so that no point of it can be told.
 *
 * @param world as of `worldMatrices`
 * @param deformed where the vertex is, in the same space
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
  const joint = skin.attachments ? heaviestJoint(skin.attachments, vertex, jointCount) : 0;
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

/** None where the box is only a stand-in. */
function boxEndPoints(joint: Joint): PinPoint[] {
  if (!hasBox(joint)) return [];
  const { min, max } = joint.box;
  return FACES.map(([axis, side, name]) => {
    const at = (k: number) => (k === axis ? joint.box[side][k] : min[k] + (max[k] - min[k]) / 2);
    return { kind: 'boxEnd', point: [at(0), at(1), at(2)], name };
  });
}

/** The face that stands out, if one does. */
function boxEnd(joint: Joint): PinPoint | undefined {
  const faces = boxEndPoints(joint);
  const end = furthest(faces);
  if (!end) return undefined;
  const length = distance(end.point);
  return faces.every((face) => face === end || distance(face.point) * STANDS_OUT <= length) ? end : undefined;
}

/** The vertex furthest from the joint's pivot, of those that the joint moves most; in the pose that it was bound in. */
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

/** The joint that moves a vertex most, of the first `jointCount`; the first of equals, -1 where none does. */
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
