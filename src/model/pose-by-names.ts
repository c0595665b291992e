/** A pose by the names of joints and DOFs: in files, and when passed between characters. */
import type { Vec3 } from '../math/vec3.ts';

export interface PoseByNames {
  readonly name: string;
  /** Root translation, apart from the root joint's own DOFs; absent if those include its translation. */
  readonly root?: Vec3 | undefined;
  /** In the order of its skeleton; names may repeat or be empty. */
  readonly joints: readonly PosedJoint[];
  /** Morph weights. */
  readonly weights: readonly NamedValue[];
}

export interface PosedJoint {
  readonly name: string;
  readonly dofs: readonly NamedValue[];
}

export interface NamedValue {
  readonly name: string;
  /** In radians, lengths and factors as in `.skel`. */
  readonly value: number;
}
