/** How joints are named to users. */
import type { Skeleton } from './skeleton.ts';

/** The joint's name, or `joint 3` by index if it is unnamed or does not exist (any more). */
export function jointName(skeleton: Skeleton | undefined, index: number): string {
  return skeleton?.joints[index]?.name || `joint ${index}`;
}
