/** Dots of rig mode: over everything, with new positions each frame. */
import type { BufferGeometry, InstancedMesh, ShaderMaterial } from 'three';
import { sphereMatrix } from '../../evaluate/shapes/joint-shapes.ts';
import { dots } from '../scene/dots.ts';
import { rawColor } from '../scene/thick-lines.ts';
import type { StageTheme } from '../theme.ts';

export type Dots = InstancedMesh<BufferGeometry, ShaderMaterial>;

/** @param size diameter in CSS pixels */
export function rigDots(count: number, size: number, renderOrder: number, hollow = false): Dots {
  const mark = dots(count, { size, depthTest: false, hollow });
  mark.matrixAutoUpdate = false;
  mark.renderOrder = renderOrder;
  return mark;
}

/** Moves instance `i` to the point in `at[o …]`. */
export function putDot(mark: Dots, i: number, at: ArrayLike<number>, o: number): void {
  // Created as a Float32Array by `dots` and three.js; its type says any array.
  sphereMatrix(at[o], at[o + 1], at[o + 2], 1, mark.instanceMatrix.array as Float32Array, 16 * i);
}

export function colorDots(mark: Dots, color: string, theme: StageTheme): void {
  mark.material.uniforms.color.value.copy(rawColor(color));
  mark.material.uniforms.ring.value.copy(rawColor(theme.labelHalo));
}

export function disposeDots(mark: Dots): void {
  mark.geometry.dispose();
  mark.material.dispose();
  mark.dispose();
}
