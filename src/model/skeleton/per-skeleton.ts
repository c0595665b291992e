/**
 * Caches what is computed from the joints of a skeleton, whatever it is called: takes of one session have the same
 * joints in skeletons named after their files (`shared-joints.ts`).
 */
import { perObject } from '../per-object.ts';
import type { Joint, Skeleton } from './skeleton.ts';

/**
 * Makes a function that computes something once per skeleton, by the joints: skeletons with the same array share it.
 * @param make is given the joints alone, without a name
 */
export function perSkeleton<V>(make: (skeleton: Skeleton) => V): (skeleton: Skeleton) => V {
  const byJoints = perObject((joints: readonly Joint[]) => make({ name: '', joints }));
  return ({ joints }) => byJoints(joints);
}
