/**
 * A compared skin over the scene: the other program's vertices with our triangles, as a ghost over ours or alone, and a
 * circle around the worst vertex. Ours are coloured by `errors`, which the viewport's `Look` takes.
 */
import { BufferAttribute, BufferGeometry, DynamicDrawUsage, Group, InstancedBufferAttribute, Mesh } from 'three';
import { type Skin, vertexCount } from '../../model/skin.ts';
import { dots } from '../dots.ts';
import { HoveredPart } from '../hovered-part.ts';
import { SkinMaterials } from '../skin-materials.ts';
import { SKIN_THEMES } from '../skin-theme.ts';
import { STAGE_THEMES, type StageTheme } from '../theme.ts';
import { rawColor } from '../thick-lines.ts';
import { compareColours } from './compare-colours.ts';
import type { ComparedSide } from './compared-skeleton.ts';

/** Over our skin, under the bones. */
const GHOST_ORDER = 14;
const MARK_ORDER = 23;
/** Larger skins are shaded by their triangles: computing normals would take too long. */
const MAX_SMOOTH = 100_000;

export interface ComparedVertices {
  readonly skin: Skin;
  /** x y z per vertex, in the character's own space; theirs are absent if only normals were compared. */
  readonly ours: Float64Array;
  readonly theirs?: Float64Array | undefined;
  /** A float from 0 to 1 per vertex. */
  readonly errors: Float32Array<ArrayBuffer>;
  /** Vertex with the largest error; undefined if all agree. */
  readonly worst: number | undefined;
}

export class ComparedSkin {
  readonly object = new Group();
  private readonly meshes = new Group();
  private readonly mark = dots(1, { size: 19, depthTest: false, hollow: true });
  private readonly materials = new SkinMaterials({ attachmentTexture: undefined }, SKIN_THEMES.dark, new HoveredPart());
  private geometry: BufferGeometry | undefined;
  /** That the geometry is of. */
  private skin: Skin | undefined;
  private compared: ComparedVertices | undefined;
  private placementCount = 0;

  constructor() {
    this.mark.renderOrder = MARK_ORDER;
    this.mark.matrixAutoUpdate = false;
    this.object.add(this.meshes, this.mark);
    this.object.visible = false;
  }

  setTheme(theme: StageTheme): void {
    this.materials.setTheme(SKIN_THEMES[theme === STAGE_THEMES.light ? 'light' : 'dark']);
    this.materials.setTint(theme.comparedFirst);
    const { uniforms } = this.mark.material;
    uniforms.color.value.copy(rawColor(compareColours(theme).own));
    uniforms.ring.value.copy(rawColor(theme.labelHalo));
  }

  /** @param compared undefined: nothing is drawn */
  show(compared: ComparedVertices | undefined, side: ComparedSide, placementCount: number): void {
    this.compared = compared;
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
    if (this.meshes.visible) this.showTheirs(compared, side);
  }

  /** Call before each frame; allocates nothing. @param placements 16 numbers per placement */
  fill(placements: Float64Array): void {
    const { compared, mark, meshes } = this;
    if (!compared || placements.length < 16 * this.placementCount) return;
    for (let p = 0; p < meshes.children.length; p++) {
      const { matrix } = meshes.children[p];
      for (let i = 0; i < 16; i++) matrix.elements[i] = placements[16 * p + i];
      meshes.children[p].matrixWorldNeedsUpdate = true;
    }
    const { worst, ours } = compared;
    if (worst === undefined) return;
    const x = ours[3 * worst];
    const y = ours[3 * worst + 1];
    const z = ours[3 * worst + 2];
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
    this.materials.dispose();
    this.mark.geometry.dispose();
    this.mark.material.dispose();
    this.mark.dispose();
  }

  private showTheirs({ skin, theirs, errors }: ComparedVertices, side: ComparedSide): void {
    if (!theirs) return;
    const geometry = this.geometryOf(skin);
    set(geometry, 'position', theirs);
    set(geometry, 'influence', errors);
    if (vertexCount(skin) <= MAX_SMOOTH) geometry.computeVertexNormals();
    const isGhost = side === 'both';
    const material = isGhost ? this.materials.xray() : this.materials.heat();
    // In front of everything: where it is inside of ours it is wanted most.
    material.depthTest = !isGhost;
    const { meshes, placementCount } = this;
    for (let p = meshes.children.length; p < placementCount; p++) meshes.add(theirMesh(geometry));
    while (meshes.children.length > placementCount) meshes.remove(meshes.children[placementCount]);
    for (const mesh of meshes.children) if (mesh instanceof Mesh) Object.assign(mesh, { geometry, material });
  }

  private geometryOf(skin: Skin): BufferGeometry {
    if (this.geometry && this.skin === skin) return this.geometry;
    this.geometry?.dispose();
    this.skin = skin;
    this.geometry = new BufferGeometry();
    const floats = (width: number) =>
      new BufferAttribute(new Float32Array(width * vertexCount(skin)), width).setUsage(DynamicDrawUsage);
    this.geometry.setAttribute('position', floats(3));
    this.geometry.setAttribute('influence', floats(1));
    this.geometry.setIndex(new BufferAttribute(skin.triangles, 1));
    return this.geometry;
  }
}

function theirMesh(geometry: BufferGeometry): Mesh {
  const mesh = new Mesh(geometry);
  mesh.frustumCulled = false;
  mesh.matrixAutoUpdate = false;
  mesh.renderOrder = GHOST_ORDER;
  return mesh;
}

function set(geometry: BufferGeometry, name: 'position' | 'influence', values: ArrayLike<number>): void {
  const attribute = geometry.getAttribute(name);
  attribute.array.set(values);
  attribute.needsUpdate = true;
}
