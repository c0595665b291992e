/**
 * Writes the axis-angle form of `.skel`, a joint per line: `length ax ay az angle children`, angles in degrees. For
 * skeletons without an obstacle (`model/axis-angle.ts`).
 */
import { axisOf, jointTypeOf } from '../../model/skeleton/joint-types.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import type { Text } from '../write-text.ts';
import { degreesOf } from './degrees.ts';

/**
 * Writes a skeleton in the axis-angle form of `.skel`.
 * @throws Error for a joint other than a hinge with a bone
 */
export function writeAxisAngleTree(text: Text, { joints, name }: Skeleton): void {
  const children = new Uint32Array(joints.length);
  for (const { parent } of joints) if (parent >= 0) children[parent]++;
  joints.forEach(({ motion, length, pose }, j) => {
    const axis = jointTypeOf(motion).isAxisAngle ? axisOf(motion) : undefined;
    if (!axis || length === undefined) {
      throw new Error(`Joint #${j} of ${name} is not a hinge with a bone, so it can't be written in axis-angle form.`);
    }
    text.about(`joint ${j}`);
    text.line(0, `${text.numbers([length, ...axis, degreesOf(pose[0])])} ${children[j]}`);
  });
  const named = joints.filter((joint) => joint.name !== '').length;
  if (named) {
    const what = named === 1 ? '1 named joint' : `${named} named joints`;
    text.left('names-left-out', `The axis-angle form stores no joint names, and ${name} has ${what}.`);
  }
}
