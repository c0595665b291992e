/**
 * Hit testing of rig mode's handles. If several are under the pointer the smallest wins, so that each can be reached.
 *
 *     joint, right on it    5 px      face of the box    8 px      arrow    6 px      joint, near it    11 px
 *     bone                  5 px
 */
import { AXES, type RigPart, type RigScreen } from '../../../view/rig/rig-screen.ts';

const ON_JOINT = 5;
/** Dot including outline: the joint's whole hit area while clicks beside it add a joint. */
const ON_DOT = 7;
export const NEAR_JOINT = 11;
const NEAR_FACE = 8;
const NEAR_ARROW = 6;
const NEAR_BONE = 5;

export interface Hand {
  /** Larger tolerance for touch. */
  readonly byTouch?: boolean;
  /** A click would add a joint, so only the dot itself hits a joint. */
  readonly isAdding?: boolean;
}

/** @param x, y CSS pixels from the viewport's top left */
export function partAt(
  screen: RigScreen,
  x: number,
  y: number,
  { byTouch = false, isAdding = false }: Hand = {},
): RigPart | undefined {
  const reach = byTouch ? 2 : 1;
  const joint = nearestJoint(screen, x, y);
  if (joint && joint.distance <= (isAdding ? ON_DOT : ON_JOINT) * reach) return { kind: 'joint', joint: joint.joint };
  if (isAdding) return undefined;
  return (
    faceAt(screen, x, y, NEAR_FACE * reach) ??
    arrowAt(screen, x, y, NEAR_ARROW * reach) ??
    (joint && joint.distance <= NEAR_JOINT * reach ? { kind: 'joint', joint: joint.joint } : undefined) ??
    boneAt(screen, x, y, NEAR_BONE * reach)
  );
}

/** Of coincident joints the selected one, else the last: a selected handle stays selected. */
function nearestJoint({ nodes, jointCount, selected }: RigScreen, x: number, y: number) {
  let best: { joint: number; distance: number } | undefined;
  for (let j = 0; j < jointCount; j++) {
    const distance = Math.hypot(nodes[2 * j] - x, nodes[2 * j + 1] - y);
    // Skips NaN.
    if (!(distance >= 0)) continue;
    const isNearer = best === undefined || distance < best.distance - SAME_PLACE;
    const isOnIt = best !== undefined && distance <= best.distance + SAME_PLACE && best.joint !== selected;
    if (isNearer || isOnIt) best = { joint: j, distance };
  }
  return best;
}
const SAME_PLACE = 0.5;

function faceAt({ faces }: RigScreen, x: number, y: number, reach: number): RigPart | undefined {
  let best: RigPart | undefined;
  let least = reach;
  for (const axis of AXES) {
    for (const side of ['min', 'max'] as const) {
      const o = 4 * axis + (side === 'max' ? 2 : 0);
      const distance = Math.hypot(faces[o] - x, faces[o + 1] - y);
      if (!(distance <= least)) continue;
      least = distance;
      best = { kind: 'face', axis, side };
    }
  }
  return best;
}

function arrowAt({ arrows }: RigScreen, x: number, y: number, reach: number): RigPart | undefined {
  let best: RigPart | undefined;
  let least = reach;
  for (const axis of AXES) {
    const o = 4 * axis;
    const distance = toSegment(x, y, arrows[o], arrows[o + 1], arrows[o + 2], arrows[o + 3]);
    if (!(distance <= least)) continue;
    least = distance;
    best = { kind: 'arrow', axis };
  }
  return best;
}

function boneAt({ nodes, starts }: RigScreen, x: number, y: number, reach: number): RigPart | undefined {
  let best: RigPart | undefined;
  let least = reach;
  for (let n = 0; n < starts.length; n++) {
    const from = starts[n];
    if (from < 0) continue;
    const distance = toSegment(x, y, nodes[2 * from], nodes[2 * from + 1], nodes[2 * n], nodes[2 * n + 1]);
    if (!(distance <= least)) continue;
    least = distance;
    best = { kind: 'bone', joint: from };
  }
  return best;
}

/** Distance from a point to a segment; NaN if an end is. */
export function toSegment(x: number, y: number, ax: number, ay: number, bx: number, by: number): number {
  const dx = bx - ax;
  const dy = by - ay;
  const length2 = dx * dx + dy * dy;
  const t = length2 > 0 ? Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / length2)) : 0;
  return Math.hypot(ax + t * dx - x, ay + t * dy - y);
}
