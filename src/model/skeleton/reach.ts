/** The size of a character, for everything that scales with it: sliders, keyboard steps. */
import { perObject } from '../per-object.ts';
import { restExtent } from './rest-extent.ts';
import type { Skeleton } from './skeleton.ts';

/** The farthest any joint can be from the root; also sensible for a single joint. */
export function reachOf(skeleton: Skeleton | undefined): number {
  return skeleton?.joints.length ? reachOfJoints(skeleton) : 1;
}

const reachOfJoints = perObject((skeleton: Skeleton) => {
  const far = new Float64Array(skeleton.joints.length);
  let reach = 0;
  skeleton.joints.forEach(({ parent, offset, box }, j) => {
    const own = parent < 0 ? 0 : Math.hypot(...offset);
    far[j] = own + (parent < 0 ? 0 : far[parent]);
    reach = Math.max(reach, far[j], Math.hypot(box.max[0] - box.min[0], box.max[1] - box.min[1]));
  });
  // Points have no root.
  const size = reach > 0 ? reach : restExtent(skeleton);
  return size > 0 && Number.isFinite(size) ? size : 1;
});

/** About a hundredth of the reach, rounded to a power of ten. */
export function lengthStep(skeleton: Skeleton | undefined): number {
  return 10 ** Math.floor(Math.log10(reachOf(skeleton) / 100));
}
