/**
 * What the words of glTF 2.0 make of a file's animations, in doubles: a program that reads them to the letter, and one
 * that interpolates the components of rotations one by one and normalises, as Blender and many engines do.
 */
import { type Glb, numbersOf, type Player } from './glb.ts';

/** How rotations are interpolated between linear keys. */
export type Arc = 'slerp' | 'components';

interface Curve {
  readonly node: number;
  readonly path: string;
  readonly interpolation: string;
  readonly times: Float64Array;
  readonly values: Float64Array;
  readonly width: number;
}

type Numbers = { -readonly [P in 'translation' | 'rotation' | 'scale']: Float64Array };

export function bySamplers(glb: Glb, arc: Arc): Player {
  const { nodes, animations = [], skins = [], scenes } = glb.json;
  const takes = animations.map(({ channels, samplers }) =>
    channels.map(({ sampler, target: { node, path } }): Curve => {
      const { input, output, interpolation } = samplers[sampler];
      const times = numbersOf(glb, input);
      const values = numbersOf(glb, output);
      const width = values.length / times.length / (interpolation === 'CUBICSPLINE' ? 3 : 1);
      return { node, path, interpolation, times, values, width };
    }),
  );
  const order: number[] = [];
  const parents = new Map(nodes.flatMap(({ children = [] }, n) => children.map((child) => [child, n] as const)));
  const pending = [...scenes[0].nodes];
  for (let next = pending.pop(); next !== undefined; next = pending.pop()) {
    order.push(next);
    pending.push(...(nodes[next].children ?? []));
  }
  const joints = skins[0]?.joints ?? [];
  const still = nodes.map(
    ({ translation = [0, 0, 0], rotation = [0, 0, 0, 1], scale = [1, 1, 1] }): Numbers => ({
      translation: Float64Array.from(translation),
      rotation: Float64Array.from(rotation),
      scale: Float64Array.from(scale),
    }),
  );
  return (take, seconds) => {
    const numbers = still.map((own) => ({ ...own }));
    let weights: readonly number[] = [];
    for (const curve of takes[take] ?? []) {
      const value = valueAt(curve, seconds, arc);
      if (curve.path === 'weights') weights = [...value];
      else if (curve.path === 'translation' || curve.path === 'rotation' || curve.path === 'scale') {
        numbers[curve.node][curve.path] = value;
      }
    }
    const worlds = new Float64Array(16 * nodes.length);
    for (const n of order) writeWorld(numbers[n], worlds, 16 * (parents.get(n) ?? -1), 16 * n);
    const matrices = new Float64Array(16 * joints.length);
    joints.forEach((node, j) => {
      matrices.set(worlds.subarray(16 * node, 16 * node + 16), 16 * j);
    });
    return { matrices, weights };
  };
}

function valueAt({ path, interpolation, times, values, width }: Curve, seconds: number, arc: Arc): Float64Array {
  const isSpline = interpolation === 'CUBICSPLINE';
  const stride = isSpline ? 3 * width : width;
  const key = (k: number) => values.slice(k * stride + (isSpline ? width : 0), k * stride + (isSpline ? 2 : 1) * width);
  const last = times.length - 1;
  let low = 0;
  let high = last;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= seconds) low = middle;
    else high = middle;
  }
  if (seconds <= times[0]) return key(0);
  if (seconds >= times[last]) return key(last);
  const a = key(low);
  const b = key(low + 1);
  const span = times[low + 1] - times[low];
  const u = (seconds - times[low]) / span;
  if (interpolation === 'STEP') return a;
  const isRotation = path === 'rotation';
  if (isSpline) {
    const out = new Float64Array(width);
    const c1 = u * u * (3 - 2 * u);
    for (let c = 0; c < width; c++) {
      const leaving = values[low * stride + 2 * width + c];
      const arriving = values[(low + 1) * stride + c];
      out[c] = (1 - c1) * a[c] + c1 * b[c] + span * (u * (1 - u) ** 2 * leaving - u * u * (1 - u) * arriving);
    }
    return isRotation ? unit(out) : out;
  }
  if (!isRotation) {
    for (let c = 0; c < width; c++) a[c] += u * (b[c] - a[c]);
    return a;
  }
  let dot = 0;
  for (let c = 0; c < width; c++) dot += a[c] * b[c];
  const sign = dot < 0 ? -1 : 1;
  const angle = arc === 'slerp' ? Math.acos(Math.min(1, Math.abs(dot))) : 0;
  const [s, t] = angle > 1e-6 ? [Math.sin((1 - u) * angle), Math.sin(u * angle)] : [1 - u, u];
  for (let c = 0; c < width; c++) a[c] = s * a[c] + t * sign * b[c];
  return unit(a);
}

/** The same one, normalised. */
function unit(q: Float64Array): Float64Array {
  let squares = 0;
  for (const v of q) squares += v * v;
  const length = Math.sqrt(squares);
  for (let c = 0; c < q.length; c++) q[c] /= length;
  return q;
}

const local = new Float64Array(12);

/** Writes the world matrix of a node at `to`, below that at `above`; a negative one is no parent. */
function writeWorld({ translation: t, rotation, scale }: Numbers, out: Float64Array, above: number, to: number): void {
  const [x, y, z, w] = rotation;
  const [sx, sy, sz] = scale;
  local[0] = (1 - 2 * (y * y + z * z)) * sx;
  local[1] = 2 * (x * y + w * z) * sx;
  local[2] = 2 * (x * z - w * y) * sx;
  local[3] = 2 * (x * y - w * z) * sy;
  local[4] = (1 - 2 * (x * x + z * z)) * sy;
  local[5] = 2 * (y * z + w * x) * sy;
  local[6] = 2 * (x * z + w * y) * sz;
  local[7] = 2 * (y * z - w * x) * sz;
  local[8] = (1 - 2 * (x * x + y * y)) * sz;
  local.set(t, 9);
  for (let c = 0; c < 4; c++) {
    const l = 3 * c;
    for (let r = 0; r < 3; r++) {
      const a = above + r;
      const own = above < 0 ? local[l + r] : out[a] * local[l] + out[a + 4] * local[l + 1] + out[a + 8] * local[l + 2];
      out[to + 4 * c + r] = c === 3 && above >= 0 ? own + out[a + 12] : own;
    }
  }
  out[to + 15] = 1;
}
