/**
 * Skins on the GPU, one for all characters with an equal one: a crowd of a hundred from files of their own is uploaded
 * once. Equal means the same numbers; where they are the same arrays, nothing is compared.
 */
import { type BufferAttribute, type BufferGeometry, InstancedBufferAttribute, InstancedBufferGeometry } from 'three';
import { type CompiledSkin, compileSkin } from '../../evaluate/skin/deform.ts';
import type { Steps } from '../../evaluate/steps.ts';
import { sameNumbers } from '../../math/same-numbers.ts';
import type { Morph, MorphRows } from '../../model/morph.ts';
import type { Skin } from '../../model/skin.ts';
import { type PackedMorphs, packMorphs } from './packed-morphs.ts';
import { normalsGeometry, type PackedSkin, packSkin } from './skin-geometry.ts';
import { looksOf } from './skin-looks.ts';
import { SkinMaterials, type SkinUniforms } from './skin-materials.ts';
import type { SkinTheme } from './skin-theme.ts';
import { PLAIN_SKIN, type SkinData } from './skinning.ts';

/** Numbers of an instance: see `Placing` in `skinning.ts`. */
export const INSTANCE_STRIDE = 4;

/** Vertices, data and materials of equal skins. */
export class SharedSkin implements SkinData {
  readonly geometry: BufferGeometry;
  readonly attachmentTexture: PackedSkin['attachmentTexture'];
  /** Set once, for the style `wire`: see `edgesOf`. */
  edges: BufferAttribute | undefined;
  /** How many skins that are shown have it. */
  owners = 0;
  private lines: InstancedBufferGeometry | undefined;
  private readonly instanced: InstancedBufferGeometry[] = [];
  private readonly idle: InstancedBufferGeometry[] = [];

  constructor(
    readonly skin: Skin,
    readonly isPosed: boolean,
    { geometry, attachmentTexture }: PackedSkin,
    readonly morphs: PackedMorphs | undefined,
    readonly materials: SkinMaterials,
  ) {
    this.geometry = geometry;
    this.attachmentTexture = attachmentTexture;
    if (morphs) geometry.setAttribute('morphRange', morphs.ranges);
  }

  get normals(): InstancedBufferGeometry {
    this.lines ??= normalsGeometry(this.geometry);
    return this.lines;
  }

  /**
   * The vertices for so many instances at least, which are in `placed`, with the surface's triangles or its edges. Give
   * it back when it isn't drawn any more: those of one skin share buffers, and end together.
   */
  takeInstanced(capacity: number, index: BufferAttribute | null): InstancedBufferGeometry {
    const found = this.idle.findIndex((g) => g.index === index && placedOf(g).count >= capacity);
    if (found >= 0) return this.idle.splice(found, 1)[0];
    const geometry = new InstancedBufferGeometry();
    for (const [name, attribute] of Object.entries(this.geometry.attributes)) geometry.setAttribute(name, attribute);
    geometry.setIndex(index);
    if (index === this.geometry.index) geometry.groups = this.geometry.groups;
    const placed = new Uint32Array(INSTANCE_STRIDE * capacity);
    geometry.setAttribute('placed', new InstancedBufferAttribute(placed, INSTANCE_STRIDE));
    this.instanced.push(geometry);
    return geometry;
  }

  giveBack(geometry: InstancedBufferGeometry): void {
    this.idle.push(geometry);
  }

  /** Frees what is on the GPU; drawn again, it is uploaded again. */
  free(): void {
    for (const geometry of [this.geometry, this.lines, ...this.instanced]) geometry?.dispose();
    this.attachmentTexture?.dispose();
    this.morphs?.texture.dispose();
  }
}

/** The instances of a geometry from `takeInstanced`. */
export function placedOf(geometry: BufferGeometry): InstancedBufferAttribute {
  // Created above; three.js's type allows interleaved ones.
  return geometry.getAttribute('placed') as unknown as InstancedBufferAttribute;
}

export class SharedSkins {
  private readonly all = new Set<SharedSkin>();
  /** Of all that have no textures of their own. */
  private readonly plain: SkinMaterials;

  constructor(
    private theme: SkinTheme,
    private readonly uniforms: SkinUniforms,
  ) {
    this.plain = new SkinMaterials(PLAIN_SKIN, theme, uniforms);
  }

  setTheme(theme: SkinTheme): void {
    this.theme = theme;
    this.plain.setTheme(theme);
    for (const { materials } of this.all) materials.setTheme(theme);
  }

  /**
   * The one for a skin with these morphs; release it when it isn't shown any more.
   *
   * @param isPosed whether there is a skeleton: without one a skin isn't deformed, whatever its weights sum to
   */
  *acquire(skin: Skin, morphs: readonly Morph[], isPosed: boolean): Steps<SharedSkin> {
    const shared = this.find(skin, morphs, isPosed) ?? (yield* this.build(compileSkin(skin), morphs, isPosed));
    shared.owners++;
    return shared;
  }

  release(shared: SharedSkin): void {
    shared.owners--;
    if (shared.owners > 0) return;
    this.all.delete(shared);
    shared.free();
    if (shared.materials !== this.plain) shared.materials.dispose();
  }

  /** See `SharedSkin.free`. */
  free(): void {
    for (const shared of this.all) shared.free();
  }

  dispose(): void {
    this.plain.dispose();
  }

  private *build(compiled: CompiledSkin, morphs: readonly Morph[], isPosed: boolean): Steps<SharedSkin> {
    const { skin, normals, matrixCount } = compiled;
    const packed = yield* packSkin(skin, normals, matrixCount, isPosed);
    const differences = yield* packMorphs(morphs, skin.positions, normals);
    const data = { attachmentTexture: packed.attachmentTexture, morphs: differences };
    const isPlain = !data.attachmentTexture && !data.morphs;
    const materials = isPlain ? this.plain : new SkinMaterials(data, this.theme, this.uniforms);
    const shared = new SharedSkin(skin, isPosed, packed, differences, materials);
    this.all.add(shared);
    return shared;
  }

  private find(skin: Skin, morphs: readonly Morph[], isPosed: boolean): SharedSkin | undefined {
    for (const shared of this.all) {
      const known = shared.morphs?.morphs;
      if (shared.isPosed !== isPosed || !areEqual(shared.skin, skin)) continue;
      if (known ? haveEqualMorphs(known, morphs) : morphs.every(isEmpty)) return shared;
    }
    return undefined;
  }
}

/** Whether they have the same vertices and triangles, moved by the same joints, with the same runs of looks. */
function areEqual(a: Skin, b: Skin): boolean {
  if (a === b) return true;
  const runs = looksOf(a).runs;
  const otherRuns = looksOf(b).runs;
  return (
    a.bindings.length === b.bindings.length &&
    runs.length === otherRuns.length &&
    runs.every((run, r) => run.look === otherRuns[r].look && run.triangleCount === otherRuns[r].triangleCount) &&
    sameNumbers(a.positions, b.positions) &&
    sameNumbers(a.triangles, b.triangles) &&
    sameNumbers(a.attachments?.start, b.attachments?.start) &&
    sameNumbers(a.attachments?.joints, b.attachments?.joints) &&
    sameNumbers(a.attachments?.weights, b.attachments?.weights) &&
    sameNumbers(a.texcoords, b.texcoords) &&
    sameNumbers(compileSkin(a).normals, compileSkin(b).normals)
  );
}

function haveEqualMorphs(a: readonly Morph[], b: readonly Morph[]): boolean {
  return a.length === b.length && a.every((morph, m) => isSameMorph(morph, b[m]));
}

function isSameMorph(a: Morph, b: Morph): boolean {
  return haveSameRows(a.positions, b.positions) && haveSameRows(a.normals, b.normals);
}

function haveSameRows(a: MorphRows, b: MorphRows): boolean {
  return sameNumbers(a.indices, b.indices) && sameNumbers(a.values, b.values);
}

function isEmpty({ positions, normals }: Morph): boolean {
  return positions.indices.length === 0 && normals.indices.length === 0;
}
