/**
 * A quad that is drawn many times in one draw, each time with numbers of its own; how many there are is said anew for each
 * picture. It is over everything, and nothing of it is culled.
 */
import {
  BufferAttribute,
  DynamicDrawUsage,
  InstancedBufferAttribute,
  InstancedBufferGeometry,
  Mesh,
  type ShaderMaterial,
} from 'three';

/** Instances that there is room for at first. */
const FIRST_ROOM = 16;

export class InstancedQuads<Name extends string> {
  readonly mesh: Mesh<InstancedBufferGeometry, ShaderMaterial>;
  /** Numbers of all instances, as many for each as `sizes` says. Other arrays after each `add`, where it took more room. */
  readonly numbers: Record<Name, Float32Array>;
  private readonly names: readonly Name[];
  private capacity = 0;

  /**
   * @param corners x y of the four, as the shader has them in `position`
   * @param sizes attributes of an instance, 1 to 4 numbers each
   */
  constructor(
    corners: readonly number[],
    private readonly sizes: Readonly<Record<Name, 1 | 2 | 3 | 4>>,
    material: ShaderMaterial,
    renderOrder: number,
  ) {
    // Object.keys gives strings; they are the record's own.
    this.names = Object.keys(sizes) as Name[];
    // Filled for each of the names right here.
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

  /** None, until some are added. */
  clear(): void {
    this.mesh.geometry.instanceCount = 0;
  }

  /** One more. @returns its index; its numbers are to be written */
  add(): number {
    const { geometry } = this.mesh;
    const i = geometry.instanceCount;
    if (i === this.capacity) this.grow();
    geometry.instanceCount = i + 1;
    return i;
  }

  /** All of them are written. */
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

  /** Twice the room. A buffer of another size is another buffer: the old ones are let go. */
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
