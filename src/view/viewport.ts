/**
 * Draws the document: everything three.js, behind one class. Two paths:
 *
 *     after an edit     show()    compares identities: which characters were added, removed or changed
 *     every frame       seek()    poses characters; draw() fills matrices and draws, only if something changed
 *
 * It reports facts (what was hit, where joints are) and never edits the document.
 */
import { Box3, Group, SRGBColorSpace, Vector3, WebGLRenderer } from 'three';
import type { Vec3 } from '../math/vec3.ts';
import type { Character, Document } from '../model/document.ts';
import { characterIdOf } from '../model/drawn-id.ts';
import type { Texture } from '../model/files.ts';
import { DEFAULT_DISPLAY, type Display, NOTHING_SELECTED, type Selection } from '../model/session.ts';
import { CameraRig, type CameraView, type ViewDirection } from './camera.ts';
import { type CharacterFacts, factsOf } from './character-facts.ts';
import { CharacterView } from './character-view.ts';
import { haveSameJoints, type JointRef, type PosedSkeleton } from './drawn-skeletons.ts';
import { Eye } from './eye.ts';
import { Framer } from './framer.ts';
import { Grid } from './grid.ts';
import { Hovering } from './hovering.ts';
import { JointFollower } from './joint-follower.ts';
import type { LabelCover } from './label-cover.ts';
import { Labels } from './labels.ts';
import type { Look } from './look.ts';
import { MotionDrawing } from './motion-drawing.ts';
import { Orientation } from './orientation.ts';
import { type Overlay, Overlays } from './overlay.ts';
import { PickedCopy } from './picked-copy.ts';
import { type Hit, Picker, type PickScene } from './picking.ts';
import { shaderError } from './shader-error.ts';
import { type ShownCharacter, ShownCharacters, vertexPosition } from './shown-characters.ts';
import { isOpaque, SkeletonDrawing } from './skeleton-drawing.ts';
import { Stage } from './stage.ts';
import { NO_TINTS, STAGE_THEMES, type ThemeName, type Tints } from './theme.ts';
import { LINE_RESOLUTION } from './thick-lines.ts';
import { VertexMarker } from './vertex-marker.ts';

export type { Hit } from './picking.ts';

export interface ViewportEvents {
  /** A skin's texture can't be decoded; the skin is drawn untextured. */
  textureFailed?(characterId: string, texture: Texture, message: string): void;
  /** The picture can't be drawn; nothing is until `show` is called with something else to draw. */
  drawingFailed?(error: unknown): void;
}

/** What is drawn into a picture besides the characters, and its size in pixels. */
export interface ShotOptions {
  readonly width: number;
  readonly height: number;
  /** Otherwise it is transparent. */
  readonly hasBackground: boolean;
  /** Also if the grid is shown. */
  readonly hasGrid: boolean;
  /** Gizmos, pins, names and what marks the selection. */
  readonly hasTools: boolean;
}

/** Pictures being drawn: see `Viewport.beginShots`. */
export interface Shots {
  /** What a picture consists of, the lowest first. */
  readonly canvases: readonly HTMLCanvasElement[];
  /**
   * Draws characters at a time of the transport. What is on the canvases must be read before the task ends.
   *
   * @throws Error if the browser has lost the canvas
   */
  draw(timeSeconds: number): void;
  /** Shows everything as before. */
  end(): void;
}

/** Of the last frame drawn. */
export interface FrameStats {
  readonly drawCalls: number;
  readonly triangles: number;
  /** On the GPU. */
  readonly geometries: number;
  readonly textures: number;
}

const MAX_PIXELS_PER_PIXEL = 2;
const EVERYTHING = { hasBackground: true, hasGrid: true, hasTools: true };

export class Viewport {
  readonly canvas: HTMLCanvasElement;
  private readonly renderer: WebGLRenderer;
  private readonly stage: Stage;
  private readonly rig: CameraRig;
  private readonly grid = new Grid();
  private readonly skeletons = new SkeletonDrawing();
  private readonly vertexMarker = new VertexMarker();
  private readonly follower = new JointFollower();
  private readonly picked = new PickedCopy();
  private readonly labels = new Labels();
  private labelCover: LabelCover | undefined;
  private readonly orientation: Orientation;
  private readonly picker: Picker;
  private readonly overlays: Overlays;
  /** What tools draw, and the marked vertex. */
  private readonly tools = new Group();
  /** Converts between points of the page and of the scene. */
  readonly eye: Eye;
  private readonly resizing: ResizeObserver;
  private readonly characters: ShownCharacters;
  private readonly motion: MotionDrawing;
  private readonly framer: Framer;
  private readonly listening = new AbortController();

  private document: Document | undefined;
  private display: Display = DEFAULT_DISPLAY;
  private selection: Selection = NOTHING_SELECTED;
  private tints: Tints = NO_TINTS;
  private look: Look | undefined;
  private themeName: ThemeName = 'dark';
  private timeSeconds = 0;
  private width = 0;
  private height = 0;
  private isStale = false;
  /** What is shown can't be drawn: trying again in each frame would fail again. */
  private hasFailed = false;
  private shooting: ShotOptions | undefined;
  private readonly requestDraw: () => void;
  private disposed = false;
  /** Poses or the set of characters have changed since the last frame. */
  private posesChanged = true;
  private readonly hovering = new Hovering();
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
    private readonly container: HTMLElement,
    inFrame: (draw: (nowMs: number) => void) => () => void,
    private readonly events: ViewportEvents = {},
  ) {
    this.requestDraw = inFrame((nowMs) => {
      if (this.isStale) this.tryDraw(nowMs);
    });
    this.renderer = new WebGLRenderer({ antialias: true, stencil: false, powerPreference: 'high-performance' });
    const { renderer } = this;
    this.canvas = renderer.domElement;
    this.canvas.style.cssText =
      'display:block;position:absolute;inset:0;width:100%;height:100%;object-fit:contain;touch-action:none';
    renderer.outputColorSpace = SRGBColorSpace;
    // Counted over a whole frame, which has several passes.
    renderer.info.autoReset = false;
    renderer.debug.onShaderError = (gl, program, vertex, fragment) => {
      // Without a context nothing compiles, and all of it does once it is restored. The program is WebGL's: the types
      // name three.js's own class.
      if (!gl.isContextLost())
        this.events.drawingFailed?.(shaderError(gl, program as WebGLProgram, [vertex, fragment]));
    };
    this.stage = new Stage(renderer);
    this.picker = new Picker(renderer);
    this.rig = new CameraRig(this.canvas, () => this.requestRender());
    this.orientation = new Orientation((side) => this.lookFrom(side));
    this.eye = new Eye(this.canvas, this.rig);
    const { scene, content } = this.stage;
    this.overlays = new Overlays(this.tools);
    this.characters = new ShownCharacters(
      content,
      (id) => this.createView(id),
      (entry) => this.prepare(entry),
    );
    this.motion = new MotionDrawing(this.characters);
    this.framer = new Framer(this.rig, this.characters, this.skeletons, this.picked);
    this.tools.add(this.vertexMarker.object);
    scene.add(this.grid.object, this.skeletons.object, this.motion.object, this.tools);

    if (getComputedStyle(container).position === 'static') container.style.position = 'relative';
    container.append(this.canvas, this.labels.canvas, this.orientation.element);
    this.setTheme('dark');
    this.resizing = new ResizeObserver(() => this.fitContainer());
    this.resizing.observe(container);
    this.fitContainer();
    this.listen();
  }

  /** Call after an edit, with the current document, selection and display. */
  show(document: Document, selection: Selection, display: Display, tints = NO_TINTS): void {
    this.hasFailed = false;
    try {
      this.showAll(document, selection, display, tints);
    } catch (error) {
      // Whoever edits must not fail for the picture's sake.
      this.fail(error);
    }
  }

  private showAll(document: Document, selection: Selection, display: Display, tints: Tints): void {
    const before = this.document;
    const { characters } = this;
    const heatChanged =
      selection.joint !== this.selection.joint || selection.characterId !== this.selection.characterId;
    const everything = display !== this.display || heatChanged;
    const stay = new Set(document.characters.map((c) => c.id));
    const known = before?.characters.some((c) => stay.has(c.id)) ?? false;
    this.document = document;
    this.selection = selection;
    this.picked.follow(selection);
    this.display = display;
    characters.show(document, display, selection, this.timeSeconds, everything, this.look);
    this.tints = tints;
    for (const { view, character } of characters.all) view.setTint(tints.get(character.id));
    // The first characters, or ones that replace everything, get the default view. Framing of further ones is up to the
    // caller.
    if (!known && document.characters.length > 0) this.framer.lookFirst();
    this.rig.setOrthographic(display.orthographic);
    this.stage.setShadow(display.shadow);
    this.grid.object.visible = display.grid;
    this.showSkeletons();
    this.motion.show(selection, display);
    this.posesChanged = true;
    this.requestRender();
  }

  /** Draws a character in another way than the display says; undefined: all as it says. */
  setLook(look: Look | undefined): void {
    const { document, selection, display, tints } = this;
    this.look = look;
    // Another object, so that all characters are shown anew.
    this.display = { ...display };
    if (document) this.show(document, selection, display, tints);
  }

  /** Poses every character at a time of the transport. Values are right at once; drawing follows. */
  seek(timeSeconds: number): void {
    this.timeSeconds = timeSeconds;
    this.characters.seek(timeSeconds);
    this.posesChanged = true;
    this.requestRender();
  }

  /** Requests a redraw with the next frame; several requests draw once. */
  requestRender(): void {
    if (this.disposed) return;
    this.isStale = true;
    this.requestDraw();
  }

  /** What is under a point of the page, by the document's ids; a character alone under its name. */
  pick(clientX: number, clientY: number): Hit | undefined {
    const scene = this.pickScene();
    if (!scene) return undefined;
    const { left, top } = this.canvas.getBoundingClientRect();
    const named = this.labels.characterAt(clientX - left, clientY - top);
    const hit =
      named === undefined
        ? this.picker.pick(scene, clientX - left, clientY - top)
        : { characterId: named, placement: 0 };
    return hit && { ...hit, characterId: characterIdOf(hit.characterId) };
  }

  /** Highlights a joint as if under the pointer, for rows of lists; undefined for none. */
  hover(joint: JointRef | undefined): void {
    if (this.highlight(joint)) this.requestRender();
  }

  /** The highlighted joint, by the document's ids. */
  get hovered(): JointRef | undefined {
    const { joint } = this.hovering;
    return joint && { ...joint, characterId: characterIdOf(joint.characterId) };
  }

  /** Calls back when `hovered` changes. Returns an unsubscribe function. */
  onHover(listener: () => void): () => void {
    return this.hovering.subscribe(listener);
  }

  /** Whether a tool has captured the pointer: no joint is highlighted meanwhile. */
  takePointer(isTaken: boolean): void {
    this.hovering.isTaken = isTaken;
    if (isTaken) this.hover(undefined);
  }

  /** Sets what finds the names of joints behind skins and boxes. Given, not made here: the first picture does without. */
  coverLabels(cover: LabelCover): void {
    this.labelCover = cover;
    this.requestRender();
  }

  /** Sets the function that returns how many CSS pixels at the top are covered by overlays, for framing. */
  keepClear(coveredTop: () => number): void {
    this.framer.coveredTop = coveredTop;
  }

  /** Frames everything. */
  frameAll(): void {
    this.framer.frameAll();
    this.requestRender();
  }

  /** Frames the selected vertex or joint of the picked instance, or the character with its motion; else everything. */
  frameSelection(selection: Selection): void {
    this.update();
    this.framer.frameSelection(selection, this.motion.playedRange, this.timeSeconds);
    this.requestRender();
  }

  /** Frames these characters with the next frame, with room for their motion, unless they are well in view. */
  reveal(...characterIds: readonly string[]): void {
    this.framer.reveal(characterIds);
    this.requestRender();
  }

  lookFrom(side: ViewDirection): void {
    this.rig.lookFrom(side);
  }

  /** The current view, or the one being moved to. */
  get cameraView(): CameraView {
    return this.rig.view;
  }

  /** Sets the view at once and cancels pending framing. */
  set cameraView(view: CameraView) {
    this.framer.leave();
    this.rig.view = view;
  }

  setTheme(name: ThemeName): void {
    this.themeName = name;
    const theme = STAGE_THEMES[name];
    this.stage.setTheme(theme, this.renderer);
    this.grid.setTheme(theme);
    this.labels.setTheme(theme);
    this.orientation.setTheme(theme);
    this.motion.setTheme(theme);
    this.vertexMarker.setTheme(theme);
    this.overlays.setTheme(theme);
    for (const { view } of this.characters.all) view.setTheme(name);
    this.showSkeletons();
    this.requestRender();
  }

  /** Playback range in seconds of the transport: covered by motion paths and by framing everything. */
  setPlayedRange(range: readonly [number, number]): void {
    const { motion, selection, display } = this;
    if (range[0] === motion.playedRange[0] && range[1] === motion.playedRange[1]) return;
    motion.playedRange = range;
    motion.show(selection, display);
    this.posesChanged = true;
    this.requestRender();
  }

  /** Frame rate for clips without frames of their own: for ghosts that are frames apart. */
  setFramesPerSecond(framesPerSecond: number): void {
    if (framesPerSecond === this.motion.framesPerSecond) return;
    this.motion.framesPerSecond = framesPerSecond;
    this.posesChanged = true;
    this.requestRender();
  }

  character(id: string): CharacterFacts | undefined {
    const view = this.characters.get(id)?.view;
    return view && factsOf(view);
  }

  stats(): FrameStats {
    const { render, memory } = this.renderer.info;
    return { drawCalls: render.calls, triangles: render.triangles, ...memory };
  }

  /**
   * Sets what the skin style `four` shows of a character: 0 to 1 per vertex of its shown skin. Kept by reference: call
   * again when they have changed, and after an edit that replaces the skin.
   */
  heatSkin(characterId: string, values: Float32Array): void {
    this.characters.get(characterId)?.view.heatSkin(values);
    this.requestRender();
  }

  /** Adds a tool's overlay. Returns a function that removes and disposes of it. */
  addOverlay(overlay: Overlay): () => void {
    const remove = this.overlays.add(overlay, STAGE_THEMES[this.themeName]);
    this.requestRender();
    return () => {
      remove();
      this.requestRender();
    };
  }

  /**
   * From a character's own space to the world, column-major, as in the next frame; undefined if it isn't shown.
   * Overwritten each frame: copy what you keep.
   */
  placementOf(characterId: string, placement: number): Float64Array | undefined {
    const entry = this.characters.seen(characterId);
    this.update();
    return entry?.placements.subarray(16 * placement, 16 * placement + 16);
  }

  /** Size of an instance of a character along the scene's axes, as drawn now; undefined if nothing is drawn. */
  sizeOf(characterId: string, placement: number): Vec3 | undefined {
    const box = this.characters.get(characterId)?.view.boundsAt(placement, this.box);
    return box && !box.isEmpty() ? box.getSize(this.point).toArray() : undefined;
  }

  /** The instance of a character that is edited, as an index into its placements. */
  pickedCopy(character: Pick<Character, 'id' | 'placements'>): number {
    return this.picked.of(character);
  }

  /**
   * For drags: freezes the root motion offset of *in place*, even while the root is dragged, and pauses following of
   * joints. Returns a function that ends both.
   */
  freezeRootMotion(characterId: string): () => void {
    const view = this.characters.get(characterId)?.view;
    const release = this.follower.hold();
    view?.freezeRootMotion(true);
    let isFrozen = true;
    return () => {
      if (!isFrozen) return;
      isFrozen = false;
      release();
      view?.freezeRootMotion(false);
      this.posesChanged = true;
      this.requestRender();
    };
  }

  /** World position of a skin's vertex as drawn; undefined if there is none. */
  vertexAt(characterId: string, vertex: number, placement: number): Vec3 | undefined {
    const entry = this.characters.seen(characterId);
    this.update();
    return entry && vertexPosition(entry, vertex, placement, this.point) ? this.point.toArray() : undefined;
  }

  /** Orbits about the target; radians, positive moves the camera to the right. */
  turnView(azimuth: number): void {
    this.rig.turn(azimuth);
  }

  /** World spacing of the grid's finest lines, as last drawn; undefined while it is hidden. */
  get gridStep(): number | undefined {
    return this.grid.object.visible ? this.grid.step : undefined;
  }

  /**
   * Begins to draw pictures: at another size, in the same view, which keeps its height. Until `end`, characters and display must not change.
   *
   * @throws Error if the graphics card can't draw at that size
   */
  beginShots(options: ShotOptions): Shots {
    const { canvas, labels, renderer, rig, timeSeconds, height } = this;
    const { view } = rig;
    const ratio = options.height / height;
    const shoot = (shooting: ShotOptions | undefined) => {
      this.shooting = shooting;
      const { hasBackground, hasGrid, hasTools } = shooting ?? EVERYTHING;
      this.stage.setBackground(hasBackground, renderer);
      this.grid.object.visible = this.display.grid && hasGrid;
      this.tools.visible = hasTools;
      this.showSkeletons();
    };
    const end = () => {
      this.width = 0;
      shoot(undefined);
      this.seek(timeSeconds);
      this.update();
      // It may have followed a joint.
      if (!isSameView(rig.view, view)) rig.view = view;
      this.fitContainer();
    };
    this.hover(undefined);
    shoot(options);
    // Else rounding may lose a pixel.
    this.resize((options.width + 0.01) / ratio, (options.height + 0.01) / ratio, ratio);
    const { drawingBufferWidth, drawingBufferHeight } = renderer.getContext();
    if (drawingBufferWidth !== options.width || drawingBufferHeight !== options.height) {
      end();
      throw new Error(
        `This graphics card can't draw ${options.width} × ${options.height} pixels. Choose a smaller size.`,
      );
    }
    return {
      canvases: options.hasTools ? [canvas, labels.canvas] : [canvas],
      draw: (seconds) => {
        this.seek(seconds);
        this.draw(performance.now());
        if (renderer.getContext().isContextLost()) throw new Error('The browser has lost the canvas. Try again.');
      },
      end,
    };
  }

  dispose(): void {
    this.disposed = true;
    this.isStale = false;
    this.listening.abort();
    this.resizing.disconnect();
    const { characters, rig, grid, skeletons, motion, vertexMarker, overlays, picker, stage } = this;
    const parts = [characters, rig, grid, skeletons, motion, vertexMarker, overlays, picker, stage];
    for (const part of parts) part.dispose();
    this.renderer.dispose();
    for (const element of [this.canvas, this.labels.canvas, this.orientation.element]) element.remove();
  }

  private createView(id: string): CharacterView {
    const view = new CharacterView(this.renderer, {
      redraw: () => this.requestRender(),
      textureFailed: (texture, message) => this.events.textureFailed?.(id, texture, message),
    });
    view.setTheme(this.themeName);
    return view;
  }

  private prepare(entry: ShownCharacter): void {
    entry.view.prepare().then(
      () => {
        this.posesChanged = true;
        this.requestRender();
      },
      // Not awaited: errors are reported like those thrown while drawing.
      (error: unknown) => reportError(error),
    );
  }

  private listen(): void {
    const { canvas } = this;
    const { signal } = this.listening;
    canvas.addEventListener('webglcontextlost', () => this.stage.forget(), { signal });
    // three.js recreates everything when the context is restored; it only has to be drawn again.
    canvas.addEventListener(
      'webglcontextrestored',
      () => {
        this.posesChanged = true;
        this.hasFailed = false;
        this.requestRender();
      },
      { signal },
    );
    canvas.addEventListener(
      'pointermove',
      ({ buttons, pointerType, offsetX, offsetY }) => {
        const { hovering } = this;
        hovering.pointer = buttons === 0 && pointerType === 'mouse' ? { x: offsetX, y: offsetY } : undefined;
        if (hovering.pointer && this.canHover) this.requestRender();
      },
      { signal },
    );
    canvas.addEventListener(
      'pointerleave',
      () => {
        this.hovering.pointer = undefined;
        this.labels.hoverCharacter(undefined);
        this.hover(undefined);
        this.requestRender();
      },
      { signal },
    );
  }

  private fitContainer(): void {
    const { clientWidth: width, clientHeight: height } = this.container;
    if (width === 0 || height === 0 || this.shooting) return;
    const ratio = Math.min(window.devicePixelRatio || 1, MAX_PIXELS_PER_PIXEL);
    if (width === this.width && height === this.height && ratio === this.renderer.getPixelRatio()) return;
    this.resize(width, height, ratio);
    // Draw at once: a resized canvas is empty, and would flash.
    if (this.document) this.tryDraw(performance.now());
  }

  /** CSS pixels, and pixels of the canvas for each. */
  private resize(width: number, height: number, ratio: number): void {
    this.width = width;
    this.height = height;
    this.renderer.setDrawingBufferSize(width, height, ratio);
    LINE_RESOLUTION.value.set(width, height);
    this.grid.setPixelRatio(ratio);
    this.labels.resize(width, height, ratio);
    this.rig.resize(width, height);
  }

  private showSkeletons(): void {
    const { skeletons, display, selection, hovering } = this;
    const hovered = hovering.joint;
    const posed = this.characters.posedSkeletons(this.tints, this.look);
    const ofHovered = (all: readonly PosedSkeleton[]) =>
      all.find(({ characterId }) => characterId === hovered?.characterId)?.skeleton;
    // Its index would highlight another joint.
    if (hovered && !haveSameJoints(ofHovered(skeletons.drawn), ofHovered(posed))) {
      this.highlight(undefined);
    }
    const marked = this.shooting?.hasTools === false ? NOTHING_SELECTED : selection;
    skeletons.show(posed, display, marked, STAGE_THEMES[this.themeName]);
    this.labels.show(skeletons.drawn, display, selection, hovering.joint);
    this.posesChanged = true;
  }

  /** Updates the matrices of everything drawn from the current poses. */
  private update(): void {
    if (!this.posesChanged) return;
    this.posesChanged = false;
    const { display, selection, characters, skeletons } = this;
    characters.place(display.inPlace);
    skeletons.fill();
    const followed = display.follow ? characters.seen(selection.characterId)?.character : undefined;
    const copy = followed ? this.picked.of(followed) : 0;
    this.follower.follow(followed, copy, selection.joint, skeletons, this.rig);
    this.vertexMarker.mark(characters.seen(selection.characterId), selection.vertex);
    this.motion.fill(selection, display, this.timeSeconds);
  }

  private tryDraw(nowMs: number): void {
    this.isStale = false;
    if (this.hasFailed) return;
    try {
      this.draw(nowMs);
    } catch (error) {
      this.fail(error);
    }
  }

  private fail(error: unknown): void {
    this.hasFailed = true;
    this.events.drawingFailed?.(error);
  }

  /** @throws whatever three.js does */
  private draw(nowMs: number): void {
    this.isStale = false;
    const { renderer, rig, stage, grid, characters, display } = this;
    const { content } = characters;
    if (this.disposed || this.width === 0 || renderer.getContext().isContextLost()) return;
    this.update();
    this.framer.settle(this.motion.playedRange, this.timeSeconds);
    rig.tick(nowMs);
    rig.fitDepth(content, display.grid);
    const { camera } = rig;
    if (display.grid) grid.update(rig);
    stage.light(camera);
    stage.fitShadow(content, rig.target, rig.distance);
    this.hoverPointer();
    this.overlays.update(camera, this.height);
    renderer.info.reset();
    renderer.render(stage.scene, camera);
    this.labels.draw(camera, this.skeletons.positions, this.coverOfLabels());
    this.orientation.update(camera);
  }

  /** What covers joints whose names are drawn. */
  private coverOfLabels(): LabelCover | undefined {
    const { display, skeletons, labelCover, rig } = this;
    if (!display.names) return undefined;
    labelCover?.fill(skeletons.drawn, rig.camera, isOpaque(display.skin), skeletons.hasSolidBoxes);
    return labelCover;
  }

  private pickScene(): PickScene | undefined {
    if (this.width === 0 || this.renderer.getContext().isContextLost()) return undefined;
    this.update();
    this.stage.scene.updateMatrixWorld();
    const { display, rig, width, height, skeletons } = this;
    rig.camera.updateMatrixWorld();
    const skins = display.skin === 'hidden' ? [] : this.characters.skins(this.look);
    return { camera: rig.camera, width, height, skeletons, skins, skinsAreOpaque: isOpaque(display.skin) };
  }

  private get canHover(): boolean {
    const { boxes, bones, skin } = this.display;
    return boxes !== 'hidden' || bones || skin !== 'hidden';
  }

  /** Highlights the joint under the pointer, once per frame. */
  private hoverPointer(): void {
    const { hovering, picker } = this;
    const { pointer } = hovering;
    hovering.pointer = undefined;
    if (!pointer || hovering.isTaken || this.rig.handling || !this.canHover) return;
    const named = this.labels.characterAt(pointer.x, pointer.y);
    this.labels.hoverCharacter(named);
    const scene = named === undefined ? this.pickScene() : undefined;
    this.highlight(scene && hovering.jointAt(picker, scene, pointer.x, pointer.y));
  }

  /** Returns whether that changed anything. */
  private highlight(joint: JointRef | undefined): boolean {
    const { skeletons, hovering, labels, characters } = this;
    if (!skeletons.hover(joint)) return false;
    hovering.joint = joint;
    labels.show(skeletons.drawn, this.display, this.selection, joint);
    for (const { view, character } of characters.all) {
      view.hoveredPart.hoveredJoint.value = character.id === joint?.characterId ? joint.joint : -1;
    }
    hovering.changed();
    return true;
  }
}

function isSameView(a: CameraView, b: CameraView): boolean {
  const isSame = a.azimuth === b.azimuth && a.polar === b.polar && a.distance === b.distance;
  return isSame && a.target.every((x, i) => x === b.target[i]);
}
