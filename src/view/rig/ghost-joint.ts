/** Preview of the joint that a click would add, with its bone. */
import { Group, Mesh } from 'three';
import type { Vec3 } from '../../math/vec3.ts';
import { lineMaterial, rawColor, segmentsGeometry } from '../scene/thick-lines.ts';
import type { StageTheme } from '../theme.ts';
import { colorDots, disposeDots, putDot, rigDots } from './rig-dots.ts';

export interface AddedJoint {
  /** Its parent. */
  readonly from: number;
  /** In the world. */
  readonly at: Vec3;
}

export class GhostJoint {
  readonly object = new Group();
  private readonly dot = rigDots(1, 14, 49, true);
  private readonly bone = new Mesh(
    segmentsGeometry([0, 0, 0, 0, 1, 0]),
    lineMaterial({ width: 1.5, opacity: 0.8 }, { depthTest: false, depthWrite: false }),
  );

  constructor() {
    this.bone.matrixAutoUpdate = false;
    this.bone.frustumCulled = false;
    this.bone.renderOrder = 42;
    this.object.add(this.dot, this.bone);
  }

  /** @param world matrices of the joints, in the world */
  place(adds: AddedJoint | undefined, world: Float64Array, jointCount: number): void {
    const { dot, bone } = this;
    dot.count = adds ? 1 : 0;
    bone.visible = adds !== undefined && adds.from >= 0 && adds.from < jointCount;
    if (!adds) return;
    putDot(dot, 0, adds.at, 0);
    dot.instanceMatrix.needsUpdate = true;
    if (!bone.visible) return;
    const o = 16 * adds.from + 12;
    const [x, y, z] = [world[o], world[o + 1], world[o + 2]];
    const [dx, dy, dz] = [adds.at[0] - x, adds.at[1] - y, adds.at[2] - z];
    // The segment is along y: only that column matters.
    bone.matrix.set(1, dx, 0, x, 0, dy, 0, y, 0, dz, 1, z, 0, 0, 0, 1);
  }

  setTheme(theme: StageTheme): void {
    colorDots(this.dot, theme.selected, theme);
    this.bone.material.uniforms.color.value.copy(rawColor(theme.selected));
  }

  dispose(): void {
    disposeDots(this.dot);
    this.bone.geometry.dispose();
    this.bone.material.dispose();
  }
}
