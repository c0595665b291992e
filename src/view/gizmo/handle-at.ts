/**
 * The handle under a point of the screen. Only what faces the viewer is hit: far halves of rings, hidden by the ball if
 * it were solid, are not.
 */
import { type HandleId, sameHandle } from '../../evaluate/handles/joint-handles.ts';
import { BALL_PART, hasArc, isAllowed, isInSquare, type Layout, type Shape } from './shapes.ts';

/** Hit tolerance, CSS pixels. */
const REACH = 7;
/**
 * A point this close to a line is on it: where several lines cross, the one in front is hit. Farther away is the line's
 * margin. CSS pixels.
 */
const ON_LINE = 3;
/** Half the size of a handle's head, CSS pixels. */
const HEAD = 6;
/** Near the pivot, where all arrows meet, none is hit. CSS pixels. */
const MIDDLE = 16;

export interface HandleHit {
  readonly id: HandleId;
  /**
   * Other joints under the pointer come first: it is a handle of free rotation, the margin of a line, or a part of a
   * ring beyond the DOF's limits, which is drawn faintly.
   */
  readonly yields: boolean;
  /** Near the pivot, where a ring passes that is seen from its edge. */
  readonly isAtPivot: boolean;
}

/** Distance from a piece in CSS pixels, and the depth of its nearest point. */
interface Nearest {
  distance: number;
  depth: number;
}

/**
 * The line nearest to a point of the viewport; where several cross, the one in front. Inside the rings, the ball. The
 * dot of the active ring comes before all: it is drawn over them.
 *
 * @param slack extra tolerance, for touch; CSS pixels
 */
export function handleAt(layout: Layout, x: number, y: number, slack = 0, active?: HandleId): HandleHit | undefined {
  const own = active?.kind === 'dof' && layout.shapes.find(({ id, form }) => form === 'ring' && sameHandle(id, active));
  const [px, py] = layout.pivot;
  const toPivot = Math.hypot(x - px, y - py);
  const isAtPivot = toPivot < MIDDLE;
  if (own && Math.hypot(x - own.points[0], y - own.points[1]) <= REACH + slack) {
    return { id: own.id, yields: false, isAtPivot };
  }
  let found: HandleHit | undefined;
  let bestOff = Infinity;
  let bestDepth = -Infinity;
  const nearest: Nearest = { distance: 0, depth: 0 };
  for (const shape of layout.shapes) {
    if (shape.isAway || shape.form === 'disc') continue;
    for (let i = 0; i < shape.isBehind.length; i++) {
      if (shape.isBehind[i]) continue;
      toPiece(shape, i, x, y, nearest);
      if (nearest.distance > REACH + slack) continue;
      const off = Math.max(0, nearest.distance - ON_LINE);
      if (off > bestOff || (off === bestOff && nearest.depth <= bestDepth)) continue;
      bestOff = off;
      bestDepth = nearest.depth;
      const yields = off > 0 || shape.id.kind === 'view' || isBeyondLimits(shape, i);
      found = { id: shape.id, yields, isAtPivot };
    }
  }
  if (found) return found;
  const ball = layout.shapes.find(({ form }) => form === 'disc');
  return ball && toPivot <= BALL_PART * layout.radius ? { id: ball.id, yields: true, isAtPivot } : undefined;
}

function isBeyondLimits({ form, range, step }: Shape, i: number): boolean {
  return form === 'ring' && hasArc(range) && !isAllowed(range, (i + 0.5) * step);
}

function toPiece(shape: Shape, i: number, x: number, y: number, out: Nearest): void {
  const { form, points, depths } = shape;
  const o = 2 * i;
  const [ax, ay, bx, by] = [points[o], points[o + 1], points[o + 2], points[o + 3]];
  const square = (bx - ax) ** 2 + (by - ay) ** 2;
  const t = square > 0 ? Math.min(1, Math.max(0, ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / square)) : 0;
  out.distance = Math.hypot(x - ax - t * (bx - ax), y - ay - t * (by - ay));
  out.depth = depths[i] + t * (depths[i + 1] - depths[i]);
  if (form === 'square' && isInSquare(shape, x, y)) {
    out.distance = 0;
    out.depth = (depths[0] + depths[2]) / 2;
  }
  if (form === 'ring' || form === 'square') return;
  const toHead = Math.hypot(x - bx, y - by) - HEAD;
  if (Math.hypot(x - ax, y - ay) < MIDDLE) out.distance = Infinity;
  else if (toHead < out.distance) {
    out.distance = Math.max(0, toHead);
    out.depth = depths[i + 1];
  }
}
