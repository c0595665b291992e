/**
 * What covers what, from solid shapes instead of pixels: nothing is read back from the GPU, and a frame costs a bounded
 * number of intersections. Skins are an ellipsoid per joint (`evaluate/shapes/skin-parts.ts`), boxes are themselves.
 *
 *     shape   M · u + c       u in the unit ball, or in the cube −1 … 1
 *     ray     eye + t · (p − eye); t = 1 at the point p
 *
 * A point of shape A is covered if the ray enters another shape before it enters A: a joint is always inside its own
 * skin, so that only other parts can be in front of it. Allocates nothing once it has grown.
 */

/** Numbers per shape: c, the rows of M⁻¹, the radius around c. */
const STRIDE = 13;
/** Intersections per frame; what is asked after that counts as uncovered. */
const BUDGET = 100_000;
/** Shapes that touch don't cover each other: `t` has to be smaller by this part of the way through the own shape. */
const TOUCH = 0.25;

export class Cover {
  private values = new Float64Array(0);
  private isBox = new Uint8Array(0);
  private count = 0;
  private left = 0;
  /** Towards the eye for an orthographic camera (w = 0), else the eye (w = 1). */
  private readonly eye = new Float64Array(4);

  /** Removes all shapes. @param x y z of the eye, or the direction to it if `w` is 0 */
  begin(x: number, y: number, z: number, w: 0 | 1): void {
    this.count = 0;
    this.left = BUDGET;
    const { eye } = this;
    eye[0] = x;
    eye[1] = y;
    eye[2] = z;
    eye[3] = w;
  }

  get isEmpty(): boolean {
    return this.count === 0;
  }

  /**
   * Returns the shape's index; −1 if it has no extent.
   *
   * @param m columns of M at `m[o] …`, 4 apart; its fourth column is c
   */
  add(m: ArrayLike<number>, o: number, isBox: boolean): number {
    const det =
      m[o] * (m[o + 5] * m[o + 10] - m[o + 9] * m[o + 6]) -
      m[o + 4] * (m[o + 1] * m[o + 10] - m[o + 9] * m[o + 2]) +
      m[o + 8] * (m[o + 1] * m[o + 6] - m[o + 5] * m[o + 2]);
    if (!(Math.abs(det) > 0) || !Number.isFinite(det)) return -1;
    this.grow();
    const index = this.count++;
    const { values } = this;
    const s = STRIDE * index;
    values[s] = m[o + 12];
    values[s + 1] = m[o + 13];
    values[s + 2] = m[o + 14];
    values[s + 3] = (m[o + 5] * m[o + 10] - m[o + 9] * m[o + 6]) / det;
    values[s + 4] = (m[o + 8] * m[o + 6] - m[o + 4] * m[o + 10]) / det;
    values[s + 5] = (m[o + 4] * m[o + 9] - m[o + 8] * m[o + 5]) / det;
    values[s + 6] = (m[o + 9] * m[o + 2] - m[o + 1] * m[o + 10]) / det;
    values[s + 7] = (m[o] * m[o + 10] - m[o + 8] * m[o + 2]) / det;
    values[s + 8] = (m[o + 8] * m[o + 1] - m[o] * m[o + 9]) / det;
    values[s + 9] = (m[o + 1] * m[o + 6] - m[o + 5] * m[o + 2]) / det;
    values[s + 10] = (m[o + 4] * m[o + 2] - m[o] * m[o + 6]) / det;
    values[s + 11] = (m[o] * m[o + 5] - m[o + 4] * m[o + 1]) / det;
    // An upper bound, also for shear: all columns of M in one direction.
    let radius = 0;
    for (let c = o; c < o + 12; c += 4) radius += Math.sqrt(m[c] * m[c] + m[c + 1] * m[c + 1] + m[c + 2] * m[c + 2]);
    values[s + 12] = radius;
    this.isBox[index] = isBox ? 1 : 0;
    return index;
  }

  /** Whether the middle of a shape is covered by another one. */
  coversMiddle(own: number): boolean {
    const s = STRIDE * own;
    const { values } = this;
    return this.covers(own, values[s], values[s + 1], values[s + 2]);
  }

  /** Whether a point of a shape is covered by another one. @param own −1 for a point outside of all shapes */
  covers(own: number, x: number, y: number, z: number): boolean {
    const { eye } = this;
    // An orthographic camera looks from beyond everything.
    const far = eye[3] === 0 ? this.reach(x, y, z) : 1;
    const ox = far * eye[0] + (1 - eye[3]) * x;
    const oy = far * eye[1] + (1 - eye[3]) * y;
    const oz = far * eye[2] + (1 - eye[3]) * z;
    const dx = x - ox;
    const dy = y - oy;
    const dz = z - oz;
    const length2 = dx * dx + dy * dy + dz * dz;
    let first = 1;
    if (own >= 0) {
      const entry = this.entry(own, ox, oy, oz, dx, dy, dz);
      first = entry < 1 ? entry - TOUCH * (1 - entry) : 1;
    }
    const { values, count } = this;
    if (this.left < count) return false;
    this.left -= count;
    for (let i = 0; i < count; i++) {
      if (i === own) continue;
      const s = STRIDE * i;
      const cx = values[s] - ox;
      const cy = values[s + 1] - oy;
      const cz = values[s + 2] - oz;
      const along = (cx * dx + cy * dy + cz * dz) / length2;
      const away2 = cx * cx + cy * cy + cz * cz - along * along * length2;
      const radius = values[s + 12];
      if (away2 > radius * radius || (along - first) * Math.sqrt(length2) > radius) continue;
      if (this.entry(i, ox, oy, oz, dx, dy, dz) < first) return true;
    }
    return false;
  }

  /** A distance beyond all shapes. */
  private reach(x: number, y: number, z: number): number {
    let most = 1;
    for (let i = 0; i < this.count; i++) {
      const s = STRIDE * i;
      const { values } = this;
      const far = Math.abs(values[s] - x) + Math.abs(values[s + 1] - y) + Math.abs(values[s + 2] - z) + values[s + 12];
      if (far > most) most = far;
    }
    return most;
  }

  /** `t` where the ray enters a shape in front of the eye; Infinity if it doesn't. */
  private entry(i: number, ox: number, oy: number, oz: number, dx: number, dy: number, dz: number): number {
    const { values } = this;
    const s = STRIDE * i;
    const px = ox - values[s];
    const py = oy - values[s + 1];
    const pz = oz - values[s + 2];
    const ax = values[s + 3] * px + values[s + 4] * py + values[s + 5] * pz;
    const ay = values[s + 6] * px + values[s + 7] * py + values[s + 8] * pz;
    const az = values[s + 9] * px + values[s + 10] * py + values[s + 11] * pz;
    const bx = values[s + 3] * dx + values[s + 4] * dy + values[s + 5] * dz;
    const by = values[s + 6] * dx + values[s + 7] * dy + values[s + 8] * dz;
    const bz = values[s + 9] * dx + values[s + 10] * dy + values[s + 11] * dz;
    return this.isBox[i] === 1 ? enterCube(ax, ay, az, bx, by, bz) : enterBall(ax, ay, az, bx, by, bz);
  }

  private grow(): void {
    if (this.count < this.isBox.length) return;
    const length = Math.max(64, 2 * this.count);
    const [values, isBox] = [this.values, this.isBox];
    this.values = new Float64Array(STRIDE * length);
    this.isBox = new Uint8Array(length);
    this.values.set(values);
    this.isBox.set(isBox);
  }
}

/** |a + t·b| = 1 at the smaller t, if that is in front. */
function enterBall(ax: number, ay: number, az: number, bx: number, by: number, bz: number): number {
  const bb = bx * bx + by * by + bz * bz;
  const ab = ax * bx + ay * by + az * bz;
  const root = ab * ab - bb * (ax * ax + ay * ay + az * az - 1);
  if (!(root >= 0) || bb === 0) return Infinity;
  const t = (-ab - Math.sqrt(root)) / bb;
  return t > 0 ? t : Infinity;
}

function enterCube(ax: number, ay: number, az: number, bx: number, by: number, bz: number): number {
  let near = -Infinity;
  let far = Infinity;
  for (let k = 0; k < 3; k++) {
    const a = k === 0 ? ax : k === 1 ? ay : az;
    const b = k === 0 ? bx : k === 1 ? by : bz;
    if (b === 0) {
      if (Math.abs(a) > 1) return Infinity;
      continue;
    }
    const one = (-1 - a) / b;
    const other = (1 - a) / b;
    near = Math.max(near, Math.min(one, other));
    far = Math.min(far, Math.max(one, other));
  }
  return near <= far && near > 0 ? near : Infinity;
}
