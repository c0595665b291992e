/** DOFs by the names that formats give them. */
import type { Dof } from '../skeleton.ts';

/** `rx` is an angle, `sy` a scale, `qw` a part of a quaternion: the first letter tells them apart. */
export function dof(name: string): Dof {
  if (name.startsWith('r')) return { name, unit: 'angle', rest: 0 };
  if (name.startsWith('t')) return { name, unit: 'length', rest: 0 };
  return { name, unit: 'factor', rest: name.startsWith('s') || name === 'qw' ? 1 : 0 };
}

export function dofList(...names: readonly string[]): readonly Dof[] {
  return names.map(dof);
}
