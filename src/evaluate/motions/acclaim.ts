/**
 * Bones of Acclaim skeletons, about axes of their own: with C their rotation, and R the product of the bone's
 * rotations,
 *
 *     bone    J = C·T(t)·R·C⁻¹        root    J = T(t)·C·R
 *
 * C is constant, so that derivatives are those of T(t)·R between the same two factors; and C·R(e, φ)·C⁻¹ = R(C·e, φ),
 * so that a bone is a product of screws about the axes as C turns them. `l` lengthens the bone, which moves no frame of
 * its own: children of such a bone start at its tip.
 */
import type { Vec3 } from '../../math/vec3.ts';
import type { AcclaimMotion } from '../../model/skeleton/skeleton.ts';
import { BALLS } from './ball.ts';
import { type JointMotion, type Screw, slideAlong, turnScrew } from './motion.ts';
import { factorOf, productOf } from './product.ts';

/** The rule of an Acclaim bone. */
export function acclaimMotion(motion: AcclaimMotion): JointMotion {
  const { dofs, axes, frame } = motion;
  const all = dofs.flatMap((name, dof) => (name === 'l' ? [] : [factorOf(name, dof)]));
  const slides = all.filter(({ kind }) => kind === 'translation');
  const turns = all.filter(({ kind }) => kind === 'rotation').reverse();
  const length = dofs.indexOf('l');
  if (axes.every((angle) => angle === 0)) return unmovedBy(length, productOf([...slides, ...turns]));
  const c = axesOf(motion);
  const along = (axis: number): Vec3 => [c[3 * axis], c[3 * axis + 1], c[3 * axis + 2]];
  if (frame === 'root') {
    const screws = [
      ...slides.map(({ axis, dof }) => slideAlong(axis, dof)),
      ...turns.map(({ axis, dof }): Screw => ({ ...turnScrew(axis, dof), axis: along(axis) })),
    ];
    return unmovedBy(length, { ...rootMotion(c, productOf(turns), dofs), turned: { screws, by: c } });
  }
  const inner = productOf([...slides, ...turns]);
  return unmovedBy(length, {
    write(values, first, out, o) {
      inner.write(values, first, out, o);
      conjugate(c, out, o);
    },
    writeDerivative(values, first, dof, out, o) {
      inner.writeDerivative(values, first, dof, out, o);
      conjugate(c, out, o);
    },
    screws: [...slides, ...turns].map(
      ({ kind, axis, dof }): Screw => ({
        ...(kind === 'rotation' ? turnScrew(axis, dof) : slideAlong(axis, dof)),
        axis: along(axis),
      }),
    ),
  });
}

/** The rotation of a bone's axes as 9 numbers, column-major. */
export function axesOf({ axes, order }: Pick<AcclaimMotion, 'axes' | 'order'>): Float64Array {
  const matrix = new Float64Array(16);
  BALLS[order].write(Float64Array.from(axes), 0, matrix, 0);
  return Float64Array.from([0, 1, 2, 4, 5, 6, 8, 9, 10], (k) => matrix[k]);
}

/** T(t)·C·R. @param turns R */
function rootMotion(c: Float64Array, turns: JointMotion, dofs: AcclaimMotion['dofs']): JointMotion {
  const slides = (['tx', 'ty', 'tz'] as const).map((name) => dofs.indexOf(name));
  return {
    write(values, first, out, o) {
      turns.write(values, first, out, o);
      turnColumns(c, out, o);
      for (let k = 0; k < 3; k++) out[o + 12 + k] = slides[k] < 0 ? 0 : values[first + slides[k]];
    },
    writeDerivative(values, first, dof, out, o) {
      const along = slides.indexOf(dof);
      if (along >= 0) {
        out.fill(0, o, o + 16);
        out[o + 12 + along] = 1;
        return;
      }
      turns.writeDerivative(values, first, dof, out, o);
      turnColumns(c, out, o);
    },
  };
}

/** The same, for bones of which a DOF moves nothing in their own frame. @param length its index; -1 for none */
function unmovedBy(length: number, motion: JointMotion): JointMotion {
  if (length < 0) return motion;
  return {
    ...motion,
    writeDerivative(values, first, dof, out, o) {
      if (dof === length) out.fill(0, o, o + 16);
      else motion.writeDerivative(values, first, dof, out, o);
    },
  };
}

/**
 * The rule of a joint that starts at the tip of a bone which a DOF lengthens.
 * @param dof that DOF, counted from the joint's own first one: negative
 * @param along the direction of the bone, normalised
 */
export function atTip(own: JointMotion, dof: number, along: Vec3): JointMotion {
  const { write, writeDerivative, stretches, groups } = own;
  return {
    write(values, first, out, o) {
      write(values, first, out, o);
      for (let k = 0; k < 3; k++) out[o + 12 + k] += along[k] * values[first + dof];
    },
    writeDerivative,
    ...(stretches && { stretches }),
    ...(groups && { groups }),
  };
}

/** M ← C·M, of an affine matrix. */
function turnColumns(c: Float64Array, m: Float64Array, o: number): void {
  for (let at = o; at < o + 16; at += 4) {
    const x = m[at];
    const y = m[at + 1];
    const z = m[at + 2];
    for (let r = 0; r < 3; r++) m[at + r] = c[r] * x + c[3 + r] * y + c[6 + r] * z;
  }
}

/** M ← C·M·C⁻¹. */
function conjugate(c: Float64Array, m: Float64Array, o: number): void {
  turnColumns(c, m, o);
  for (let r = o; r < o + 3; r++) {
    const x = m[r];
    const y = m[r + 4];
    const z = m[r + 8];
    for (let k = 0; k < 3; k++) m[r + 4 * k] = c[k] * x + c[3 + k] * y + c[6 + k] * z;
  }
}
