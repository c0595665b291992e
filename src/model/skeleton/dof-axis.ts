/**
 * The axis whose colour (red, green or blue) a DOF is drawn in: the one in its name, or else the main axis that its
 * joint's own axis lies along.
 */
import type { CharacterDof } from './dofs.ts';
import { axisOf } from './joint-types.ts';
import type { Motion, Skeleton } from './skeleton.ts';

/** An axis of a joint's space, by which a DOF is coloured. */
export type AxisLetter = 'x' | 'y' | 'z';
/** The three axes, in their order. */
export const AXIS_LETTERS: readonly AxisLetter[] = ['x', 'y', 'z'];

/** Tolerance for an axis to count as a main one; covers rounding in files. */
const ALONG = 1e-6;

/**
 * `rx`, `tx`, `sx` and `qx` use x; a shear uses the axis missing from its name, about which its plane turns; `r`, `t`
 * and `s` use the joint's axis if that is a main one.
 * @returns undefined if there is no main axis: `qw`, a hinge with an oblique axis, uniform scale
 */
export function dofAxis(motion: Motion | undefined, name: string): AxisLetter | undefined {
  const shear = /^h([xyz])([xyz])$/.exec(name);
  if (shear) return AXIS_LETTERS.find((letter) => letter !== shear[1] && letter !== shear[2]);
  const named = /^[trsq]([xyz])$/.exec(name)?.[1];
  if (named) return AXIS_LETTERS.find((letter) => letter === named);
  const axis = motion && axisOf(motion);
  if (!axis) return undefined;
  const length = Math.hypot(...axis);
  return AXIS_LETTERS.find((_, k) => Math.abs(axis[k]) >= length * (1 - ALONG));
}

/** The axis that colours one of a character's DOFs; undefined for morph weights. */
export function axisOfDof(
  skeleton: Skeleton | undefined,
  { joint, name, unit }: Pick<CharacterDof, 'joint' | 'name' | 'unit'>,
): AxisLetter | undefined {
  return unit === 'weight' ? undefined : dofAxis(skeleton?.joints[joint]?.motion, name);
}
