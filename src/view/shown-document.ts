/**
 * What is shown of the document, in the scene and on the canvas of names: characters, their skeletons and motion, what
 * marks the selection, and what tools draw. It knows neither camera nor pointer. Two paths:
 *
 *     after an edit                     show()
 *     in frames in which things moved   update()
 */
import { type Camera, Group, type OrthographicCamera, type PerspectiveCamera } from 'three';
import type { Document } from '../model/document.ts';
import type { Texture } from '../model/files.ts';
import { DEFAULT_DISPLAY, type Display, NOTHING_SELECTED, type Selection } from '../model/session.ts';
import { CharacterView } from './character-view.ts';
import type { Look } from './look.ts';
import type { Annotations } from './names/annotations.ts';
import { type Overlay, Overlays } from './overlay.ts';
import { PickedCopy } from './picked-copy.ts';
import { Highlight } from './picking/highlight.ts';
import type { PickableSkin } from './picking/picking.ts';
import { Grid } from './scene/grid.ts';
import { Stage } from './scene/stage.ts';
import type { Screen } from './screen.ts';
import { type ShownCharacter, ShownCharacters } from './shown-characters.ts';
import { haveSameJoints, type JointRef, type PosedSkeleton } from './skeleton/drawn-skeletons.ts';
import { isOpaque, SkeletonDrawing } from './skeleton/skeleton-drawing.ts';
import { DrawnSkins } from './skin/drawn-skins.ts';
import { NO_TINTS, STAGE_THEMES, type ThemeName, type Tints } from './theme.ts';

/** What is drawn besides the characters. */
export interface Surroundings {
  /** Otherwise it is transparent. */
  readonly hasBackground: boolean;
  /** Also if the grid is shown. */
  readonly hasGrid: boolean;
  /** Gizmos, pins, names and what marks the selection. */
  readonly hasTools: boolean;
}

export interface ShownDocumentEvents {
  /** The picture is no longer that of the document. */
  redraw(): void;
  /** A skin's texture can't be decoded; the skin is drawn untextured. */
  textureFailed(characterId: string, texture: Texture, message: string): void;
}

const EVERYTHING: Surroundings = { hasBackground: true, hasGrid: true, hasTools: true };

export class ShownDocument {
  document: Document | undefined;
  display: Display = DEFAULT_DISPLAY;
  selection: Selection = NOTHING_SELECTED;
  timeSeconds = 0;
  /** Seconds of the transport. */
  playedRange: readonly [number, number] = [0, 0];
  /** Absent in the first picture. */
  annotations: Annotations | undefined;
  readonly stage: Stage;
  readonly grid = new Grid();
  readonly characters: ShownCharacters;
  readonly skins = new DrawnSkins();
  readonly skeletons = new SkeletonDrawing();
  readonly picked = new PickedCopy();
  readonly highlighted = new Highlight();
  private readonly overlays: Overlays;
  /** What tools draw, and the marked vertex. */
  private readonly tools = new Group();
  private tints: Tints = NO_TINTS;
  private look: Look | undefined;
  private themeName: ThemeName = 'dark';
  private surroundings = EVERYTHING;
  /** Pictures are drawn, which show motion as it is. */
  private isShot = false;
  private framesPerSecond = 30;
  /** Poses or the set of characters have changed since the last update. */
  private hasMoved = true;

  constructor(
    private readonly screen: Screen,
    private readonly events: ShownDocumentEvents,
  ) {
    this.stage = new Stage(screen.renderer);
    const { scene, content } = this.stage;
    content.add(this.skins.object);
    scene.onBeforeRender = (_renderer, _scene, camera) => this.aimSkins(camera);
    this.overlays = new Overlays(this.tools);
    this.characters = new ShownCharacters(
      content,
      (id) => this.createView(id),
      (entry) => this.prepare(entry),
    );
    scene.add(this.grid.object, this.skeletons.object, this.tools);
  }

  /** Whether none of the characters shown so far is in `document`, which has some. */
  isReplacedBy({ characters }: Document): boolean {
    const stay = new Set(characters.map((c) => c.id));
    return characters.length > 0 && !this.document?.characters.some((c) => stay.has(c.id));
  }

  /** Call after an edit. */
  show(document: Document, selection: Selection, display: Display, tints: Tints): void {
    const { characters } = this;
    const heatChanged =
      selection.joint !== this.selection.joint || selection.characterId !== this.selection.characterId;
    const everything = display !== this.display || heatChanged;
    this.document = document;
    this.selection = selection;
    this.picked.follow(selection);
    this.display = display;
    characters.show(document, this.drawnDisplay, selection, this.timeSeconds, everything, this.look);
    this.tints = tints;
    for (const { view, character } of characters.all) view.setTint(tints.get(character.id));
    this.stage.setShadow(display.shadow);
    this.grid.object.visible = display.grid;
    this.showSkeletons();
    this.showMotion();
  }

  /** Draws a character in another way than the display says; undefined: all as it says. */
  setLook(look: Look | undefined): void {
    const { document, selection, display, tints } = this;
    this.look = look;
    // Another object, so that all characters are shown again.
    this.display = { ...display };
    if (document) this.show(document, selection, display, tints);
  }

  /** For pictures: draws this besides the characters, and no stepped preview; undefined: as ever. */
  surround(surroundings = EVERYTHING): void {
    const { hasBackground, hasGrid, hasTools } = surroundings;
    this.surroundings = surroundings;
    this.isShot = surroundings !== EVERYTHING;
    if (this.display.stepped) this.setLook(this.look);
    this.stage.setBackground(hasBackground);
    this.grid.object.visible = this.display.grid && hasGrid;
    this.tools.visible = hasTools;
    this.showSkeletons();
  }

  /** Poses every character at a time of the transport. */
  seek(timeSeconds: number): void {
    this.timeSeconds = timeSeconds;
    this.characters.seek(timeSeconds);
    this.move();
  }

  /** Poses aren't what they were at the last update. */
  move(): void {
    this.hasMoved = true;
    this.stage.moveCasters();
    this.events.redraw();
  }

  setTheme(name: ThemeName): void {
    const theme = STAGE_THEMES[name];
    this.themeName = name;
    this.stage.setTheme(theme);
    for (const part of [this.grid, this.overlays]) part.setTheme(theme);
    this.annotations?.setTheme(theme);
    this.skins.setTheme(name);
    for (const { view } of this.characters.all) view.setTheme(name);
    this.showSkeletons();
  }

  /** Playback range in seconds of the transport. */
  setPlayedRange(range: readonly [number, number]): void {
    const { playedRange } = this;
    if (range[0] === playedRange[0] && range[1] === playedRange[1]) return;
    this.playedRange = range;
    this.showMotion();
    this.move();
  }

  /** Frame rate for takes without frames of their own. */
  setFramesPerSecond(framesPerSecond: number): void {
    if (framesPerSecond === this.framesPerSecond) return;
    this.framesPerSecond = framesPerSecond;
    this.move();
  }

  /** Adds a tool's overlay. Returns a function that removes and disposes of it. */
  addOverlay(overlay: Overlay): () => void {
    const remove = this.overlays.add(overlay, STAGE_THEMES[this.themeName]);
    this.events.redraw();
    return () => {
      remove();
      this.events.redraw();
    };
  }

  /** Draws names, paths, ghosts and the marked vertex from now on. @param annotations of these `characters`; disposed of with this */
  annotate(annotations: Annotations): void {
    const { stage, skeletons, display, selection, highlighted } = this;
    this.annotations = annotations;
    this.tools.add(annotations.vertexMarker.object);
    annotations.setTheme(STAGE_THEMES[this.themeName]);
    stage.scene.add(annotations.motion.object);
    annotations.labels.show(skeletons.drawn, display, selection, highlighted.joint);
    this.showMotion();
    this.move();
  }

  /** Highlights a joint; undefined: none. Returns whether that changed anything. */
  highlight(joint: JointRef | undefined): boolean {
    const { skeletons, annotations, highlighted } = this;
    if (!skeletons.hover(joint)) return false;
    annotations?.labels.show(skeletons.drawn, this.display, this.selection, joint);
    highlighted.set(joint);
    return true;
  }

  /** Whether anything is drawn that can be pointed at. */
  get canBePointedAt(): boolean {
    const { boxes, bones, skin } = this.display;
    return boxes !== 'hidden' || bones || skin !== 'hidden';
  }

  /** The skins that are drawn, to be picked. */
  get pickableSkins(): readonly PickableSkin[] {
    return this.display.skin === 'hidden' ? [] : this.characters.pickableSkins(this.look);
  }

  /** Updates the matrices of everything drawn from the current poses. Returns false if nothing has moved since. */
  update(): boolean {
    if (!this.hasMoved) return false;
    this.hasMoved = false;
    const { display, selection, characters } = this;
    characters.place(display.inPlace);
    this.skeletons.fill();
    const { annotations } = this;
    annotations?.vertexMarker.mark(characters.seen(selection.characterId), selection.vertex);
    annotations?.motion.fill(selection, this.drawnDisplay, this.timeSeconds, this.playedRange, this.framesPerSecond);
    return true;
  }

  /** Every frame: sizes of what has one on screen. @param heightPx CSS pixels of the viewport */
  updateOverlays(camera: PerspectiveCamera | OrthographicCamera, heightPx: number): void {
    this.overlays.update(camera, heightPx);
  }

  /** Every frame, once the scene is drawn. */
  drawLabels(camera: PerspectiveCamera | OrthographicCamera): void {
    const { display, skeletons, annotations } = this;
    if (!annotations) return;
    const { labels, cover } = annotations;
    if (display.names) cover.fill(skeletons.drawn, camera, isOpaque(display.skin), skeletons.hasSolidBoxes);
    labels.draw(camera, skeletons.positions, display.names ? cover : undefined, this.overlays.covers);
  }

  dispose(): void {
    const { characters, skins, grid, skeletons, overlays, stage } = this;
    for (const part of [characters, skins, grid, skeletons, overlays, stage]) part.dispose();
    this.annotations?.dispose();
  }

  /** Gives back what three.js keeps of everything drawn: it continues listening for its disposal after a lost context. */
  forget(): void {
    this.stage.forget();
    this.skins.free();
  }

  private aimSkins(camera: Camera): void {
    const { skins, stage, characters, highlighted } = this;
    const { joint: hovered } = highlighted;
    skins.hovered.show(hovered && characters.get(hovered.characterId)?.view.paletteTexelOf(hovered.joint));
    skins.aim(camera, stage.mayCast);
  }

  private createView(id: string): CharacterView {
    const view = new CharacterView(this.skins, this.screen.renderer, {
      redraw: () => this.events.redraw(),
      textureFailed: (texture, message) => this.events.textureFailed(id, texture, message),
    });
    view.setTheme(this.themeName);
    return view;
  }

  private prepare(entry: ShownCharacter): void {
    entry.view.prepare().then(
      () => this.move(),
      // Not awaited: errors are reported like those thrown while drawing.
      (error: unknown) => reportError(error),
    );
  }

  private showMotion(): void {
    this.annotations?.motion.show(this.selection, this.drawnDisplay, this.playedRange);
  }

  private get drawnDisplay(): Display {
    const { display } = this;
    return this.isShot && display.stepped ? { ...display, stepped: false } : display;
  }

  private showSkeletons(): void {
    const { skeletons, display, selection, highlighted } = this;
    const hovered = highlighted.joint;
    const posed = this.characters.posedSkeletons(this.tints, this.look);
    const ofHovered = (all: readonly PosedSkeleton[]) =>
      all.find(({ characterId }) => characterId === hovered?.characterId)?.skeleton;
    // Its index would highlight another joint.
    if (hovered && !haveSameJoints(ofHovered(skeletons.drawn), ofHovered(posed))) {
      this.highlight(undefined);
    }
    const marked = this.surroundings.hasTools ? selection : NOTHING_SELECTED;
    skeletons.show(posed, display, marked, STAGE_THEMES[this.themeName]);
    this.annotations?.labels.show(skeletons.drawn, display, selection, highlighted.joint);
    this.move();
  }
}
