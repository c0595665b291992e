/** The end of a limb under the pointer, which Pose mode drags. */
import { isLongerThanLimb } from '../../../evaluate/ik/limb.ts';
import { limbEnds } from '../../../evaluate/ik/limb-ends.ts';
import { pointAt } from '../../../evaluate/ik/set-up.ts';
import { invertAffine, isSingular } from '../../../math/mat4.ts';
import { type Vec3, ZERO } from '../../../math/vec3.ts';
import { type Character, findCharacter } from '../../../model/document.ts';
import { perSkeleton } from '../../../model/skeleton/per-skeleton.ts';
import type { Skeleton } from '../../../model/skeleton/skeleton.ts';
import type { Uses } from '../../state/workbench.ts';
import { NATURAL_POINT_PIXELS, nearestOnScreen } from '../ik/nearest-on-screen.ts';
import {
  heldPoint,
  inWorld,
  pointUnder,
  type SeenPoint,
  type SeenSkeleton,
  seenSkeletons,
} from '../ik/pins-on-screen.ts';
import { whatMoves } from '../ik/reach.ts';
import type { CanvasPointer } from '../viewport/canvas-tools.ts';

const ENDS = {
  y: perSkeleton((skeleton) => limbEnds(skeleton, 'y')),
  z: perSkeleton((skeleton) => limbEnds(skeleton, 'z')),
  '-y': perSkeleton((skeleton) => limbEnds(skeleton, '-y')),
} as const;

/** Undefined: a press there is the camera's. Its point is the one under the pointer, in the space of the end. */
export function endUnder(wb: Uses<'store' | 'viewport' | 'settings'>, at: CanvasPointer): SeenPoint | undefined {
  const under = pointUnder(wb, at);
  const character = findCharacter(wb.store.document, under?.characterId);
  if (!under || !character?.skeleton) return undefined;
  const ends = endsOf(character, character.skeleton);
  const end = ends[under.joint];
  const { characterId, placement } = under;
  if (end === under.joint) return { characterId, placement, joint: end, point: heldPoint(wb, under) };
  const seen = seenAt(wb, characterId, placement);
  if (!seen) return undefined;
  if (end >= 0) {
    const point = inJoint(seen, end, pointAt(seen.world, under.joint, heldPoint(wb, under)));
    return point && { characterId, placement, joint: end, point };
  }
  const near = pivotNear(wb, seen, ends, at);
  return near === undefined ? undefined : { characterId, placement, joint: near, point: ZERO };
}

/** What a drag of the end that a joint belongs to would move, in words; undefined if it belongs to none. */
export function whatEndMoves(
  wb: Uses<'store' | 'viewport' | 'settings' | 'posing'>,
  characterId: string,
  joint: number,
): string | undefined {
  const character = findCharacter(wb.store.document, characterId);
  const end = character?.skeleton && endsOf(character, character.skeleton)[joint];
  return end === undefined || end < 0 ? undefined : whatMoves(wb, characterId, end);
}

function endsOf({ space }: Pick<Character, 'space'>, skeleton: Skeleton): Int32Array {
  return ENDS[space?.up ?? 'y'](skeleton);
}

function seenAt(wb: Uses<'store' | 'viewport'>, characterId: string, placement: number): SeenSkeleton | undefined {
  for (const one of seenSkeletons(wb, ({ id }) => id === characterId)) if (one.placement === placement) return one;
  return undefined;
}

/** A point of the character's space in a joint's. */
function inJoint({ world }: SeenSkeleton, joint: number, point: Vec3): Vec3 | undefined {
  if (isSingular(world, 16 * joint)) return undefined;
  const inverse = new Float64Array(16);
  invertAffine(world, 16 * joint, inverse, 0);
  return pointAt(inverse, 0, point);
}

/** The end whose pivot is close to the pointer: bones and skin there are those of the joint above. */
function pivotNear(
  wb: Uses<'viewport'>,
  seen: SeenSkeleton,
  ends: Int32Array,
  { clientX, clientY }: CanvasPointer,
): number | undefined {
  const joints = [...ends.keys()].filter((joint) => ends[joint] === joint && !isLongerThanLimb(seen.skeleton, joint));
  const places = joints.map((joint) => wb.viewport.eye.toScreen(inWorld(seen, joint, ZERO)));
  const near = nearestOnScreen(places, { x: clientX, y: clientY }, NATURAL_POINT_PIXELS);
  return near < 0 ? undefined : joints[near];
}
