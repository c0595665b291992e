/**
 * Draws the document: everything three.js, behind one class. Two paths:
 *
 *     after an edit     show()    compares identities: which characters were added, removed or changed
 *     every frame       seek()    poses characters; draw() fills matrices and draws, only if something changed
 *
 * It reports facts (what was hit, where joints are) and never edits the document. Its parts, each of which knows only
 * those before it; the page has `camera` and `pointing`:
 *
 *     Screen          the canvas, its size and its context
 *     ShownDocument   what is drawn
 *     CameraRig       from where; Framer, JointFollower and ViewCamera move it
 *     Pointing        what is under the pointer
 *     Redraw          when
 */
import { Box3, Vector3 } from 'three';
import type { Vec3 } from '../math/vec3.ts';
import type { Character, Document } from '../model/document.ts';
import type { Texture } from '../model/files.ts';
import type { Display, Selection } from '../model/session.ts';
import { CameraRig } from './camera/camera.ts';
import { Eye } from './camera/eye.ts';
import { Framer } from './camera/framer.ts';
import { JointFollower } from './camera/joint-follower.ts';
import { Orientation } from './camera/orientation.ts';
import type { ShotParts } from './camera/shots.ts';
import { ViewCamera } from './camera/view-camera.ts';
import { type CharacterFacts, factsOf } from './character-facts.ts';
import type { Look } from './look.ts';
import type { Annotations } from './names/annotations.ts';
import type { Overlay } from './overlay.ts';
import { Pointing } from './picking/pointing.ts';
import { Redraw } from './redraw.ts';
import { type FrameStats, Screen } from './screen.ts';
import { type ShownCharacter, vertexPosition } from './shown-characters.ts';
import { ShownDocument } from './shown-document.ts';
import { NO_TINTS, STAGE_THEMES, type ThemeName } from './theme.ts';

export interface ViewportEvents {
  /** A skin's texture can't be decoded; the skin is drawn untextured. */
  textureFailed?(characterId: string, texture: Texture, message: string): void;
  /** The picture can't be drawn; nothing is until `show` is called with something else to draw. */
  drawingFailed?(error: unknown): void;
}

export class Viewport {
  readonly canvas: HTMLCanvasElement;
  /** Converts between points of the page and of the scene. */
  readonly eye: Eye;
  readonly camera: ViewCamera;
  readonly pointing: Pointing;
  private readonly screen: Screen;
  private readonly shown: ShownDocument;
  private readonly rig: CameraRig;
  private readonly framer: Framer;
  private readonly follower = new JointFollower();
  private readonly orientation: Orientation;
  private readonly redraw: Redraw;
  private readonly box = new Box3();
  private readonly point = new Vector3();

  /**
   * Fills `container` at any size.
   *
   * @param inFrame makes of `draw` a request for the next frame, which calls it once, when the time of that frame and all
   * that follows it is decided
   * @throws Error if the browser has no WebGL2
   */
  constructor(
    container: HTMLElement,
    inFrame: (draw: (nowMs: number) => void) => () => void,
    events: ViewportEvents = {},
  ) {
    const drawingFailed = (error: unknown) => events.drawingFailed?.(error);
    const redraw = () => this.requestRender();
    this.redraw = new Redraw(inFrame, (nowMs) => this.draw(nowMs), drawingFailed);
    this.screen = new Screen(container, {
      resized: (width, height, ratio) => this.resize(width, height, ratio),
      fitted: () => {
        if (this.shown.document) this.redraw.tryNow(performance.now());
      },
      shaderFailed: drawingFailed,
      contextLost: () => this.shown.forget(),
      contextRestored: () => {
        // three.js recreates everything; it only has to be drawn again.
        this.redraw.retry();
        this.shown.move();
      },
    });
    const { screen } = this;
    this.canvas = screen.canvas;
    this.shown = new ShownDocument(screen, {
      redraw,
      textureFailed: (id, texture, message) => events.textureFailed?.(id, texture, message),
    });
    const { shown } = this;
    this.rig = new CameraRig(this.canvas, redraw);
    this.eye = new Eye(this.canvas, this.rig);
    this.framer = new Framer(this.rig, shown.characters, shown.skeletons, shown.picked);
    const frame = { update: () => this.update(), redraw };
    this.camera = new ViewCamera(this.rig, this.framer, shown, frame);
    this.orientation = new Orientation((side) => this.camera.lookFrom(side));
    this.pointing = new Pointing(screen, shown, this.rig, frame);
    if (getComputedStyle(container).position === 'static') container.style.position = 'relative';
    container.append(this.canvas, this.orientation.element);
    this.setTheme('dark');
    screen.fill();
  }

  /** Call after an edit, with the current document, selection and display. */
  show(document: Document, selection: Selection, display: Display, tints = NO_TINTS): void {
    const { shown } = this;
    this.tryShow(() => {
      // The first characters, or ones that replace everything, get the default view. Framing of further ones is up to
      // the caller.
      if (shown.isReplacedBy(document)) this.framer.lookFirst();
      shown.show(document, selection, display, tints);
      this.rig.setOrthographic(display.orthographic);
    });
  }

  /** Makes ready what `show` will need of a character that is about to be added: see `ShownCharacters`. */
  prepare(character: Character): void {
    const { characters, display, timeSeconds } = this.shown;
    this.tryShow(() => characters.prepareView(character, display, timeSeconds));
  }

  /** Draws a character in another way than the display says; undefined: all as it says. */
  setLook(look: Look | undefined): void {
    this.tryShow(() => this.shown.setLook(look));
  }

  /** Poses every character at a time of the transport. Values are right at once; drawing follows. */
  seek(timeSeconds: number): void {
    this.shown.seek(timeSeconds);
  }

  /** Requests a redraw with the next frame; several requests draw once. */
  requestRender(): void {
    this.redraw.request();
  }

  /** Draws names, motion paths and ghosts from now on. Given, not made here: the first picture does without. */
  annotate(create: (...parts: ConstructorParameters<typeof Annotations>) => Annotations): void {
    const { shown, screen } = this;
    const annotations = create(shown.characters, () => this.requestRender());
    this.canvas.after(annotations.labels.canvas);
    annotations.labels.resize(screen.width, screen.height, screen.renderer.getPixelRatio());
    shown.annotate(annotations);
  }

  /** Takes the size of its element at once: framing that waits for the next frame is then for that size. */
  fitScreen(): void {
    this.screen.fit();
  }

  setTheme(name: ThemeName): void {
    this.shown.setTheme(name);
    this.orientation.setTheme(STAGE_THEMES[name]);
  }

  /** Playback range in seconds of the transport: covered by motion paths and by framing everything. */
  setPlayedRange(range: readonly [number, number]): void {
    this.shown.setPlayedRange(range);
  }

  /** Frame rate for takes without frames of their own: for ghosts that are frames apart. */
  setFramesPerSecond(framesPerSecond: number): void {
    this.shown.setFramesPerSecond(framesPerSecond);
  }

  character(id: string): CharacterFacts | undefined {
    const view = this.shown.characters.get(id)?.view;
    return view && factsOf(view);
  }

  stats(): FrameStats {
    return this.screen.stats;
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

  /** The scene's y of the floor: of its grid and the shadow on it. */
  setFloor(y: number): void {
    const { grid, stage } = this.shown;
    grid.floor = stage.floor = y;
    this.requestRender();
  }

  /** What draws pictures of another size, for `beginShots`: the first picture on screen does without that. */
  get shotParts(): ShotParts {
    const { screen, shown, rig, redraw } = this;
    return { screen, shown, rig, redraw, update: () => this.update() };
  }

  dispose(): void {
    const { redraw, pointing, shown, rig, screen, orientation } = this;
    redraw.end();
    for (const part of [pointing, shown, rig, screen]) part.dispose();
    orientation.element.remove();
  }

  private tryShow(show: () => void): void {
    this.redraw.retry();
    try {
      show();
    } catch (error) {
      // Whoever edits must not fail for the picture's sake.
      this.redraw.fail(error);
    }
  }

  private resize(width: number, height: number, ratio: number): void {
    const { grid, annotations } = this.shown;
    grid.setPixelRatio(ratio);
    annotations?.labels.resize(width, height, ratio);
    this.rig.resize(width, height);
  }

  /** Updates the matrices of everything drawn from the current poses, and the camera that follows a joint. */
  private update(): void {
    const { shown, follower } = this;
    if (!shown.update()) return;
    const { display, selection, characters, picked, skeletons } = shown;
    const followed = followedBy(display, selection);
    const { visible } = characters;
    const only = followed === 'root' && visible.length === 1 ? visible[0] : undefined;
    const character = followed === undefined ? undefined : (characters.seen(selection.characterId) ?? only)?.character;
    follower.follow(character, character ? picked.of(character) : 0, followed, skeletons, this.rig);
  }

  /** @throws whatever three.js does */
  private draw(nowMs: number): void {
    const { screen, shown, rig, framer, orientation } = this;
    const { stage, grid, display, characters } = shown;
    if (!screen.canDraw) return;
    this.update();
    framer.settle(shown.playedRange, shown.timeSeconds, display.followRoot);
    // The camera that follows, or frames something, has moved for this frame; one that travels moves for the next, too.
    this.redraw.include();
    rig.tick(nowMs);
    rig.fitDepth(characters.content, display.grid);
    const { camera } = rig;
    if (display.grid) grid.update(rig);
    stage.light(camera);
    stage.fitShadow(characters.content, rig.target, rig.distance);
    this.pointing.settle();
    shown.updateOverlays(camera, screen.height);
    screen.renderer.info.reset();
    screen.renderer.render(stage.scene, camera);
    shown.drawLabels(camera);
    orientation.update(camera);
  }
}

/** What the camera follows: a selected joint before the root. */
function followedBy({ follow, followRoot }: Display, { joint }: Selection): number | 'root' | undefined {
  if (follow && joint !== undefined) return joint;
  return followRoot ? 'root' : undefined;
}
