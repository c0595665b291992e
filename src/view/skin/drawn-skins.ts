/**
 * All skins that are drawn: equal ones of one material with one call, as instances of a batch. What they have of their
 * own is in two textures that are uploaded once, however many there are:
 *
 *     palette         per skin: matrices of joints and weights of morphs, when its pose changes
 *     placements      per instance: matrices to the view and to the world, when they or the camera change
 *
 * An instance's attribute says where its own are. A batch holds what is in view, or may throw a shadow into it, the
 * nearest first, or last if it is transparent: the order in which three.js draws meshes.
 */
import {
  type BufferAttribute,
  type Camera,
  DetachedBindMode,
  Frustum,
  Group,
  type InstancedBufferGeometry,
  LineSegments,
  type Material,
  Matrix4,
  Skeleton,
  SkinnedMesh,
  Sphere,
} from 'three';
import { STAGE_THEMES, type ThemeName } from '../theme.ts';
import { FloatBlocks, MATRIX_TEXELS } from './float-blocks.ts';
import { HoveredPart } from './hovered-part.ts';
import { INSTANCE_STRIDE, placedOf, type SharedSkin, SharedSkins } from './shared-skins.ts';
import { SharedTextures } from './shared-textures.ts';
import { SKIN_THEMES } from './skin-theme.ts';
import type { MarrowSkinnedMesh } from './skinned-mesh.ts';

/** How a skin is drawn. */
export interface SkinDrawing {
  readonly material: Material | readonly Material[];
  /** Edges instead of the surface. */
  readonly edges?: BufferAttribute | undefined;
  /** For its shadow; undefined: it throws none. */
  readonly depth?: Material | undefined;
  /** The joint whose influence is shown. */
  readonly heatJoint?: number | undefined;
}

/** Whether a sphere in the world may throw a shadow that is seen. */
export type MayCast = (sphere: Sphere) => boolean;

/** Texels of a placement: its matrices to the view and to the world. */
const TEXELS = 2 * MATRIX_TEXELS;
/** No joint's influence. */
const NO_JOINT = 0xffffffff;
/** Instances that a batch has room for at first. */
const FIRST_CAPACITY = 4;

/** Scratch, never escapes. */
const toView = new Matrix4();
const toTake = new Matrix4();
const frustum = new Frustum();
const sphere = new Sphere();

export class DrawnSkins {
  /** Parent of all that is drawn. */
  readonly object = new Group();
  readonly palette = new FloatBlocks();
  readonly hovered = new HoveredPart();
  readonly shared: SharedSkins;
  readonly textures = new SharedTextures();
  readonly placements = new FloatBlocks();
  private readonly skeleton = new BatchSkeleton();
  private readonly batches = new Map<string, SkinBatch>();
  private readonly instances = new Map<MarrowSkinnedMesh, Instance>();
  private readonly seenFrom = new Matrix4();
  private havePlacesChanged = true;

  constructor(theme: ThemeName = 'dark') {
    this.skeleton.boneTexture = this.palette.texture;
    const { placements, hovered } = this;
    this.shared = new SharedSkins(SKIN_THEMES[theme], { placements, hovered });
    this.setTheme(theme);
  }

  setTheme(theme: ThemeName): void {
    this.hovered.hoveredColour.value.set(STAGE_THEMES[theme].hovered);
    this.shared.setTheme(SKIN_THEMES[theme]);
  }

  /** Draws a skin from now on where its mesh is, or no longer. */
  draw(mesh: MarrowSkinnedMesh, drawing: SkinDrawing | undefined): void {
    const before = this.instances.get(mesh);
    if (!drawing) {
      if (!before) return;
      this.leave(before);
      this.placements.release(before.placement, TEXELS);
      this.instances.delete(mesh);
      return;
    }
    const heatJoint = drawing.heatJoint ?? NO_JOINT;
    if (before) {
      before.heatJoint = heatJoint;
      if (before.batch.key === keyOf(mesh.shared, drawing)) return;
      // First: the new batch takes over what the old one may leave.
      this.leave(before);
      before.batch = this.batchOf(mesh.shared, drawing);
      before.batch.instances.push(before);
      return;
    }
    const batch = this.batchOf(mesh.shared, drawing);
    const placement = this.placements.allocate(TEXELS);
    const instance = { mesh, batch, placement, heatJoint, depth: 0 };
    this.instances.set(mesh, instance);
    batch.instances.push(instance);
    this.movePlacements();
  }

  /** Placements aren't what they were. */
  movePlacements(): void {
    this.havePlacesChanged = true;
  }

  /** Call before everything is drawn; allocates nothing unless something was added. */
  aim(camera: Camera, mayCast?: MayCast): void {
    const { matrixWorldInverse } = camera;
    if (this.havePlacesChanged || !this.seenFrom.equals(matrixWorldInverse)) {
      this.havePlacesChanged = false;
      this.seenFrom.copy(matrixWorldInverse);
      this.instances.forEach(this.place);
    }
    frustum.setFromProjectionMatrix(toTake.multiplyMatrices(camera.projectionMatrix, matrixWorldInverse));
    for (const batch of this.batches.values()) batch.arrange(matrixWorldInverse, mayCast);
  }

  /** Frees what is on the GPU; drawn again, it is uploaded again. */
  free(): void {
    this.palette.dispose();
    this.placements.dispose();
    this.shared.free();
  }

  dispose(): void {
    this.free();
    this.shared.dispose();
    this.object.removeFromParent();
  }

  private readonly place = ({ mesh, placement }: Instance): void => {
    toView.multiplyMatrices(this.seenFrom, mesh.matrixWorld);
    this.placements.writeMatrices(placement, toView.elements);
    this.placements.writeMatrices(placement + MATRIX_TEXELS, mesh.matrixWorld.elements);
  };

  private batchOf(shared: SharedSkin, drawing: SkinDrawing): SkinBatch {
    const key = keyOf(shared, drawing);
    const known = this.batches.get(key);
    if (known) return known;
    const { material, edges, depth } = drawing;
    const batch = new SkinBatch(key, shared, material, edges, depth, this.skeleton);
    this.batches.set(key, batch);
    this.object.add(batch.object);
    return batch;
  }

  private leave(instance: Instance): void {
    const { batch } = instance;
    batch.remove(instance);
    if (batch.instances.length > 0) return;
    batch.dispose();
    this.batches.delete(batch.key);
  }
}

/** The same for all that are drawn with one call. */
function keyOf({ geometry }: SharedSkin, { material, edges, depth }: SkinDrawing): string {
  const ids = [material].flat().map(({ id }) => id);
  return [geometry.id, edges ? 'edges' : 'surface', depth ? 'casts' : '', ...ids].join(' ');
}

/** A skin at one placement. */
interface Instance {
  readonly mesh: MarrowSkinnedMesh;
  batch: SkinBatch;
  /** Its first texel among the placements. */
  readonly placement: number;
  heatJoint: number;
  /** Along the view, as of the last frame; larger is farther. */
  depth: number;
}

/** Equal skins of one material, in one call. */
class SkinBatch {
  readonly object: BatchSurface | BatchLines;
  readonly instances: Instance[] = [];
  /** Those that are drawn, in order, and how many: it keeps its length, so that no frame allocates. */
  private readonly drawn: Instance[] = [];
  private drawnCount = 0;
  private readonly isFarFirst: boolean;

  constructor(
    readonly key: string,
    private readonly shared: SharedSkin,
    material: Material | readonly Material[],
    private readonly edges: BufferAttribute | undefined,
    depth: Material | undefined,
    skeleton: Skeleton,
  ) {
    const geometry = shared.takeInstanced(FIRST_CAPACITY, this.index);
    // three.js only reads the list.
    const materials = material as Material | Material[];
    this.object = edges
      ? new BatchLines(geometry, materials, skeleton)
      : new BatchSurface(geometry, materials, skeleton);
    this.isFarFirst = [materials].flat()[0].transparent;
    if (!depth) return;
    this.object.castShadow = true;
    this.object.customDepthMaterial = depth;
  }

  /** Chooses and sorts what is drawn. @param view from the world to the camera, of the scratch `frustum` */
  arrange(view: Matrix4, mayCast: MayCast | undefined): void {
    const { drawn, instances, object } = this;
    const casts = object.castShadow ? mayCast : undefined;
    let count = 0;
    for (let i = 0; i < instances.length; i++) {
      const instance = instances[i];
      const { mesh } = instance;
      sphere.copy(mesh.sphere).applyMatrix4(mesh.matrixWorld);
      if (!frustum.intersectsSphere(sphere) && !casts?.(sphere)) continue;
      const { x, y, z } = sphere.center;
      const e = view.elements;
      instance.depth = -(e[2] * x + e[6] * y + e[10] * z + e[14]);
      // Nearly sorted: they were in the last frame.
      let at = count++;
      for (; at > 0 && this.comesBefore(instance, drawn[at - 1]); at--) drawn[at] = drawn[at - 1];
      drawn[at] = instance;
    }
    this.drawnCount = count;
    object.visible = count > 0;
    if (!object.visible) return;
    // As three.js sorts batches.
    const first = drawn[0];
    object.boundingSphere.copy(first.mesh.sphere).applyMatrix4(first.mesh.matrixWorld);
    if (placedOf(object.geometry).count < count) this.grow(count);
    this.write();
  }

  remove(instance: Instance): void {
    this.instances.splice(this.instances.indexOf(instance), 1);
    // Nothing keeps what is gone.
    this.drawn.length = 0;
  }

  dispose(): void {
    this.object.removeFromParent();
    this.shared.giveBack(this.object.geometry);
  }

  private get index(): BufferAttribute | null {
    return this.edges ?? this.shared.geometry.index;
  }

  private comesBefore(a: Instance, b: Instance): boolean {
    return this.isFarFirst ? a.depth > b.depth : a.depth < b.depth;
  }

  private grow(count: number): void {
    const { object, shared } = this;
    shared.giveBack(object.geometry);
    object.geometry = shared.takeInstanced(2 ** Math.ceil(Math.log2(count)), this.index);
  }

  private write(): void {
    const { drawn, drawnCount, object } = this;
    const placed = placedOf(object.geometry);
    const { array } = placed;
    object.geometry.instanceCount = drawnCount;
    let hasChanged = false;
    for (let i = 0; i < drawnCount; i++) {
      const { mesh, placement, heatJoint } = drawn[i];
      const { firstMatrix, firstWeight } = mesh.skeleton;
      const o = INSTANCE_STRIDE * i;
      if (array[o] === placement && array[o + 1] === firstMatrix && array[o + 2] === firstWeight) {
        if (array[o + 3] === heatJoint) continue;
      }
      array[o] = placement;
      array[o + 1] = firstMatrix;
      array[o + 2] = firstWeight;
      array[o + 3] = heatJoint;
      hasChanged = true;
    }
    if (hasChanged) placed.needsUpdate = true;
  }
}

/** Gives the palette to batches, which have no bones. three.js would upload it in every frame, whether or not it changed. */
class BatchSkeleton extends Skeleton {
  override update(): void {}
}

class BatchSurface extends SkinnedMesh<InstancedBufferGeometry, Material | Material[]> {
  override readonly boundingSphere = new Sphere();

  constructor(geometry: InstancedBufferGeometry, material: Material | Material[], skeleton: Skeleton) {
    super(geometry, material);
    this.skeleton = skeleton;
    this.bindMode = DetachedBindMode;
    this.matrixAutoUpdate = false;
    this.frustumCulled = false;
  }

  /** At the origin for good. */
  override updateMatrixWorld(): void {}

  /** Skins are picked one by one. */
  override raycast(): void {}
}

/** three.js skins anything with `isSkinnedMesh` and a skeleton. */
class BatchLines extends LineSegments<InstancedBufferGeometry, Material | Material[]> {
  readonly isSkinnedMesh = true;
  readonly bindMatrix = new Matrix4();
  readonly bindMatrixInverse = new Matrix4();
  readonly boundingSphere = new Sphere();

  constructor(
    geometry: InstancedBufferGeometry,
    material: Material | Material[],
    readonly skeleton: Skeleton,
  ) {
    super(geometry, material);
    this.matrixAutoUpdate = false;
    this.frustumCulled = false;
  }

  override updateMatrixWorld(): void {}

  override raycast(): void {}
}
