/** Which of a joint's DOFs are angles that can be told to turn it: all of a rotation's, or each by itself. */
import { dofsOf, factorsOf, pitchOf, stretches } from '../model/joint-types.ts';
import type { EulerOrder, Motion } from '../model/skeleton.ts';

/** Where among a joint's DOFs the Euler angles are that make up its whole rotation. */
export interface EulerDofs {
  readonly x: number;
  readonly y: number;
  readonly z: number;
  /** In which they are applied. */
  readonly order: EulerOrder;
}

/**
 * The three rotations of a joint, with nothing between them; undefined where it turns about fewer than three axes, or not
 * by such angles.
 */
export function eulerDofs(motion: Motion): EulerDofs | undefined {
  const turns = (factorsOf(motion) ?? []).flatMap((name, i) => (name.startsWith('r') ? [i] : []));
  return turns.length === 3 && turns[2] - turns[0] === 2 ? listedAngles(motion) : undefined;
}

/** The three rotations of a joint that does nothing else but translate, before, between or behind them. */
export function rigidEulerDofs(motion: Motion): EulerDofs | undefined {
  return stretches(motion) ? undefined : listedAngles(motion);
}

/** Rotations as they are multiplied from left to right: the last one is applied first. */
function listedAngles(motion: Motion): EulerDofs | undefined {
  const axes = (factorsOf(motion) ?? []).filter((name) => name.startsWith('r')).map((name) => name[1]);
  if (axes.length !== 3) return undefined;
  const names = dofsOf(motion).map(({ name }) => name);
  const [x, y, z] = ['rx', 'ry', 'rz'].map((name) => names.indexOf(name));
  // The three letters of a permutation, which is what the orders are.
  return { x, y, z, order: axes.reverse().join('') as EulerOrder };
}

/** A rotation by Euler angles as Rz(γ)·Ry(β)·Rx(α) with the axes renamed: what `math/euler.ts` is about. */
export interface RenamedAxes {
  /** Which of x, y, z (0, 1, 2) α, β and γ turn about: the order in which they are applied. */
  readonly axes: readonly [number, number, number];
  /** −1 where the new names mirror space (xzy, yxz, zyx): there rotations turn the other way. */
  readonly sign: 1 | -1;
}

export function renamedAxes(order: EulerOrder): RenamedAxes {
  const [i, j, k] = [0, 1, 2].map((at) => 'xyz'.indexOf(order[at]));
  return { axes: [i, j, k], sign: (j - i + 3) % 3 === 1 ? 1 : -1 };
}

/** The DOFs of α, β and γ among the joint's. */
export function appliedDofs({ x, y, z, order }: EulerDofs): readonly [number, number, number] {
  const [i, j, k] = renamedAxes(order).axes;
  const dofs = [x, y, z];
  return [dofs[i], dofs[j], dofs[k]];
}

/** Of each DOF of a joint, whether a whole turn more of it changes nothing. */
export function turningDofs(motion: Motion): readonly boolean[] {
  // A turn of a screw goes somewhere.
  const turns = pitchOf(motion) === 0;
  return dofsOf(motion).map(({ unit }) => turns && unit === 'angle');
}
