/** Cases of the files of other courses and labs, which were computed separately. */
import { eachFrame } from '../../src/evaluate/bake.ts';
import { bareCharacter } from '../../src/evaluate/bare-character.ts';
import { compileSkeleton, worldMatrices } from '../../src/evaluate/kinematics.ts';
import type { Skeleton } from '../../src/model/skeleton/skeleton.ts';
import type { Take } from '../../src/model/takes/take.ts';
import { conformance } from './shared.ts';

export interface LabCase {
  readonly name: string;
  readonly kind: string;
  readonly files: readonly string[];
  readonly joints: readonly string[];
  readonly parents: readonly number[];
  readonly frames: number;
  readonly fps: number;
  readonly size: number;
  readonly tolerance?: number;
  readonly metres?: number;
  /** By frame: of each joint its position and its rotation, row by row. */
  readonly at: Readonly<Record<string, { readonly positions?: number[][]; readonly rotations?: number[][] }>>;
  readonly ends?: Readonly<Record<string, number[][]>>;
  readonly up?: string;
  readonly says?: readonly string[];
  readonly trans?: Readonly<Record<string, number[]>>;
  readonly mean_error?: number;
  readonly max_error?: number;
}

export interface MalformedCase {
  readonly file: string;
  readonly with: readonly string[];
  readonly word: string;
}

export function labCases(): { readonly cases: readonly LabCase[]; readonly malformed: readonly MalformedCase[] } {
  return conformance('lab.json');
}

/** World matrices of a take's joints, frame by frame. */
export function eachWorld(
  skeleton: Skeleton,
  take: Take,
  visit: (world: Float64Array, dofs: Float64Array, frame: number) => void,
): void {
  const { samples } = take;
  if (!samples) throw new Error('It has no samples.');
  const compiled = compileSkeleton(skeleton);
  const world = new Float64Array(16 * compiled.jointCount);
  eachFrame(bareCharacter(skeleton, take), samples, (dofs, frame) => {
    worldMatrices(compiled, dofs, world);
    visit(world, dofs, frame);
  });
}
