/** What joints are called where people read of them. */
import type { Skeleton } from './skeleton.ts';

/** Its name; `joint 3`, by its index, where the file gives none, and where there is no such joint (any more). */
export function jointName(skeleton: Skeleton | undefined, index: number): string {
  return skeleton?.joints[index]?.name || `joint ${index}`;
}
