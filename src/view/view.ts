/**
 * Draws the document: everything three.js, behind one class. Two paths:
 *
 *     after an edit     show()    compares identities: which characters were added, removed or changed
 *     every frame       seek()    poses characters; draw() fills matrices and draws, only if something changed
 *
 * It reports facts (where joints are) and never edits the document. Its parts, each of which knows only those before it:
 *
 *     Screen          the canvas, its size and its context
 *     ShownDocument   what is drawn
 *     CameraRig       from where; Framer, JointFollower and ViewCamera move it
 *     Redraw          when
 *
 * The workbench adds pointing and tools (`viewport.ts`); the element of other pages shares a context (`shared-view.ts`).
 */
import type { Document } from '../model/document.ts';
import type { Texture } from '../model/files.ts';
import type { Display, Selection } from '../model/session.ts';
import { CameraRig } from './camera/camera.ts';
import { Framer } from './camera/framer.ts';
import { JointFollower } from './camera/joint-follower.ts';
import { ViewCamera } from './camera/view-camera.ts';
import { type CharacterFacts, factsOf } from './character-facts.ts';
import type { Annotations } from './names/annotations.ts';
import { Redraw } from './redraw.ts';
import { type FrameStats, Screen, type Surface } from './screen.ts';
import { ShownDocument } from './shown-document.ts';
import { NO_TINTS, type ThemeName } from './theme.ts';

export interface ViewEvents {
  /** A skin's texture can't be decoded; the skin is drawn untextured. */
  textureFailed?(characterId: string, texture: Texture, message: string): void;
  /** The picture can't be drawn; nothing is until `show` is called with something else to draw. */
  drawingFailed?(error: unknown): void;
}

export class View {
  readonly canvas: HTMLCanvasElement;
  readonly camera: ViewCamera;
  protected readonly screen: Screen;
  protected readonly shown: ShownDocument;
  protected readonly rig: CameraRig;
  protected readonly redraw: Redraw;
  protected readonly follower = new JointFollower();
  private readonly framer: Framer;

  /**
   * Fills `container` at any size.
   *
   * @param inFrame makes of `draw` a request for the next frame, which calls it once, when the time of that frame and all
   * that follows it is decided
   * @param surface default: a context of its own
   * @throws Error if the browser has no WebGL2
   */
  constructor(
    container: HTMLElement,
    inFrame: (draw: (nowMs: number) => void) => () => void,
    events: ViewEvents = {},
    surface?: Surface,
  ) {
    const drawingFailed = (error: unknown) => events.drawingFailed?.(error);
    const redraw = () => this.requestRender();
    this.redraw = new Redraw(inFrame, (nowMs) => this.draw(nowMs), drawingFailed);
    this.screen = new Screen(
      container,
      {
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
      },
      surface,
    );
    const { screen } = this;
    this.canvas = screen.canvas;
    this.shown = new ShownDocument(screen, {
      redraw,
      textureFailed: (id, texture, message) => events.textureFailed?.(id, texture, message),
    });
    const { shown } = this;
    this.rig = new CameraRig(this.canvas, redraw);
    this.framer = new Framer(this.rig, shown.characters, shown.skeletons, shown.picked);
    this.camera = new ViewCamera(this.rig, this.framer, shown, { update: () => this.update(), redraw });
    if (getComputedStyle(container).position === 'static') container.style.position = 'relative';
    container.append(this.canvas);
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

  /** Poses every character at a time of the transport. Values are right at once; drawing follows. */
  seek(timeSeconds: number): void {
    this.shown.seek(timeSeconds);
  }

  /** Requests a redraw with the next frame; several requests draw once. */
  requestRender(): void {
    this.redraw.request();
  }

  /** Draws names, motion paths, ghosts and the marked vertex from now on. Given, not made here: the first picture does without. */
  annotate(create: (...parts: ConstructorParameters<typeof Annotations>) => Annotations): void {
    const { shown, screen } = this;
    const annotations = create(shown.characters, () => this.requestRender(), shown.skins);
    this.canvas.after(annotations.labels.canvas);
    annotations.labels.resize(screen.width, screen.height, screen.ratio);
    shown.annotate(annotations);
  }

  /** Call before `show`. */
  setTheme(name: ThemeName): void {
    this.shown.setTheme(name);
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

  /** The scene's y of the floor: of its grid and the shadow on it. */
  setFloor(y: number): void {
    const { grid, stage } = this.shown;
    grid.floor = stage.floor = y;
    this.requestRender();
  }

  dispose(): void {
    const { redraw, shown, rig, screen } = this;
    redraw.end();
    for (const part of [shown, rig, screen]) part.dispose();
  }

  protected tryShow(show: () => void): void {
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
  protected update(): void {
    const { shown, follower } = this;
    if (!shown.update()) return;
    const { display, selection, characters, picked, skeletons } = shown;
    const followed = followedBy(display, selection);
    const { visible } = characters;
    const only = followed === 'root' && visible.length === 1 ? visible[0] : undefined;
    const character = followed === undefined ? undefined : (characters.seen(selection.characterId) ?? only)?.character;
    follower.follow(character, character ? picked.of(character) : 0, followed, skeletons, this.rig);
  }

  /** Every frame, once the camera is where it will be. */
  protected settle(): void {}

  /** @throws whatever three.js does */
  private draw(nowMs: number): void {
    const { screen, shown, rig, framer } = this;
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
    this.settle();
    shown.updateOverlays(camera, screen.height);
    stage.begin();
    screen.render(stage.scene, camera);
    shown.drawLabels(camera);
  }
}

/** What the camera follows: a selected joint before the root. */
function followedBy({ follow, followRoot }: Display, { joint }: Selection): number | 'root' | undefined {
  if (follow && joint !== undefined) return joint;
  return followRoot ? 'root' : undefined;
}
