/** Where a foot points, for retargeting and for review alike. */
import { type BodyParts, LIMB_SIDES } from './roles.ts';

/** The points of a skeleton: its joints, then the End Sites of each. */
export interface PointTree {
  /** The joint above each point; -1 for the root. */
  readonly above: Int32Array;
  /** The distance of a point from the joint above; metres. */
  lengthOf(point: number): number;
}

/** Metres; what is nearer to its joint points nowhere. */
const SOMEWHERE = 0.01;

/** The point that a foot points to: its toe joint, or else what is below the ankle; -1 for none. */
export function footTip(tree: PointTree, { single }: Pick<BodyParts, 'single'>, ankle: number): number {
  const toes = LIMB_SIDES.map((side) => single.get(`${side} toe`) ?? -1);
  return toes.find((joint) => isBelow(tree, joint, ankle)) ?? tipBelow(tree, ankle);
}

/** The first joint right below one that is somewhere else, or else its first such End Site; -1 for none. */
export function tipBelow({ above, lengthOf }: PointTree, joint: number): number {
  return above.findIndex((parent, point) => parent === joint && lengthOf(point) > SOMEWHERE);
}

function isBelow({ above }: PointTree, point: number, joint: number): boolean {
  let j = point;
  while (j > joint) j = above[j];
  return j === joint && point !== joint;
}
