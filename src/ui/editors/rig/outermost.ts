import type { Skeleton } from '../../../model/skeleton/skeleton.ts';

/** Those of the joints that aren't within the hierarchy of another one of them. */
export function outermostJoints({ joints: all }: Skeleton, joints: readonly number[]): readonly number[] {
  const meant = new Set(joints);
  const isInside = (joint: number): boolean => {
    let { parent } = all[joint];
    while (parent >= 0 && !meant.has(parent)) ({ parent } = all[parent]);
    return parent >= 0;
  };
  return joints.filter((joint) => !isInside(joint));
}
