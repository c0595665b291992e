/**
 * The axis-angle form of `.skel`: hinges only, each with a bone, every child at its parent's tip, and no other
 * attributes. Names can't be stored; the writer reports the loss.
 */
import { tipOf } from './bone-ends.ts';
import { jointTypeOf } from './joint-types.ts';
import { DEFAULT_BOX, isUnlimited, type Joint, type Skeleton } from './skeleton.ts';

/**
 * Why a skeleton can't be written in the axis-angle form, as a sentence about the first joint that does not fit: "#3
 * elbow is no hinge." Undefined if it can.
 */
export function axisAngleObstacle({ joints }: Skeleton): string | undefined {
  for (let j = 0; j < joints.length; j++) {
    const why = obstacleOf(joints, j);
    if (why) return `joint ${j}${joints[j].name && ` "${joints[j].name}"`} ${why}.`;
  }
  return undefined;
}

function obstacleOf(joints: readonly Joint[], j: number): string | undefined {
  const { motion, length, offset, parent, limits, couples, endSites } = joints[j];
  if (!jointTypeOf(motion).isAxisAngle) return 'is not a hinge';
  if (length === undefined) return 'has no bone length';
  const [x, y, z] = (joints[parent] && tipOf(joints[parent])) ?? [0, 0, 0];
  if (offset[0] !== x || offset[1] !== y || offset[2] !== z) {
    return parent < 0 ? 'is the root but is not at 0 0 0' : "is not at its parent's tip";
  }
  if (!limits.every(isUnlimited)) return 'has limits';
  if (couples?.length) return 'follows another joint';
  if (hasOwnBox(joints[j])) return 'has its own box';
  return endSites?.length ? 'has End Sites' : undefined;
}

/** Whether the box differs from the default. Called every frame, so it allocates nothing. */
export function hasOwnBox({ box: { min, max } }: Pick<Joint, 'box'>): boolean {
  for (let k = 0; k < 3; k++) if (min[k] !== DEFAULT_BOX.min[k] || max[k] !== DEFAULT_BOX.max[k]) return true;
  return false;
}

/** Whether the file is written in the axis-angle form: it was read from one and still fits. */
export function savesAsAxisAngle(skeleton: Skeleton): boolean {
  return skeleton.form === 'axis-angle' && axisAngleObstacle(skeleton) === undefined;
}

/** Marks the skeleton to be written in the axis-angle form, if it fits. */
export function inAxisAngleForm(skeleton: Skeleton): Skeleton {
  return skeleton.form === 'axis-angle' ? skeleton : { ...skeleton, form: 'axis-angle' };
}

/** Marks the skeleton to be written in the hierarchy form, whichever form it was read from. */
export function inHierarchyForm(skeleton: Skeleton): Skeleton {
  const { form, ...rest } = skeleton;
  return form ? rest : skeleton;
}
