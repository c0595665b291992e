/** A character's library of poses: named, in the order in which they were kept. */

export interface NamedPose {
  /** Unique in its character. */
  readonly name: string;
  /** One value for each of the character's DOFs (see `dofs.ts`), as set; what has no place in it is at rest. */
  readonly values: readonly number[];
}
