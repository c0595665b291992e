/**
 * The ends of bones that no joint continues: BVH's End Sites, and the tips of joints with a bone of their own along +y.
 * Drawing, framing and measuring all use these, so that a last bone counts like any other.
 */
import type { Vec3 } from '../../math/vec3.ts';
import type { Joint, Skeleton } from './skeleton.ts';

/** The end of a bone that no joint continues. */
export interface BoneEnd {
  /** The joint whose bone ends here. */
  readonly joint: number;
  /** In that joint's space. */
  readonly at: Vec3;
}

/** The far end of a joint's own bone, in the joint's space; undefined if it has no bone. */
export function tipOf({ length }: Pick<Joint, 'length'>): Vec3 | undefined {
  return length === undefined ? undefined : [0, length, 0];
}

/** In joint order, End Sites before the tip. Omits ends at the joint itself and tips that coincide with a child. */
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

/** Exact: files that mean the same point write the same number. */
function isAt(a: Vec3, b: Vec3 | undefined): boolean {
  return b !== undefined && a[0] === b[0] && a[1] === b[1] && a[2] === b[2];
}
