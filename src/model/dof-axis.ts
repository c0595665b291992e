/**
 * The axis that a DOF goes by the colour of, red, green or blue, wherever it is drawn: the one of its name, and for a
 * DOF whose name says none the one that its joint's own axis lies along.
 */
import type { CharacterDof } from './dofs.ts';
import { axisOf } from './joint-types.ts';
import type { Motion, Skeleton } from './skeleton.ts';

export type AxisLetter = 'x' | 'y' | 'z';

const LETTERS = ['x', 'y', 'z'] as const;

/** What of an axis goes another way than a main one; as much as rounding in a file makes. */
const ALONG = 1e-6;

/**
 * `rx`, `tx`, `sx` and `qx` go by x; a shear by the axis that is not in it, which its plane is turned about; `r`, `t` and
 * `s` by the joint's axis where that is a main one.
 * @returns undefined for what has no main axis: `qw`, a hinge that stands askew, scale of all axes alike
 */
export function dofAxis(motion: Motion | undefined, name: string): AxisLetter | undefined {
  const shear = /^h([xyz])([xyz])$/.exec(name);
  if (shear) return LETTERS.find((letter) => letter !== shear[1] && letter !== shear[2]);
  const named = /^[trsq]([xyz])$/.exec(name)?.[1];
  if (named) return LETTERS.find((letter) => letter === named);
  const axis = motion && axisOf(motion);
  if (!axis) return undefined;
  const length = Math.hypot(...axis);
  return LETTERS.find((_, k) => Math.abs(axis[k]) >= length * (1 - ALONG));
}

/** The same for one of a character's DOFs; none for weights of morphs. */
export function axisOfDof(
  skeleton: Skeleton | undefined,
  { joint, name, unit }: Pick<CharacterDof, 'joint' | 'name' | 'unit'>,
): AxisLetter | undefined {
  return unit === 'weight' ? undefined : dofAxis(skeleton?.joints[joint]?.motion, name);
}
