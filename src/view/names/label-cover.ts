/** Which joints are behind an opaque skin or a solid box of another part, as drawn in this frame. */
import type { Camera } from 'three';
import { PART_STRIDE } from '../../evaluate/shapes/skin-parts.ts';
import { multiplyAffine } from '../../math/mat4.ts';
import { hasBox } from '../../model/skeleton/boxes.ts';
import { Cover } from '../scene/cover.ts';
import type { DrawnSkeleton } from '../skeleton/drawn-skeletons.ts';

/** Scratch; never escapes. */
const local = new Float64Array(16);
const moved = new Float64Array(16);
const world = new Float64Array(16);
local[15] = moved[15] = world[15] = 1;

export class LabelCover {
  private readonly cover = new Cover();
  /** The shape of each joint's own part, by instance; −1 for none. */
  private own = new Int32Array(0);

  /**
   * Call each frame in which labels of joints are drawn.
   *
   * @param hasSkins whether skins are opaque
   * @param hasBoxes whether the boxes of `drawn[d]` are solid
   */
  fill(drawn: readonly DrawnSkeleton[], camera: Camera, hasSkins: boolean, hasBoxes: (d: number) => boolean): void {
    const { cover } = this;
    const m = camera.matrixWorld.elements;
    if ('isPerspectiveCamera' in camera) cover.begin(m[12], m[13], m[14], 1);
    else cover.begin(m[8], m[9], m[10], 0);
    const last = drawn.at(-1);
    const instances = last ? last.firstInstance + last.placementCount * last.nodes.count : 0;
    if (this.own.length < instances) this.own = new Int32Array(instances);
    for (let d = 0; d < drawn.length; d++) {
      const isBoxed = hasBoxes(d);
      for (let p = 0; p < drawn[d].placementCount; p++) this.addPlacement(drawn[d], p, hasSkins, isBoxed);
    }
  }

  /** @param x y z of the joint, in the world */
  isCovered(instance: number, x: number, y: number, z: number): boolean {
    const { cover, own } = this;
    if (cover.isEmpty || own[instance] < 0) return false;
    // Seen at the joint, or in the middle of what moves with it.
    return cover.covers(own[instance], x, y, z) && cover.coversMiddle(own[instance]);
  }

  private addPlacement(drawn: DrawnSkeleton, p: number, hasSkins: boolean, isBoxed: boolean): void {
    const { own, cover } = this;
    const { skeleton, skinShape, nodes, placements, firstInstance } = drawn;
    const { joints } = skeleton;
    const first = firstInstance + p * nodes.count;
    const parts = hasSkins ? skinShape?.skinParts : undefined;
    const matrices = skinShape?.skinMatrices;
    for (let j = 0; j < nodes.jointCount; j++) {
      // The part of the parent, for a joint that moves nothing itself.
      const { parent } = joints[j];
      own[first + j] = parent < 0 ? -1 : own[first + parent];
      const s = PART_STRIDE * j;
      if (parts && s < parts.length && !Number.isNaN(parts[s])) {
        local.fill(0, 0, 12);
        local[0] = parts[s + 3];
        local[1] = parts[s + 4];
        local[2] = parts[s + 6];
        local[5] = parts[s + 5];
        local[6] = parts[s + 7];
        local[10] = parts[s + 8];
        local[12] = parts[s];
        local[13] = parts[s + 1];
        local[14] = parts[s + 2];
        if (matrices) multiplyAffine(matrices, 16 * j, local, 0, moved, 0);
        else moved.set(local);
        this.addShape(placements, p, first + j, false);
      }
      if (isBoxed && hasBox(joints[j])) {
        const { min, max } = joints[j].box;
        local.fill(0, 0, 12);
        for (let k = 0; k < 3; k++) {
          local[5 * k] = (max[k] - min[k]) / 2;
          local[12 + k] = (max[k] + min[k]) / 2;
        }
        multiplyAffine(drawn.world, 16 * j, local, 0, moved, 0);
        this.addShape(placements, p, first + j, true);
      }
    }
    if (cover.isEmpty) own.fill(-1, first, first + nodes.jointCount);
  }

  private addShape(placements: Float64Array, p: number, instance: number, isBox: boolean): void {
    multiplyAffine(placements, 16 * p, moved, 0, world, 0);
    const shape = this.cover.add(world, 0, isBox);
    if (shape >= 0) this.own[instance] = shape;
  }
}
