/** Rotation about and sliding along an axis: hinge, prismatic and screw joints. */
import { turnAbout } from '../../math/mat3.ts';
import type { Vec3 } from '../../math/vec3.ts';
import { crossColumns } from './ball.ts';
import type { JointMotion } from './motion.ts';

/** T(axis · perTurn · r / 2π) · R(axis, r): a hinge if `perTurn` is 0, else a screw. R′ = [a]× · R. */
export function screwMotion(axis: Vec3, perTurn: number): JointMotion {
  const [x, y, z] = direction(axis);
  const advance = perTurn / (2 * Math.PI);
  const screw: JointMotion = {
    write(dofs, first, out, o) {
      const r = dofs[first];
      turnAbout(x, y, z, Math.cos(r), Math.sin(r), out, o, 4);
      const t = advance * r;
      out[o + 12] = t * x;
      out[o + 13] = t * y;
      out[o + 14] = t * z;
      out[o + 3] = out[o + 7] = out[o + 11] = 0;
      out[o + 15] = 1;
    },
    writeDerivative(dofs, first, _dof, out, o) {
      screw.write(dofs, first, out, o);
      crossColumns(out, o, x, y, z);
      out[o + 12] = advance * x;
      out[o + 13] = advance * y;
      out[o + 14] = advance * z;
    },
    screws: [{ axis: [x, y, z], turn: 1, slide: advance, dof: 0 }],
  };
  return screw;
}

/** T(t · axis). */
export function prismaticMotion(axis: Vec3): JointMotion {
  const [x, y, z] = direction(axis);
  const along = (out: Float64Array, o: number, t: number) => {
    out.fill(0, o, o + 16);
    out[o + 12] = t * x;
    out[o + 13] = t * y;
    out[o + 14] = t * z;
  };
  return {
    write(dofs, first, out, o) {
      along(out, o, dofs[first]);
      out[o] = out[o + 5] = out[o + 10] = out[o + 15] = 1;
    },
    writeDerivative: (_dofs, _first, _dof, out, o) => along(out, o, 1),
    screws: [{ axis: [x, y, z], turn: 0, slide: 1, dof: 0 }],
  };
}

/**
 * The normalised axis, divided by its largest component first so that neither 1e-200 nor 1e200 is lost. An axis of
 * length 0, which readers reject, gives x.
 */
export function direction([x, y, z]: Vec3): Vec3 {
  const largest = Math.max(Math.abs(x), Math.abs(y), Math.abs(z));
  if (!(largest > 0 && largest < Infinity)) return [1, 0, 0];
  const [a, b, c] = [x / largest, y / largest, z / largest];
  const length = Math.sqrt(a * a + b * b + c * c);
  return [a / length, b / length, c / length];
}
