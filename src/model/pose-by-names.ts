/** A pose by the names of joints and DOFs: in files, and when passed between characters. */
import type { Vec3 } from '../math/vec3.ts';

/** A pose that doesn't depend on a skeleton's indices, so that it fits any character with the same names. */
export interface PoseByNames {
  readonly name: string;
  /** Root translation, apart from the root joint's own DOFs; absent if those include its translation. */
  readonly root?: Vec3;
  /** In the order of its skeleton; names may repeat or be empty. */
  readonly joints: readonly PosedJoint[];
  /** Morph weights. */
  readonly weights: readonly NamedValue[];
}

/** One joint of a pose, with the DOFs that the pose gives. */
export interface PosedJoint {
  readonly name: string;
  readonly dofs: readonly NamedValue[];
}

/** The value of a DOF or morph target, by its name. */
export interface NamedValue {
  readonly name: string;
  /** In radians, lengths and factors as in `.skel`. */
  readonly value: number;
}
