/**
 * Whether two skeletons have the same bones: in their file poses all bones point in the same directions. Then their
 * joints have the same axes too, and the file poses match, however little they look like a person's.
 */
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import type { Space } from '../../model/space.ts';
import type { Bodies } from './align.ts';
import type { RetargetBody } from './body.ts';

/** How far two skeletons have the same bones. */
export interface SameBones {
  readonly directions: boolean;
  /** Also equally long, but for one factor. */
  readonly lengths: boolean;
}

/** Cosine of the largest angle between equal directions: 0.5°. */
const EQUAL = Math.cos(Math.PI / 360);
/** Fraction of the longest bone: shorter ones have no direction, and lengths may differ by that much. */
const NOTHING = 1e-4;
/** Fraction of the target's joints that have to be paired. */
const PAIRED = 0.8;

const NEITHER: SameBones = { directions: false, lengths: false };

/**
 * Compares the bones of a target with those of its source, both in their file poses.
 * @param rest the source in its file pose; the bodies' must be the target's
 */
export function sameBones({ target, source, sourceOf, rest: own }: Bodies, rest: RetargetBody): SameBones {
  const bones: { readonly own: number; readonly other: number; readonly cos: number }[] = [];
  let paired = 0;
  for (let j = 0; j < target.joints.length; j++) {
    const s = sourceOf[j];
    if (s < 0) continue;
    paired++;
    let above = target.joints[j].parent;
    while (above >= 0 && sourceOf[above] < 0) above = target.joints[above].parent;
    if (above < 0) continue;
    let other = source.joints[s].parent;
    while (other >= 0 && other !== sourceOf[above]) other = source.joints[other].parent;
    if (other < 0) return NEITHER;
    const a = [0, 1, 2].map((k) => own.points[3 * j + k] - own.points[3 * above + k]);
    const b = [0, 1, 2].map((k) => rest.points[3 * s + k] - rest.points[3 * other + k]);
    const [length, otherLength] = [Math.hypot(...a), Math.hypot(...b)];
    const dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    bones.push({ own: length, other: otherLength, cos: dot / (length * otherLength) });
  }
  if (paired === 0 || paired < PAIRED * target.joints.length) return NEITHER;
  const [most, otherMost] = [Math.max(...bones.map((b) => b.own)), Math.max(...bones.map((b) => b.other))];
  const isNothing = (b: (typeof bones)[number]) => b.own < NOTHING * most || b.other < NOTHING * otherMost;
  const directions = bones.every((b) => isNothing(b) || b.cos > EQUAL);
  const lengths = bones.every((b) => Math.abs(b.own / most - b.other / otherMost) < NOTHING);
  return { directions, lengths: directions && lengths };
}

/**
 * Whether each joint is paired with its equal in an equal skeleton: then a pose of one is a pose of the other, number
 * by number.
 */
export function sameJoints({ target, targetSpace, source, sourceSpace, sourceOf }: Bodies): boolean {
  if (target.joints.length !== source.joints.length || !sourceOf.every((s, j) => s === j)) return false;
  const told = ({ joints }: Skeleton, space: Space | undefined) =>
    JSON.stringify([
      joints.map(({ parent, offset, motion, limits, pose }) => [parent, offset, motion, limits, pose]),
      space,
    ]);
  return told(target, targetSpace) === told(source, sourceSpace);
}
