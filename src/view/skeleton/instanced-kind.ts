/**
 * One kind of shape (balls, say), drawn many times in one call: an instanced mesh that grows as needed, optionally a
 * second mesh for covered instances, and a material that draws ids for picking.
 */
import {
  type BufferGeometry,
  type Color,
  DynamicDrawUsage,
  type Group,
  InstancedBufferAttribute,
  InstancedMesh,
  type Material,
  ShaderMaterial,
} from 'three';
import { ID_FRAGMENT } from '../scene/thick-lines.ts';
import { NodeMesh, type NodeShape } from './node-buffer.ts';

/** Covered instances are drawn after everything that may cover them, and before the markers. */
const COVERED_ORDER = 15;

export interface InstancedOptions {
  readonly coveredMaterial?: Material;
  /** With fewer and fewer triangles, instead of `geometry`. */
  readonly lighter?: readonly BufferGeometry[];
  /** If given, drawn from a `NodeBuffer`, which its owner fills, instead of `matrices`. */
  readonly shape?: NodeShape;
}

/** A kind's mesh, recreated to grow, and optionally one more for covered instances. */
export class InstancedKind {
  mesh: InstancedMesh;
  /** Drawn only behind something opaque: bones show through a skin. */
  covered: InstancedMesh | undefined;
  private tint: InstancedBufferAttribute | undefined;
  private capacity = 0;

  constructor(
    readonly geometry: BufferGeometry,
    readonly material: Material,
    readonly idMaterial: ShaderMaterial | undefined,
    private readonly tinted: boolean,
    parent: Group,
    private readonly more: InstancedOptions = {},
  ) {
    this.mesh = this.create(1);
    parent.add(this.mesh);
    this.cover();
  }

  /** Makes room for `count` instances. */
  resize(count: number): void {
    if (count > this.capacity) {
      const { parent, visible, castShadow, renderOrder, geometry } = this.mesh;
      this.mesh.removeFromParent();
      this.mesh.dispose();
      this.mesh = this.create(count);
      Object.assign(this.mesh, { visible, castShadow, renderOrder, geometry });
      parent?.add(this.mesh);
      this.cover();
    }
    this.mesh.count = count;
    if (this.covered) this.covered.count = count;
  }

  /** All its geometries. */
  get geometries(): readonly BufferGeometry[] {
    return [this.geometry, ...(this.more.lighter ?? [])];
  }

  /** Draws with fewer triangles. @param level of `geometries` */
  setLevel(level: number): void {
    const shape = this.geometries[level] ?? this.geometry;
    this.mesh.geometry = shape;
    if (this.covered) this.covered.geometry = shape;
  }

  /** Colour of one instance; sRGB for tinted lines. */
  paint(instance: number, color: Color, opacity: number): void {
    if (this.tint) this.tint.setXYZW(instance, color.r, color.g, color.b, opacity);
    else this.mesh.setColorAt(instance, color);
  }

  painted(): void {
    if (this.tint) this.tint.needsUpdate = true;
    if (this.mesh.instanceColor) this.mesh.instanceColor.needsUpdate = true;
    if (this.covered) this.covered.instanceColor = this.mesh.instanceColor;
  }

  get matrices(): Float32Array {
    // InstancedMesh creates a Float32Array; its type says any array.
    return this.mesh.instanceMatrix.array as Float32Array;
  }

  dispose(): void {
    this.mesh.removeFromParent();
    this.mesh.dispose();
    this.geometry.dispose();
    for (const geometry of this.more.lighter ?? []) geometry.dispose();
    this.material.dispose();
    this.idMaterial?.dispose();
    this.covered?.removeFromParent();
    this.covered?.dispose();
    this.more.coveredMaterial?.dispose();
  }

  /** Recreates the covered mesh with the mesh's arrays. */
  private cover(): void {
    const { coveredMaterial } = this.more;
    if (!coveredMaterial) return;
    const before = this.covered;
    before?.removeFromParent();
    before?.dispose();
    const covered = new InstancedMesh(this.mesh.geometry, coveredMaterial, 0);
    covered.instanceMatrix = this.mesh.instanceMatrix;
    covered.frustumCulled = false;
    covered.matrixAutoUpdate = false;
    covered.renderOrder = COVERED_ORDER;
    covered.visible = before?.visible ?? false;
    this.mesh.parent?.add(covered);
    this.covered = covered;
  }

  private create(count: number): InstancedMesh {
    this.capacity = count;
    const { geometry, material } = this;
    const { shape } = this.more;
    const mesh = shape ? new NodeMesh(geometry, material, count, shape) : new InstancedMesh(geometry, material, count);
    mesh.instanceMatrix.setUsage(DynamicDrawUsage);
    // Instances are anywhere: the unit shape's sphere means nothing.
    mesh.frustumCulled = false;
    mesh.matrixAutoUpdate = false;
    if (this.tinted) {
      this.tint = new InstancedBufferAttribute(new Float32Array(4 * count), 4);
      this.geometry.setAttribute('tint', this.tint);
    }
    return mesh;
  }
}

/** Draws the ids `firstId + instance` of instanced meshes. */
export function meshIdMaterial(): ShaderMaterial {
  return new ShaderMaterial({
    toneMapped: false,
    uniforms: { firstId: { value: 0 } },
    vertexShader: /* glsl */ `
      uniform float firstId;
      flat varying highp uint vId;
      void main() {
        vId = uint(firstId) + uint(gl_InstanceID);
        gl_Position = projectionMatrix * (modelViewMatrix * (instanceMatrix * vec4(position, 1.0)));
      }
    `,
    fragmentShader: ID_FRAGMENT,
  });
}
