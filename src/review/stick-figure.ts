/** A take as a small moving picture: a few frames of a stick figure, seen from the side and above its feet. */
import { partsOf } from '../evaluate/retarget/roles.ts';
import type { Skeleton } from '../model/skeleton/skeleton.ts';
import type { Space } from '../model/space.ts';
import type { Take } from '../model/takes/take.ts';
import { takeFrames } from './frames.ts';

/** About 2 kB, so that thousands fit in a page. */
export interface StickFigure {
  readonly frameCount: number;
  readonly pointCount: number;
  /** Of each point the one above it, which precedes it; its own index for one without. */
  readonly above: Uint8Array;
  /** x y of each point of each frame, 0 to 255 from the top left, the same scale both ways. */
  readonly points: Uint8Array;
}

const FRAMES = 24;
const MAX_POINTS = 64;
/** The figure is turned by this much, so that arms and legs are seen; radians. */
const TURN = 0.6;

/** In place: the middle of the figure stays in the middle of the picture. */
export function stickFigure(skeleton: Skeleton, take: Take, space: Space | undefined): StickFigure {
  const frames = takeFrames(skeleton, take, space);
  const kept = pointsKept(skeleton, frames.above, space);
  const frameCount = Math.min(FRAMES, frames.count);
  const pointCount = kept.length;
  const flat = new Float64Array(2 * pointCount * frameCount);
  const dofs = new Float64Array(frames.dofCount);
  const points = new Float64Array(3 * frames.pointCount);
  const [cos, sin] = [Math.cos(TURN), Math.sin(TURN)];
  let [low, high, wide] = [Infinity, -Infinity, 0];
  for (let f = 0; f < frameCount; f++) {
    frames.write(Math.round((f * (frames.count - 1)) / Math.max(1, frameCount - 1)), dofs, points);
    let middle = 0;
    kept.forEach((p, i) => {
      const o = 2 * (f * pointCount + i);
      flat[o] = cos * points[3 * p] + sin * points[3 * p + 2];
      flat[o + 1] = points[3 * p + 1];
      middle += flat[o] / pointCount;
      low = Math.min(low, flat[o + 1]);
      high = Math.max(high, flat[o + 1]);
    });
    for (let i = 0; i < pointCount; i++) {
      const o = 2 * (f * pointCount + i);
      flat[o] -= middle;
      wide = Math.max(wide, Math.abs(flat[o]));
    }
  }
  const size = Math.max(high - low, 2 * wide);
  const scale = size > 0 ? 255 / size : 0;
  const out = new Uint8Array(flat.length);
  for (let o = 0; o < flat.length; o += 2) {
    out[o] = Math.round(127.5 + scale * flat[o]);
    out[o + 1] = Math.round(127.5 - scale * (flat[o + 1] - (low + high) / 2));
  }
  const places = new Map(kept.map((p, i) => [p, i]));
  const above = Uint8Array.from(kept, (p, i) => places.get(frames.above[p]) ?? i);
  return { frameCount, pointCount, above, points: out };
}

/** Joints and End Sites without fingers: those above each come first. */
function pointsKept(skeleton: Skeleton, above: Int32Array, space: Space | undefined): readonly number[] {
  const { single } = partsOf(skeleton, space?.up);
  const hands = new Set([single.get('left hand'), single.get('right hand')]);
  const kept = new Set<number>();
  above.forEach((parent, p) => {
    if (kept.size >= MAX_POINTS || (parent >= 0 && (!kept.has(parent) || hands.has(parent)))) return;
    kept.add(p);
  });
  return [...kept];
}
