/**
 * A rotation after a translation along x, y and z: BVH joints and freejoints.
 *
 *     J = T(t) · R        ∂J/∂t_k = e_k in the last column        ∂J/∂r = that of R
 */
import type { BvhMotion, EulerOrder } from '../../model/skeleton/skeleton.ts';
import { BALLS, spreadBall } from './ball.ts';
import { type JointMotion, type Screw, slideAlong, turnScrew } from './motion.ts';
import { factorOf, productOf } from './product.ts';

const SLIDES = [slideAlong(0, 0), slideAlong(1, 1), slideAlong(2, 2)];

/** T(tx, ty, tz) · R; the rotation's angles come after the translation. */
export function freeMotion(order: EulerOrder): JointMotion {
  const ball = BALLS[order];
  return {
    groups: 'right',
    write(dofs, first, out, o) {
      ball.write(dofs, first + 3, out, o);
      out[o + 12] = dofs[first];
      out[o + 13] = dofs[first + 1];
      out[o + 14] = dofs[first + 2];
    },
    writeDerivative(dofs, first, dof, out, o) {
      if (dof < 3) writeAlong(out, o, dof, 1);
      else ball.writeDerivative(dofs, first + 3, dof - 3, out, o);
    },
    screws: [...SLIDES, ...ball.screws.map((screw) => ({ ...screw, dof: screw.dof + 3 }))],
  };
}

/**
 * T(tx, ty, tz) · R_first · R_second · R_third, as far as present. Three rotations are a ball: BVH multiplies in the
 * listed order, a ball's order names the first applied first, so ZXY here is `yxz` there.
 */
export function bvhMotion({ channels }: BvhMotion): JointMotion {
  const translations = (['tx', 'ty', 'tz'] as const).map((name) => channels.indexOf(name));
  const turns = channels.flatMap((name, dof) => (name.startsWith('r') ? [factorOf(name, dof)] : []));
  const rotation = turns.length === 3 ? listedBall(channels) : productOf(turns);
  if (translations.every((at) => at < 0)) return rotation;
  return {
    ...(rotation.groups && { groups: rotation.groups }),
    write(dofs, first, out, o) {
      rotation.write(dofs, first, out, o);
      for (let k = 0; k < 3; k++) {
        const at = translations[k];
        if (at >= 0) out[o + 12 + k] = dofs[first + at];
      }
    },
    writeDerivative(dofs, first, dof, out, o) {
      const along = translations.indexOf(dof);
      if (along >= 0) writeAlong(out, o, along, 1);
      else rotation.writeDerivative(dofs, first, dof, out, o);
    },
    screws: [...translations.flatMap((dof, axis) => (dof >= 0 ? [slideAlong(axis, dof)] : [])), ...turnsOf(channels)],
  };
}

/** The rotations, in the order in which they are multiplied. */
function turnsOf(channels: readonly string[]): Screw[] {
  return channels.flatMap((name, dof) => (name.startsWith('r') ? [turnScrew('xyz'.indexOf(name[1]), dof)] : []));
}

/** A ball whose three angles may be anywhere among the channels. */
function listedBall(channels: readonly string[]): JointMotion {
  const names = channels.filter((name) => name.startsWith('r')).map((name) => name[1]);
  // A permutation of three letters, which is exactly an order.
  const order = names.reverse().join('') as EulerOrder;
  return spreadBall(order, channels.indexOf('rx'), channels.indexOf('ry'), channels.indexOf('rz'));
}

/** The derivative of a translation along one of the axes. */
function writeAlong(out: Float64Array, o: number, axis: number, speed: number): void {
  out.fill(0, o, o + 16);
  out[o + 12 + axis] = speed;
}
