/** The circle around the picked vertex of a skin, at each placement of its character. */
import { InstancedBufferAttribute, Vector3 } from 'three';
import { dots } from '../scene/dots.ts';
import { rawColor } from '../scene/thick-lines.ts';
import { type ShownCharacter, vertexPosition } from '../shown-characters.ts';
import type { StageTheme } from '../theme.ts';

export class VertexMarker {
  readonly object = dots(1, { size: 17, depthTest: false, hollow: true });
  private readonly point = new Vector3();

  constructor() {
    this.object.renderOrder = 23;
    this.object.matrixAutoUpdate = false;
  }

  setTheme(theme: StageTheme): void {
    this.object.material.uniforms.color.value.copy(rawColor(theme.vertex));
    this.object.material.uniforms.ring.value.copy(rawColor(theme.labelHalo));
  }

  /** Marks a vertex where it is drawn now; hides the mark if there is none. */
  mark(entry: ShownCharacter | undefined, vertex: number | undefined): void {
    const { object, point } = this;
    const count = entry && vertex !== undefined ? entry.character.placements.length : 0;
    object.visible = false;
    if (!entry || vertex === undefined || count === 0) return;
    if (object.instanceMatrix.count < count) {
      object.instanceMatrix = new InstancedBufferAttribute(new Float32Array(16 * count), 16);
    }
    for (let p = 0; p < count; p++) {
      if (!vertexPosition(entry, vertex, p, point)) return;
      point.toArray(object.instanceMatrix.array, 16 * p + 12);
      object.instanceMatrix.array[16 * p + 15] = 1;
    }
    object.count = count;
    object.instanceMatrix.needsUpdate = true;
    object.visible = true;
  }

  dispose(): void {
    this.object.geometry.dispose();
    this.object.material.dispose();
    this.object.dispose();
  }
}
