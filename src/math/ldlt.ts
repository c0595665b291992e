/**
 * Symmetric linear systems in 3×3 blocks, by LDLᵀ: a Cholesky factorisation without square roots, which would take as
 * long as the rest.
 */

/**
 * A + λI = L·D·Lᵀ.
 * @param a only its lower triangle is read
 * @param size a multiple of 3
 * @param l L below the diagonal, 1/D on it
 * @returns false if the matrix is not positive definite or numbers overflow
 */
export function factorise(a: Float64Array, size: number, damping: number, l: Float64Array): boolean {
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

/** Solves L·D·Lᵀ·x = b in place. @param l from `factorise` */
export function substitute(l: Float64Array, size: number, b: Float64Array): void {
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
