/** A character's pose library: named poses, in the order in which they were saved. */

export interface NamedPose {
  /** Unique in its character. */
  readonly name: string;
  /** One value per DOF of the character (see `dofs.ts`), as set; missing values are at rest. */
  readonly values: readonly number[];
}
