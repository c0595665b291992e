/**
 * A skin of a character: its block of the palette, what it shares with equal ones, and for each placement a mesh.
 * Matrices and bounds are available at once; what takes long for a large skin is a generator.
 */
import {
  type Box3,
  BufferAttribute,
  type BufferGeometry,
  type Group,
  LineSegments,
  Matrix4,
  type ShaderMaterial,
  type Sphere,
  type Texture,
} from 'three';
import { posedBounds, type SkinBounds, skinBounds } from '../../evaluate/skin/bounds.ts';
import { type CompiledSkin, compileSkin, skinMatrices } from '../../evaluate/skin/deform.ts';
import { runToEnd, type Steps } from '../../evaluate/steps.ts';
import type { Morph } from '../../model/morph.ts';
import type { Display } from '../../model/session.ts';
import { type Skin, vertexCount } from '../../model/skin.ts';
import type { Bones } from '../skeleton/bones.ts';
import { runInSlices } from '../slices.ts';
import type { DrawnSkins, SkinDrawing } from './drawn-skins.ts';
import { MATRIX_TEXELS } from './float-blocks.ts';
import { PaletteSkeleton } from './palette-skeleton.ts';
import type { SharedSkin } from './shared-skins.ts';
import { edgesOf } from './skin-geometry.ts';
import { looksOf } from './skin-looks.ts';
import { MarrowSkinnedMesh } from './skinned-mesh.ts';
import { placeOne } from './skinning.ts';
import { ValueTexture } from './value-texture.ts';

/** Skins and their wireframes are built at once up to this many vertices: a few milliseconds. */
export const BUILT_AT_ONCE = 40_000;
/** Length of the lines that show normals, as a part of the skin's diagonal. */
const NORMAL_LENGTH = 0.015;

/** What the style `heat` shows: the weights of a joint, or a value from 0 to 1 per vertex. */
export type Heat = number | Float32Array | undefined;

/** The skin at one placement. */
interface Placed {
  readonly group: Group;
  readonly mesh: MarrowSkinnedMesh;
  normals?: NormalLines;
}

export class ShownSkin {
  readonly bounds: SkinBounds;
  /** Called when something requested earlier becomes visible. */
  onLater: () => void = () => {};
  private readonly compiled: CompiledSkin;
  private readonly skeleton: PaletteSkeleton;
  /** Undefined until it is built. */
  shared: SharedSkin | undefined;
  private placed: readonly Placed[] = [];
  private display: Display | undefined;
  private textures: ReadonlyMap<string, Texture> = new Map();
  private tint: string | undefined;
  private isRevealed = false;
  private isVisible = true;
  private readonly ended = new AbortController();
  private areEdgesComing = false;
  private heatWanted: Heat;
  /** What the style `four` shows. */
  private fourValues: Float32Array | undefined;
  private values: ValueTexture | undefined;

  /**
   * @param bones the character's; undefined without a skeleton: the skin is then never deformed
   * @param sphere around the posed character in its own space, kept up to date by the owner; likewise `box`
   */
  constructor(
    private readonly drawn: DrawnSkins,
    readonly skin: Skin,
    private readonly morphs: readonly Morph[],
    private bones: Bones | undefined,
    private readonly sphere: Sphere,
    private readonly box: Box3,
  ) {
    this.bounds = skinBounds(skin, morphs);
    this.compiled = compileSkin(skin);
    const { matrixCount, inverseBindings } = this.compiled;
    const { palette } = drawn;
    this.skeleton = new PaletteSkeleton(
      palette,
      [...(bones?.bones ?? [])],
      matrixCount,
      inverseBindings,
      morphs.length,
    );
  }

  /** Converts everything for the GPU. Nothing is drawn before it has finished and `reveal` was called. */
  *build(): Steps<void> {
    const shared = yield* this.drawn.shared.acquire(this.skin, this.morphs, this.bones !== undefined);
    this.shared = shared;
  }

  get isShown(): boolean {
    return this.isRevealed;
  }

  get meshes(): readonly MarrowSkinnedMesh[] {
    return this.placed.map(({ mesh }) => mesh);
  }

  /** W·B⁻¹, 16 numbers per joint, from `evaluate/deform.ts`; undefined if nothing moves the skin. */
  get matrices(): Float64Array | undefined {
    return this.bones && this.skeleton.matrices;
  }

  /** First texel in the palette of a joint's matrix; undefined if it moves nothing of the skin. */
  matrixOf(joint: number): number | undefined {
    return joint < this.skeleton.identityIndex ? this.skeleton.firstMatrix + MATRIX_TEXELS * joint : undefined;
  }

  /** What must be on the GPU before it is drawn; undefined until it is built. */
  get uploads(): { readonly geometry: BufferGeometry; readonly textures: readonly Texture[] } | undefined {
    if (!this.shared) return undefined;
    const { geometry, attachmentTexture, morphs } = this.shared;
    const textures = [attachmentTexture, morphs?.texture, ...this.textures.values()];
    return { geometry, textures: textures.filter((t) => t !== undefined) };
  }

  /** One mesh per group. */
  place(groups: readonly Group[]): void {
    this.unplace();
    const { shared, skeleton, sphere, box } = this;
    if (!shared) return;
    this.placed = groups.map((group) => {
      return { group, mesh: new MarrowSkinnedMesh(shared, skeleton, shared.materials.solid(), sphere, box) };
    });
    this.followGroups();
    this.refresh();
  }

  /** The groups' matrices aren't what they were. */
  followGroups(): void {
    for (let i = 0; i < this.placed.length; i++) {
      const { group, mesh } = this.placed[i];
      mesh.matrixWorld.copy(group.matrix);
    }
    this.drawn.movePlacements();
  }

  /** Shows the skin from now on. */
  reveal(): void {
    this.isRevealed = true;
    this.refresh();
  }

  /** Whether it is drawn if the display says so. */
  setVisible(isVisible: boolean): void {
    if (isVisible === this.isVisible) return;
    this.isVisible = isVisible;
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
    this.fourValues = values;
    this.values?.forget();
    this.refresh();
  }

  /** A colour for the whole skin; undefined: its own. */
  setTint(tint: string | undefined): void {
    if (tint === this.tint) return;
    this.tint = tint;
    this.refresh();
  }

  /** Those that are decoded, by their names in the materials. */
  setTextures(textures: ReadonlyMap<string, Texture>): void {
    this.textures = textures;
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
    const { bones, skeleton } = this;
    const { weights, matrices } = skeleton;
    if (bones) skinMatrices(this.compiled, bones.world, matrices);
    for (let m = 0; m < weights.length; m++) weights[m] = dofs[firstMorph + m];
    if (bones || weights.length > 0) skeleton.upload();
  }

  dispose(): void {
    this.ended.abort();
    this.unplace();
    this.skeleton.dispose();
    this.values?.dispose();
    if (this.shared) this.drawn.shared.release(this.shared);
  }

  private unplace(): void {
    for (const { mesh, normals } of this.placed) {
      this.drawn.draw(mesh, undefined);
      normals?.removeFromParent();
    }
    this.placed = [];
  }

  /** Applies what is requested. */
  private refresh(): void {
    const { display, shared, placed, drawn } = this;
    if (!display || !shared) return;
    const isShown = this.isRevealed && this.isVisible;
    const drawing = this.drawing(shared, display);
    for (const each of placed) {
      const { mesh } = each;
      // three.js only reads the list.
      if (drawing) mesh.material = drawing.material as MarrowSkinnedMesh['material'];
      drawn.draw(mesh, isShown ? drawing : undefined);
      if (display.normals) each.normals ??= this.normalLines(shared, each);
      if (each.normals) each.normals.visible = isShown && display.normals;
    }
  }

  /** Undefined if the display hides it, or its edges are still coming. */
  private drawing(shared: SharedSkin, { skin: style }: Display): SkinDrawing | undefined {
    const { tint, textures, heatWanted } = this;
    const { materials } = shared;
    const depth = materials.depth();
    switch (style) {
      case 'hidden':
        return undefined;
      case 'solid':
        return { material: materials.solid(tint), depth };
      case 'textured':
        return { material: materials.textured(looksOf(this.skin).looks, textures, tint), depth };
      case 'xray':
        return { material: materials.xray(tint) };
      case 'wire': {
        const edges = this.edgesOf(shared);
        return edges && { material: materials.wire(tint), edges };
      }
      case 'heat':
        if (heatWanted instanceof Float32Array) return { material: materials.heat(this.valuesOf(heatWanted)), depth };
        return { material: materials.heat(), depth, heatJoint: heatWanted };
      case 'four':
        return { material: materials.heat(this.fourValues && this.valuesOf(this.fourValues)), depth };
    }
  }

  private valuesOf(values: Float32Array): Texture {
    this.values ??= new ValueTexture(values.length);
    this.values.set(values);
    return this.values.texture;
  }

  private normalLines(shared: SharedSkin, { group, mesh }: Placed): NormalLines {
    const box = new Float64Array(6);
    posedBounds({ ...this.bounds, reaches: [] }, undefined, box, 0, box);
    const size = Math.hypot(box[3] - box[0], box[4] - box[1], box[5] - box[2]);
    const lines = new NormalLines(shared, mesh, NORMAL_LENGTH * size);
    group.add(lines);
    return lines;
  }

  /** The edges as lines; undefined while those of a large skin are being found. */
  private edgesOf(shared: SharedSkin): BufferAttribute | undefined {
    if (shared.edges || this.areEdgesComing) return shared.edges;
    const vertices = vertexCount(this.skin);
    // In the shared skin's order, which is consistent.
    const work = edgesOf(shared.skin.triangles, vertices);
    if (vertices <= BUILT_AT_ONCE) {
      shared.edges = new BufferAttribute(runToEnd(work), 1);
      return shared.edges;
    }
    this.areEdgesComing = true;
    void runInSlices(work, this.ended.signal).then((edges) => {
      if (!edges) return;
      shared.edges ??= new BufferAttribute(edges, 1);
      this.refresh();
      this.onLater();
    });
    return undefined;
  }
}

/** A line along each normal, of a skin at one placement. */
class NormalLines extends LineSegments<BufferGeometry, ShaderMaterial> {
  /** three.js skins anything with this and a skeleton. */
  readonly isSkinnedMesh = true;
  readonly skeleton: PaletteSkeleton;
  readonly bindMatrix = new Matrix4();
  readonly bindMatrixInverse = new Matrix4();
  readonly boundingSphere: Sphere;

  constructor(shared: SharedSkin, { skeleton, sphere }: MarrowSkinnedMesh, length: number) {
    super(shared.normals, shared.materials.normals());
    this.skeleton = skeleton;
    this.boundingSphere = sphere;
    this.matrixAutoUpdate = false;
    this.onBeforeRender = () => {
      this.material.uniforms.normalLength.value = length;
      placeOne(this.material, skeleton);
    };
  }

  /** Only the surface is picked. */
  override raycast(): void {}
}
