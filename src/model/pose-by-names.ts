/** A pose by the names of joints and DOFs: in files, and on its way from one character to another. */
import type { Vec3 } from '../math/vec3.ts';

export interface PoseByNames {
  readonly name: string;
  /** The root's translation beside its joint's own DOFs; absent where the root moves by itself. */
  readonly root?: Vec3 | undefined;
  /** In the order of the skeleton that it is of; names may repeat and be empty. */
  readonly joints: readonly PosedJoint[];
  /** Of morphs. */
  readonly weights: readonly NamedValue[];
}

export interface PosedJoint {
  readonly name: string;
  readonly dofs: readonly NamedValue[];
}

export interface NamedValue {
  readonly name: string;
  /** Radians, lengths and factors as in `.skel`. */
  readonly value: number;
}
