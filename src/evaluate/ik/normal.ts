/**
 * The damped step of least squares, by whichever of the two systems is smaller, and Cholesky's factorisation:
 *
 *     (JᵀJ + λI)·h = −Jᵀe        as many equations as unknowns
 *     (JJᵀ + λI)·z = e,  h = −Jᵀz        as many as errors: a point pinned is 3, however long the chain
 *
 * Both give the same h. J is kept by rows, so both are sums over consecutive numbers.
 */

/** The smaller system without damping: its lower triangle. J has `rows` rows of `n` numbers, `rows` a multiple of 3. */
export function writeNormal(jacobian: Float64Array, rows: number, n: number, out: Float64Array): void {
  if (rows <= n) {
    for (let r = 0; r < rows; r += 3) for (let c = 0; c <= r; c += 3) writeBlock(jacobian, rows, n, r, c, out);
    return;
  }
  out.fill(0, 0, n * n);
  for (let r = 0; r < rows; r++) {
    const a = r * n;
    for (let i = 0; i < n; i++) {
      const left = jacobian[a + i];
      if (left === 0) continue;
      for (let k = 0; k <= i; k++) out[i * n + k] += left * jacobian[a + k];
    }
  }
}

/** Three rows against three rows: a position's or an orientation's errors come in threes. */
function writeBlock(jacobian: Float64Array, rows: number, n: number, r: number, c: number, out: Float64Array): void {
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
  for (let v = 0; v < n; v++) {
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
  errors: Float64Array,
  normal: Float64Array,
  damping: number,
  factor: Float64Array,
  solution: Float64Array,
  step: Float64Array,
): boolean {
  const size = rows <= n ? rows : n;
  if (!(size === 3 ? factorise3(normal, damping, factor) : factorise(normal, size, damping, factor))) return false;
  if (rows <= n) {
    for (let r = 0; r < rows; r++) solution[r] = errors[r];
    if (rows === 3) substitute3(factor, solution);
    else substitute(factor, rows, solution);
    for (let r = 0; r < rows; r += 3) {
      const x = solution[r];
      const y = solution[r + 1];
      const z = solution[r + 2];
      const a = r * n;
      const b = a + n;
      const c = b + n;
      if (r === 0) for (let v = 0; v < n; v++) step[v] = -(x * jacobian[v] + y * jacobian[b + v] + z * jacobian[c + v]);
      else for (let v = 0; v < n; v++) step[v] -= x * jacobian[a + v] + y * jacobian[b + v] + z * jacobian[c + v];
    }
    return true;
  }
  for (let v = 0; v < n; v++) step[v] = 0;
  for (let r = 0; r < rows; r++) {
    const e = errors[r];
    const a = r * n;
    for (let v = 0; v < n; v++) step[v] -= e * jacobian[a + v];
  }
  substitute(factor, n, step);
  return true;
}

/** A + λI = L·Lᵀ, with 1/L on the diagonal of what is kept. */
function factorise(a: Float64Array, size: number, damping: number, l: Float64Array): boolean {
  for (let i = 0; i < size; i++) {
    const row = i * size;
    for (let k = 0; k <= i; k++) {
      const other = k * size;
      let sum = a[row + k];
      for (let m = 0; m < k; m++) sum -= l[row + m] * l[other + m];
      if (k < i) l[row + k] = sum * l[other + k];
      else {
        sum += damping;
        if (!(sum > 0 && sum < Infinity)) return false;
        l[row + i] = 1 / Math.sqrt(sum);
      }
    }
  }
  return true;
}

/** The same of three equations, one pin's: loops of three cost more than what is in them. */
function factorise3(a: Float64Array, damping: number, l: Float64Array): boolean {
  const xx = a[0] + damping;
  const x = 1 / Math.sqrt(xx);
  const yx = a[3] * x;
  const yy = a[4] + damping - yx * yx;
  const y = 1 / Math.sqrt(yy);
  const zx = a[6] * x;
  const zy = (a[7] - zx * yx) * y;
  const zz = a[8] + damping - zx * zx - zy * zy;
  if (!(xx > 0 && yy > 0 && zz > 0 && xx + yy + zz < Infinity)) return false;
  l[0] = x;
  l[3] = yx;
  l[4] = y;
  l[6] = zx;
  l[7] = zy;
  l[8] = 1 / Math.sqrt(zz);
  return true;
}

function substitute3(l: Float64Array, b: Float64Array): void {
  const x = b[0] * l[0];
  const y = (b[1] - l[3] * x) * l[4];
  const z = (b[2] - l[6] * x - l[7] * y) * l[8] * l[8];
  b[2] = z;
  b[1] = (y - l[7] * z) * l[4];
  b[0] = (x - l[3] * b[1] - l[6] * z) * l[0];
}

/** Solves L·Lᵀ·x = b in place. */
function substitute(l: Float64Array, size: number, b: Float64Array): void {
  for (let i = 0; i < size; i++) {
    let sum = b[i];
    for (let m = 0; m < i; m++) sum -= l[i * size + m] * b[m];
    b[i] = sum * l[i * size + i];
  }
  for (let i = size - 1; i >= 0; i--) {
    let sum = b[i];
    for (let m = i + 1; m < size; m++) sum -= l[m * size + i] * b[m];
    b[i] = sum * l[i * size + i];
  }
}
