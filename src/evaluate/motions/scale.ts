/** Joints that deform: scales in all modes, and shear. Their matrices are no rotations. */
import { setIdentity } from '../../math/mat4.ts';
import type { Vec3 } from '../../math/vec3.ts';
import type { ScaleMode } from '../../model/skeleton/skeleton.ts';
import { direction } from './axis.ts';
import type { JointMotion, MotionPart } from './motion.ts';
import { factorOf, productOf } from './product.ts';
import { shearParts } from './shear-parts.ts';

/** Minimum length: preserving the volume at length 0 would need infinite width. */
const SHORTEST = 1e-6;

/** The motion of a scale joint. The axis may have any length but 0; the modes `uniform` and `xyz` ignore it. */
export function scaleMotion(mode: ScaleMode, axis: Vec3): JointMotion {
  switch (mode) {
    case 'uniform':
      return UNIFORM;
    case 'xyz':
      return productOf(['sx', 'sy', 'sz'].map(factorOf));
    case 'axis':
      return stretch(axis, 'axis');
    case 'volume':
      return stretch(axis, 'volume');
  }
}

const UNIFORM: JointMotion = {
  stretches: true,
  parts: [{ kind: 'scale', by: { dof: 0, axes: [0, 1, 2] }, write: (dofs, first, out) => void out.fill(dofs[first]) }],
  write(dofs, first, out, o) {
    diagonal(out, o, dofs[first]);
    out[o + 15] = 1;
  },
  writeDerivative: (_dofs, _first, _dof, out, o) => diagonal(out, o, 1),
};

function diagonal(out: Float64Array, o: number, s: number): void {
  out.fill(0, o, o + 16);
  out[o] = out[o + 5] = out[o + 10] = s;
}

/**
 * s along the axis a, p across it: p·I + (s − p)·a·aᵀ. Here p is 1, or 1/√s to preserve the volume, which requires s >
 * 0; the derivative uses s′ = 1 and p′ = 0 or −1/(2·s·√s) instead.
 */
function stretch(axis: Vec3, mode: 'axis' | 'volume'): JointMotion {
  const [x, y, z] = direction(axis);
  const write = (out: Float64Array, o: number, along: number, across: number) => {
    const d = along - across;
    out[o] = across + d * x * x;
    out[o + 5] = across + d * y * y;
    out[o + 10] = across + d * z * z;
    out[o + 1] = out[o + 4] = d * x * y;
    out[o + 2] = out[o + 8] = d * x * z;
    out[o + 6] = out[o + 9] = d * y * z;
    out[o + 3] = out[o + 7] = out[o + 11] = out[o + 12] = out[o + 13] = out[o + 14] = out[o + 15] = 0;
  };
  if (mode === 'axis') {
    return {
      stretches: true,
      parts: partsAlong(
        [x, y, z],
        (s, out) => {
          out.fill(1);
          out[0] = s;
        },
        { dof: 0, axes: [0] },
      ),
      write(dofs, first, out, o) {
        write(out, o, dofs[first], 1);
        out[o + 15] = 1;
      },
      writeDerivative: (_dofs, _first, _dof, out, o) => write(out, o, 1, 0),
    };
  }
  return {
    stretches: true,
    parts: partsAlong([x, y, z], (value, out) => {
      const s = Math.max(SHORTEST, value);
      out.fill(1 / Math.sqrt(s));
      out[0] = s;
    }),
    write(dofs, first, out, o) {
      const s = Math.max(SHORTEST, dofs[first]);
      write(out, o, s, 1 / Math.sqrt(s));
      out[o + 15] = 1;
    },
    writeDerivative(dofs, first, _dof, out, o) {
      const s = dofs[first];
      if (s > SHORTEST) write(out, o, 1, -0.5 / (s * Math.sqrt(s)));
      else write(out, o, 0, 0);
    },
  };
}

/** A scale across an axis that is none of x, y, z: Q · diag · Qᵀ, where Q takes x to the axis. */
function partsAlong(
  [x, y, z]: Vec3,
  scale: (value: number, out: Float64Array) => void,
  by?: MotionPart['by'],
): readonly MotionPart[] {
  // Half-way between x and the axis: (x × a, 1 + x·a), normalised; opposite directions scale alike.
  const sign = x < 0 ? -1 : 1;
  const w = Math.sqrt((1 + sign * x) / 2);
  const across = sign / (2 * w);
  const turn = (by: number): MotionPart => ({
    kind: 'rotation',
    write(_dofs, _first, out) {
      out[0] = 0;
      out[1] = -z * across * by + 0;
      out[2] = y * across * by + 0;
      out[3] = w;
    },
  });
  const stretched: MotionPart = {
    kind: 'scale',
    ...(by && { by }),
    write: (dofs, first, out) => scale(dofs[first], out),
  };
  return w === 1 ? [stretched] : [turn(1), stretched, turn(-1)];
}

/** x′ = x + hxy·y + hxz·z, y′ = y + hyz·z, z′ = z. */
export const SHEAR_MOTION: JointMotion = {
  stretches: true,
  parts: shearParts(),
  write(dofs, first, out, o) {
    setIdentity(out, o);
    out[o + 4] = dofs[first];
    out[o + 8] = dofs[first + 1];
    out[o + 9] = dofs[first + 2];
  },
  writeDerivative(_dofs, _first, dof, out, o) {
    out.fill(0, o, o + 16);
    out[o + (dof === 0 ? 4 : dof === 1 ? 8 : 9)] = 1;
  },
};
