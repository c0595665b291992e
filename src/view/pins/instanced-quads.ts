/**
 * Instanced quads with per-instance attributes, in one draw; the count is set again each frame. Drawn over everything,
 * never culled.
 */
import {
  BufferAttribute,
  DynamicDrawUsage,
  InstancedBufferAttribute,
  InstancedBufferGeometry,
  Mesh,
  type ShaderMaterial,
} from 'three';

/** Initial capacity. */
const FIRST_ROOM = 16;

export class InstancedQuads<Name extends string> {
  readonly mesh: Mesh<InstancedBufferGeometry, ShaderMaterial>;
  /** Attributes of all instances, with `sizes` numbers each. `add` may replace the arrays to grow. */
  readonly numbers: Record<Name, Float32Array>;
  private readonly names: readonly Name[];
  private capacity = 0;

  /**
   * @param corners x y of the four, `position` in the shader
   * @param sizes attributes of an instance, 1 to 4 numbers each
   */
  constructor(
    corners: readonly number[],
    private readonly sizes: Readonly<Record<Name, 1 | 2 | 3 | 4>>,
    material: ShaderMaterial,
    renderOrder: number,
  ) {
    // Object.keys returns strings; these are the record's own keys.
    this.names = Object.keys(sizes) as Name[];
    // Filled for each name right here.
    this.numbers = Object.fromEntries(this.names.map((name) => [name, new Float32Array(0)])) as Record<
      Name,
      Float32Array
    >;
    const geometry = new InstancedBufferGeometry();
    const flat = [0, 1, 2, 3].flatMap((c) => [corners[2 * c], corners[2 * c + 1], 0]);
    geometry.setAttribute('position', new BufferAttribute(new Float32Array(flat), 3));
    geometry.setIndex([0, 1, 2, 2, 1, 3]);
    geometry.instanceCount = 0;
    this.mesh = new Mesh(geometry, material);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = renderOrder;
  }

  /** Removes all instances. */
  clear(): void {
    this.mesh.geometry.instanceCount = 0;
  }

  /** Adds an instance. @returns its index; the caller writes its attributes */
  add(): number {
    const { geometry } = this.mesh;
    const i = geometry.instanceCount;
    if (i === this.capacity) this.grow();
    geometry.instanceCount = i + 1;
    return i;
  }

  /** Uploads everything written. */
  filled(): void {
    const { geometry } = this.mesh;
    this.mesh.visible = geometry.instanceCount > 0;
    for (const name of this.names) {
      const attribute = geometry.attributes[name];
      if (attribute) attribute.needsUpdate = true;
    }
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
  }

  /** Doubles the capacity. A larger buffer is a new buffer, so the old ones are disposed of. */
  private grow(): void {
    const { geometry } = this.mesh;
    this.capacity = Math.max(FIRST_ROOM, 2 * this.capacity);
    geometry.dispose();
    for (const name of this.names) {
      const size = this.sizes[name];
      const more = new Float32Array(size * this.capacity);
      more.set(this.numbers[name]);
      this.numbers[name] = more;
      geometry.setAttribute(name, new InstancedBufferAttribute(more, size).setUsage(DynamicDrawUsage));
    }
  }
}
