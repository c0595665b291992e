/**
 * A skeleton as three.js's bones. A bone is its joint by index, so names may repeat and be empty.
 *
 * Bones form the real hierarchy, but their matrices are ours, in doubles: `matrix` (in the parent) and `matrixWorld`
 * (in the character's space, before any placement) are views of two arrays, and three.js doesn't update them. 100
 * characters of 25 joints would otherwise cost 2,500 calls and products per frame for values that are already known.
 * The matrices in the character's space are filled each frame; those in the parent only when read, which drawing never
 * does.
 */
import { Bone, type Matrix4 } from 'three';
import { endsAt, hasStretches } from '../../evaluate/end-sites.ts';
import { type CompiledSkeleton, compileSkeleton, localMatrices, worldMatrices } from '../../evaluate/kinematics.ts';
import type { PoseRotations } from '../../evaluate/rotations/pose-rotations.ts';
import { setIdentity } from '../../math/mat4.ts';
import type { Vec3 } from '../../math/vec3.ts';
import { areBoxesOversized, hasBox } from '../../model/skeleton/boxes.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';

/**
 * Extents around joints: boxes, and bone ends as boxes of size 0, which come first. Centres are in the joint's space.
 */
interface Reaches {
  readonly joints: Int32Array;
  /** How many of them are bone ends. */
  readonly endCount: number;
  /** x y z each. */
  readonly centres: Float64Array;
  /** Half of each side, x y z. */
  readonly halves: Float64Array;
  /** Where DOFs move bone ends: joints and centres of these, in no pose. */
  readonly ends?: { readonly owners: Int32Array; readonly at: Float64Array };
}

function reachesOf(skeleton: Skeleton): Reaches {
  const { joints } = skeleton;
  const all: { joint: number; min: Vec3; max: Vec3 }[] = [];
  joints.forEach(({ endSites = [], length }, j) => {
    for (const end of endSites) all.push({ joint: j, min: end, max: end });
    const tip: Vec3 = [0, length ?? 0, 0];
    if (length !== undefined) all.push({ joint: j, min: tip, max: tip });
  });
  const endCount = all.length;
  const tooLarge = areBoxesOversized(skeleton);
  joints.forEach((joint, j) => {
    if (hasBox(joint) && !tooLarge) all.push({ joint: j, ...joint.box });
  });
  const owners = Int32Array.from(all, ({ joint }) => joint);
  const centres = Float64Array.from(all.flatMap(({ min, max }) => min.map((least, k) => (least + max[k]) / 2)));
  return {
    joints: owners,
    endCount,
    centres,
    ...(hasStretches(skeleton) && {
      ends: { owners: owners.subarray(0, endCount), at: centres.slice(0, 3 * endCount) },
    }),
    // Boxes with min > max are drawn too.
    halves: Float64Array.from(all.flatMap(({ min, max }) => min.map((least, k) => Math.abs(max[k] - least) / 2))),
  };
}

/** A bone whose matrices are both set by us. */
class PosedBone extends Bone {
  override matrixAutoUpdate = false;
  override matrixWorldAutoUpdate = false;

  override updateMatrixWorld(): void {}

  override updateWorldMatrix(): void {}
}

export class Bones {
  readonly bones: readonly Bone[];
  readonly compiled: CompiledSkeleton;
  /** 16 numbers per joint, column-major, in the character's space. */
  readonly world: Float64Array;

  private readonly reaches: Reaches;
  private readonly ownLocal: Float64Array;
  /** The pose whose parent-space matrices have not been computed yet. */
  private posed: Float64Array | undefined;

  constructor(private readonly skeleton: Skeleton) {
    this.reaches = reachesOf(skeleton);
    const compiled = compileSkeleton(skeleton);
    this.compiled = compiled;
    this.ownLocal = new Float64Array(16 * compiled.jointCount);
    this.world = new Float64Array(16 * compiled.jointCount);
    const bones: Bone[] = [];
    skeleton.joints.forEach((joint, j) => {
      const bone = new PosedBone();
      bone.name = joint.name;
      setIdentity(this.ownLocal, 16 * j);
      setIdentity(this.world, 16 * j);
      const local = elementsOf(this.ownLocal, j);
      Object.defineProperty(bone.matrix, 'elements', {
        get: () => {
          this.makeLocal();
          return local;
        },
      });
      bone.matrixWorld.elements = elementsOf(this.world, j);
      bones.push(bone);
      bones[joint.parent]?.add(bone);
    });
    this.bones = bones;
  }

  get root(): Bone | undefined {
    return this.bones[0];
  }

  /**
   * Bounding box of all joints, their boxes and bone ends, as posed: min x y z and max x y z, in the character's space.
   */
  bounds(out: Float64Array): void {
    const { world, reaches } = this;
    const { joints, endCount, centres, halves } = reaches;
    let x0 = Infinity;
    let y0 = Infinity;
    let z0 = Infinity;
    let x1 = -Infinity;
    let y1 = -Infinity;
    let z1 = -Infinity;
    for (let o = 12; o < world.length; o += 16) {
      const x = world[o];
      const y = world[o + 1];
      const z = world[o + 2];
      if (x < x0) x0 = x;
      if (x > x1) x1 = x;
      if (y < y0) y0 = y;
      if (y > y1) y1 = y;
      if (z < z0) z0 = z;
      if (z > z1) z1 = z;
    }
    for (let i = 0; i < endCount; i++) {
      const m = 16 * joints[i];
      const a = centres[3 * i];
      const b = centres[3 * i + 1];
      const c = centres[3 * i + 2];
      const x = world[m] * a + world[m + 4] * b + world[m + 8] * c + world[m + 12];
      const y = world[m + 1] * a + world[m + 5] * b + world[m + 9] * c + world[m + 13];
      const z = world[m + 2] * a + world[m + 6] * b + world[m + 10] * c + world[m + 14];
      if (x < x0) x0 = x;
      if (x > x1) x1 = x;
      if (y < y0) y0 = y;
      if (y > y1) y1 = y;
      if (z < z0) z0 = z;
      if (z > z1) z1 = z;
    }
    out[0] = x0;
    out[1] = y0;
    out[2] = z0;
    out[3] = x1;
    out[4] = y1;
    out[5] = z1;
    for (let i = endCount; i < joints.length; i++) {
      for (let r = 0; r < 3; r++) {
        const m = 16 * joints[i] + r;
        let centre = world[m + 12];
        let half = 0;
        for (let c = 0; c < 3; c++) {
          centre += world[m + 4 * c] * centres[3 * i + c];
          half += Math.abs(world[m + 4 * c] * halves[3 * i + c]);
        }
        if (centre - half < out[r]) out[r] = centre - half;
        if (centre + half > out[r + 3]) out[r + 3] = centre + half;
      }
    }
  }

  /**
   * Poses the bones.
   *
   * @param dofs kept by reference; must not change before the next pose
   * @param rotations rotations sampled with the DOFs, if any
   */
  pose(dofs: Float64Array, rotations?: PoseRotations): void {
    worldMatrices(this.compiled, dofs, this.world, rotations);
    const { ends, centres } = this.reaches;
    if (ends) endsAt(this.skeleton, ends.owners, ends.at, dofs, 0, centres);
    this.posed = dofs;
  }

  private makeLocal(): void {
    if (!this.posed) return;
    localMatrices(this.compiled, this.posed, this.ownLocal);
    this.posed = undefined;
  }
}

/** Matrix elements of joint `j` in `all`. */
function elementsOf(all: Float64Array, j: number): Matrix4['elements'] {
  // three.js types elements as a tuple, but only indexes them.
  return all.subarray(16 * j, 16 * j + 16) as unknown as Matrix4['elements'];
}
