/**
 * Matches DOFs of two motions: by name, and rotations about the same main axis whatever their names:
 *
 *     r of a hinge or screw about ±x, ±y or ±z   ⇄   ± rx, ry or rz
 */
import { axisOf, dofsOf } from '../../model/skeleton/joint-types.ts';
import type { Motion } from '../../model/skeleton/skeleton.ts';

/** The DOF of another motion with the same effect. */
export interface SameDof {
  readonly name: string;
  /** Factor of the values. */
  readonly sign: 1 | -1;
}

/** The DOF of `before` that does the same as the named one in `after`; symmetric. */
export function sameDof(before: Motion, after: Motion, name: string): SameDof | undefined {
  if (has(before, name)) return { name, sign: 1 };
  if (name === 'r') {
    const turn = turnOf(after);
    return turn && has(before, turn.name) ? turn : undefined;
  }
  const turn = turnOf(before);
  return turn?.name === name && !has(after, 'r') ? { name: 'r', sign: turn.sign } : undefined;
}

/** −v, but 0 stays 0, since −0 would be written with its sign. */
export function timesSign(value: number, sign: 1 | -1): number {
  return sign < 0 ? 0 - value : value;
}

function has(motion: Motion, name: string): boolean {
  return dofsOf(motion).some((dof) => dof.name === name);
}

/** The named rotation that is equivalent to one about its own axis, if that is along x, y or z. */
function turnOf(motion: Motion): SameDof | undefined {
  const axis = has(motion, 'r') ? axisOf(motion) : undefined;
  if (!axis) return undefined;
  const along = [0, 1, 2].filter((k) => axis[k] !== 0);
  if (along.length !== 1) return undefined;
  const [k] = along;
  return { name: `r${'xyz'[k]}`, sign: axis[k] < 0 ? -1 : 1 };
}
