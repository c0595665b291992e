/**
 * Writes the axis-angle form of `.skel`, a joint a line: `length ax ay az angle children`, angles in degrees. For
 * skeletons in whose way nothing stands (`model/axis-angle.ts`).
 */
import { axisOf, jointTypeOf } from '../../model/joint-types.ts';
import type { Skeleton } from '../../model/skeleton.ts';
import type { Text } from '../write-text.ts';
import { degreesOf } from './degrees.ts';

/** @throws Error for a joint that is no hinge with a bone */
export function writeAxisAngleTree(text: Text, { joints, name }: Skeleton): void {
  const children = new Uint32Array(joints.length);
  for (const { parent } of joints) if (parent >= 0) children[parent]++;
  joints.forEach(({ motion, length, pose }, j) => {
    const axis = jointTypeOf(motion).isAxisAngle ? axisOf(motion) : undefined;
    if (!axis || length === undefined) {
      throw new Error(`Joint #${j} of ${name} is no hinge with a bone: it can't be written in the axis-angle form.`);
    }
    text.line(0, `${text.numbers([length, ...axis, degreesOf(pose[0])])} ${children[j]}`);
  });
  const named = joints.filter((joint) => joint.name !== '').length;
  if (named) {
    const what = named === 1 ? '1 joint has a name' : `${named} joints have names`;
    text.left('names-left-out', `The axis-angle form has no names of joints; in ${name} ${what}.`);
  }
}
