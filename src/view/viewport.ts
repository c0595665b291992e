/**
 * The picture of the document: everything three.js, behind one class. Two paths:
 *
 *     after an edit     show()    compares identities: which characters came, went or changed
 *     every frame       seek()    poses what is there; draw() fills matrices and draws, once, when something changed
 *
 * It gives back facts (what was hit, where joints are), never edits: it can't see how documents change.
 */
import { Box3, InstancedBufferAttribute, SRGBColorSpace, Vector3, WebGLRenderer } from 'three';
import type { Character, Document } from '../model/document.ts';
import { findCharacter, shownSkin } from '../model/document.ts';
import type { Texture } from '../model/files.ts';
import { DEFAULT_DISPLAY, type Display, NOTHING_SELECTED, type Selection } from '../model/session.ts';
import { CameraRig, type CameraView, type Side } from './camera.ts';
import { CharacterView } from './character-view.ts';
import { dots } from './dots.ts';
import { Grid } from './grid.ts';
import { Labels } from './labels.ts';
import { Orientation } from './orientation.ts';
import { type DrawnSkin, type Hit, Picker, type PickScene } from './picking.ts';
import { placementMatrix } from './placements.ts';
import { isOpaque, type JointRef, type PosedSkeleton, SkeletonDrawing, sizesFor } from './skeleton-drawing.ts';
import { Stage } from './stage.ts';
import { STAGE_THEMES, type ThemeName } from './theme.ts';
import { LINE_RESOLUTION, rawColor } from './thick-lines.ts';
import { Trail } from './trail.ts';

export type { Hit } from './picking.ts';

/** What is known of a character as it is drawn now. */
export interface CharacterFacts {
  /** Every DOF (see `model/dofs.ts`), clamped. Filled anew by each `seek`: copy what is to be kept. */
  readonly dofs: Float64Array;
  /** 16 numbers a joint, column-major, in the character's own space; a copy. */
  worldMatrices(): Float64Array;
  /** The skin's vertices as drawn, x y z each, in the character's own space; a copy. Empty without a skin. */
  vertices(): Float64Array;
}

export interface ViewportEvents {
  /** A skin's picture can't be decoded; it is drawn without. */
  textureFailed?(characterId: string, texture: Texture, message: string): void;
}

/** Of the last frame drawn. */
export interface FrameStats {
  readonly drawCalls: number;
  readonly triangles: number;
}

/** A character's view, with what is drawn of it elsewhere. */
interface Shown {
  readonly view: CharacterView;
  character: Character;
  /** 16 a placement: see `placements.ts`. */
  placements: Float64Array;
}

const MOST_PIXELS_PER_PIXEL = 2;
/** Above this many triangles the pointer's every move would be felt: joints in skins then light up on a click only. */
const HOVER_TRIANGLES = 300_000;
/** Of the played range, looked at when everything is framed. */
const FRAMED_MOMENTS = 16;
/** Framing leaves at most so much more room than everything takes now. */
const MOST_ROOM = 3;

export class Viewport {
  readonly canvas: HTMLCanvasElement;
  private readonly renderer: WebGLRenderer;
  private readonly stage: Stage;
  private readonly rig: CameraRig;
  private readonly grid = new Grid();
  private readonly skeletons = new SkeletonDrawing();
  private readonly trail = new Trail();
  private readonly vertexDots = dots(1, { size: 17, depthTest: false, hollow: true });
  private readonly labels = new Labels();
  private readonly orientation: Orientation;
  private readonly picker: Picker;
  private readonly resizing: ResizeObserver;
  private readonly shown = new Map<string, Shown>();
  /** The same, as a list: walking it allocates nothing. */
  private all: readonly Shown[] = [];
  private readonly listening = new AbortController();

  private document: Document | undefined;
  private display: Display = DEFAULT_DISPLAY;
  private selection: Selection = NOTHING_SELECTED;
  private themeName: ThemeName = 'dark';
  private timeSeconds = 0;
  private playedRange: readonly [number, number] = [0, 0];
  private width = 0;
  private height = 0;
  private queued = 0;
  private disposed = false;
  /** Something moved, or came or went, since the last frame. */
  private posesChanged = true;
  /** Frame all with the next picture, when poses and sizes are known. */
  private framing: 'no' | 'smoothly' | 'first look' = 'no';
  private hovered: JointRef | undefined;
  private pointer: { x: number; y: number } | undefined;
  private following: string | undefined;
  private followedJoint = -1;
  private readonly content = new Box3();
  private readonly room = new Box3();
  private readonly box = new Box3();
  private readonly step = new Vector3();
  private readonly lastFollowed = new Vector3();
  private readonly point = new Vector3();

  /**
   * Fills `container`, whatever its size becomes.
   * @throws Error where the browser has no WebGL2
   */
  constructor(
    container: HTMLElement,
    private readonly events: ViewportEvents = {},
  ) {
    this.renderer = new WebGLRenderer({ antialias: true, stencil: false, powerPreference: 'high-performance' });
    const { renderer } = this;
    this.canvas = renderer.domElement;
    this.canvas.style.cssText = 'display:block;position:absolute;inset:0;width:100%;height:100%;touch-action:none';
    renderer.outputColorSpace = SRGBColorSpace;
    // Counted over a whole frame, which is more than one pass.
    renderer.info.autoReset = false;
    this.stage = new Stage(renderer);
    this.picker = new Picker(renderer);
    this.rig = new CameraRig(this.canvas, () => this.requestRender());
    this.orientation = new Orientation((side) => this.lookFrom(side));
    this.vertexDots.renderOrder = 23;
    this.vertexDots.matrixAutoUpdate = false;
    this.stage.scene.add(this.grid.object, this.skeletons.object, this.trail.object, this.vertexDots);

    if (getComputedStyle(container).position === 'static') container.style.position = 'relative';
    container.append(this.canvas, this.labels.canvas, this.orientation.element);
    this.setTheme('dark');
    this.resizing = new ResizeObserver(() => this.resize(container.clientWidth, container.clientHeight));
    this.resizing.observe(container);
    this.resize(container.clientWidth, container.clientHeight);
    this.listen();
  }

  /** After an edit: what the document, the selection and the switches of the display say now. */
  show(document: Document, selection: Selection, display: Display): void {
    const before = this.document;
    const { shown } = this;
    const displayChanged = display !== this.display;
    const heatChanged =
      selection.joint !== this.selection.joint || selection.characterId !== this.selection.characterId;
    this.document = document;
    this.selection = selection;
    this.display = display;
    for (const [id, { view }] of shown) {
      if (findCharacter(document, id)) continue;
      view.dispose();
      shown.delete(id);
    }
    const known = before?.characters.some((c) => shown.has(c.id)) ?? false;
    for (const character of document.characters) {
      let entry = shown.get(character.id);
      if (!entry) {
        entry = { view: this.createView(character.id), character, placements: new Float64Array(0) };
        shown.set(character.id, entry);
        this.stage.content.add(entry.view.object);
      } else if (character === entry.character && !displayChanged && !heatChanged) continue;
      entry.character = character;
      if (entry.placements.length !== 16 * character.placements.length) {
        entry.placements = new Float64Array(16 * character.placements.length);
      }
      entry.view.show(character, display, selection.characterId === character.id ? selection.joint : undefined);
      entry.view.seek(this.timeSeconds);
      if (entry.view.needsPreparing) this.prepare(entry);
    }
    this.all = [...shown.values()];
    // The first to come into an empty picture, or in the place of everything before, are looked at from where one
    // looks first; what comes beside others is left to whoever brought it.
    if (!known && document.characters.length > 0) this.framing = 'first look';
    this.rig.setOrthographic(display.orthographic);
    this.stage.setShadow(display.shadow);
    this.grid.object.visible = display.grid;
    this.showSkeletons();
    this.showTrail();
    this.posesChanged = true;
    this.requestRender();
  }

  /** Poses every character at a time of the transport. Facts are right at once; the picture follows. */
  seek(timeSeconds: number): void {
    this.timeSeconds = timeSeconds;
    for (let i = 0; i < this.all.length; i++) this.all[i].view.seek(timeSeconds);
    this.posesChanged = true;
    this.requestRender();
  }

  /** Draws with the next frame of the browser; however often it is asked, once. */
  requestRender(): void {
    if (this.queued === 0 && !this.disposed) this.queued = requestAnimationFrame(this.draw);
  }

  /** What is under a point of the page. */
  pick(clientX: number, clientY: number): Hit | undefined {
    const scene = this.pickScene();
    if (!scene) return undefined;
    const { left, top } = this.canvas.getBoundingClientRect();
    return this.picker.pick(scene, clientX - left, clientY - top);
  }

  /** Marks a joint as the one under the pointer, as a row of a list may ask for; undefined for none. */
  hover(joint: JointRef | undefined): void {
    if (!this.skeletons.hover(joint)) return;
    this.hovered = joint;
    this.labels.show(this.skeletons.drawn, this.display, this.selection, joint);
    this.requestRender();
  }

  /** Everything there is. */
  frameAll(): void {
    if (this.framing === 'no') this.framing = 'smoothly';
    this.requestRender();
  }

  /** The selected vertex, joint or character; everything where nothing is selected. */
  frameSelection(selection: Selection): void {
    const { characterId, joint, vertex } = selection;
    const entry = characterId === undefined ? undefined : this.shown.get(characterId);
    if (!entry) {
      this.frameAll();
      return;
    }
    this.update();
    const { skeleton } = entry.character;
    entry.view.bounds(this.box);
    const size = this.box.isEmpty() ? 1 : this.box.getSize(this.point).length();
    if (vertex !== undefined && this.vertexPosition(entry, vertex, 0, this.point)) {
      this.rig.frameSphere(this.point, 0.06 * size, true);
    } else if (joint !== undefined && skeleton && this.skeletons.positionOf(entry.character.id, 0, joint, this.point)) {
      this.rig.frameSphere(this.point, this.jointRadius(entry, joint), true);
    } else this.rig.frame(this.box, true);
  }

  lookFrom(side: Side): void {
    this.rig.lookFrom(side);
  }

  /** Where the camera stands, or is going. */
  get cameraView(): CameraView {
    return this.rig.view;
  }

  /** Puts the camera there at once, whatever was about to be framed. */
  set cameraView(view: CameraView) {
    this.framing = 'no';
    this.rig.view = view;
  }

  setTheme(name: ThemeName): void {
    this.themeName = name;
    const theme = STAGE_THEMES[name];
    this.stage.setTheme(theme, this.renderer);
    this.grid.setTheme(theme);
    this.labels.setTheme(theme);
    this.orientation.setTheme(theme);
    this.trail.setTheme(theme);
    this.vertexDots.material.uniforms.color.value.copy(rawColor(theme.vertex));
    this.vertexDots.material.uniforms.ring.value.copy(rawColor(theme.labelHalo));
    for (const { view } of this.shown.values()) view.setTheme(name);
    this.showSkeletons();
    this.requestRender();
  }

  /** Seconds of the transport that are played: what a trail covers, and what framing everything leaves room for. */
  setPlayedRange(range: readonly [number, number]): void {
    if (range[0] === this.playedRange[0] && range[1] === this.playedRange[1]) return;
    this.playedRange = range;
    this.showTrail();
    this.requestRender();
  }

  character(id: string): CharacterFacts | undefined {
    const view = this.shown.get(id)?.view;
    if (!view) return undefined;
    return { dofs: view.dofs, worldMatrices: () => view.worldMatrices.slice(), vertices: () => view.vertices() };
  }

  stats(): FrameStats {
    const { calls, triangles } = this.renderer.info.render;
    return { drawCalls: calls, triangles };
  }

  /** Length between the labelled lines of the grid, as last drawn. */
  get gridSpacing(): number {
    return this.grid.spacing;
  }

  dispose(): void {
    this.disposed = true;
    cancelAnimationFrame(this.queued);
    this.listening.abort();
    this.resizing.disconnect();
    for (const { view } of this.shown.values()) view.dispose();
    this.shown.clear();
    this.all = [];
    for (const part of [this.rig, this.grid, this.skeletons, this.trail, this.picker, this.stage]) part.dispose();
    this.vertexDots.geometry.dispose();
    this.vertexDots.material.dispose();
    this.vertexDots.dispose();
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

  private prepare(entry: Shown): void {
    entry.view.prepare().then(
      () => {
        this.posesChanged = true;
        this.requestRender();
      },
      // Nobody waits for it: an error is the page's, as one thrown while drawing would be.
      (error: unknown) => reportError(error),
    );
  }

  private listen(): void {
    const { canvas } = this;
    const { signal } = this.listening;
    // three.js asks for the context back, and makes everything anew when it comes; then it only has to be drawn.
    canvas.addEventListener(
      'webglcontextrestored',
      () => {
        this.posesChanged = true;
        this.requestRender();
      },
      { signal },
    );
    canvas.addEventListener(
      'pointermove',
      ({ buttons, pointerType, offsetX, offsetY }) => {
        this.pointer = buttons === 0 && pointerType === 'mouse' ? { x: offsetX, y: offsetY } : undefined;
        if (this.pointer && this.canHover) this.requestRender();
      },
      { signal },
    );
    canvas.addEventListener(
      'pointerleave',
      () => {
        this.pointer = undefined;
        this.hover(undefined);
      },
      { signal },
    );
  }

  private resize(width: number, height: number): void {
    if (width === 0 || height === 0) return;
    const ratio = Math.min(window.devicePixelRatio || 1, MOST_PIXELS_PER_PIXEL);
    if (width === this.width && height === this.height && ratio === this.renderer.getPixelRatio()) return;
    this.width = width;
    this.height = height;
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, false);
    LINE_RESOLUTION.value.set(width, height);
    this.grid.setPixelRatio(ratio);
    this.labels.resize(width, height, ratio);
    this.rig.resize(width, height);
    // At once: a canvas is empty after a change of size, and would flash.
    if (this.document) this.draw(performance.now());
  }

  private showSkeletons(): void {
    const posed: PosedSkeleton[] = [];
    for (const { view, character, placements } of this.shown.values()) {
      if (!character.skeleton) continue;
      const { id, skeleton } = character;
      const hasSkin = shownSkin(character) !== undefined;
      posed.push({ characterId: id, skeleton, world: view.worldMatrices, placements, hasSkin });
    }
    const { skeletons, display, selection } = this;
    skeletons.show(posed, display, selection, STAGE_THEMES[this.themeName]);
    this.labels.show(skeletons.drawn, display, selection, this.hovered);
    this.posesChanged = true;
  }

  private showTrail(): void {
    const { characterId, joint } = this.selection;
    const entry = characterId === undefined ? undefined : this.shown.get(characterId);
    const { trail, inPlace } = this.display;
    this.trail.show(trail ? entry?.character : undefined, joint, this.playedRange, inPlace);
  }

  /** Matrices of what is drawn, from the poses as they are. */
  private update(): void {
    if (!this.posesChanged) return;
    this.posesChanged = false;
    const { display, content, box, selection } = this;
    content.makeEmpty();
    for (let i = 0; i < this.all.length; i++) {
      const { view, character, placements } = this.all[i];
      const x = display.inPlace ? view.dofs[0] : 0;
      const z = display.inPlace ? view.dofs[2] : 0;
      for (let p = 0; p < character.placements.length; p++) {
        placementMatrix(character.placements[p], x, z, placements, 16 * p);
      }
      content.union(view.bounds(box));
    }
    this.skeletons.fill();
    this.followJoint();
    this.markVertex(selection);
  }

  /** Every frame that has something new. An arrow, for it is handed to the browser each time. */
  private readonly draw = (nowMs: number): void => {
    cancelAnimationFrame(this.queued);
    this.queued = 0;
    const { renderer, rig, stage, grid, content, display } = this;
    if (this.disposed || this.width === 0 || renderer.getContext().isContextLost()) return;
    this.update();
    if (this.framing !== 'no' && !content.isEmpty()) {
      const room = this.roomOfMotion();
      if (this.framing === 'first look') rig.lookFirst(room);
      else rig.frame(room, true);
      this.framing = 'no';
    }
    rig.tick(nowMs);
    rig.fitDepth(content, display.grid);
    const { camera } = rig;
    if (display.grid) grid.update(rig);
    stage.light(camera);
    stage.fitShadow(content);
    this.hoverPointer();
    renderer.info.reset();
    renderer.render(stage.scene, camera);
    this.labels.draw(camera, this.skeletons.positions);
    this.orientation.update(camera);
  };

  /**
   * Around everything at all moments played, as far as a few of them tell: who walks about is not framed out of the
   * picture. Who walks far away would be a dot in it, and is framed where it stands.
   */
  private roomOfMotion(): Box3 {
    const { content, room, box, playedRange, timeSeconds } = this;
    const [start, end] = playedRange;
    room.copy(content);
    if (end > start) {
      for (const { view } of this.all) {
        for (let i = 0; i <= FRAMED_MOMENTS; i++) {
          view.seek(start + ((end - start) * i) / FRAMED_MOMENTS);
          room.union(view.bounds(box));
        }
        view.seek(timeSeconds);
      }
    }
    const far = room.getSize(this.step).length() > MOST_ROOM * content.getSize(this.point).length();
    return far ? content : room;
  }

  /** Takes the camera along with the selected joint. */
  private followJoint(): void {
    const { display, selection, skeletons, point, rig } = this;
    const { characterId, joint } = selection;
    const found =
      display.follow &&
      characterId !== undefined &&
      joint !== undefined &&
      skeletons.positionOf(characterId, 0, joint, point);
    if (!found) {
      this.following = undefined;
      return;
    }
    if (this.following === characterId && this.followedJoint === joint)
      rig.shift(this.step.subVectors(point, this.lastFollowed));
    else rig.moveTo(point);
    this.following = characterId;
    this.followedJoint = joint;
    this.lastFollowed.copy(point);
  }

  private markVertex({ characterId, vertex }: Selection): void {
    const { vertexDots, point } = this;
    const entry = characterId === undefined ? undefined : this.shown.get(characterId);
    const count = entry && vertex !== undefined ? entry.character.placements.length : 0;
    vertexDots.visible = false;
    if (!entry || vertex === undefined || count === 0) return;
    if (vertexDots.instanceMatrix.count < count) {
      vertexDots.instanceMatrix = new InstancedBufferAttribute(new Float32Array(16 * count), 16);
    }
    for (let p = 0; p < count; p++) {
      if (!this.vertexPosition(entry, vertex, p, point)) return;
      point.toArray(vertexDots.instanceMatrix.array, 16 * p + 12);
      vertexDots.instanceMatrix.array[16 * p + 15] = 1;
    }
    vertexDots.count = count;
    vertexDots.instanceMatrix.needsUpdate = true;
    vertexDots.visible = true;
  }

  /** Where a skin's vertex is drawn, in the world; false where there is none. */
  private vertexPosition(
    { view, character, placements }: Shown,
    vertex: number,
    placement: number,
    out: Vector3,
  ): boolean {
    const mesh = view.skinnedMeshes[placement];
    const skin = shownSkin(character);
    if (!mesh || !skin || vertex >= skin.positions.length / 3) return false;
    mesh.getVertexPosition(vertex, out);
    const m = placements;
    const o = 16 * placement;
    const { x, y, z } = out;
    out.set(
      m[o] * x + m[o + 4] * y + m[o + 8] * z + m[o + 12],
      m[o + 1] * x + m[o + 5] * y + m[o + 9] * z + m[o + 13],
      m[o + 2] * x + m[o + 6] * y + m[o + 10] * z + m[o + 14],
    );
    return true;
  }

  /** Of a sphere around a joint that shows it with its neighbours, in the world. */
  private jointRadius({ character, placements }: Shown, joint: number): number {
    const { skeleton } = character;
    if (!skeleton) return 1;
    let reach = 0.06 * sizesFor(skeleton).extent;
    const { min, max } = skeleton.joints[joint].box;
    reach = Math.max(reach, 0.6 * Math.hypot(max[0] - min[0], max[1] - min[1], max[2] - min[2]));
    for (const { parent, offset } of skeleton.joints)
      if (parent === joint) reach = Math.max(reach, Math.hypot(...offset));
    return 1.8 * reach * Math.hypot(placements[0], placements[1], placements[2]);
  }

  private pickScene(): PickScene | undefined {
    if (this.width === 0 || this.renderer.getContext().isContextLost()) return undefined;
    this.update();
    this.stage.scene.updateMatrixWorld();
    const { display, rig, width, height, skeletons } = this;
    rig.camera.updateMatrixWorld();
    const skins: DrawnSkin[] = [];
    if (display.skin !== 'hidden') {
      for (const { view, character } of this.shown.values()) {
        view.skinnedMeshes.forEach((mesh, placement) => {
          skins.push({ characterId: character.id, placement, mesh });
        });
      }
    }
    return { camera: rig.camera, width, height, skeletons, skins, skinsAreOpaque: isOpaque(display.skin) };
  }

  private get canHover(): boolean {
    return this.display.boxes !== 'hidden' || this.display.bones;
  }

  /** Lights up the joint under the pointer, with the frame that its move asked for. */
  private hoverPointer(): void {
    const { pointer } = this;
    this.pointer = undefined;
    if (!pointer || this.rig.handling || !this.canHover) return;
    const scene = this.pickScene();
    if (!scene) return;
    const triangles = scene.skins.reduce((sum, { mesh }) => sum + mesh.gpu.skin.triangles.length / 3, 0);
    if (scene.skinsAreOpaque && triangles > HOVER_TRIANGLES) return;
    const { skeletons, labels } = this;
    const joint = this.picker.pickJoint(scene, pointer.x, pointer.y);
    if (!skeletons.hover(joint)) return;
    this.hovered = joint;
    labels.show(skeletons.drawn, this.display, this.selection, joint);
  }
}
