/**
 * A skin in the scene: its GPU data, morphs, materials, and for each placement a mesh with its lines. Matrices and
 * bounds are available at once; what takes long for a large skin is a generator.
 */
import { type Box3, BufferAttribute, type BufferGeometry, type Group, type Sphere, type Texture } from 'three';
import { posedBounds, type SkinBounds, skinBounds } from '../../evaluate/skin/bounds.ts';
import { type CompiledSkin, compileSkin, skinMatrices } from '../../evaluate/skin/deform.ts';
import { runToEnd, type Steps } from '../../evaluate/steps.ts';
import type { Morph } from '../../model/morph.ts';
import type { Display, SkinStyle } from '../../model/session.ts';
import { type Skin, vertexCount } from '../../model/skin.ts';
import type { Bones } from '../skeleton/bones.ts';
import { runInSlices } from '../slices.ts';
import type { HoveredPart } from './hovered-part.ts';
import { type Morphing, morphing } from './morphs.ts';
import { edgesOf, influenceOf, normalsGeometry, packSkin, wireGeometry } from './skin-geometry.ts';
import { looksOf } from './skin-looks.ts';
import { SkinMaterials } from './skin-materials.ts';
import type { SkinTheme } from './skin-theme.ts';
import { ExactSkeleton, MarrowSkinnedMesh, type SkinGpu, SkinnedLines } from './skinning.ts';

/** Skins and their wireframes are built at once up to this many vertices: a few milliseconds. */
export const BUILT_AT_ONCE = 40_000;
/** Length of the lines that show normals, as a part of the skin's diagonal. */
const NORMAL_LENGTH = 0.015;
/** For a heat map without values: 0 everywhere. */
const NO_JOINT = -1;

/** What the style `heat` shows: the weights of a joint, or a value from 0 to 1 per vertex. */
export type Heat = number | Float32Array | undefined;

/** The result of `build`. */
interface Built {
  readonly gpu: SkinGpu;
  readonly morphing: Morphing;
  readonly materials: SkinMaterials;
}

/** The skin's objects at one placement. */
interface Placed {
  readonly group: Group;
  readonly mesh: MarrowSkinnedMesh;
  wire?: SkinnedLines;
  normals?: SkinnedLines;
}

export class ShownSkin {
  readonly bounds: SkinBounds;
  /** Called when something requested earlier becomes visible. */
  onLater: () => void = () => {};
  private readonly compiled: CompiledSkin;
  private readonly skeleton: ExactSkeleton;
  private built: Built | undefined;
  private placed: readonly Placed[] = [];
  private display: Display | undefined;
  private textures: ReadonlyMap<string, Texture> = new Map();
  private tint: string | undefined;
  private isRevealed = false;
  private readonly ended = new AbortController();
  /** Edges as lines; all geometries share the vertices. */
  private wire: BufferGeometry | undefined;
  private wireIsComing = false;
  private normals: BufferGeometry | undefined;
  private heatWanted: Heat;
  private heatValues: Float32Array | undefined;
  private influence: BufferAttribute | undefined;
  private influenceShown: number | Float32Array | undefined;

  /**
   * @param bones the character's; undefined without a skeleton: the skin is then never deformed
   * @param sphere around the posed character in its own space, kept up to date by the owner; likewise `box`
   */
  constructor(
    readonly skin: Skin,
    private readonly morphs: readonly Morph[],
    private bones: Bones | undefined,
    private theme: SkinTheme,
    private readonly sphere: Sphere,
    private readonly box: Box3,
    private readonly hovered: HoveredPart,
  ) {
    this.bounds = skinBounds(skin, morphs);
    this.compiled = compileSkin(skin);
    const { matrixCount, inverseBindings } = this.compiled;
    this.skeleton = new ExactSkeleton([...(bones?.bones ?? [])], matrixCount, inverseBindings);
  }

  /** Converts everything for the GPU. Nothing is drawn before it has finished and `reveal` was called. */
  *build(): Steps<void> {
    const { skin, compiled, skeleton } = this;
    const isPosed = this.bones !== undefined;
    const packed = yield* packSkin(skin, compiled.normals, skeleton.identityIndex, isPosed);
    const gpu = { skin, skeleton, isPosed, ...packed };
    const made = yield* morphing(gpu.geometry, skin.positions, compiled.normals, this.morphs);
    const materials = new SkinMaterials(gpu, this.theme, this.hovered);
    materials.setTextures(this.textures);
    materials.setTint(this.tint);
    this.built = { gpu, materials, morphing: made };
  }

  get isShown(): boolean {
    return this.isRevealed;
  }

  get meshes(): readonly MarrowSkinnedMesh[] {
    return this.placed.map((p) => p.mesh);
  }

  /** W·B⁻¹, 16 numbers per joint, from `evaluate/deform.ts`; undefined if nothing moves the skin. */
  get matrices(): Float64Array | undefined {
    return this.bones && this.skeleton.matrices;
  }

  /** What must be on the GPU before it is drawn; undefined until it is built. */
  get uploads(): { readonly geometry: BufferGeometry; readonly textures: readonly Texture[] } | undefined {
    if (!this.built) return undefined;
    const { geometry, attachmentTexture } = this.built.gpu;
    return { geometry, textures: [attachmentTexture, ...this.textures.values()].filter((t) => t !== undefined) };
  }

  /** One mesh per group. */
  place(groups: readonly Group[]): void {
    this.unplace();
    const { built } = this;
    if (!built) return;
    const { gpu, materials, morphing } = built;
    this.placed = groups.map((group) => {
      const mesh = new MarrowSkinnedMesh(gpu, materials.solid(), this.sphere, this.box);
      mesh.customDepthMaterial = materials.depth();
      mesh.customDistanceMaterial = materials.distance();
      if (morphing.influences.length > 0) mesh.morphTargetInfluences = morphing.influences;
      group.add(mesh);
      return { group, mesh };
    });
    this.refresh();
  }

  /** Shows the skin from now on. */
  reveal(): void {
    this.isRevealed = true;
    this.refresh();
  }

  show(display: Display, heat: Heat): void {
    this.display = display;
    this.heatWanted = heat;
    this.refresh();
  }

  /** Sets what the style `four` shows: see `Viewport.heatSkin`. */
  heat(values: Float32Array): void {
    // Measured before an edit that has replaced the skin.
    if (values.length !== vertexCount(this.skin)) return;
    this.heatValues = values;
    if (this.influenceShown instanceof Float32Array) this.influenceShown = undefined;
    this.refresh();
  }

  setTheme(theme: SkinTheme): void {
    this.theme = theme;
    this.built?.materials.setTheme(theme);
  }

  /** A colour for the whole skin; undefined: its own. */
  setTint(tint: string | undefined): void {
    this.tint = tint;
    this.built?.materials.setTint(tint);
  }

  /** Those that are decoded, by their names in the materials. */
  setTextures(textures: ReadonlyMap<string, Texture>): void {
    this.textures = textures;
    this.built?.materials.setTextures(textures);
    this.refresh();
  }

  /** Whether it can be kept with these: the same morphs, and bones in both cases or in neither. */
  fits(morphs: readonly Morph[], bones: Bones | undefined): boolean {
    if ((bones === undefined) !== (this.bones === undefined)) return false;
    return morphs.length === this.morphs.length && morphs.every((m, i) => m === this.morphs[i]);
  }

  /** Call after an edit of the skeleton: the skin keeps as many matrices as it has bindings. */
  setBones(bones: Bones | undefined): void {
    this.bones = bones;
    this.skeleton.bones = [...(bones?.bones ?? [])];
  }

  /**
   * Call every frame, after the bones; allocates nothing.
   *
   * @param firstMorph index in `dofs` of the first morph's weight
   */
  pose(dofs: Float64Array, firstMorph: number): void {
    const { bones, built, normals } = this;
    if (bones) {
      skinMatrices(this.compiled, bones.world, this.skeleton.matrices);
      this.skeleton.upload();
    }
    built?.morphing.apply(dofs, firstMorph);
    if (built && normals) {
      // Morphs summed on the CPU change the surface's buffers; the lines share those arrays.
      follow(normals, built.gpu.geometry, 'position');
      follow(normals, built.gpu.geometry, 'normal');
    }
  }

  dispose(): void {
    this.ended.abort();
    this.unplace();
    this.skeleton.dispose();
    const { built } = this;
    if (!built) return;
    // Together, since they share buffers.
    for (const geometry of [built.gpu.geometry, this.wire, this.normals]) geometry?.dispose();
    built.gpu.attachmentTexture?.dispose();
    built.materials.dispose();
  }

  private unplace(): void {
    for (const { mesh, wire, normals } of this.placed) {
      for (const object of [mesh, wire, normals]) object?.removeFromParent();
    }
    this.placed = [];
  }

  /** Applies what is requested to the objects. */
  private refresh(): void {
    const { display, built } = this;
    if (!display || !built) return;
    const { materials } = built;
    if (display.skin === 'heat') this.heatUp(built, this.heatWanted ?? NO_JOINT);
    if (display.skin === 'four') this.heatUp(built, this.heatValues ?? NO_JOINT);
    if (display.skin === 'wire') this.needWire(built);
    if (display.normals) this.normals ??= normalsGeometry(built.gpu.geometry);
    for (const placed of this.placed) {
      const { mesh } = placed;
      mesh.material = surfaceMaterial(materials, display.skin, this.skin);
      mesh.visible = this.isRevealed && display.skin !== 'hidden' && display.skin !== 'wire';
      mesh.castShadow = display.skin !== 'xray';
      if (this.wire && display.skin === 'wire') placed.wire ??= this.lines(placed, this.wire, materials.wire(), built);
      if (placed.wire) placed.wire.visible = this.isRevealed && display.skin === 'wire';
      if (this.normals && display.normals) {
        placed.normals ??= this.lines(placed, this.normals, this.normalsMaterial(materials), built);
      }
      if (placed.normals) placed.normals.visible = this.isRevealed && display.normals;
    }
  }

  private lines(
    placed: Placed,
    geometry: BufferGeometry,
    material: SkinnedLines['material'],
    { morphing }: Built,
  ): SkinnedLines {
    const lines = new SkinnedLines(geometry, material, this.skeleton, this.sphere);
    if (morphing.influences.length > 0) lines.morphTargetInfluences = morphing.influences;
    placed.group.add(lines);
    return lines;
  }

  private normalsMaterial(materials: SkinMaterials): SkinnedLines['material'] {
    const material = materials.normals();
    const box = new Float64Array(6);
    posedBounds({ ...this.bounds, reaches: [] }, undefined, box, 0, box);
    const size = Math.hypot(box[3] - box[0], box[4] - box[1], box[5] - box[2]);
    material.uniforms.normalLength.value = NORMAL_LENGTH * size;
    return material;
  }

  private needWire({ gpu }: Built): void {
    if (this.wire || this.wireIsComing) return;
    const vertices = vertexCount(this.skin);
    const work = edgesOf(this.skin.triangles, vertices);
    if (vertices <= BUILT_AT_ONCE) {
      this.wire = wireGeometry(gpu.geometry, runToEnd(work));
      return;
    }
    this.wireIsComing = true;
    void runInSlices(work, this.ended.signal).then((edges) => {
      if (!edges) return;
      this.wire = wireGeometry(gpu.geometry, edges);
      this.refresh();
      this.onLater();
    });
  }

  /** @param what a joint, for its weights, or a value per vertex */
  private heatUp({ gpu }: Built, what: number | Float32Array): void {
    if (this.influence && this.influenceShown === what) return;
    this.influence ??= new BufferAttribute(new Float32Array(vertexCount(this.skin)), 1);
    gpu.geometry.setAttribute('influence', this.influence);
    if (what instanceof Float32Array) this.influence.copyArray(what);
    // Created above, with floats.
    else influenceOf(this.skin, what, this.influence.array as Float32Array);
    this.influence.needsUpdate = true;
    this.influenceShown = what;
  }
}

function surfaceMaterial(materials: SkinMaterials, style: SkinStyle, skin: Skin): MarrowSkinnedMesh['material'] {
  switch (style) {
    case 'textured':
      return materials.textured(looksOf(skin).looks);
    case 'xray':
      return materials.xray();
    case 'heat':
    case 'four':
      return materials.heat();
    case 'solid':
    case 'wire':
    case 'hidden':
      return materials.solid();
  }
}

/** Uploads a buffer when the one it shares its array with changes. */
function follow(lines: BufferGeometry, surface: BufferGeometry, name: 'position' | 'normal'): void {
  // Neither is interleaved: both are created in `skin-geometry.ts`.
  const copy = lines.attributes[name] as BufferAttribute;
  copy.version = (surface.attributes[name] as BufferAttribute).version;
}
