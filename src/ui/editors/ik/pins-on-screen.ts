/** Screen positions of pins and joints, as drawn now. */
import { seenPoint } from '../../../evaluate/ik/drag/grip.ts';
import { isLongerThanLimb } from '../../../evaluate/ik/limb.ts';
import { type PinPoint, pinPoints, skinPinPoint } from '../../../evaluate/ik/pin-points.ts';
import { ikOf, pointAt } from '../../../evaluate/ik/set-up.ts';
import { invertAffine, isSingular } from '../../../math/mat4.ts';
import { type Vec3, ZERO } from '../../../math/vec3.ts';
import { type Character, findCharacter, shownSkin } from '../../../model/document.ts';
import type { Pin } from '../../../model/ik.ts';
import { reachOf } from '../../../model/skeleton/reach.ts';
import type { Skeleton } from '../../../model/skeleton/skeleton.ts';
import type { Skin } from '../../../model/skin.ts';
import type { Uses } from '../../state/workbench.ts';
import type { CanvasPointer } from '../viewport/canvas-tools.ts';
import { NATURAL_POINT_PIXELS, nearestOnScreen, type PlaceOnScreen } from './nearest-on-screen.ts';

/** Hit tolerance around a pin, CSS pixels. */
const PIN_PIXELS = 9;
const PIN_PIXELS_TOUCH = 18;
/** Maximum distance from a bone for the pointer to be on it rather than on a box behind it. */
const BONE_PIXELS = 7;

/** As a part of the reach: pivots this close coincide. */
const SAME_PIVOT = 1e-6;

/** A visible pin. */
export interface SeenPin {
  readonly character: Character;
  readonly placement: number;
  readonly pin: Pin;
}

/** A point of a joint under the pointer. */
export interface SeenPoint {
  readonly characterId: string;
  readonly placement: number;
  readonly joint: number;
  /** The exact point for a drag, in the joint's space. */
  readonly point: Vec3;
  /** The natural point, if one is close. */
  readonly natural?: PinPoint;
  /** The picked vertex of the skin. */
  readonly vertex?: number;
}

/** A visible skeleton, with the matrices of its pose and placement, valid until the next `seek`. */
export interface SeenSkeleton {
  readonly character: Character;
  readonly skeleton: Skeleton;
  readonly placement: number;
  readonly world: Float64Array;
  /** From its own space to the world. */
  readonly toWorld: Float64Array;
  readonly dofs: Float64Array;
}

/** Visible characters with a skeleton, once per placement. */
export function* seenSkeletons(
  wb: Uses<'store' | 'viewport'>,
  of: (character: Character) => boolean,
): Generator<SeenSkeleton> {
  for (const character of wb.store.document.characters) {
    const { id, skeleton } = character;
    if (!skeleton || character.isHidden || !of(character)) continue;
    const facts = wb.viewport.character(id);
    if (!facts) continue;
    const world = facts.worlds;
    if (world.length < 16 * skeleton.joints.length) continue;
    for (let placement = 0; placement < character.placements.length; placement++) {
      const toWorld = wb.viewport.placementOf(id, placement);
      if (toWorld && toWorld.length === 16) yield { character, skeleton, placement, world, toWorld, dofs: facts.dofs };
    }
  }
}

/** World position of a point of a joint. */
export function inWorld({ world, toWorld }: SeenSkeleton, joint: number, point: Vec3): Vec3 {
  return pointAt(toWorld, 0, pointAt(world, joint, point));
}

export const hasPins = (character: Character) => (character.ik?.pins.length ?? 0) > 0;

/** Every visible pin with its client coordinates, in the same order. */
export function pinsInPicture(wb: Uses<'store' | 'viewport'>): {
  readonly pins: readonly SeenPin[];
  readonly places: readonly PlaceOnScreen[];
} {
  const pins: SeenPin[] = [];
  const places: PlaceOnScreen[] = [];
  for (const seen of seenSkeletons(wb, hasPins)) {
    for (const pin of ikOf(seen.character).pins) {
      const place = wb.viewport.eye.toScreen(inWorld(seen, pin.joint, pin.point));
      if (place.depth <= 0) continue;
      pins.push({ character: seen.character, placement: seen.placement, pin });
      places.push(place);
    }
  }
  return { pins, places };
}

/** The pin under the pointer; the nearest of several. */
export function pinUnder(wb: Uses<'store' | 'viewport'>, at: CanvasPointer): SeenPin | undefined {
  const { pins, places } = pinsInPicture(wb);
  const reach = at.pointerType === 'touch' ? PIN_PIXELS_TOUCH : PIN_PIXELS;
  return pins[nearestOnScreen(places, { x: at.clientX, y: at.clientY }, reach)];
}

/** The point that a drag holds, in the joint's space: a natural one if it is close, unless that can hardly be moved. */
export function heldPoint(wb: Uses<'store'>, { characterId, joint, natural, point }: SeenPoint): Vec3 {
  const skeleton = findCharacter(wb.store.document, characterId)?.skeleton;
  if (natural?.kind === 'origin' && skeleton && isLongerThanLimb(skeleton, joint)) return point;
  return natural?.point ?? point;
}

/** The point of a character under the pointer. */
export function pointUnder(wb: Uses<'store' | 'viewport' | 'settings'>, at: CanvasPointer): SeenPoint | undefined {
  const hit = wb.viewport.pointing.pick(at.clientX, at.clientY);
  const character = findCharacter(wb.store.document, hit?.characterId);
  if (!hit || hit.joint === undefined || !character?.skeleton) return undefined;
  const { placement } = hit;
  let seen: SeenSkeleton | undefined;
  for (const one of seenSkeletons(wb, ({ id }) => id === character.id)) if (one.placement === placement) seen = one;
  if (!seen || isSingular(seen.toWorld)) return undefined;
  const picked = pickedPoint(wb, seen, hit.joint, hit.vertex, at);
  if (!picked) return undefined;
  const natural = naturalPoint(wb, seen, picked.joint, at);
  if (natural?.kind === 'origin') {
    const joint = firstAtPivot(seen, picked.joint);
    if (joint !== picked.joint) return { characterId: character.id, placement, joint, point: ZERO, natural };
  }
  const child = natural || hit.vertex === undefined ? undefined : childUnder(wb, seen, picked.joint, at);
  if (child) return { characterId: character.id, placement, ...child };
  return {
    characterId: character.id,
    placement,
    ...picked,
    ...(natural && { natural }),
    ...(hit.vertex !== undefined && { vertex: hit.vertex }),
  };
}

/** Of joints whose pivots coincide, such as hips and the first joint of a leg in a capture, the one that moves the rest. */
function firstAtPivot({ skeleton, world }: SeenSkeleton, joint: number): number {
  const near = SAME_PIVOT * reachOf(skeleton);
  const pivot = pointAt(world, joint, ZERO);
  let first = joint;
  for (let above = skeleton.joints[joint].parent; above >= 0; above = skeleton.joints[above].parent) {
    const other = pointAt(world, above, ZERO);
    if (Math.hypot(...pivot.map((part, k) => part - other[k])) > near) break;
    first = above;
  }
  return first;
}

/**
 * The origin of a child of the joint, if the pointer is close: the skin at the ankle follows the shin, and who picks it
 * means the foot.
 */
function childUnder(
  wb: Uses<'viewport' | 'settings'>,
  seen: SeenSkeleton,
  joint: number,
  at: CanvasPointer,
): Pick<SeenPoint, 'joint' | 'point' | 'natural'> | undefined {
  const origins = [...seen.skeleton.joints.keys()].flatMap((child) => {
    if (seen.skeleton.joints[child].parent !== joint) return [];
    const points = offeredPoints(wb, seen.character, seen.skeleton, child);
    return points.flatMap((natural) =>
      natural.kind === 'origin' ? { joint: child, point: natural.point, natural } : [],
    );
  });
  const places = origins.map((each) => wb.viewport.eye.toScreen(inWorld(seen, each.joint, each.point)));
  return origins[nearestOnScreen(places, { x: at.clientX, y: at.clientY }, NATURAL_POINT_PIXELS)];
}

/** On a skin the vertex, as a point of the joint with the largest weight; else the visible point of the joint. */
function pickedPoint(
  wb: Uses<'viewport' | 'settings'>,
  { character, skeleton, placement, world, toWorld }: SeenSkeleton,
  joint: number,
  vertex: number | undefined,
  { clientX, clientY }: CanvasPointer,
): { readonly joint: number; readonly point: Vec3 } | undefined {
  const toOwn = new Float64Array(16);
  invertAffine(toWorld, 0, toOwn, 0);
  if (vertex !== undefined) {
    const drawn = wb.viewport.vertexAt(character.id, vertex, placement);
    return drawn && skinPinPoint(character, vertex, world, pointAt(toOwn, 0, drawn));
  }
  const { eye } = wb.viewport;
  const ray = eye.rayAt(clientX, clientY);
  const origin = pointAt(toOwn, 0, ray.origin);
  const ahead = pointAt(toOwn, 0, [
    ray.origin[0] + ray.direction[0],
    ray.origin[1] + ray.direction[1],
    ray.origin[2] + ray.direction[2],
  ]);
  const direction: Vec3 = [ahead[0] - origin[0], ahead[1] - origin[1], ahead[2] - origin[2]];
  const pivot = pointAt(toWorld, 0, pointAt(world, joint, [0, 0, 0]));
  // Scales one world unit to the character's own unit.
  const near = BONE_PIXELS * eye.unitsPerPixel(pivot) * Math.hypot(...direction);
  const boxesAreSeen = showsBoxes(wb, character);
  return { joint, point: seenPoint(skeleton, joint, world, { origin, direction }, near, boxesAreSeen) };
}

function naturalPoint(
  wb: Uses<'viewport' | 'settings'>,
  seen: SeenSkeleton,
  joint: number,
  at: CanvasPointer,
): PinPoint | undefined {
  const points = offeredPoints(wb, seen.character, seen.skeleton, joint);
  const places = points.map(({ point }) => wb.viewport.eye.toScreen(inWorld(seen, joint, point)));
  return points[nearestOnScreen(places, { x: at.clientX, y: at.clientY }, NATURAL_POINT_PIXELS)];
}

/** Whether the boxes of a character are drawn. */
function showsBoxes(wb: Uses<'settings'>, character: Character): boolean {
  const { boxes, skin } = wb.settings.get().display;
  const isSkinned = shownSkin(character) !== undefined && skin !== 'hidden';
  return boxes === 'bare' ? !isSkinned : boxes !== 'hidden';
}

/** The natural points that are visible: box ends only if boxes are drawn. */
export function offeredPoints(
  wb: Uses<'settings'>,
  character: Character,
  skeleton: Skeleton,
  joint: number,
): readonly PinPoint[] {
  const points = naturalPoints(skeleton, joint, shownSkin(character));
  return showsBoxes(wb, character) ? points : points.filter(({ kind }) => kind !== 'boxEnd');
}

/** Cached per joint, since finding the end of a skin searches all its vertices. */
export function naturalPoints(skeleton: Skeleton, joint: number, skin: Skin | undefined): readonly PinPoint[] {
  let known = lists.get(skeleton);
  if (!known || known.skin !== skin) {
    known = { skin, byJoint: new Map() };
    lists.set(skeleton, known);
  }
  let points = known.byJoint.get(joint);
  if (!points) {
    points = pinPoints(skeleton, joint, skin);
    known.byJoint.set(joint, points);
  }
  return points;
}

interface KnownPoints {
  readonly skin: Skin | undefined;
  readonly byJoint: Map<number, readonly PinPoint[]>;
}
const lists = new WeakMap<Skeleton, KnownPoints>();
