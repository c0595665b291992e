/** A character's pose library: named poses, in the order in which they were saved. */
import type { Morph } from './morph.ts';
import type { Skeleton } from './skeleton/skeleton.ts';

/** An entry of the pose library. */
export interface NamedPose {
  /** Unique in its character. */
  readonly name: string;
  /** One value per DOF of the character (see `dofs.ts`), as set; missing values are at rest. */
  readonly values: readonly number[];
}

/** The library as a part of a character, with the joint and morph names it refers to. */
export interface PoseLibrary {
  readonly skeleton?: Skeleton;
  readonly morphs: readonly Morph[];
  readonly poses: readonly NamedPose[];
}
