/**
 * Where bones end that no joint continues: BVH's End Sites, and the tips of joints that have a bone of their own along
 * +y. What draws, frames and measures skeletons asks here, so that a last bone counts as any other.
 */
import type { Vec3 } from '../math/vec3.ts';
import type { Joint, Skeleton } from './skeleton.ts';

export interface BoneEnd {
  /** The joint whose bone it ends. */
  readonly joint: number;
  /** In that joint's space. */
  readonly at: Vec3;
}

/** The far end of a joint's own bone, in the joint's space; undefined where it has no such bone. */
export function tipOf({ length }: Pick<Joint, 'length'>): Vec3 | undefined {
  return length === undefined ? undefined : [0, length, 0];
}

/** In the order of joints, End Sites before the tip; none that is where its joint is, no tip at which a child stands. */
export function boneEnds({ joints }: Skeleton): readonly BoneEnd[] {
  const continued = new Set<number>();
  for (const { parent, offset } of joints) {
    if (parent >= 0 && isAt(offset, tipOf(joints[parent]))) continued.add(parent);
  }
  return joints.flatMap((joint, j) => {
    const tip = continued.has(j) ? undefined : tipOf(joint);
    const ends = [...(joint.endSites ?? []), ...(tip ? [tip] : [])];
    return ends.filter((at) => Math.hypot(...at) > 0).map((at) => ({ joint: j, at }));
  });
}

/** Exactly: files that mean the same place write the same number. */
function isAt(a: Vec3, b: Vec3 | undefined): boolean {
  return b !== undefined && a[0] === b[0] && a[1] === b[1] && a[2] === b[2];
}
