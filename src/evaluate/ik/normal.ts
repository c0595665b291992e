/**
 * The damped least-squares step, from the smaller of two systems, factorised (`math/ldlt.ts`):
 *
 *     (JᵀJ + λI)·h = −Jᵀe        as many equations as variables
 *     (JJᵀ + λI)·z = e,  h = −Jᵀz        as many as errors: 3 for a pinned point, however long the chain
 *
 * Both give the same h. J is stored by rows, so both are sums over consecutive numbers.
 *
 * Errors come in threes, for a position or an orientation, and so do equations, padded if the number of variables is no
 * multiple of 3: everything works in blocks of 3 × 3, nine sums at a time. Only entries of J that can be nonzero are
 * read: a pin depends on the variables of the joints above it, two pins both depend on those of their common ancestors.
 */
import { factorise, substitute } from '../../math/ldlt.ts';
import type { JacobianShape } from './state.ts';

/** Size of the smaller system, a multiple of 3. */
export function systemSize(rows: number, n: number): number {
  return rows <= n ? rows : 3 * Math.ceil(n / 3);
}

/**
 * The lower triangle of the smaller system, without damping. J has `rows` rows of `n` numbers, `rows` a multiple of 3.
 */
export function writeNormal(
  jacobian: Float64Array,
  rows: number,
  n: number,
  shape: JacobianShape,
  out: Float64Array,
): void {
  const blocks = rows / 3;
  if (rows <= n) {
    for (let r = 0; r < blocks; r++) {
      writeOwnBlock(jacobian, rows, n, r, shape, out);
      for (let c = 0; c < r; c++) writeBlock(jacobian, rows, n, 3 * r, 3 * c, shape.shared[r * blocks + c], out);
    }
    return;
  }
  const size = systemSize(rows, n);
  out.fill(0, 0, size * size);
  for (let r = 0; r < rows; r++) {
    const a = r * n;
    for (let i = 0; i < n; i++) {
      const left = jacobian[a + i];
      if (left === 0) continue;
      for (let k = 0; k <= i; k++) out[i * size + k] += left * jacobian[a + k];
    }
  }
}

/** Products of three rows with themselves. */
function writeOwnBlock(
  jacobian: Float64Array,
  rows: number,
  n: number,
  block: number,
  { first, column }: JacobianShape,
  out: Float64Array,
): void {
  const a = 3 * block * n;
  let xx = 0;
  let yx = 0;
  let yy = 0;
  let zx = 0;
  let zy = 0;
  let zz = 0;
  for (let i = first[block]; i < first[block + 1]; i++) {
    const at = a + column[i];
    const x = jacobian[at];
    const y = jacobian[at + n];
    const z = jacobian[at + 2 * n];
    xx += x * x;
    yx += y * x;
    yy += y * y;
    zx += z * x;
    zy += z * y;
    zz += z * z;
  }
  const o = 3 * block * (rows + 1);
  out[o] = xx;
  out[o + rows] = yx;
  out[o + rows + 1] = yy;
  out[o + 2 * rows] = zx;
  out[o + 2 * rows + 1] = zy;
  out[o + 2 * rows + 2] = zz;
}

/**
 * Products of three rows with three others.
 * @param shared the number of leading variables beyond which one of the two has only zeros
 */
function writeBlock(
  jacobian: Float64Array,
  rows: number,
  n: number,
  r: number,
  c: number,
  shared: number,
  out: Float64Array,
): void {
  const a = r * n;
  const b = c * n;
  let xx = 0;
  let xy = 0;
  let xz = 0;
  let yx = 0;
  let yy = 0;
  let yz = 0;
  let zx = 0;
  let zy = 0;
  let zz = 0;
  for (let v = 0; v < shared; v++) {
    const x = jacobian[a + v];
    const y = jacobian[a + n + v];
    const z = jacobian[a + 2 * n + v];
    const p = jacobian[b + v];
    const q = jacobian[b + n + v];
    const s = jacobian[b + 2 * n + v];
    xx += x * p;
    xy += x * q;
    xz += x * s;
    yx += y * p;
    yy += y * q;
    yz += y * s;
    zx += z * p;
    zy += z * q;
    zz += z * s;
  }
  const o = r * rows + c;
  out[o] = xx;
  out[o + 1] = xy;
  out[o + 2] = xz;
  out[o + rows] = yx;
  out[o + rows + 1] = yy;
  out[o + rows + 2] = yz;
  out[o + 2 * rows] = zx;
  out[o + 2 * rows + 1] = zy;
  out[o + 2 * rows + 2] = zz;
}

/**
 * Writes the step h to `step`.
 * @param normal from `writeNormal` for the same J
 * @param factor @param solution scratch, as large as the system
 * @returns false if the system is not positive definite; more damping makes it so
 */
export function solveDamped(
  jacobian: Float64Array,
  rows: number,
  n: number,
  { first, column }: JacobianShape,
  errors: Float64Array,
  normal: Float64Array,
  damping: number,
  factor: Float64Array,
  solution: Float64Array,
  step: Float64Array,
): boolean {
  const size = systemSize(rows, n);
  if (!factorise(normal, size, damping, factor)) return false;
  if (rows <= n) {
    for (let r = 0; r < rows; r++) solution[r] = errors[r];
    substitute(factor, rows, solution);
    for (let v = 0; v < n; v++) step[v] = 0;
    for (let block = 0; 3 * block < rows; block++) {
      const x = solution[3 * block];
      const y = solution[3 * block + 1];
      const z = solution[3 * block + 2];
      const a = 3 * block * n;
      for (let i = first[block]; i < first[block + 1]; i++) {
        const v = column[i];
        const at = a + v;
        step[v] -= x * jacobian[at] + y * jacobian[at + n] + z * jacobian[at + 2 * n];
      }
    }
    return true;
  }
  for (let i = 0; i < size; i++) solution[i] = 0;
  for (let r = 0; r < rows; r++) {
    const e = errors[r];
    const a = r * n;
    for (let v = 0; v < n; v++) solution[v] -= e * jacobian[a + v];
  }
  substitute(factor, size, solution);
  for (let v = 0; v < n; v++) step[v] = solution[v];
  return true;
}

/**
 * Solves a damped step for one pin's position, three equations, directly from J: storing nothing but the step takes a
 * third of the time. J has at least 3 columns.
 */
export function solveThree(
  jacobian: Float64Array,
  n: number,
  errors: Float64Array,
  damping: number,
  solution: Float64Array,
  step: Float64Array,
): boolean {
  let xx = damping;
  let yx = 0;
  let yy = damping;
  let zx = 0;
  let zy = 0;
  let zz = damping;
  const b = n;
  const c = n + n;
  for (let v = 0; v < n; v++) {
    const x = jacobian[v];
    const y = jacobian[b + v];
    const z = jacobian[c + v];
    xx += x * x;
    yx += y * x;
    yy += y * y;
    zx += z * x;
    zy += z * y;
    zz += z * z;
  }
  const ox = 1 / xx;
  const ly = yx * ox;
  yy -= ly * yx;
  const oy = 1 / yy;
  const lz = zx * ox;
  const wz = zy - lz * yx;
  const mz = wz * oy;
  zz -= lz * zx + mz * wz;
  if (!(xx > 0 && yy > 0 && zz > 0 && xx + yy + zz < Infinity)) return false;
  const oz = 1 / zz;
  const f = errors[1] - ly * errors[0];
  const z = (errors[2] - lz * errors[0] - mz * f) * oz;
  const y = f * oy - mz * z;
  const x = errors[0] * ox - ly * y - lz * z;
  solution[0] = x;
  solution[1] = y;
  solution[2] = z;
  for (let v = 0; v < n; v++) step[v] = -(x * jacobian[v] + y * jacobian[b + v] + z * jacobian[c + v]);
  return true;
}
