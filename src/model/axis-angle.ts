/**
 * What the axis-angle form of `.skel` can hold: hinges with a bone each, every child at its parent's tip, and nothing
 * else about them. Names are none of its business; they are lost, and the writer says so.
 */
import { tipOf } from './bone-ends.ts';
import { jointTypeOf } from './joint-types.ts';
import { DEFAULT_BOX, isUnlimited, type Joint, type Skeleton } from './skeleton.ts';

/**
 * What keeps a skeleton from being written in the axis-angle form, as a sentence about the first joint that is not like
 * that: "#3 elbow is no hinge." Undefined where nothing does.
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

/** Whether someone set its box. Asked in every frame, so it allocates nothing. */
export function hasOwnBox({ box: { min, max } }: Pick<Joint, 'box'>): boolean {
  for (let k = 0; k < 3; k++) if (min[k] !== DEFAULT_BOX.min[k] || max[k] !== DEFAULT_BOX.max[k]) return true;
  return false;
}

/** Whether its file is written in the axis-angle form: it was read from that, and still fits into it. */
export function savesAsAxisAngle(skeleton: Skeleton): boolean {
  return skeleton.form === 'axis-angle' && axisAngleObstacle(skeleton) === undefined;
}

/** To be written in the axis-angle form, where it fits into that. */
export function inAxisAngleForm(skeleton: Skeleton): Skeleton {
  return skeleton.form === 'axis-angle' ? skeleton : { ...skeleton, form: 'axis-angle' };
}

/** To be written in the hierarchy form, whatever it was read from. */
export function inHierarchyForm(skeleton: Skeleton): Skeleton {
  const { form, ...rest } = skeleton;
  return form ? rest : skeleton;
}
