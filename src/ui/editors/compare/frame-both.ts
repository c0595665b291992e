/** The view that shows both programs' numbers: what is wrong may be far away. */
import type { Vec3 } from '../../../math/vec3.ts';
import type { CameraView } from '../../../view/camera/camera.ts';

/** Room around it. */
const MARGIN = 1.1;

/** Places of a character: x y z every `stride` numbers, from `first`. */
export interface Places {
  readonly numbers: Float64Array;
  readonly stride: 3 | 16;
  readonly first: 0 | 12;
}

export interface Sphere {
  readonly centre: Vec3;
  readonly radius: number;
}

/** Around the box of all finite places at all placements (16 numbers each); undefined if there are none. */
export function sphereAround(all: readonly Places[], placements: Float64Array): Sphere | undefined {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let m = 0; m < placements.length; m += 16) {
    for (const { numbers, stride, first } of all) {
      for (let o = first; o + 2 < numbers.length; o += stride) {
        for (let r = 0; r < 3; r++) {
          const at =
            placements[m + r] * numbers[o] +
            placements[m + 4 + r] * numbers[o + 1] +
            placements[m + 8 + r] * numbers[o + 2] +
            placements[m + 12 + r];
          if (!Number.isFinite(at)) break;
          low[r] = Math.min(low[r], at);
          high[r] = Math.max(high[r], at);
        }
      }
    }
  }
  const sizes = high.map((most, r) => most - low[r]);
  if (!sizes.every((size) => size >= 0)) return undefined;
  return {
    centre: [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2],
    radius: Math.hypot(...sizes) / 2,
  };
}

/**
 * The same direction, from where a sphere fills the view.
 *
 * @param across length at the view's target, in the world, that fits the shorter side of the viewport
 */
export function viewOf({ centre, radius }: Sphere, view: CameraView, across: number): CameraView {
  const distance = radius > 0 ? (view.distance * 2 * MARGIN * radius) / across : view.distance;
  return { ...view, target: centre, distance };
}
