/** Transforms points from source to target, between their own spaces and the scene's. */
import type { RetargetPlan, SpaceRule } from './plan.ts';

/**
 * Moves the whole target by its travel DOFs and updates its joints' positions; axes without such a DOF are left alone.
 */
export function moveBy(
  { target, targetWorld }: RetargetPlan,
  x: number,
  y: number,
  z: number,
  out: Float64Array,
): void {
  const { travel } = target;
  for (let k = 0; k < 3; k++) {
    const d = travel[k];
    if (d < 0) continue;
    const way = k === 0 ? x : k === 1 ? y : z;
    out[d] += way;
    for (let o = 12 + k; o < targetWorld.length; o += 16) targetWorld[o] += way;
  }
}

/** A point of a character, from its own space to the scene's metres. */
export function toScene({ up, metres, lift }: SpaceRule, p: Float64Array): void {
  const x = p[0];
  const y = p[1];
  const z = p[2];
  for (let k = 0; k < 3; k++) p[k] = metres * (up[k] * x + up[3 + k] * y + up[6 + k] * z);
  p[1] += lift;
}

/** A point of the scene, to a character's own space. */
export function fromScene({ up, metres, lift }: SpaceRule, p: Float64Array): void {
  const x = p[0] / metres;
  const y = (p[1] - lift) / metres;
  const z = p[2] / metres;
  for (let k = 0; k < 3; k++) p[k] = up[3 * k] * x + up[3 * k + 1] * y + up[3 * k + 2] * z;
}

/** Maps a point of the source in the scene to the target's position, by their heights when standing. */
export function inProportion({ scale }: RetargetPlan, p: Float64Array, ownHeight: number, sourceHeight: number): void {
  p[0] *= scale;
  p[1] = ownHeight + scale * (p[1] - sourceHeight);
  p[2] *= scale;
}
