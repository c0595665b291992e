/**
 * The baseline for frames of motion captures: a loop over typed arrays without checks or look-ups. For each joint it
 * computes the quaternions of the two frames around a time, slerps, writes the rotation matrix and multiplies it by the
 * parent's. Or it interpolates angles linearly, which is wrong, but the minimum.
 */

export interface BareCrowd {
  readonly parent: ArrayLike<number>;
  /** x y z per joint; the root's is replaced by its position channels. */
  readonly offsets: ArrayLike<number>;
  readonly frameSeconds: number;
  /** Rows of each character: x y z of the root, then degrees about z, x and y of each joint. */
  readonly values: readonly Float64Array[];
}

/**
 * The loop over all characters at a time. Refers to nothing outside itself, so that it can be passed to a page as text.
 *
 * @param way of interpolating between frames
 */
export function bareCrowd(
  { parent, offsets, frameSeconds, values }: BareCrowd,
  way: 'slerp' | 'mixed angles',
): (time: number) => void {
  const jointCount = parent.length;
  const width = 3 + 3 * jointCount;
  const perDegree = Math.PI / 180;
  /** As in the page: all matrices of all characters. */
  const a = new Float64Array(16 * jointCount * values.length);
  const local = new Float64Array(16);
  const from = new Float64Array(4);
  const to = new Float64Array(4);
  local[15] = 1;
  const turn = way === 'slerp' ? slerp : mix;

  return (time) => {
    for (let i = 0; i < values.length; i++) character(i, time);
  };

  function character(i: number, time: number): void {
    const v = values[i];
    const f = time / frameSeconds;
    const row = Math.floor(f);
    const u = f - row;
    const at = row * width;
    const base = 16 * jointCount * i;
    for (let j = 0; j < jointCount; j++) {
      turn(v, at + 3 + 3 * j, u);
      for (let k = 0; k < 3; k++) {
        local[12 + k] = j === 0 ? v[at + k] + (v[at + width + k] - v[at + k]) * u : offsets[3 * j + k];
      }
      if (j === 0) a.set(local, base);
      else product(base + 16 * parent[j], base + 16 * j);
    }
  }

  /** Rz·Rx·Ry of degrees, as a quaternion x y z w. */
  function quaternion(v: Float64Array, at: number, out: Float64Array): void {
    const half = perDegree / 2;
    const sz = Math.sin(v[at] * half);
    const cz = Math.cos(v[at] * half);
    const sx = Math.sin(v[at + 1] * half);
    const cx = Math.cos(v[at + 1] * half);
    const sy = Math.sin(v[at + 2] * half);
    const cy = Math.cos(v[at + 2] * half);
    out[0] = cz * sx * cy - sz * cx * sy;
    out[1] = cz * cx * sy + sz * sx * cy;
    out[2] = sz * cx * cy + cz * sx * sy;
    out[3] = cz * cx * cy - sz * sx * sy;
  }

  function slerp(v: Float64Array, at: number, u: number): void {
    quaternion(v, at, from);
    quaternion(v, at + width, to);
    let cosine = from[0] * to[0] + from[1] * to[1] + from[2] * to[2] + from[3] * to[3];
    const sign = cosine < 0 ? -1 : 1;
    cosine *= sign;
    const theta = Math.acos(Math.min(1, cosine));
    const sine = Math.sin(theta);
    const p = sine > 1e-9 ? Math.sin((1 - u) * theta) / sine : 1 - u;
    const q = sign * (sine > 1e-9 ? Math.sin(u * theta) / sine : u);
    const x = p * from[0] + q * to[0];
    const y = p * from[1] + q * to[1];
    const z = p * from[2] + q * to[2];
    const w = p * from[3] + q * to[3];
    local[0] = 1 - 2 * (y * y + z * z);
    local[1] = 2 * (x * y + w * z);
    local[2] = 2 * (x * z - w * y);
    local[4] = 2 * (x * y - w * z);
    local[5] = 1 - 2 * (x * x + z * z);
    local[6] = 2 * (y * z + w * x);
    local[8] = 2 * (x * z + w * y);
    local[9] = 2 * (y * z - w * x);
    local[10] = 1 - 2 * (x * x + y * y);
  }

  function mix(v: Float64Array, at: number, u: number): void {
    const z = (v[at] + (v[at + width] - v[at]) * u) * perDegree;
    const x = (v[at + 1] + (v[at + width + 1] - v[at + 1]) * u) * perDegree;
    const y = (v[at + 2] + (v[at + width + 2] - v[at + 2]) * u) * perDegree;
    const sz = Math.sin(z);
    const cz = Math.cos(z);
    const sx = Math.sin(x);
    const cx = Math.cos(x);
    const sy = Math.sin(y);
    const cy = Math.cos(y);
    local[0] = cz * cy - sz * sx * sy;
    local[1] = sz * cy + cz * sx * sy;
    local[2] = -cx * sy;
    local[4] = -sz * cx;
    local[5] = cz * cx;
    local[6] = sx;
    local[8] = cz * sy + sz * sx * cy;
    local[9] = sz * sy - cz * sx * cy;
    local[10] = cx * cy;
  }

  function product(p: number, o: number): void {
    for (let c = 0; c < 4; c++) {
      for (let r = 0; r < 3; r++) {
        a[o + 4 * c + r] = a[p + r] * local[4 * c] + a[p + 4 + r] * local[4 * c + 1] + a[p + 8 + r] * local[4 * c + 2];
      }
      a[o + 4 * c + 3] = c === 3 ? 1 : 0;
    }
    a[o + 12] += a[p + 12];
    a[o + 13] += a[p + 13];
    a[o + 14] += a[p + 14];
  }
}
