/**
 * Tween, relax and push of a pose: values between the keys around a time, for DOFs that have keys on both sides.
 *
 *     tween                 v_before + u · (v_after − v_before)
 *     tween toward rest     x + u · (file pose − x)
 *     relax, push           x + a · (L − x)        L on the straight line between both keys; a < 0 pushes away from it
 */
import { channelOf, dofCountOf, poseAt } from '../../evaluate/pose.ts';
import { neighboursAt, onLine, tweened } from '../../evaluate/tween.ts';
import type { Character } from '../../model/document.ts';
import { wholeFilePose } from '../../model/skeleton/dofs.ts';
import { activeShare } from '../layers/layer-values.ts';

/** A tween of a pose; see this file's comment. */
export type Tween =
  | { readonly kind: 'keys'; readonly u: number }
  | { readonly kind: 'rest'; readonly u: number }
  | { readonly kind: 'relax'; readonly amount: number };

const WHOLE = { a: 0, b: 1 };

/** The new values, and how many keyed or sampled DOFs of those asked for are left alone. */
export interface TweenedPose {
  /** By DOF. */
  readonly values: ReadonlyMap<number, number>;
  readonly leftAlone: number;
}

/**
 * The values of a tween at a time of the transport.
 * @param dofs indices of the character's DOFs, default all
 */
export function tweenedPose(
  character: Character,
  timeSeconds: number,
  tween: Tween,
  dofs?: readonly number[],
): TweenedPose {
  const shown = new Float64Array(dofCountOf(character));
  poseAt(character, timeSeconds, shown);
  const rest = tween.kind === 'rest' ? wholeFilePose(character.skeleton, character.morphs) : shown;
  const time = timeSeconds + character.timeOffsetSeconds;
  const values = new Map<number, number>();
  let leftAlone = 0;
  const share = activeShare(character, timeSeconds);
  for (const dof of dofs ?? shown.keys()) {
    const channel = channelOf(character, dof);
    if (!channel || channel.kind === 'rest') continue;
    const near = channel.kind === 'keys' ? neighboursAt(channel, time) : undefined;
    // Keys are the active layer's, and values are as displayed: a + b · its own.
    const { a, b } = share?.(dof) ?? WHOLE;
    const x = shown[dof];
    if (!near) leftAlone++;
    else if (tween.kind === 'keys') values.set(dof, a + b * tweened(near, tween.u));
    else if (tween.kind === 'rest') values.set(dof, x + tween.u * (rest[dof] - x));
    else values.set(dof, x + tween.amount * (a + b * onLine(near, time) - x));
  }
  return { values, leftAlone };
}
