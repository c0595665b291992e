/**
 * Forward kinematics of joints that are products of screws, with the world axes that the Jacobian needs:
 *
 *     W = W_parent · T(offset) · Π T(slide·φ·a) · R(a, turn·φ)
 *
 * A rotation about x, y or z mixes two columns of W, and its world axis is the third. Other rotations become a matrix
 * by Rodrigues' formula, with the third column as the cross product of the other two.
 *
 * From a joint to its first child the matrix stays in local variables, since array access takes longer than the
 * arithmetic. One long loop, since a call per joint would cost as much as the joint.
 */
import { writeSinesAndCosines } from '../../math/sines-cosines.ts';
import { OTHER, PLAN, RULES, SLANTED, STANDS, WORLD } from './screws.ts';
import type { IkProblem } from './state.ts';

/**
 * Writes the world matrices of all kept slots, and the lines of the screws.
 * @param writeOther writes the world matrix of a slot that is no product of screws
 */
export function writeMatrices(
  problem: IkProblem,
  dofs: Float64Array,
  writeOther: (problem: IkProblem, dofs: Float64Array, slot: number) => void,
): void {
  const { plan, rules, angles, turned, lines } = problem.links;
  const { worlds } = problem.slots;
  const count = angles.length;
  for (let i = 0; i < count; i++) if (plan[PLAN * i] <= SLANTED) angles[i] = dofs[plan[PLAN * i + 1]];
  writeSinesAndCosines(angles, count, turned);
  // The columns of the matrix.
  let x0 = 0;
  let x1 = 0;
  let x2 = 0;
  let y0 = 0;
  let y1 = 0;
  let y2 = 0;
  let z0 = 0;
  let z1 = 0;
  let z2 = 0;
  let ox = 0;
  let oy = 0;
  let oz = 0;
  for (let i = 0; i < count; i++) {
    const does = plan[PLAN * i];
    const from = plan[PLAN * i + 2];
    const kept = plan[PLAN * i + 3];
    if (does === OTHER) {
      writeOther(problem, dofs, kept);
      continue;
    }
    if (from >= 0) {
      const g = 16 * from;
      x0 = worlds[g];
      x1 = worlds[g + 1];
      x2 = worlds[g + 2];
      y0 = worlds[g + 4];
      y1 = worlds[g + 5];
      y2 = worlds[g + 6];
      z0 = worlds[g + 8];
      z1 = worlds[g + 9];
      z2 = worlds[g + 10];
      ox = worlds[g + 12];
      oy = worlds[g + 13];
      oz = worlds[g + 14];
    } else if (from === WORLD) {
      const { hasRootTranslation } = problem.skeleton;
      x0 = y1 = z2 = 1;
      x1 = x2 = y0 = y2 = z0 = z1 = 0;
      ox = hasRootTranslation ? dofs[0] : 0;
      oy = hasRootTranslation ? dofs[1] : 0;
      oz = hasRootTranslation ? dofs[2] : 0;
    }
    const rule = RULES * i;
    const dx = rules[rule];
    const dy = rules[rule + 1];
    const dz = rules[rule + 2];
    ox += x0 * dx + y0 * dy + z0 * dz;
    oy += x1 * dx + y1 * dy + z1 * dz;
    oz += x2 * dx + y2 * dy + z2 * dz;
    const line = 6 * i;
    lines[line + 3] = ox;
    lines[line + 4] = oy;
    lines[line + 5] = oz;
    const sin = turned[2 * i];
    const cos = turned[2 * i + 1];
    if (does === 0) {
      lines[line] = x0;
      lines[line + 1] = x1;
      lines[line + 2] = x2;
      const a0 = cos * y0 + sin * z0;
      const a1 = cos * y1 + sin * z1;
      const a2 = cos * y2 + sin * z2;
      z0 = cos * z0 - sin * y0;
      z1 = cos * z1 - sin * y1;
      z2 = cos * z2 - sin * y2;
      y0 = a0;
      y1 = a1;
      y2 = a2;
    } else if (does === 1) {
      lines[line] = y0;
      lines[line + 1] = y1;
      lines[line + 2] = y2;
      const a0 = cos * z0 + sin * x0;
      const a1 = cos * z1 + sin * x1;
      const a2 = cos * z2 + sin * x2;
      x0 = cos * x0 - sin * z0;
      x1 = cos * x1 - sin * z1;
      x2 = cos * x2 - sin * z2;
      z0 = a0;
      z1 = a1;
      z2 = a2;
    } else if (does === 2) {
      lines[line] = z0;
      lines[line + 1] = z1;
      lines[line + 2] = z2;
      const a0 = cos * x0 + sin * y0;
      const a1 = cos * x1 + sin * y1;
      const a2 = cos * x2 + sin * y2;
      y0 = cos * y0 - sin * x0;
      y1 = cos * y1 - sin * x1;
      y2 = cos * y2 - sin * x2;
      x0 = a0;
      x1 = a1;
      x2 = a2;
    } else if (does !== STANDS) {
      const a = rules[rule + 3];
      const b = rules[rule + 4];
      const c = rules[rule + 5];
      lines[line] = x0 * a + y0 * b + z0 * c;
      lines[line + 1] = x1 * a + y1 * b + z1 * c;
      lines[line + 2] = x2 * a + y2 * b + z2 * c;
      if (does === SLANTED) {
        const ka = (1 - cos) * a;
        const kb = (1 - cos) * b;
        const xx = cos + ka * a;
        const xy = ka * b + sin * c;
        const xz = ka * c - sin * b;
        const yx = ka * b - sin * c;
        const yy = cos + kb * b;
        const yz = kb * c + sin * a;
        const a0 = x0 * xx + y0 * xy + z0 * xz;
        const a1 = x1 * xx + y1 * xy + z1 * xz;
        const a2 = x2 * xx + y2 * xy + z2 * xz;
        y0 = x0 * yx + y0 * yy + z0 * yz;
        y1 = x1 * yx + y1 * yy + z1 * yz;
        y2 = x2 * yx + y2 * yy + z2 * yz;
        x0 = a0;
        x1 = a1;
        x2 = a2;
        z0 = x1 * y2 - x2 * y1;
        z1 = x2 * y0 - x0 * y2;
        z2 = x0 * y1 - x1 * y0;
      }
    }
    if (rules[rule + 6] !== 0) {
      // The rotation does not change its own axis.
      const slide = rules[rule + 6] * dofs[plan[PLAN * i + 1]];
      ox += slide * lines[line];
      oy += slide * lines[line + 1];
      oz += slide * lines[line + 2];
    }
    if (kept < 0) continue;
    const o = 16 * kept;
    worlds[o] = x0;
    worlds[o + 1] = x1;
    worlds[o + 2] = x2;
    worlds[o + 4] = y0;
    worlds[o + 5] = y1;
    worlds[o + 6] = y2;
    worlds[o + 8] = z0;
    worlds[o + 9] = z1;
    worlds[o + 10] = z2;
    worlds[o + 12] = ox;
    worlds[o + 13] = oy;
    worlds[o + 14] = oz;
  }
}
