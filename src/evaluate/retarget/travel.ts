/** Transforms points from source to target, between their own spaces and the scene's. */
import type { RetargetPlan, SpaceRule } from './plan.ts';

/**
 * Moves the target by its carrier's DOFs and updates the positions of the joints that it carries; axes without such a
 * DOF are left alone.
 */
export function moveBy(
  { target, targetWorld, carrier }: RetargetPlan,
  x: number,
  y: number,
  z: number,
  out: Float64Array,
): void {
  const { joint, dofs } = carrier;
  const above = target.parent[joint];
  for (let k = 0; k < 3; k++) {
    const d = dofs[k];
    if (d < 0) continue;
    const way = k === 0 ? x : k === 1 ? y : z;
    if (above < 0) out[d] += way;
    else {
      const c = 16 * above + 4 * k;
      out[d] += targetWorld[c] * x + targetWorld[c + 1] * y + targetWorld[c + 2] * z;
    }
    for (let o = 16 * joint + 12 + k; o < 16 * target.subtreeEnd[joint]; o += 16) targetWorld[o] += way;
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

/** Maps a point of the source in the scene to the target's. */
export function inProportion({ scale }: RetargetPlan, p: Float64Array): void {
  for (let k = 0; k < 3; k++) p[k] *= scale;
}
