/**
 * A skeleton as three.js's bones. A bone is its joint by index, so names may repeat and be empty.
 *
 * Bones stand in their true hierarchy, but their matrices are ours, in doubles: `matrix` (in the parent) and
 * `matrixWorld` (in the character's space, before any placement) are windows on two arrays that are filled each frame,
 * and three.js is kept from walking them. 100 characters of 25 joints would otherwise be 2,500 calls and products a
 * frame, for values that are known already.
 */
import { Bone, type Matrix4 } from 'three';
import { type CompiledSkeleton, compileSkeleton, localMatrices } from '../evaluate/kinematics.ts';
import { multiplyAffine, setIdentity } from '../math/mat4.ts';
import { hasBox } from '../model/boxes.ts';
import type { Box, Skeleton } from '../model/skeleton.ts';

const NO_BOX: Box = { min: [0, 0, 0], max: [0, 0, 0] };

/** A bone that is given both of its matrices. */
class PosedBone extends Bone {
  override matrixAutoUpdate = false;
  override matrixWorldAutoUpdate = false;

  override updateMatrixWorld(): void {}

  override updateWorldMatrix(): void {}
}

export class Bones {
  readonly bones: readonly Bone[];
  readonly compiled: CompiledSkeleton;
  /** 16 numbers a joint, column-major: in the parent's space. */
  readonly local: Float64Array;
  /** In the character's space. */
  readonly world: Float64Array;

  constructor(private readonly skeleton: Skeleton) {
    const compiled = compileSkeleton(skeleton);
    this.compiled = compiled;
    this.local = new Float64Array(16 * compiled.jointCount);
    this.world = new Float64Array(16 * compiled.jointCount);
    const bones: Bone[] = [];
    skeleton.joints.forEach((joint, j) => {
      const bone = new PosedBone();
      bone.name = joint.name;
      setIdentity(this.local, 16 * j);
      setIdentity(this.world, 16 * j);
      window(bone.matrix, this.local, j);
      window(bone.matrixWorld, this.world, j);
      bones.push(bone);
      bones[joint.parent]?.add(bone);
    });
    this.bones = bones;
  }

  get root(): Bone | undefined {
    return this.bones[0];
  }

  /** The box around all joints, their boxes and End Sites, as posed: least x y z and greatest x y z, in the character's space. */
  bounds(out: Float64Array): void {
    const { joints } = this.skeleton;
    const { world } = this;
    out.fill(Infinity, 0, 3);
    out.fill(-Infinity, 3, 6);
    for (let j = 0; j < joints.length; j++) {
      const joint = joints[j];
      const { min, max } = hasBox(joint) ? joint.box : NO_BOX;
      for (let r = 0; r < 3; r++) {
        const m = 16 * j + r;
        const origin = world[m + 12];
        let centre = origin;
        let half = 0;
        for (let c = 0; c < 3; c++) {
          centre += (world[m + 4 * c] * (min[c] + max[c])) / 2;
          // Boxes with min > max are drawn all the same.
          half += Math.abs((world[m + 4 * c] * (max[c] - min[c])) / 2);
        }
        out[r] = Math.min(out[r], origin, centre - half);
        out[r + 3] = Math.max(out[r + 3], origin, centre + half);
      }
      const { endSites } = joint;
      if (!endSites) continue;
      for (let e = 0; e < endSites.length; e++) {
        const end = endSites[e];
        for (let r = 0; r < 3; r++) {
          const m = 16 * j + r;
          const at = world[m] * end[0] + world[m + 4] * end[1] + world[m + 8] * end[2] + world[m + 12];
          out[r] = Math.min(out[r], at);
          out[r + 3] = Math.max(out[r + 3], at);
        }
      }
    }
  }

  /** Poses the bones: both arrays, and with them every bone's matrices. */
  pose(dofs: Float64Array): void {
    const { compiled, local, world } = this;
    localMatrices(compiled, dofs, local);
    for (let j = 0; j < compiled.jointCount; j++) {
      const parent = compiled.parent[j];
      if (parent < 0) for (let i = 0; i < 16; i++) world[16 * j + i] = local[16 * j + i];
      else multiplyAffine(world, 16 * parent, local, 16 * j, world, 16 * j);
    }
  }
}

/** Makes a matrix's elements those of joint `j` in `all`. */
function window(matrix: Matrix4, all: Float64Array, j: number): void {
  // three.js types elements as a tuple, but only ever indexes them.
  matrix.elements = all.subarray(16 * j, 16 * j + 16) as unknown as Matrix4['elements'];
}
