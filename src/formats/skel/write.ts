/**
 * Writes `.skel`, hierarchy form. What is the default is left out, except the offset; a skeleton of balljoints in xyz
 * order uses the classic tokens only, so that other tools read it.
 */
import {
  type Box,
  DEFAULT_BOX,
  dofsOf,
  type Joint,
  type Limit,
  type Skeleton,
  UNLIMITED,
} from '../../model/skeleton.ts';
import type { WriteResult } from '../reader.ts';
import { Text } from '../write-text.ts';
import { jointTypeOfMotion, LIMIT_TOKENS } from './joint-types.ts';

/** Every skeleton is a root of its own. `fileName` is what diagnostics name. */
export function writeSkel(skeletons: readonly Skeleton[], fileName = ''): WriteResult {
  const text = new Text(fileName);
  for (const { joints } of skeletons) writeTree(text, joints);
  return text.result();
}

/** Pre-order makes this a walk: joints that are no ancestors of the next one are closed before it. */
function writeTree(text: Text, joints: readonly Joint[]): void {
  const open: number[] = [];
  joints.forEach((joint, index) => {
    while (open.length > 0 && open.at(-1) !== joint.parent) closeJoint(text, open);
    const depth = open.length;
    text.line(depth, `${jointTypeOfMotion(joint.motion).keyword}${text.name(joint.name, 'joint')} {`);
    writeTokens(text, depth + 1, joint);
    open.push(index);
  });
  while (open.length > 0) closeJoint(text, open);
}

function closeJoint(text: Text, open: number[]): void {
  open.pop();
  text.line(open.length, '}');
}

function writeTokens(text: Text, depth: number, joint: Joint): void {
  const { box, motion, limits, pose } = joint;
  text.line(depth, `offset ${text.numbers(joint.offset)}`);
  for (const line of jointTypeOfMotion(motion).lines(motion)) text.line(depth, line);
  const sides: readonly [string, keyof Box][] = [
    ['boxmin', 'min'],
    ['boxmax', 'max'],
  ];
  for (const [token, side] of sides) {
    if (!same(box[side], DEFAULT_BOX[side])) text.line(depth, `${token} ${text.numbers(box[side])}`);
  }
  dofsOf(motion).forEach((dof, i) => {
    const limit: Limit = limits[i] ?? UNLIMITED;
    if (same([limit.min, limit.max], [UNLIMITED.min, UNLIMITED.max])) return;
    text.line(depth, `${LIMIT_TOKENS[dof.name] ?? `limit ${dof.name}`} ${text.numbers([limit.min, limit.max])}`);
  });
  if (!pose.every((v) => Object.is(v, 0))) text.line(depth, `pose ${text.numbers(pose)}`);
}

function same(a: readonly number[], b: readonly number[]): boolean {
  return a.every((v, i) => Object.is(v, b[i]));
}
