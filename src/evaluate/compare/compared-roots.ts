/**
 * References from which two takes are compared: the joints that carry the two characters, and the rotation between
 * their axes.
 *
 * Roots of different skeletons point elsewhere in the same pose, which is no difference between two motions. So the
 * second one's rotation is multiplied by K, the constant by which the retargeter aligns the same two joints
 * (`retarget/align.ts`).
 */
import type { Character } from '../../model/document.ts';
import { shownTake } from '../../model/document.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import { alignment, type Bodies, bodiesOf, type Reference, sourceBody } from '../retarget/align.ts';
import { sourceReference, stands } from '../retarget/reference.ts';
import { playedSource } from '../retarget/source-pose.ts';
import { carrierOf } from '../travel.ts';
import type { ComparedJoints } from './compared-joints.ts';
import type { JointMatch } from './joint-match.ts';

/**
 * Index of the pair that counts as the root: the joints that carry the two characters (`carrier.ts`), since a root that
 * stays at the studio's origin while the hips walk says nothing about place and heading. If each take is carried by
 * another pair, the lower one, which both move. The topmost pair if no carrier has a partner.
 */
export function rootPair(a: Character, b: Character, { first, second }: JointMatch): number {
  return Math.max(0, first.indexOf(carrierOf(a)), second.indexOf(carrierOf(b)));
}

/** Nine numbers for `measureDistances`; undefined if both have the same skeleton, and so the same axes. */
export function rootTurn(a: Character, b: Character, joints: ComparedJoints): Float64Array | undefined {
  if (joints.isSame || !joints.first.length || !a.skeleton || !b.skeleton) return undefined;
  const root = rootPair(a, b, joints);
  const [i, j] = [joints.first[root], joints.second[root]];
  const ontoSecond = bodiesFrom(a, a.skeleton, joints.first, b, b.skeleton, joints.second);
  const ontoFirst = bodiesFrom(b, b.skeleton, joints.second, a, a.skeleton, joints.first);
  // The target's rest pose must be a standing one; of the source, a frame of its take can be used.
  if (sourceStands(ontoSecond) || !sourceStands(ontoFirst)) {
    return correction(ontoFirst, b, i);
  }
  return transposed(correction(ontoSecond, a, j));
}

function sourceStands(bodies: Bodies): boolean {
  return stands(bodies, sourceBody(bodies), (t) => bodies.sourceOf[t]);
}

function bodiesFrom(
  source: Character,
  from: Skeleton,
  sources: readonly number[],
  target: Character,
  onto: Skeleton,
  targets: readonly number[],
): Bodies {
  const pairs = targets.map((t, k) => ({ target: t, source: sources[k] }));
  return bodiesOf(from, source.space, onto, target.space, pairs);
}

function correction(bodies: Bodies, source: Character, target: number): Float64Array {
  return alignment(bodies, referenceOf(bodies, source)).corrections.slice(9 * target, 9 * target + 9);
}

function referenceOf(bodies: Bodies, source: Character): Reference {
  const { pose, clampsToLimits, limbs } = source;
  const take = source.driver ? undefined : shownTake(source);
  if (!take) return { ...sourceBody(bodies), soles: true };
  const played = playedSource({ skeleton: bodies.source, take, pose, clampsToLimits, ...(limbs && { limbs }) });
  return sourceReference(bodies, { played, range: take.range }, 'automatic');
}

function transposed(m: Float64Array): Float64Array {
  return Float64Array.of(m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]);
}
