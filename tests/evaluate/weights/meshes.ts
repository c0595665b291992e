/** Small meshes whose weights can be foretold. */
import type { BoneSegments } from '../../../src/evaluate/weights/bones.ts';
import type { HeatWeights } from '../../../src/evaluate/weights/heat-weights.ts';
import type { Vec3 } from '../../../src/math/vec3.ts';
import type { Attachments } from '../../../src/model/skin.ts';

export interface Mesh {
  readonly positions: Float64Array;
  readonly triangles: Uint32Array;
}

export interface TubePlan {
  readonly around: number;
  readonly along: number;
  readonly radius: number;
  readonly length: number;
  /** Of the axis; the tube runs up from y 0. */
  readonly at?: readonly [x: number, z: number];
}

/** A closed tube along y: rings from y 0 to its length, and a point in the middle of each end. */
export function tube({ around, along, radius, length, at = [0, 0] }: TubePlan): Mesh {
  const positions: number[] = [];
  const triangles: number[] = [];
  for (let ring = 0; ring <= along; ring++) {
    for (let k = 0; k < around; k++) {
      const a = (2 * Math.PI * k) / around;
      positions.push(at[0] + radius * Math.cos(a), (length * ring) / along, at[1] + radius * Math.sin(a));
    }
  }
  const [bottom, top] = [around * (along + 1), around * (along + 1) + 1];
  positions.push(at[0], 0, at[1], at[0], length, at[1]);
  for (let k = 0; k < around; k++) {
    const next = (k + 1) % around;
    for (let ring = 0; ring < along; ring++) {
      const [a, b] = [ring * around + k, ring * around + next];
      triangles.push(a, a + around, b + around, a, b + around, b);
    }
    triangles.push(bottom, k, next, top, along * around + next, along * around + k);
  }
  return { positions: Float64Array.from(positions), triangles: Uint32Array.from(triangles) };
}

export function together(...meshes: readonly Mesh[]): Mesh {
  const positions: number[] = [];
  const triangles: number[] = [];
  for (const mesh of meshes) {
    const first = positions.length / 3;
    positions.push(...mesh.positions);
    triangles.push(...[...mesh.triangles].map((v) => first + v));
  }
  return { positions: Float64Array.from(positions), triangles: Uint32Array.from(triangles) };
}

/** One bone a joint. */
export function bonesFrom(...bones: readonly (readonly [from: Vec3, to: Vec3])[]): BoneSegments {
  return { joints: Uint32Array.from(bones.keys()), ends: Float64Array.from(bones.flat(2)) };
}

/** Bones one after another up the y axis. */
export function chain(...heights: readonly number[]): BoneSegments {
  return bonesFrom(
    ...heights.slice(1).map(
      (to, i) =>
        [
          [0, heights[i], 0],
          [0, to, 0],
        ] as const,
    ),
  );
}

export function finish<T>(steps: Generator<number, T>): T {
  let step = steps.next();
  while (!step.done) step = steps.next();
  return step.value;
}

export function weightOf({ start, joints, weights }: Attachments, vertex: number, joint: number): number {
  let sum = 0;
  for (let a = start[vertex]; a < start[vertex + 1]; a++) if (joints[a] === joint) sum += weights[a];
  return sum;
}

export type Weighing = (mesh: Mesh, bones: BoneSegments, most: number) => Generator<number, HeatWeights>;
