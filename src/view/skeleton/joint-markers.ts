/**
 * Marks the selected joints on top of everything, at each placement: the active one by a dot, its axes and the edges of
 * its box, the others by dots.
 */
import {
  type BufferAttribute,
  type BufferGeometry,
  type Group,
  InstancedBufferAttribute,
  type InstancedMesh,
  type InterleavedBufferAttribute,
  ShaderMaterial,
} from 'three';
import { axesMatrix, boxMatrix, type JointSizes, sphereMatrix } from '../../evaluate/shapes/joint-shapes.ts';
import { hasBox } from '../../model/skeleton/boxes.ts';
import type { Joint } from '../../model/skeleton/skeleton.ts';
import { dots } from '../scene/dots.ts';
import { lineMaterial, rawColor } from '../scene/thick-lines.ts';
import type { StageTheme } from '../theme.ts';
import { InstancedKind } from './instanced-kind.ts';

/** Opacity of marks behind a skin. */
const MARKER_OPACITY = 0.5;

export class JointMarkers {
  private readonly dots = dots(1, { size: 9, depthTest: false });
  private readonly otherDots = dots(1, { size: 8, depthTest: false });
  private readonly edges: InstancedKind;
  private readonly axes: InstancedKind;

  constructor(parent: Group, boxEdges: BufferGeometry, axes: BufferGeometry) {
    const onTop = { depthTest: false, depthWrite: false };
    const edgeLines = lineMaterial({ width: 1.5, opacity: MARKER_OPACITY }, onTop);
    const axisLines = lineMaterial({ width: 2, segmentColors: true }, onTop);
    this.edges = new InstancedKind(boxEdges, edgeLines, undefined, false, parent);
    this.axes = new InstancedKind(axes, axisLines, undefined, false, parent);
    parent.add(this.otherDots, this.dots);
    this.otherDots.renderOrder = 21;
    this.otherDots.matrixAutoUpdate = false;
    this.edges.mesh.renderOrder = 20;
    this.axes.mesh.renderOrder = 21;
    this.dots.renderOrder = 22;
    this.dots.matrixAutoUpdate = false;
  }

  /**
   * @param count placements of the active joint's character; 0 for none
   * @param others number of dots for the other selected joints, of all characters
   */
  show(count: number, withBox: boolean, others: number): void {
    this.edges.resize(count);
    this.axes.resize(count);
    resizeDots(this.dots, count);
    resizeDots(this.otherDots, others);
    this.edges.mesh.visible = withBox && count > 0;
    this.axes.mesh.visible = this.dots.visible = count > 0;
    this.otherDots.visible = others > 0;
  }

  /** Sets the marks of one placement to a joint with the scene matrix `world[o …]`. */
  fill(placement: number, joint: Joint, sizes: JointSizes, scale: number, world: Float64Array, o: number): void {
    const to = 16 * placement;
    sphereMatrix(world[o + 12], world[o + 13], world[o + 14], 1, matricesOf(this.dots), to);
    axesMatrix(world, o, sizes.axis * scale, this.axes.matrices, to);
    if (hasBox(joint)) boxMatrix(world, o, joint.box, 1e-4 * sizes.extent, this.edges.matrices, to);
    else this.edges.matrices.fill(0, to, to + 16);
  }

  /** Sets the dot of another selected joint. @param slot less than the number of such dots */
  fillOther(slot: number, x: number, y: number, z: number): void {
    sphereMatrix(x, y, z, 1, matricesOf(this.otherDots), 16 * slot);
  }

  /** Draws no marks of one placement: its joint is a point that is missing. */
  hide(placement: number): void {
    const [from, to] = [16 * placement, 16 * placement + 16];
    for (const matrices of [matricesOf(this.dots), this.axes.matrices, this.edges.matrices]) matrices.fill(0, from, to);
  }

  /** The same for another selected joint. */
  hideOther(slot: number): void {
    matricesOf(this.otherDots).fill(0, 16 * slot, 16 * slot + 16);
  }

  filled(): void {
    this.edges.mesh.instanceMatrix.needsUpdate = true;
    this.axes.mesh.instanceMatrix.needsUpdate = true;
    this.dots.instanceMatrix.needsUpdate = true;
    this.otherDots.instanceMatrix.needsUpdate = true;
  }

  /** Hides the marks while `draw` runs. */
  without(draw: () => void): void {
    const meshes = [this.edges.mesh, this.axes.mesh, this.dots, this.otherDots];
    const before = meshes.map((mesh) => mesh.visible);
    for (const mesh of meshes) mesh.visible = false;
    try {
      draw();
    } finally {
      meshes.forEach((mesh, i) => {
        mesh.visible = before[i];
      });
    }
  }

  setTheme(theme: StageTheme): void {
    this.dots.material.uniforms.color.value.copy(rawColor(theme.selected));
    this.otherDots.material.uniforms.color.value.copy(rawColor(theme.selectedToo));
    this.dots.material.uniforms.ring.value.copy(rawColor(theme.labelHalo));
    // Without axes beside it, a dot needs more contrast with a skin.
    this.otherDots.material.uniforms.ring.value.copy(rawColor(theme.bone));
    const { material } = this.edges;
    if (material instanceof ShaderMaterial) material.uniforms.color.value.copy(rawColor(theme.selected));
  }

  dispose(): void {
    this.edges.dispose();
    this.axes.dispose();
    for (const made of [this.dots, this.otherDots]) {
      made.geometry.dispose();
      made.material.dispose();
      made.dispose();
    }
  }
}

function resizeDots(mesh: InstancedMesh, count: number): void {
  if (count > mesh.instanceMatrix.count) {
    mesh.instanceMatrix = new InstancedBufferAttribute(new Float32Array(16 * count), 16);
  }
  mesh.count = count;
}

function matricesOf(mesh: InstancedMesh): Float32Array {
  // Created as a Float32Array; three.js types it as any array.
  return mesh.instanceMatrix.array as Float32Array;
}

/** Colours x, y and z of lines with segment colours. */
export function paintAxes(axes: BufferGeometry, theme: StageTheme): void {
  const colors = [theme.axisX, theme.axisY, theme.axisZ].map(rawColor);
  const attribute: BufferAttribute | InterleavedBufferAttribute = axes.getAttribute('segmentColor');
  for (let v = 0; v < 12; v++) colors[Math.floor(v / 4)].toArray(attribute.array, 3 * v);
  attribute.needsUpdate = true;
}
