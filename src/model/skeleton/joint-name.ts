/** How joints are named to users. */
import { perObject } from '../per-object.ts';
import type { Skeleton } from './skeleton.ts';

/** The joint's name, or `joint 3` by index if it is unnamed or does not exist (any more). */
export function jointName(skeleton: Skeleton | undefined, index: number): string {
  return skeleton?.joints[index]?.name || `joint ${index}`;
}

/** A joint's name as lists show it: without a namespace that all names share, such as Mixamo's `mixamorig:`. */
export function shortJointName(skeleton: Skeleton | undefined, index: number): string {
  const name = jointName(skeleton, index);
  const shared = skeleton ? namespaceOf(skeleton) : '';
  return shared && name.startsWith(shared) && name.length > shared.length ? name.slice(shared.length) : name;
}

/**
 * The beginning, up to a colon, of at least two names, and of all that have a colon; names without one may be among
 * them, as of joints that were added later. Cached; empty if there is none.
 */
const namespaceOf = perObject(({ joints }: Skeleton): string => {
  const spaces = joints.flatMap(({ name }) => {
    const end = name.lastIndexOf(':') + 1;
    return end > 1 ? [name.slice(0, end)] : [];
  });
  return spaces.length > 1 && spaces.every((space) => space === spaces[0]) ? spaces[0] : '';
});
