/**
 * Writes `.skel`: the hierarchy form, or the axis-angle form for a skeleton that was read from it. Defaults are
 * omitted, except the offset; a skeleton of balljoints in xyz order uses only the classic tokens, so that other tools
 * can read it.
 */
import { axisAngleObstacle, savesAsAxisAngle } from '../../model/skeleton/axis-angle.ts';
import { dofsOf } from '../../model/skeleton/joint-types.ts';
import { skelSkeleton } from '../../model/skeleton/skel-motion.ts';
import {
  type Box,
  DEFAULT_BOX,
  type Joint,
  type Limit,
  type Skeleton,
  UNLIMITED,
} from '../../model/skeleton/skeleton.ts';
import type { WriteResult } from '../reader.ts';
import { Text } from '../write-text.ts';
import { coupleTargets } from './couples.ts';
import { keywordOf, LIMIT_TOKENS, ownLines } from './joint-types.ts';
import { writeAxisAngleTree } from './write-axis-angle.ts';

/** Every skeleton becomes a root. `fileName` appears in diagnostics. */
export function writeSkel(skeletons: readonly Skeleton[], fileName = ''): WriteResult {
  const text = new Text(fileName);
  const [only, ...others] = skeletons;
  if (only && others.length === 0 && savesAsAxisAngle(only)) {
    writeAxisAngleTree(text, only);
    return text.result();
  }
  for (const skeleton of skeletons) {
    tellForm(text, skeleton, skeletons.length);
    const { joints } = skelSkeleton(skeleton);
    const ends = joints.reduce((sum, { endSites = [] }) => sum + endSites.length, 0);
    if (ends) text.left('end-sites-left-out', `A .skel file stores no End Sites, and ${skeleton.name} has ${ends}.`);
    const turned = joints.filter(({ restAngles }) => restAngles).length;
    if (turned) {
      const message = `A .skel file stores no rest orientations; ${skeleton.name} has ${turned}.`;
      text.left('rest-orientations-left-out', message);
    }
    writeTree(text, joints);
  }
  return text.result();
}

/** Reports a skeleton from the axis-angle form that no longer fits it. */
function tellForm(text: Text, skeleton: Skeleton, count: number): void {
  if (skeleton.form !== 'axis-angle') return;
  const why = axisAngleObstacle(skeleton) ?? `it holds one skeleton, and there are ${count}.`;
  text.changedForm(`${skeleton.name} can't be written in axis-angle form: ${why}`);
}

/** One walk in pre-order: joints that are not ancestors of the next one are closed before it. */
function writeTree(text: Text, joints: readonly Joint[]): void {
  const targets = joints.some((joint) => joint.couples) ? coupleTargets(joints) : [];
  const open: number[] = [];
  joints.forEach((joint, index) => {
    while (open.length > 0 && open.at(-1) !== joint.parent) closeJoint(text, open);
    const depth = open.length;
    text.about(`joint ${index} "${joint.name}"`);
    text.line(depth, `${keywordOf(joint.motion)}${text.name(joint.name, 'joint')} {`);
    writeTokens(text, depth + 1, joint, targets);
    open.push(index);
  });
  while (open.length > 0) closeJoint(text, open);
}

function closeJoint(text: Text, open: number[]): void {
  open.pop();
  text.line(open.length, '}');
}

/** @param targets how links refer to each joint */
function writeTokens(text: Text, depth: number, joint: Joint, targets: readonly string[]): void {
  const { box, motion, limits, pose, length, role, couples = [] } = joint;
  text.line(depth, `offset ${text.numbers(joint.offset)}`);
  for (const line of ownLines(motion, (values) => text.numbers(values))) text.line(depth, line);
  const sides: readonly [string, keyof Box][] = [
    ['boxmin', 'min'],
    ['boxmax', 'max'],
  ];
  for (const [token, side] of sides) {
    if (!same(box[side], DEFAULT_BOX[side])) text.line(depth, `${token} ${text.numbers(box[side])}`);
  }
  dofsOf(motion).forEach((dof, i) => {
    const limit: Limit = limits[i] ?? UNLIMITED;
    if (hasNoLine(limit)) return;
    text.line(depth, `${LIMIT_TOKENS[dof.name] ?? `limit ${dof.name}`} ${text.numbers([limit.min, limit.max])}`);
  });
  if (length !== undefined) text.line(depth, `length ${text.number(length)}`);
  if (role) text.line(depth, `role ${text.name(role, 'role')}`);
  const rest = dofsOf(motion).map((dof) => dof.rest);
  if (!same(pose, rest)) text.line(depth, `pose ${text.numbers(pose)}`);
  for (const { dof, joint, follows, gain, offset } of couples) {
    text.line(depth, `couple ${dof} ${targets[joint]}.${follows} ${text.numbers([gain, offset])}`);
  }
}

/** Whether a joint without that line has these limits: none at all, as position channels of motion capture, too. */
function hasNoLine({ min, max }: Limit): boolean {
  if (min === Number.NEGATIVE_INFINITY && max === Number.POSITIVE_INFINITY) return true;
  return min === UNLIMITED.min && max === UNLIMITED.max;
}

function same(a: readonly number[], b: readonly number[]): boolean {
  return a.every((v, i) => Object.is(v, b[i]));
}
