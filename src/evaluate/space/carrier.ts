/**
 * The joint that moves a character over the ground.
 *
 * Usually it is the root. But in some captures (Bandai Namco's) the root stays at the studio's origin, and the hips
 * below it move. So the carrier is the first joint, from the root down to where the skeleton branches, whose
 * translation changes over the take by at least a 20th of the largest change among these joints: noise on a static root
 * doesn't count.
 */

import type { Driver } from '../../model/document.ts';
import { perPair } from '../../model/per-object.ts';
import { firstDofs, rootDofCount } from '../../model/skeleton/dofs.ts';
import { dofsOf } from '../../model/skeleton/joint-types.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { columnOf } from '../../model/takes/samples.ts';
import type { Take } from '../../model/takes/take.ts';
import { compileSkeleton } from '../kinematics.ts';

/** Smaller fractions of the largest translation in the chain are noise. */
const NOISE = 0.05;

/** Index of the joint that moves a character in a take; cached. */
export const carrierIn = perPair(findCarrier);

/**
 * Index of the joint that a retargeted take moves over the ground: the one that follows the source's, if it can move in
 * all directions, else the closest one above it that can, or the root. Cached per driver.
 */
export const retargetCarrier = perPair(({ source, pairs }: Driver, skeleton: Skeleton): number => {
  const moving = carrierIn(source.skeleton, source.take);
  const chain = chainOf(skeleton);
  const { slides, turns, firstDof } = compileSkeleton(skeleton);
  const canMove = (j: number) =>
    [0, 1, 2].every((k) => slides[3 * j + k] >= 0) && (turns[3 * j] >= 0 || firstDof[j + 1] - firstDof[j] === 3);
  const canScale = (j: number) => dofsOf(skeleton.joints[j].motion).some(({ name }) => /^[sh]/.test(name));
  let joint = (pairs.find((pair) => pair.source === moving) ?? pairs[0])?.target ?? 0;
  while (joint > 0 && !(chain.includes(joint) && canMove(joint))) joint = skeleton.joints[joint].parent;
  // A scaled parent would scale the movement.
  for (let j = skeleton.joints[joint]?.parent ?? -1; j >= 0; j = skeleton.joints[j].parent) if (canScale(j)) return 0;
  return joint;
});

function findCarrier(skeleton: Skeleton, take: Take): number {
  const first = firstDofs(skeleton);
  const chain = chainOf(skeleton);
  const moved = chain.map((j) => {
    let most = j === 0 && rootDofCount(skeleton) > 0 ? Math.max(...[0, 1, 2].map((c) => rangeOf(take, c))) : 0;
    dofsOf(skeleton.joints[j].motion).forEach(({ name }, d) => {
      if (name === 'tx' || name === 'ty' || name === 'tz') most = Math.max(most, rangeOf(take, first[j] + d));
    });
    return most;
  });
  const most = moved.reduce((a, b) => Math.max(a, b), 0);
  return most > 0 ? chain[moved.findIndex((m) => m >= NOISE * most)] : 0;
}

/**
 * From the root down to the first joint with several children or none. In pre-order an only child is the next joint.
 */
function chainOf({ joints }: Skeleton): number[] {
  const below = new Uint32Array(joints.length);
  for (const { parent } of joints) if (parent >= 0) below[parent]++;
  const chain = joints.length ? [0] : [];
  for (let j = 0; below[j] === 1; j++) chain.push(j + 1);
  return chain;
}

/** Range of the values of a channel's keys or samples. */
function rangeOf({ channels, samples }: Take, index: number): number {
  let least = Infinity;
  let greatest = -Infinity;
  const take = (value: number) => {
    least = Math.min(least, value);
    greatest = Math.max(greatest, value);
  };
  const channel = channels[index];
  if (samples && channel?.kind === 'samples') {
    const { values, scales } = samples;
    for (let v = columnOf(samples, index); v < values.length; v += scales.length) take(values[v]);
  } else if (channel?.kind === 'keys') channel.values.forEach(take);
  return greatest > least ? greatest - least : 0;
}
