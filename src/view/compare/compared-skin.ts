/**
 * A compared skin over the scene: the other program's vertices with our triangles, as a ghost over ours or alone, and a
 * circle around the worst vertex. Ours are coloured by `errors`, which the viewport's `Look` takes.
 */
import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  DynamicDrawUsage,
  Group,
  InstancedBufferAttribute,
  type Material,
  Mesh,
  MeshBasicMaterial,
} from 'three';
import { type Skin, vertexCount } from '../../model/skin.ts';
import { dots } from '../scene/dots.ts';
import { rawColor } from '../scene/thick-lines.ts';
import { SkinMaterials } from '../skin/skin-materials.ts';
import { SKIN_THEMES } from '../skin/skin-theme.ts';
import { PLAIN_SKIN } from '../skin/skinning.ts';
import { ValueTexture } from '../skin/value-texture.ts';
import { STAGE_THEMES, type StageTheme } from '../theme.ts';
import { compareColours } from './compare-colours.ts';
import type { ComparedSide } from './compared-skeleton.ts';

/** Over our skin, under the bones. The ghost's depth comes first, so that only its front is seen, in front of ours. */
const DEPTH_ORDER = 13;
const GHOST_ORDER = 14;
const MARK_ORDER = 23;
/** Larger skins are shaded by their triangles: computing normals would take too long. */
const MAX_SMOOTH = 100_000;

export interface ComparedVertices {
  readonly skin: Skin;
  /** x y z per vertex, in the character's own space; theirs are absent if only normals were compared. */
  readonly ours: Float64Array;
  readonly theirs?: Float64Array;
  /** A float from 0 to 1 per vertex. */
  readonly errors: Float32Array<ArrayBuffer>;
  /** Vertex with the largest error; undefined if all agree. */
  readonly worst: number | undefined;
}

export class ComparedSkin {
  readonly object = new Group();
  private readonly meshes = new Group();
  private readonly depths = new Group();
  private readonly depth = new MeshBasicMaterial({ side: DoubleSide, colorWrite: false, transparent: true });
  private readonly mark = dots(1, { size: 19, depthTest: false, hollow: true });
  private readonly materials = new SkinMaterials(PLAIN_SKIN, SKIN_THEMES.dark);
  private tint = '';
  private geometry: BufferGeometry | undefined;
  private values: ValueTexture | undefined;
  /** That the geometry is of. */
  private skin: Skin | undefined;
  private compared: ComparedVertices | undefined;
  private side: ComparedSide = 'both';
  private placementCount = 0;

  constructor() {
    this.mark.renderOrder = MARK_ORDER;
    this.mark.matrixAutoUpdate = false;
    this.object.add(this.depths, this.meshes, this.mark);
    this.object.visible = false;
  }

  setTheme(theme: StageTheme): void {
    this.materials.setTheme(SKIN_THEMES[theme === STAGE_THEMES.light ? 'light' : 'dark']);
    this.tint = theme.comparedFirst;
    const { uniforms } = this.mark.material;
    uniforms.color.value.copy(rawColor(compareColours(theme).own));
    uniforms.ring.value.copy(rawColor(theme.labelHalo));
  }

  /** @param compared undefined: nothing is drawn */
  show(compared: ComparedVertices | undefined, side: ComparedSide, placementCount: number): void {
    this.compared = compared;
    this.side = side;
    this.placementCount = placementCount;
    this.object.visible = compared !== undefined;
    if (!compared) return;
    this.mark.visible = compared.worst !== undefined;
    if (this.mark.instanceMatrix.count < placementCount) {
      // Frees the old buffer.
      this.mark.dispose();
      this.mark.instanceMatrix = new InstancedBufferAttribute(new Float32Array(16 * placementCount), 16);
    }
    this.mark.count = placementCount;
    this.meshes.visible = side !== 'ours' && compared.theirs !== undefined;
    this.depths.visible = this.meshes.visible && side === 'both';
    if (this.meshes.visible) this.showTheirs(compared, side);
  }

  /** Call before each frame; allocates nothing. @param placements 16 numbers per placement */
  fill(placements: Float64Array): void {
    const { compared, mark, meshes, depths } = this;
    if (!compared || placements.length < 16 * this.placementCount) return;
    place(meshes, placements);
    place(depths, placements);
    const { worst, ours, theirs } = compared;
    if (worst === undefined) return;
    const marked = this.side === 'theirs' ? (theirs ?? ours) : ours;
    const x = marked[3 * worst];
    const y = marked[3 * worst + 1];
    const z = marked[3 * worst + 2];
    const { array } = mark.instanceMatrix;
    for (let p = 0; p < this.placementCount; p++) {
      const m = 16 * p;
      for (let r = 0; r < 3; r++) {
        array[m + 12 + r] =
          placements[m + r] * x + placements[m + 4 + r] * y + placements[m + 8 + r] * z + placements[m + 12 + r];
      }
      array[m + 15] = 1;
    }
    mark.instanceMatrix.needsUpdate = true;
  }

  dispose(): void {
    this.geometry?.dispose();
    this.values?.dispose();
    this.materials.dispose();
    this.depth.dispose();
    this.mark.geometry.dispose();
    this.mark.material.dispose();
    this.mark.dispose();
  }

  private showTheirs({ skin, theirs, errors }: ComparedVertices, side: ComparedSide): void {
    if (!theirs) return;
    const geometry = this.geometryOf(skin);
    const position = geometry.getAttribute('position');
    position.array.set(theirs);
    position.needsUpdate = true;
    if (vertexCount(skin) <= MAX_SMOOTH) geometry.computeVertexNormals();
    const { materials, tint } = this;
    const look = side === 'both' ? materials.xray(tint) : materials.heat(this.valuesOf(errors));
    this.setMeshes(this.meshes, geometry, look, GHOST_ORDER);
    this.setMeshes(this.depths, geometry, this.depth, DEPTH_ORDER);
    const [first] = this.depths.children;
    if (first) first.onBeforeRender = (renderer) => renderer.clearDepth();
  }

  /** One mesh per placement. */
  private setMeshes(group: Group, geometry: BufferGeometry, material: Material, order: number): void {
    const { placementCount } = this;
    group.clear();
    for (let p = 0; p < placementCount; p++) {
      const mesh = new Mesh(geometry, material);
      mesh.frustumCulled = false;
      mesh.matrixAutoUpdate = false;
      mesh.renderOrder = order;
      group.add(mesh);
    }
  }

  private valuesOf(errors: Float32Array): ValueTexture['texture'] {
    if (this.values?.count !== errors.length) {
      this.values?.dispose();
      this.values = new ValueTexture(errors.length);
    }
    this.values.set(errors);
    return this.values.texture;
  }

  private geometryOf(skin: Skin): BufferGeometry {
    if (this.geometry && this.skin === skin) return this.geometry;
    this.geometry?.dispose();
    this.skin = skin;
    this.geometry = new BufferGeometry();
    const floats = new Float32Array(3 * vertexCount(skin));
    this.geometry.setAttribute('position', new BufferAttribute(floats, 3).setUsage(DynamicDrawUsage));
    this.geometry.setIndex(new BufferAttribute(skin.triangles, 1));
    return this.geometry;
  }
}

function place({ children }: Group, placements: Float64Array): void {
  for (let p = 0; p < children.length; p++) {
    const { elements } = children[p].matrix;
    for (let i = 0; i < 16; i++) elements[i] = placements[16 * p + i];
    children[p].matrixWorldNeedsUpdate = true;
  }
}
