/** DOFs by the names that formats use. */
import type { Dof } from '../skeleton/skeleton.ts';

/** The names used by joint types, files and scripts. */
export const DOF_NAMES = [
  ...(['r', 'rx', 'ry', 'rz', 't', 'tx', 'ty', 'tz', 'l'] as const),
  ...(['s', 'sx', 'sy', 'sz', 'qx', 'qy', 'qz', 'qw', 'hxy', 'hxz', 'hyz', 'valid'] as const),
] as const;
/** A DOF's name, as formats and channels spell it; see `DOF_NAMES`. */
export type DofName = (typeof DOF_NAMES)[number];

/** The first letter gives the unit: `rx` is an angle, `sy` a scale, `qw` a quaternion component; `valid` is 1 or 0. */
export function dof(name: DofName): Dof {
  if (name.startsWith('r')) return { name, unit: 'angle', rest: 0 };
  if (name.startsWith('t') || name === 'l') return { name, unit: 'length', rest: 0 };
  return { name, unit: 'factor', rest: name.startsWith('s') || name === 'qw' || name === 'valid' ? 1 : 0 };
}

/** The DOFs of these names, in the same order. */
export function dofList(...names: readonly DofName[]): readonly Dof[] {
  return names.map(dof);
}
