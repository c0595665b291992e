/**
 * The damped step of least squares, by whichever of the two systems is smaller, and its factorisation (Cholesky's):
 *
 *     (JᵀJ + λI)·h = −Jᵀe        as many equations as unknowns
 *     (JJᵀ + λI)·z = e,  h = −Jᵀz        as many as errors: a point pinned is 3, however long the chain
 *
 * Both give the same h. J is kept by rows, so both are sums over consecutive numbers.
 *
 * Errors come in threes, a position's or an orientation's, and so do equations, with idle ones where the unknowns are
 * no multiple of 3: everything goes by blocks of 3 × 3, nine sums at a time. Of J only what is not 0 for certain is
 * read: a pin is moved by the unknowns of the joints above it, two pins both by those of the joints above both.
 */
import type { JacobianShape } from './state.ts';

/** Equations of the smaller system, a multiple of 3. */
export function systemSize(rows: number, n: number): number {
  return rows <= n ? rows : 3 * Math.ceil(n / 3);
}

/**
 * The smaller system without damping: its lower triangle. J has `rows` rows of `n` numbers, `rows` a multiple of 3.
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

/** Three rows against themselves. */
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
 * Three rows against three others.
 * @param shared past how many unknowns one of both has nothing but 0
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
 * The step h, to `step`.
 * @param normal what `writeNormal` wrote of the same J
 * @param factor @param solution scratch, as large as the system
 * @returns false where the system is not positive definite, which more damping cures
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
 * The same of one pin's position, three equations, from J itself: with nothing written but the step it takes a third of
 * the time. J has at least 3 columns.
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

/** A + λI = L·D·Lᵀ, with 1/D on the diagonal of what is kept: without roots, which take as long as all the rest. */
function factorise(a: Float64Array, size: number, damping: number, l: Float64Array): boolean {
  for (let i = 0; i < size; i += 3) {
    const x = i * size;
    const y = x + size;
    const z = y + size;
    // L·D first, block by block.
    for (let k = 0; k < i; k += 3) {
      const p = k * size;
      const q = p + size;
      const s = q + size;
      let xx = a[x + k];
      let xy = a[x + k + 1];
      let xz = a[x + k + 2];
      let yx = a[y + k];
      let yy = a[y + k + 1];
      let yz = a[y + k + 2];
      let zx = a[z + k];
      let zy = a[z + k + 1];
      let zz = a[z + k + 2];
      for (let m = 0; m < k; m++) {
        const u = l[x + m];
        const v = l[y + m];
        const w = l[z + m];
        const f = l[p + m];
        const g = l[q + m];
        const h = l[s + m];
        xx -= u * f;
        xy -= u * g;
        xz -= u * h;
        yx -= v * f;
        yy -= v * g;
        yz -= v * h;
        zx -= w * f;
        zy -= w * g;
        zz -= w * h;
      }
      const f = l[q + k];
      const g = l[s + k];
      const h = l[s + k + 1];
      xy -= xx * f;
      xz -= xx * g + xy * h;
      yy -= yx * f;
      yz -= yx * g + yy * h;
      zy -= zx * f;
      zz -= zx * g + zy * h;
      l[x + k] = xx;
      l[x + k + 1] = xy;
      l[x + k + 2] = xz;
      l[y + k] = yx;
      l[y + k + 1] = yy;
      l[y + k + 2] = yz;
      l[z + k] = zx;
      l[z + k + 1] = zy;
      l[z + k + 2] = zz;
    }
    let xx = a[x + i] + damping;
    let yx = a[y + i];
    let yy = a[y + i + 1] + damping;
    let zx = a[z + i];
    let zy = a[z + i + 1];
    let zz = a[z + i + 2] + damping;
    for (let m = 0; m < i; m++) {
      const part = l[m * size + m];
      const u = l[x + m] * part;
      const v = l[y + m] * part;
      const w = l[z + m] * part;
      xx -= u * l[x + m];
      yx -= u * l[y + m];
      yy -= v * l[y + m];
      zx -= u * l[z + m];
      zy -= v * l[z + m];
      zz -= w * l[z + m];
      l[x + m] = u;
      l[y + m] = v;
      l[z + m] = w;
    }
    const ox = 1 / xx;
    const f = yx * ox;
    yy -= f * yx;
    const oy = 1 / yy;
    const g = zx * ox;
    zy -= g * yx;
    const h = zy * oy;
    zz -= g * zx + h * zy;
    if (!(xx > 0 && yy > 0 && zz > 0 && xx + yy + zz < Infinity)) return false;
    l[x + i] = ox;
    l[y + i] = f;
    l[y + i + 1] = oy;
    l[z + i] = g;
    l[z + i + 1] = h;
    l[z + i + 2] = 1 / zz;
  }
  return true;
}

/** Solves L·D·Lᵀ·x = b in place. */
function substitute(l: Float64Array, size: number, b: Float64Array): void {
  for (let i = 0; i < size; i += 3) {
    const o = i * size;
    const p = o + size;
    const q = p + size;
    let x = b[i];
    let y = b[i + 1];
    let z = b[i + 2];
    for (let m = 0; m < i; m++) {
      const known = b[m];
      x -= l[o + m] * known;
      y -= l[p + m] * known;
      z -= l[q + m] * known;
    }
    y -= l[p + i] * x;
    b[i] = x;
    b[i + 1] = y;
    b[i + 2] = z - l[q + i] * x - l[q + i + 1] * y;
  }
  for (let i = size - 3; i >= 0; i -= 3) {
    const o = i * size;
    const p = o + size;
    const q = p + size;
    let x = b[i] * l[o + i];
    let y = b[i + 1] * l[p + i + 1];
    let z = b[i + 2] * l[q + i + 2];
    for (let m = i + 3; m < size; m++) {
      const known = b[m];
      const a = m * size + i;
      x -= l[a] * known;
      y -= l[a + 1] * known;
      z -= l[a + 2] * known;
    }
    y -= l[q + i + 1] * z;
    b[i] = x - l[p + i] * y - l[q + i] * z;
    b[i + 1] = y;
    b[i + 2] = z;
  }
}
