/** DOFs by the names that formats give them. */
import type { Dof } from '../skeleton.ts';

/** Those that the types of joints have, and that files and scripts call them by. */
export const DOF_NAMES = [
  ...(['r', 'rx', 'ry', 'rz', 't', 'tx', 'ty', 'tz'] as const),
  ...(['s', 'sx', 'sy', 'sz', 'qx', 'qy', 'qz', 'qw', 'hxy', 'hxz', 'hyz'] as const),
] as const;
export type DofName = (typeof DOF_NAMES)[number];

/** `rx` is an angle, `sy` a scale, `qw` a part of a quaternion: the first letter tells them apart. */
export function dof(name: DofName): Dof {
  if (name.startsWith('r')) return { name, unit: 'angle', rest: 0 };
  if (name.startsWith('t')) return { name, unit: 'length', rest: 0 };
  return { name, unit: 'factor', rest: name.startsWith('s') || name === 'qw' ? 1 : 0 };
}

export function dofList(...names: readonly DofName[]): readonly Dof[] {
  return names.map(dof);
}
