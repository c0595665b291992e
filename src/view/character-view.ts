/**
 * One character in the scene: bones, skin, motion, and its placements.
 *
 *     after an edit     show()    rebuilds what changed; a part that is the same object needs nothing
 *     every frame       seek()    mixer → DOFs → matrices → bone texture; no allocation
 *
 *     object ─┬─ placement ── normals                      with a mesh each, that `DrawnSkins` draws
 *             ├─ placement ── …
 *             └─ root bone ── …                            in the character's own space
 *
 * A large skin isn't shown at once: `prepare` converts and uploads it in slices, then shows it.
 */

import { type Bone, Box3, Group, PerspectiveCamera, Scene, Sphere, Vector3, type WebGLRenderer } from 'three';
import { skinParts } from '../evaluate/shapes/skin-parts.ts';
import { posedBounds } from '../evaluate/skin/bounds.ts';
import { NO_TRAVEL, placementMatrix } from '../evaluate/space/placements.ts';
import { upAxis } from '../evaluate/space/space.ts';
import { steppedCharacter } from '../evaluate/stepped-take.ts';
import { runToEnd, type Steps } from '../evaluate/steps.ts';
import { carrierOf, groundTravel } from '../evaluate/travel.ts';
import { type Character, shownSkin } from '../model/document.ts';
import type { Texture as Picture } from '../model/files.ts';
import type { Morph } from '../model/morph.ts';
import type { Display } from '../model/session.ts';
import { type Skin, textureNames, vertexCount } from '../model/skin.ts';
import { PosePlayer } from './motion/pose-track.ts';
import { Bones } from './skeleton/bones.ts';
import type { DrawnSkins } from './skin/drawn-skins.ts';
import type { SharedSkin } from './skin/shared-skins.ts';
import { BUILT_AT_ONCE, type Heat, ShownSkin } from './skin/shown-skin.ts';
import { SkinTextures } from './skin/skin-textures.ts';
import type { MarrowSkinnedMesh } from './skin/skinned-mesh.ts';
import { uploadInFrames } from './skin/upload.ts';
import { runInSlices } from './slices.ts';
import { STAGE_THEMES, type ThemeName, type Tint } from './theme.ts';

/** Callbacks of a character. */
export interface CharacterEvents {
  /** Something has changed: redraw. */
  redraw?(): void;
  /** A texture of the skin can't be decoded; what has it stays untextured. */
  textureFailed?(picture: Picture, message: string): void;
}

const NO_NUMBERS = new Float64Array(0);
/** Scratch, never escapes. */
const box = new Float64Array(6);
const matrix = new Float64Array(16);
const travelled = new Float64Array(3);
const placedBox = new Box3();
const vertex = new Vector3();

export class CharacterView {
  /** Contains everything of this character but its skin, which is in that of `skins`; at the scene's origin. */
  readonly object = new Group();
  /** Bounds of the posed character in its own space, for three.js's culling and sorting. */
  readonly localBox = new Box3();
  private readonly localSphere = new Sphere();
  private shown: Character | undefined;
  private display: Display | undefined;
  private heat: Heat;
  private theme: ThemeName = 'dark';
  private isVisible = true;
  private tint: Tint | undefined;
  private timeSeconds = 0;
  /** See `freezeRootMotion`. */
  private heldTravel: Float64Array | undefined;
  private player: PosePlayer | undefined;
  private boneSet: Bones | undefined;
  private groups: readonly Group[] = [];
  private skin: ShownSkin | undefined;
  /** See `drawnVertices`; undefined until they are asked for in this pose. */
  private verticesNow: Float64Array | undefined;
  /** A skin being built: at once, or in slices by `prepare`. */
  private building: Steps<void> | undefined;
  private preparing: Promise<void> | undefined;
  private skinLife = new AbortController();
  private readonly textures: SkinTextures;

  /**
   * @param skins where its skin is drawn
   * @param renderer `prepare` uploads to it; without one it only converts
   */
  constructor(
    private readonly skins: DrawnSkins,
    private readonly renderer?: WebGLRenderer,
    private readonly events: CharacterEvents = {},
  ) {
    this.object.matrixAutoUpdate = false;
    this.textures = new SkinTextures(
      skins.textures,
      (textures) => {
        this.skin?.setTextures(textures);
        this.events.redraw?.();
      },
      (picture, message) => this.events.textureFailed?.(picture, message),
    );
  }

  /** One per placement, in order, with the placement's matrix. */
  get placements(): readonly Group[] {
    return this.groups;
  }

  get bones(): readonly Bone[] {
    return this.boneSet?.bones ?? [];
  }

  /** One per placement; none without a skin, or while a large one is being prepared. */
  get skinnedMeshes(): readonly MarrowSkinnedMesh[] {
    return this.skin?.isShown ? this.skin.meshes : [];
  }

  /** What its skin shares with equal ones; undefined without a skin, or while a large one is being prepared. */
  get sharedSkin(): SharedSkin | undefined {
    return this.skin?.isShown ? this.skin.shared : undefined;
  }

  /** See `SkinShape`. */
  get skinParts(): Float64Array | undefined {
    return this.skin?.isShown ? skinParts(this.skin.skin) : undefined;
  }

  get skinMatrices(): Float64Array | undefined {
    return this.skin?.matrices;
  }

  /** Every DOF at the time of the last `seek` (see `model/dofs.ts`), clamped. */
  get dofs(): Float64Array {
    return this.player?.dofs ?? NO_NUMBERS;
  }

  /** 16 numbers per joint, column-major, in the character's own space. */
  get worldMatrices(): Float64Array {
    return this.boneSet?.world ?? NO_NUMBERS;
  }

  /** Whether a skin is waiting for `prepare`. */
  get needsPreparing(): boolean {
    return this.skin !== undefined && !this.skin.isShown;
  }

  /** Whether it is drawn at all. */
  setVisible(isVisible: boolean): void {
    this.isVisible = isVisible;
    this.object.visible = isVisible;
    this.skin?.setVisible(isVisible);
  }

  /** First texel in the palette of a joint's matrix; undefined if it moves no skin. */
  paletteTexelOf(joint: number): number | undefined {
    return this.skin?.matrixOf(joint);
  }

  setTheme(theme: ThemeName): void {
    this.theme = theme;
    this.skin?.setTint(this.tint && STAGE_THEMES[theme][this.tint]);
  }

  /** Draws the skin in this colour; undefined: its own. */
  setTint(tint: Tint | undefined): void {
    if (tint === this.tint) return;
    this.tint = tint;
    this.skin?.setTint(tint && STAGE_THEMES[this.theme][tint]);
  }

  /**
   * Call after an edit.
   *
   * @param heat what the heat map shows
   * @param timeSeconds of the transport, to pose it at; default: as before
   */
  show(character: Character, display: Display, heat: Heat, timeSeconds = this.timeSeconds): void {
    const before = this.shown;
    this.shown = character;
    this.display = display;
    this.heat = heat;
    this.timeSeconds = timeSeconds;
    const played = display.stepped ? steppedCharacter(character) : character;
    if (this.player?.fits(played)) this.player.character = played;
    else this.player = new PosePlayer(played);

    const hasNewPlaces = character.placements.length !== this.groups.length;
    if (hasNewPlaces) this.rebuildPlacements(character.placements.length);
    const hasNewBones = !before || character.skeleton !== before.skeleton;
    if (hasNewBones) this.rebuildBones(character);
    const skin = shownSkin(character);
    if (this.skin && this.skin.skin === skin && this.skin.fits(character.morphs, this.boneSet)) {
      if (hasNewBones) this.skin.setBones(this.boneSet);
      if (hasNewPlaces) this.skin.place(this.groups);
      this.skin.show(display, heat);
    } else this.rebuildSkin(character, skin);
    this.textures.show(skin?.texcoords ? textureNames(skin) : [], character.textures);
    this.placeGroups(character);
    this.seek(timeSeconds);
  }

  /** Whether `show` with these has nothing to do. */
  isShowing(character: Character, display: Display, heat: Heat, timeSeconds: number): boolean {
    return (
      character === this.shown && display === this.display && heat === this.heat && timeSeconds === this.timeSeconds
    );
  }

  /** Whether another display, or another joint's heat map, changes nothing of how it is drawn and posed. */
  isDrawnAlike({ inPlace, stepped }: Display): boolean {
    return !this.skin && this.display?.inPlace === inPlace && this.display.stepped === stepped;
  }

  /** See `Viewport.heatSkin`. Another skin has no values until it is given some. */
  heatSkin(values: Float32Array): void {
    this.skin?.heat(values);
  }

  /** Poses everything at a time of the transport. Allocates nothing. */
  seek(timeSeconds: number): void {
    const { player, boneSet, skin, shown } = this;
    this.timeSeconds = timeSeconds;
    this.verticesNow = undefined;
    if (!player || !shown) return;
    player.seek(timeSeconds);
    const { dofs } = player;
    const firstMorph = dofs.length - shown.morphs.length;
    boneSet?.pose(dofs, player.rotations);
    skin?.pose(dofs, firstMorph);
    if (this.display?.inPlace) this.placeGroups(shown);

    if (skin) posedBounds(skin.bounds, skin.matrices, dofs, firstMorph, box);
    else if (boneSet) boneSet.bounds(box);
    else box.fill(Number.NaN);
    const { localBox, localSphere } = this;
    if (box[0] <= box[3]) {
      localBox.min.set(box[0], box[1], box[2]);
      localBox.max.set(box[3], box[4], box[5]);
    } else localBox.makeEmpty();
    if (skin) localBox.getBoundingSphere(localSphere);
  }

  /**
   * Horizontal root motion so far, x y z in the character's own space, which *in place* cancels. Scratch: read it
   * before the next call. Zero if `inPlace` is false.
   */
  travel(inPlace: boolean): Float64Array {
    const { boneSet, shown, dofs } = this;
    if (!inPlace) return NO_TRAVEL;
    if (this.heldTravel) return this.heldTravel;
    if (boneSet && shown) {
      groundTravel(boneSet.compiled, shown.space, carrierOf(shown), dofs, boneSet.world, travelled);
    } else {
      // Only a root translation, and a skin moved by it.
      travelled.set(dofs.subarray(0, 3));
      travelled[upAxis(shown?.space)] = 0;
    }
    return travelled;
  }

  /** Freezes the current root motion offset of *in place* while the root is edited, until released. */
  freezeRootMotion(holds: boolean): void {
    this.heldTravel = undefined;
    if (holds) this.heldTravel = this.travel(true).slice();
    else if (this.shown && this.display?.inPlace) this.placeGroups(this.shown);
  }

  /**
   * Bounds of all placements, in the scene's space, from the joints. Empty for a character without skin and skeleton.
   */
  bounds(out: Box3): Box3 {
    out.makeEmpty();
    for (let p = 0; p < this.groups.length; p++) out.union(this.boundsAt(p, placedBox));
    return out;
  }

  /** Bounds of one placement. */
  boundsAt(placement: number, out: Box3): Box3 {
    const group = this.groups[placement];
    return group ? out.copy(this.localBox).applyMatrix4(group.matrix) : out.makeEmpty();
  }

  /** A copy of `drawnVertices`. */
  vertices(): Float64Array {
    return this.drawnVertices.slice();
  }

  /**
   * The skin's vertices as drawn, x y z each, in the character's own space; empty without a skin. Computed once in each
   * pose: read-only.
   */
  get drawnVertices(): Float64Array {
    this.verticesNow ??= this.computeVertices();
    return this.verticesNow;
  }

  private computeVertices(): Float64Array {
    if (this.building) runToEnd(this.building);
    const mesh = this.skin?.meshes[0];
    if (!mesh) return new Float64Array(0);
    const count = vertexCount(mesh.shared.skin);
    const out = new Float64Array(3 * count);
    for (let v = 0; v < count; v++) {
      mesh.getVertexPosition(v, vertex);
      out[3 * v] = vertex.x;
      out[3 * v + 1] = vertex.y;
      out[3 * v + 2] = vertex.z;
    }
    return out;
  }

  /**
   * Completes what `show` postponed: converts a large skin in slices, uploads it over several frames, compiles its
   * shader asynchronously, then shows it. Small skins are already done. Resolves early if the skin is replaced
   * meanwhile. Repeated calls share one preparation.
   *
   * @param onProgress progress, 0 to 1
   */
  prepare(onProgress?: (done: number) => void): Promise<void> {
    const { skin } = this;
    if (!skin || skin.isShown) return Promise.resolve();
    this.preparing ??= this.prepareSkin(skin, onProgress);
    return this.preparing;
  }

  private async prepareSkin(skin: ShownSkin, onProgress?: (done: number) => void): Promise<void> {
    const { renderer, building } = this;
    const { signal } = this.skinLife;
    if (building) await runInSlices(building, signal, (done) => onProgress?.(done / 2));
    if (signal.aborted) return;
    const { uploads } = skin;
    if (renderer && uploads) {
      const { geometry, textures } = uploads;
      await uploadInFrames(renderer, geometry, textures, signal, (done) => onProgress?.(0.5 + done / 2));
      if (!signal.aborted) await this.compileAside(renderer);
    }
    if (signal.aborted) return;
    skin.reveal();
    this.preparing = undefined;
    onProgress?.(1);
    this.events.redraw?.();
  }

  dispose(): void {
    this.dropSkin();
    this.textures.dispose();
    this.object.removeFromParent();
    this.object.clear();
    this.groups = [];
    this.boneSet = undefined;
    this.player = undefined;
    this.shown = undefined;
  }

  private rebuildPlacements(count: number): void {
    for (const group of this.groups.slice(count)) group.removeFromParent();
    this.groups = Array.from({ length: count }, (_, i) => {
      const group = this.groups[i] ?? new Group();
      group.matrixAutoUpdate = false;
      if (group.parent !== this.object) this.object.add(group);
      return group;
    });
  }

  private rebuildBones(character: Character): void {
    this.boneSet?.root?.removeFromParent();
    this.boneSet = character.skeleton && new Bones(character.skeleton);
    const root = this.boneSet?.root;
    if (!root) return;
    // Bones draw nothing: invisible, they are skipped in every render pass.
    root.visible = false;
    this.object.add(root);
  }

  private rebuildSkin(character: Character, model: Skin | undefined): void {
    this.dropSkin();
    if (!model) return;
    const { boneSet, localSphere, localBox } = this;
    const skin = new ShownSkin(this.skins, model, character.morphs, boneSet, localSphere, localBox);
    skin.setVisible(this.isVisible);
    skin.setTint(this.tint && STAGE_THEMES[this.theme][this.tint]);
    skin.onLater = () => this.events.redraw?.();
    skin.setTextures(this.textures.decoded);
    this.skin = skin;
    this.building = this.bring(skin);
    if (sizeOf(model, character.morphs) > BUILT_AT_ONCE) return;
    runToEnd(this.building);
    skin.reveal();
  }

  private *bring(skin: ShownSkin): Steps<void> {
    yield* skin.build();
    this.building = undefined;
    skin.place(this.groups);
    if (this.display) skin.show(this.display, this.heat);
    this.seek(this.timeSeconds);
  }

  private dropSkin(): void {
    if (!this.skin) return;
    this.skinLife.abort();
    this.skinLife = new AbortController();
    this.building = undefined;
    this.preparing = undefined;
    this.skin?.dispose();
    this.skin = undefined;
  }

  private placeGroups(character: Character): void {
    const travel = this.travel(this.display?.inPlace ?? false);
    for (let p = 0; p < this.groups.length; p++) {
      const group = this.groups[p];
      placementMatrix(character.placements[p], character.space, travel, matrix);
      group.matrix.fromArray(matrix);
      group.matrixWorldNeedsUpdate = true;
    }
    this.skin?.followGroups();
  }

  /** Compiles the surface's shader for the lights of its scene. */
  private async compileAside(renderer: WebGLRenderer): Promise<void> {
    const mesh = this.skin?.meshes[0];
    let scene = this.object.parent;
    while (scene?.parent) scene = scene.parent;
    if (mesh) await renderer.compileAsync(mesh, new PerspectiveCamera(), scene instanceof Scene ? scene : null);
  }
}

/** Cost of building a skin, in vertices. */
function sizeOf(skin: Skin, morphs: readonly Morph[]): number {
  return morphs.reduce((sum, { positions, normals }) => {
    return sum + (positions.indices.length + normals.indices.length) / 4;
  }, vertexCount(skin));
}
