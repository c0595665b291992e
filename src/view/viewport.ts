/**
 * The workbench's view of the document: with what is under the pointer, the axis widget, what tools draw, and what draws
 * pictures of another size. It reports facts and never edits the document.
 */
import { Box3, Vector3 } from 'three';
import type { Vec3 } from '../math/vec3.ts';
import type { Character } from '../model/document.ts';
import { Eye } from './camera/eye.ts';
import { Orientation } from './camera/orientation.ts';
import type { ShotParts } from './camera/shots.ts';
import type { Look } from './look.ts';
import type { Overlay } from './overlay.ts';
import { Pointing } from './picking/pointing.ts';
import { type FramedTimes, type ShownCharacter, vertexPosition } from './shown-characters.ts';
import { STAGE_THEMES, type ThemeName } from './theme.ts';
import { View, type ViewEvents } from './view.ts';

export class Viewport extends View {
  /** Converts between points of the page and of the scene. */
  readonly eye: Eye;
  readonly pointing: Pointing;
  private readonly orientation: Orientation;
  private readonly box = new Box3();
  private readonly point = new Vector3();

  /** Arguments as of `View`, with a context of its own. */
  constructor(container: HTMLElement, inFrame: (draw: (nowMs: number) => void) => () => void, events: ViewEvents = {}) {
    super(container, inFrame, events);
    const { canvas, rig, screen, shown, camera } = this;
    this.eye = new Eye(canvas, rig);
    this.orientation = new Orientation((side) => camera.lookFrom(side));
    this.pointing = new Pointing(screen, shown, rig, {
      update: () => this.update(),
      redraw: () => this.requestRender(),
    });
    container.append(this.orientation.element);
  }

  /** Makes ready what `show` and framing will need of a character that is about to be added: see `ShownCharacters`. */
  prepare(character: Character, times: FramedTimes): void {
    const { characters, display, timeSeconds } = this.shown;
    this.tryShow(() => characters.prepareView(character, display, timeSeconds, times));
  }

  /** Draws a character in another way than the display says; undefined: all as it says. */
  setLook(look: Look | undefined): void {
    this.tryShow(() => this.shown.setLook(look));
  }

  /** Takes the size of its element at once: framing that waits for the next frame is then for that size. */
  fitScreen(): void {
    this.screen.fit();
  }

  override setTheme(name: ThemeName): void {
    super.setTheme(name);
    this.orientation.setTheme(STAGE_THEMES[name]);
  }

  /**
   * Sets what the skin style `four` shows of a character: 0 to 1 per vertex of its shown skin. Kept by reference: call
   * again when they have changed, and after an edit that replaces the skin.
   */
  heatSkin(characterId: string, values: Float32Array): void {
    this.shown.characters.get(characterId)?.view.heatSkin(values);
    this.requestRender();
  }

  /** Adds a tool's overlay. Returns a function that removes and disposes of it. */
  addOverlay(overlay: Overlay): () => void {
    return this.shown.addOverlay(overlay);
  }

  /**
   * From a character's own space to the world, column-major, as in the next frame; undefined if it isn't shown.
   * Overwritten each frame: copy what you keep.
   */
  placementOf(characterId: string, placement: number): Float64Array | undefined {
    const entry = this.shown.characters.seen(characterId);
    this.update();
    return entry?.placements.subarray(16 * placement, 16 * placement + 16);
  }

  /** Size of an instance of a character along the scene's axes, as drawn now; undefined if nothing is drawn. */
  sizeOf(characterId: string, placement: number): Vec3 | undefined {
    const box = this.shown.characters.get(characterId)?.view.boundsAt(placement, this.box);
    return box && !box.isEmpty() ? box.getSize(this.point).toArray() : undefined;
  }

  /** World position of a skin's vertex as drawn; undefined if there is none. */
  vertexAt(characterId: string, vertex: number, placement: number): Vec3 | undefined {
    const entry = this.shown.characters.seen(characterId);
    this.update();
    return entry && vertexPosition(entry, vertex, placement, this.point) ? this.point.toArray() : undefined;
  }

  /** A character whose skin is drawn, as it is now, for `insideSkin`: the first picture on screen does without that. */
  withDrawnSkin(characterId: string): ShownCharacter | undefined {
    const { characters, pickableSkins } = this.shown;
    if (!pickableSkins.some((skin) => skin.characterId === characterId)) return undefined;
    this.update();
    return characters.seen(characterId);
  }

  /** The instance of a character that is edited, as an index into its placements. */
  pickedCopy(character: Pick<Character, 'id' | 'placements'>): number {
    return this.shown.picked.of(character);
  }

  /**
   * For drags: freezes the root motion offset of *in place*, even while the root is dragged, and pauses following of
   * joints. Returns a function that ends both.
   */
  freezeRootMotion(characterId: string): () => void {
    const view = this.shown.characters.get(characterId)?.view;
    const release = this.follower.hold();
    view?.freezeRootMotion(true);
    let isFrozen = true;
    return () => {
      if (!isFrozen) return;
      isFrozen = false;
      release();
      view?.freezeRootMotion(false);
      this.shown.move();
    };
  }

  /** World spacing of the grid's finest lines, as last drawn; undefined while it is hidden. */
  get gridStep(): number | undefined {
    const { grid } = this.shown;
    return grid.object.visible ? grid.step : undefined;
  }

  /** What draws pictures of another size, for `beginShots`: the first picture on screen does without that. */
  get shotParts(): ShotParts {
    const { screen, shown, rig, redraw } = this;
    return { screen, shown, rig, redraw, update: () => this.update() };
  }

  override dispose(): void {
    this.pointing.dispose();
    super.dispose();
    this.orientation.element.remove();
  }

  protected override settle(): void {
    this.pointing.settle();
    this.orientation.update(this.rig.camera);
  }
}
