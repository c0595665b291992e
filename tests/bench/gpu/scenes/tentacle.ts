/**
 * A tentacle: a tube on a chain of joints, with morphs that widen it. It is made as numbers, for files of the page and
 * for three.js alike, so that both draw the same.
 */

export const JOINTS = 30;
export const MORPHS = 3;
export const INFLUENCES = 4;
/** Of its animation, which repeats. */
export const SECONDS = 4;
export const KEYS = 12;
export const JOINT_LENGTH = 0.1;
const HEIGHT = JOINTS * JOINT_LENGTH;
const RADIUS = 0.2;
const WIDER_RADIUS = 0.24;
const MAX_AROUND = 500;
/** Each morph moves one of so many vertices. */
const MORPH_STEP = 10;

export interface Tentacle {
  /** x y z per vertex, and so are the normals. */
  readonly positions: Float32Array;
  readonly normals: Float32Array;
  /** `INFLUENCES` per vertex. */
  readonly joints: Uint16Array;
  readonly weights: Float32Array;
  /** Three vertices per triangle. */
  readonly triangles: Uint32Array;
  readonly morphs: readonly TentacleMorph[];
}

export interface TentacleMorph {
  readonly vertices: Uint32Array;
  /** x y z for each of them. */
  readonly positions: Float32Array;
}

/** @param vertices a multiple of those around it, which are 500 or, of smaller ones, 20 */
export function tentacle(vertices: number): Tentacle {
  const around = vertices < 100 * MAX_AROUND ? 20 : MAX_AROUND;
  const along = Math.floor(vertices / around);
  const count = around * along;
  const positions = new Float32Array(3 * count);
  const normals = new Float32Array(3 * count);
  const joints = new Uint16Array(INFLUENCES * count);
  const weights = new Float32Array(INFLUENCES * count);
  const angleOf = (v: number) => (2 * Math.PI * (v % around)) / around;
  const heightOf = (v: number) => Math.floor(v / around) / along;
  const putPoint = (out: Float32Array, at: number, v: number, radius: number) =>
    out.set([radius * Math.cos(angleOf(v)), heightOf(v) * HEIGHT, radius * Math.sin(angleOf(v))], 3 * at);
  for (let v = 0; v < count; v++) {
    putPoint(positions, v, v, RADIUS);
    normals.set([Math.cos(angleOf(v)), 0, Math.sin(angleOf(v))], 3 * v);
    const place = heightOf(v) * (JOINTS - 1);
    const joint = Math.floor(place);
    const part = place - joint;
    const first = Math.min(Math.max(joint - 1, 0), JOINTS - INFLUENCES);
    for (let i = 0; i < INFLUENCES; i++) {
      const by = first + i - joint;
      joints[INFLUENCES * v + i] = first + i;
      weights[INFLUENCES * v + i] = by === 0 ? 0.8 * (1 - part) : by === 1 ? 0.8 * part : 0.1;
    }
  }
  const morphs = Array.from({ length: MORPHS }, (_, m) => {
    const moved = Uint32Array.from({ length: Math.floor(count / MORPH_STEP) }, (_, i) => i * MORPH_STEP + m);
    const to = new Float32Array(3 * moved.length);
    moved.forEach((v, i) => {
      putPoint(to, i, v, WIDER_RADIUS);
    });
    return { vertices: moved, positions: to };
  });
  return { positions, normals, joints, weights, triangles: trianglesOf(around, along), morphs };
}

function trianglesOf(around: number, along: number): Uint32Array {
  const triangles = new Uint32Array(6 * around * (along - 1));
  let at = 0;
  for (let row = 0; row < along - 1; row++) {
    for (let i = 0; i < around; i++) {
      const a = row * around + i;
      const b = row * around + ((i + 1) % around);
      triangles.set([a, a + around, b, b, a + around, b + around], at);
      at += 6;
    }
  }
  return triangles;
}

/** Seconds of a key. */
export const timeOf = (key: number) => (SECONDS * key) / (KEYS - 1);

/** The angle of a joint about an axis (0 to 2) at a key. */
export const angleOf = (joint: number, axis: number, key: number) =>
  0.15 * Math.sin((axis + 1) * joint + (2 * Math.PI * timeOf(key)) / SECONDS);

/** The weight of a morph at a key. */
export const weightOf = (morph: number, key: number) =>
  0.5 + 0.5 * Math.sin(morph + (2 * Math.PI * timeOf(key)) / SECONDS);
