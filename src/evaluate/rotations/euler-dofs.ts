/** Which of a joint's DOFs are rotation angles: all three of a rotation, or each by itself. */
import { dofsOf, factorsOf, pitchOf, stretches, turnsOf } from '../../model/skeleton/joint-types.ts';
import type { CompoundDof, EulerOrder, Motion } from '../../model/skeleton/skeleton.ts';

/** The DOFs of a joint that are the Euler angles of its whole rotation. */
export interface EulerDofs {
  readonly x: number;
  readonly y: number;
  readonly z: number;
  /** In which they are applied. */
  readonly order: EulerOrder;
}

/**
 * The three rotations of a joint, if adjacent; undefined if it rotates about fewer than three axes, or not by Euler
 * angles.
 */
export function eulerDofs(motion: Motion): EulerDofs | undefined {
  const turns = (factorsOf(motion) ?? []).flatMap((name, i) => (name.startsWith('r') ? [i] : []));
  return turns.length === 3 && turns[2] - turns[0] === 2 ? listedAngles(motion) : undefined;
}

/**
 * The three rotations of a joint that turn it as a whole, if adjacent, though constant turns may be before and after
 * them: the shortest way from one rotation to another is the same between these. Undefined as of `eulerDofs`.
 */
export function turnedDofs(motion: Motion): EulerDofs | undefined {
  const turns = turnsOf(motion);
  return turns ? anglesIn(turns, motion) : eulerDofs(motion);
}

/** The three rotations of a joint that otherwise only translates, before, between or after them. */
export function rigidEulerDofs(motion: Motion): EulerDofs | undefined {
  return stretches(motion) ? undefined : listedAngles(motion);
}

/** Factors are listed from left to right, so the last one is applied first. */
function listedAngles(motion: Motion): EulerDofs | undefined {
  return anglesIn(factorsOf(motion) ?? [], motion);
}

function anglesIn(factors: readonly CompoundDof[], motion: Motion): EulerDofs | undefined {
  const axes = factors.filter((name) => name.startsWith('r')).map((name) => name[1]);
  if (axes.length !== 3) return undefined;
  const names = dofsOf(motion).map(({ name }) => name);
  const [x, y, z] = ['rx', 'ry', 'rz'].map((name) => names.indexOf(name));
  // A permutation of three letters, which is exactly an order.
  return { x, y, z, order: axes.reverse().join('') as EulerOrder };
}

/** A rotation by Euler angles as Rz(γ)·Ry(β)·Rx(α) with renamed axes, for `math/euler.ts`. */
export interface RenamedAxes {
  /** Which of x, y, z (0, 1, 2) α, β and γ turn about, in the order of application. */
  readonly axes: readonly [number, number, number];
  /** −1 if the renaming mirrors space (xzy, yxz, zyx), which reverses rotations. */
  readonly sign: 1 | -1;
}

/** The axes of an Euler order, the first applied first, and whether they are a cyclic permutation of x y z. */
export function renamedAxes(order: EulerOrder): RenamedAxes {
  const [i, j, k] = [0, 1, 2].map((at) => 'xyz'.indexOf(order[at]));
  return { axes: [i, j, k], sign: (j - i + 3) % 3 === 1 ? 1 : -1 };
}

/** The joint's DOFs for α, β and γ. */
export function appliedDofs({ x, y, z, order }: EulerDofs): readonly [number, number, number] {
  const [i, j, k] = renamedAxes(order).axes;
  const dofs = [x, y, z];
  return [dofs[i], dofs[j], dofs[k]];
}

/** For each DOF of a joint, whether adding a whole turn changes nothing. */
export function turningDofs(motion: Motion): readonly boolean[] {
  // A whole turn of a screw moves it along its axis.
  const turns = pitchOf(motion) === 0;
  return dofsOf(motion).map(({ unit }) => turns && unit === 'angle');
}
