/**
 * One-DOF matrices along and about x, y and z, multiplied from left to right: universal and compound joints, and BVH
 * joints with fewer than three rotations.
 *
 *     M ← M · F        ∂: the factor of the DOF is replaced by its derivative, F′
 *
 * Multiplying by such a factor, or by its derivative, mixes columns of M, so no factor is written out as a matrix.
 */
import { setIdentity } from '../../math/mat4.ts';
import type { AxisPair } from '../../model/skeleton/skeleton.ts';
import { type JointMotion, type MotionPart, slideAlong, turnScrew } from './motion.ts';

/** A one-DOF matrix along or about a main axis. */
export interface Factor {
  readonly kind: 'translation' | 'rotation' | 'scale';
  /** 0, 1, 2 for x, y, z. */
  readonly axis: number;
  /** Index among the joint's DOFs. */
  readonly dof: number;
}

/** The factor of a DOF's name: `tx`, `rz`, `sy`. */
export function factorOf(name: string, dof: number): Factor {
  const kind = name.startsWith('t') ? 'translation' : name.startsWith('r') ? 'rotation' : 'scale';
  return { kind, axis: 'xyz'.indexOf(name[1]), dof };
}

/** From left to right. */
export function productOf(factors: readonly Factor[]): JointMotion {
  const stretches = factors.some(({ kind }) => kind === 'scale');
  const screws = factors.map(({ kind, axis, dof }) =>
    kind === 'rotation' ? turnScrew(axis, dof) : slideAlong(axis, dof),
  );
  return {
    stretches,
    ...(stretches ? { parts: factors.map(partOf) } : { screws }),
    write(dofs, first, out, o) {
      setIdentity(out, o);
      for (let f = 0; f < factors.length; f++) multiply(out, o, factors[f], dofs[first + factors[f].dof]);
    },
    writeDerivative(dofs, first, dof, out, o) {
      setIdentity(out, o);
      for (let f = 0; f < factors.length; f++) {
        const factor = factors[f];
        const value = dofs[first + factor.dof];
        if (factor.dof === dof) multiplyByDerivative(out, o, factor, value);
        else multiply(out, o, factor, value);
      }
      out[o + 15] = 0;
    },
  };
}

function partOf({ kind, axis, dof }: Factor): MotionPart {
  return {
    kind,
    by: { dof, axes: [axis] },
    write(dofs, first, out) {
      const value = dofs[first + dof];
      out.fill(kind === 'scale' ? 1 : 0);
      out[axis] = kind === 'rotation' ? Math.sin(value / 2) : value;
      if (kind === 'rotation') out[3] = Math.cos(value / 2);
    },
  };
}

/** Two rotations, the one named first applied first; the DOFs are always in the order x, y, z. */
export function universalMotion(order: AxisPair): JointMotion {
  const [first, second] = order;
  const turn = (axis: string) => factorOf(`r${axis}`, axis === (first < second ? first : second) ? 0 : 1);
  return productOf([turn(second), turn(first)]);
}

/** M ← M · F. */
function multiply(m: Float64Array, o: number, { kind, axis }: Factor, value: number): void {
  const own = o + 4 * axis;
  if (kind === 'rotation') {
    turnColumns(m, o, axis, Math.cos(value), Math.sin(value));
  } else if (kind === 'scale') {
    for (let r = 0; r < 3; r++) m[own + r] *= value;
  } else {
    for (let r = 0; r < 3; r++) m[o + 12 + r] += m[own + r] * value;
  }
}

/** M ← M · F′: the unaffected part of the factor has derivative 0. */
function multiplyByDerivative(m: Float64Array, o: number, { kind, axis }: Factor, value: number): void {
  const own = o + 4 * axis;
  if (kind === 'rotation') {
    // Derivatives of cos and sin.
    turnColumns(m, o, axis, -Math.sin(value), Math.cos(value));
    for (let r = 0; r < 3; r++) m[own + r] = m[o + 12 + r] = 0;
  } else if (kind === 'scale') {
    for (let c = o; c < o + 16; c += 4) if (c !== own) m[c] = m[c + 1] = m[c + 2] = 0;
  } else {
    for (let r = 0; r < 3; r++) m[o + 12 + r] = m[own + r];
    for (let c = o; c < o + 12; c += 4) m[c] = m[c + 1] = m[c + 2] = 0;
  }
}

/** Rotates the two columns of the other axes. */
function turnColumns(m: Float64Array, o: number, axis: number, cos: number, sin: number): void {
  const u = o + 4 * ((axis + 1) % 3);
  const v = o + 4 * ((axis + 2) % 3);
  for (let r = 0; r < 3; r++) {
    const a = m[u + r];
    const b = m[v + r];
    m[u + r] = a * cos + b * sin;
    m[v + r] = b * cos - a * sin;
  }
}
