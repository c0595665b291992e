/** The shape of bones that start at one joint: they turn as one, so that it is where they are on average. */
import { backTurnVector, copy3, setIdentity3, turnVector } from '../../math/mat3.ts';
import { nearestRotation } from './nearest-rotation.ts';
import type { JointFrameSet } from './point-paths.ts';

/** Frames that a shape is the mean of. */
const MAX_FRAMES = 512;
const MAX_ROUNDS = 30;
/** How much a shape changes, by its size, when it is found. */
const STEADY = 1e-10;

/**
 * The mean of the frames turned onto each other (generalised Procrustes analysis, without scale), as it is in the first
 * frame: x y z of each child from the joint.
 * @param jointCount of the frames
 */
export function restShape(
  frames: JointFrameSet,
  jointCount: number,
  joint: number,
  children: readonly number[],
): Float64Array {
  const count = Math.min(frames.count, MAX_FRAMES);
  const width = 3 * children.length;
  const vectors = new Float64Array(count * width);
  for (let i = 0; i < count; i++) {
    const from = 3 * jointCount * Math.floor((i * frames.count) / count);
    children.forEach((child, c) => {
      for (let k = 0; k < 3; k++) {
        vectors[i * width + 3 * c + k] =
          frames.positions[from + 3 * child + k] - frames.positions[from + 3 * joint + k];
      }
    });
  }
  // One bone has a direction, and turns to any other.
  if (children.length === 1) return firstDirection(vectors);
  let shape = vectors.slice(0, width);
  const rotations = Array.from({ length: count }, () => {
    const rotation = new Float64Array(9);
    setIdentity3(rotation);
    return rotation;
  });
  const turned = new Float64Array(3);
  for (let round = 0; round < MAX_ROUNDS; round++) {
    const mean = new Float64Array(width);
    for (let i = 0; i < count; i++) {
      turnOnto(shape, vectors, i * width, rotations[i]);
      for (let c = 0; c < width; c += 3) {
        backTurnVector(rotations[i], 0, vectors, i * width + c, turned, 0);
        for (let k = 0; k < 3; k++) mean[c + k] += turned[k] / count;
      }
    }
    const size = mean.reduce((most, v) => Math.max(most, Math.abs(v)), 0);
    const change = mean.reduce((most, v, k) => Math.max(most, Math.abs(v - shape[k])), 0);
    shape = mean;
    if (change <= STEADY * size) break;
  }
  turnOnto(shape, vectors, 0, rotations[0]);
  for (let c = 0; c < width; c += 3) turnVector(rotations[0], 0, shape, c, shape, c);
  return shape;
}

/** The rotation that takes a shape to its vectors in a frame best, from a near one. */
function turnOnto(shape: Float64Array, vectors: Float64Array, from: number, rotation: Float64Array): void {
  products.fill(0);
  for (let c = 0; c < shape.length; c += 3) addProduct(vectors, from + c, shape, c, products);
  copy3(rotation, 0, before, 0);
  nearestRotation(products, rotation, before);
}

/** The first of some vectors that is not 0; else 0. */
function firstDirection(vectors: Float64Array): Float64Array {
  for (let at = 0; at < vectors.length; at += 3) {
    if (vectors[at] || vectors[at + 1] || vectors[at + 2]) return vectors.slice(at, at + 3);
  }
  return new Float64Array(3);
}

/** Adds b·aᵀ to 9 numbers, column-major. */
export function addProduct(b: Float64Array, bo: number, a: Float64Array, ao: number, out: Float64Array): void {
  const x = b[bo];
  const y = b[bo + 1];
  const z = b[bo + 2];
  const u = a[ao];
  const v = a[ao + 1];
  const w = a[ao + 2];
  out[0] += x * u;
  out[1] += y * u;
  out[2] += z * u;
  out[3] += x * v;
  out[4] += y * v;
  out[5] += z * v;
  out[6] += x * w;
  out[7] += y * w;
  out[8] += z * w;
}

/** Scratch; never escapes. */
const products = new Float64Array(9);
const before = new Float64Array(9);
