/** Weights that change smoothly along a limb, as if painted with one soft brush. */
import { smoothstep } from '../../../src/math/smoothstep.ts';
import { add, dot, scaled, subtract, type Vec3 } from '../../../src/math/vec3.ts';
import type { Weights } from './mesh.ts';

/** Beyond this position the joint takes over from the previous one, blended over `soft` to either side. */
export interface Bend {
  readonly joint: number;
  readonly from: number;
  readonly soft: number;
}

/** Weights at `x` along a chain starting with joint `first`; bends in ascending (or all descending) order. */
export function chainWeights(x: number, first: number, bends: readonly Bend[]): Weights {
  const weights = new Map<number, number>();
  let left = 1;
  for (let i = bends.length - 1; i >= 0; i--) {
    const { joint, from, soft } = bends[i];
    const taken = left * smoothstep(from - soft, from + soft, x);
    if (taken > 0) weights.set(joint, (weights.get(joint) ?? 0) + taken);
    left -= taken;
  }
  if (left > 0) weights.set(first, (weights.get(first) ?? 0) + left);
  return weights;
}

/** `a` and `b` in the proportion 1 − t : t. */
export function mixWeights(a: Weights, b: Weights, t: number): Weights {
  const weights = new Map<number, number>();
  for (const [joint, w] of a) weights.set(joint, w * (1 - t));
  for (const [joint, w] of b) weights.set(joint, (weights.get(joint) ?? 0) + w * t);
  return weights;
}

/** Position of the point of a polyline nearest to `p`: i + t on segment i; below 0 before its start. */
export function placeAlong(line: readonly Vec3[], p: Vec3): number {
  let place = 0;
  let nearest = Number.POSITIVE_INFINITY;
  for (let i = 0; i + 1 < line.length; i++) {
    const d = subtract(line[i + 1], line[i]);
    const t = Math.max(i === 0 ? -1 : 0, Math.min(1, dot(subtract(p, line[i]), d) / dot(d, d)));
    const miss = subtract(p, add(line[i], scaled(d, t)));
    if (dot(miss, miss) < nearest) [nearest, place] = [dot(miss, miss), i + t];
  }
  return place;
}
