/**
 * Names of joints and characters, on a 2D canvas over the scene: crisp at any scale, in any script, without an element
 * per name. A name that would overlap one already drawn is left out. The names of characters come first, the selected
 * one's before the others in a fixed order, so that dancers who pass each other don't make names flicker, and none
 * gives way to the pointer on its way to it; then the hovered joint's and the selected one's; then joints: those in
 * front, nearest first, then, dimmed, those behind a skin or a box (`label-cover.ts`).
 */
import { type Camera, Matrix4 } from 'three';
import type { Display, Selection } from '../../model/session.ts';
import { jointName } from '../../model/skeleton/joint-name.ts';
import type { Skeleton } from '../../model/skeleton/skeleton.ts';
import type { ScreenBox } from '../overlay.ts';
import { type DrawnSkeleton, instanceOf, type JointRef, jointAt } from '../skeleton/drawn-skeletons.ts';
import type { StageTheme } from '../theme.ts';
import { MIN_Y, nameLeft, placeName } from './character-names.ts';
import type { LabelCover } from './label-cover.ts';
import { type Candidates, LabelChoice, LabelLayout, LINE_HEIGHT } from './label-layout.ts';
import { type Name, NameSprites } from './name-sprites.ts';

/** Positions tried for a character's name in a crowd before it is left out. */
const NAME_LINES = 6;
/** The same for the name of the hovered or the selected joint. */
const JOINT_LINES = 4;
/** Gap between a joint and its name. */
const BESIDE = 8;
/** Maximum number of joints considered. */
const CANDIDATES = 4096;
/** Maximum number of characters considered besides the selected one: hardly more than a tenth of them have room. */
const MAX_NAMED = 1000;
/** Longer names are truncated. */
const MAX_LETTERS = 40;
/** Maximum length of the character's name before a joint's. */
const MAX_BEFORE = 28;
/** CSS pixels. The joints of smaller characters aren't named: their names would cover them. */
const MIN_SIZE = 24;
/** Characters smaller than this are marked with a dot. */
const DOT_BELOW = 8;
const DOT_RADIUS = 2.5;
/** Shorter lines from a name to its character aren't drawn. */
const MIN_LEADER = 6;
/** Opacity of the names of covered joints. */
const COVERED = 0.45;

export class Labels {
  readonly canvas = document.createElement('canvas');
  private readonly pen: CanvasRenderingContext2D;
  private readonly sprites: NameSprites;
  /** Names of the joints of all characters, one after the other, each measured when it is first written. */
  private names: (Name | undefined)[] = [];
  private drawn: readonly DrawnSkeleton[] = [];
  private width = 1;
  private height = 1;
  private ratio = 1;
  private theme: StageTheme | undefined;
  private always: number[] = [];
  private selected = -1;
  /** Under the pointer; -1 for none. */
  private hovered = -1;
  private hoveredName: Name | undefined;
  private showsAll = false;
  /** In the order of `drawn`, each measured when first written; empty for a single character, or if names are off. */
  private characterNames: (Name | undefined)[] = [];
  private selectedCharacter = -1;
  /** Under the pointer. */
  private hoveredCharacter: string | undefined;
  private readonly place = new Float64Array(4);
  private wrote = false;
  /** Kept free of names in this frame. */
  private free: readonly ScreenBox[] = [];
  private readonly toTake = new Matrix4();
  /** Screen x, y and depth of each candidate. */
  private readonly screen = new Float32Array(3 * CANDIDATES);
  /** Index in `drawn` and in `names`, and instance, of each candidate. */
  private readonly owners = new Uint32Array(CANDIDATES);
  private readonly named = new Uint32Array(CANDIDATES);
  private readonly instances = new Uint32Array(CANDIDATES);
  private readonly layout = new LabelLayout();
  private readonly choice = new LabelChoice(CANDIDATES);
  private readonly candidates: ReturnType<Labels['jointCandidates']>;

  constructor() {
    const pen = this.canvas.getContext('2d');
    if (!pen) throw new Error('This browser does not provide a 2D canvas.');
    this.pen = pen;
    this.sprites = new NameSprites(pen);
    this.candidates = this.jointCandidates();
    this.canvas.setAttribute('aria-hidden', 'true');
    this.canvas.style.cssText = 'position:absolute;inset:0;width:100%;height:100%;pointer-events:none';
  }

  resize(width: number, height: number, ratio: number): void {
    this.width = width;
    this.height = height;
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
    this.wrote = true;
    if (ratio !== this.ratio) this.sprites.setRatio(ratio);
    this.ratio = ratio;
  }

  setTheme(theme: StageTheme): void {
    this.theme = theme;
    this.sprites.setHalo(theme.labelHalo);
  }

  /** Call after an edit. `hovered` is labelled even if names are off. */
  show(drawn: readonly DrawnSkeleton[], display: Display, selection: Selection, hovered: JointRef | undefined): void {
    if (drawn !== this.drawn || display.names !== this.showsAll) {
      const joints = drawn.reduce((sum, { nodes }) => sum + nodes.jointCount, 0);
      this.names = new Array(display.names ? joints : 0);
    }
    this.showsAll = display.names;
    this.selected = display.names ? instanceOf(drawn, selection.characterId, 0, selection.joint) : -1;
    this.hovered = hovered ? instanceOf(drawn, hovered.characterId, hovered.placement, hovered.joint) : -1;
    this.hoveredName = hovered && this.nameUnderPointer(hovered);
    this.always = [...new Set([this.hovered, this.selected])].filter((i) => i >= 0);
    const named = display.characterNames && drawn.length > 1 ? drawn.length : 0;
    if (drawn !== this.drawn || this.characterNames.length !== named) this.characterNames = new Array(named);
    this.drawn = drawn;
    this.selectedCharacter = drawn.findIndex((d) => d.characterId === selection.characterId);
  }

  /**
   * Call every frame.
   *
   * @param positions x y z of each instance of the skeleton drawing
   * @param cover filled for this frame; undefined if nothing covers joints
   * @param free kept free of names
   */
  draw(camera: Camera, positions: Float64Array, cover: LabelCover | undefined, free: readonly ScreenBox[] = []): void {
    const { pen, theme, layout } = this;
    const nothing = !this.showsAll && this.always.length === 0 && this.characterNames.length === 0;
    layout.begin();
    for (const box of free) layout.block(box);
    this.free = free;
    if (!theme || (nothing && !this.wrote)) return;
    pen.clearRect(0, 0, this.canvas.width, this.canvas.height);
    // Chromium may keep showing the old content of a canvas that is only cleared.
    this.canvas.style.visibility = nothing ? 'hidden' : '';
    this.wrote = !nothing;
    if (nothing) return;
    this.toTake.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);

    this.writeCharacters(positions, theme);
    for (const instance of this.always) this.writeAlways(instance, positions, theme);
    if (this.showsAll) this.writeJoints(positions, theme, cover);
    this.sprites.flush();
  }

  /** Id of the character whose name is at a point of the viewport, as last drawn. */
  characterAt(x: number, y: number): string | undefined {
    return this.drawn[this.layout.ownerAt(x, y)]?.characterId;
  }

  /** Highlights a character's name; undefined for none. */
  hoverCharacter(characterId: string | undefined): void {
    this.hoveredCharacter = characterId;
  }

  private writeJoints(positions: Float64Array, theme: StageTheme, cover: LabelCover | undefined): void {
    const { screen, candidates } = this;
    // Only the first instance of each character: a crowd would repeat the same names.
    let firstName = 0;
    let count = 0;
    for (let d = 0; d < this.drawn.length && count < CANDIDATES; d++) {
      const { firstInstance, skeleton, missing } = this.drawn[d];
      const first = count;
      let left = Infinity;
      let right = -Infinity;
      let top = Infinity;
      let bottom = -Infinity;
      for (let j = 0; j < skeleton.joints.length && count < CANDIDATES; j++) {
        if (missing?.[j] || !this.project(positions, firstInstance + j, count)) continue;
        left = Math.min(left, screen[3 * count]);
        right = Math.max(right, screen[3 * count]);
        top = Math.min(top, screen[3 * count + 1]);
        bottom = Math.max(bottom, screen[3 * count + 1]);
        this.owners[count] = d;
        this.named[count] = firstName + j;
        this.instances[count] = firstInstance + j;
        count++;
      }
      if (skeleton.joints.length > 1 && right - left < MIN_SIZE && bottom - top < MIN_SIZE) count = first;
      firstName += skeleton.joints.length;
    }
    candidates.count = count;
    candidates.positions = positions;
    candidates.cover = cover;
    candidates.color = theme.label;
    this.choice.choose(candidates);
  }

  private writeCharacters(positions: Float64Array, theme: StageTheme): void {
    const { characterNames: names, selectedCharacter: first } = this;
    if (names.length === 0) return;
    if (first >= 0) this.writeCharacter(first, positions, theme.selectedLabel);
    const most = Math.min(names.length, MAX_NAMED);
    for (let c = 0; c < most && !this.layout.isFull; c++) {
      if (c === first) continue;
      const { tint, characterId } = this.drawn[c];
      const color = characterId === this.hoveredCharacter ? theme.selectedLabel : tint ? theme[tint] : theme.label;
      this.writeCharacter(c, positions, color);
    }
  }

  private writeCharacter(c: number, positions: Float64Array, color: string): void {
    const { place, characterNames } = this;
    if (!placeName(this.drawn[c], positions, this.toTake, this.width, this.height, place)) return;
    characterNames[c] ??= this.measure(this.drawn[c].name ?? '');
    const name = characterNames[c];
    // A name behind the axis widget is better than none.
    if (!this.writeName(name, c, color, true)) this.writeName(name, c, color, false);
  }

  /** Returns whether there was room. */
  private writeName(name: Name, c: number, color: string, isBeside: boolean): boolean {
    const { place, width } = this;
    // Above a name that is already there.
    for (let y = place[1]; y > place[1] - NAME_LINES * LINE_HEIGHT && y >= MIN_Y; y -= LINE_HEIGHT) {
      if (!this.write(name, nameLeft(place[0], y, name.width, width, isBeside), y, color, c)) continue;
      this.pointFrom(y, color);
      return true;
    }
    return false;
  }

  /** From a name at the height `y` to its character at `place`, if that is far away or tiny. */
  private pointFrom(y: number, color: string): void {
    const { pen, place, ratio } = this;
    const x = place[0];
    const top = place[2];
    const bottom = place[3];
    const from = y + LINE_HEIGHT / 2;
    const isDot = bottom - top < DOT_BELOW;
    const isLeading = top - from >= MIN_LEADER && (isDot || y < place[1]);
    if (!isDot && !isLeading) return;
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.beginPath();
    if (isLeading) {
      pen.moveTo(x, from);
      pen.lineTo(x, isDot ? (top + bottom) / 2 - DOT_RADIUS : top);
    }
    pen.strokeStyle = color;
    pen.lineWidth = 1;
    pen.stroke();
    if (isDot) {
      pen.beginPath();
      pen.arc(x, (top + bottom) / 2, DOT_RADIUS, 0, 2 * Math.PI);
      pen.fillStyle = color;
      pen.fill();
    }
    pen.setTransform(1, 0, 0, 1, 0, 0);
  }

  /** The joints that may be named in a frame. */
  private jointCandidates() {
    const { screen, layout, instances } = this;
    const nameOf = (i: number) => {
      const { skeleton, firstInstance } = this.drawn[this.owners[i]];
      return this.nameAt(this.named[i], skeleton, instances[i] - firstInstance);
    };
    const candidates = {
      count: 0,
      positions: new Float64Array(0) as Float64Array,
      cover: undefined as LabelCover | undefined,
      color: '',
      depthOf: (i: number) => screen[3 * i + 2],
      hasRoom(i: number) {
        if (layout.isFull) return false;
        const { text, width } = nameOf(i);
        return text !== '' && layout.hasRoom(Math.round(screen[3 * i] + BESIDE), Math.round(screen[3 * i + 1]), width);
      },
      isCovered(i: number) {
        const { cover, positions } = candidates;
        const o = 3 * instances[i];
        return cover?.isCovered(instances[i], positions[o], positions[o + 1], positions[o + 2]) ?? false;
      },
      put: (i: number, isCovered: boolean) => {
        const opacity = isCovered ? COVERED : 1;
        this.write(nameOf(i), screen[3 * i] + BESIDE, screen[3 * i + 1], candidates.color, -1, opacity);
      },
    };
    return candidates satisfies Candidates;
  }

  private writeAlways(instance: number, positions: Float64Array, theme: StageTheme): void {
    const name = instance === this.hovered ? this.hoveredName : this.nameOf(instance);
    if (!name || this.isMissing(instance) || !this.project(positions, instance, CANDIDATES - 1)) return;
    const color = instance === this.selected ? theme.selectedLabel : theme.label;
    const o = 3 * (CANDIDATES - 1);
    const [x, y] = [this.screen[o], this.screen[o + 1]];
    // What is kept free, such as the rings of the joint that is turned, has the names of joints in it at its side.
    const around = this.free.find(([left, top, right, bottom]) => x > left && x < right && y > top && y < bottom);
    // Below a character's name that is already there.
    for (let line = 0; line < JOINT_LINES; line++) {
      if (this.write(name, (around?.[2] ?? x) + BESIDE, y + line * LINE_HEIGHT, color)) return;
    }
  }

  /** Whether an instance is a point that isn't there. */
  private isMissing(instance: number): boolean {
    const found = jointAt(this.drawn, instance);
    const drawn = found && this.drawn.find(({ characterId }) => characterId === found.characterId);
    return drawn?.missing?.[found?.joint ?? 0] === 1;
  }

  /** Writes an instance's screen position to slot `to`; false if it is out of view. */
  private project(positions: Float64Array, instance: number, to: number): boolean {
    const m = this.toTake.elements;
    const x = positions[3 * instance];
    const y = positions[3 * instance + 1];
    const z = positions[3 * instance + 2];
    const w = m[3] * x + m[7] * y + m[11] * z + m[15];
    if (w <= 0) return false;
    const cx = (m[0] * x + m[4] * y + m[8] * z + m[12]) / w;
    const cy = (m[1] * x + m[5] * y + m[9] * z + m[13]) / w;
    if (Math.abs(cx) > 1 || Math.abs(cy) > 1) return false;
    this.screen[3 * to] = (cx * 0.5 + 0.5) * this.width;
    this.screen[3 * to + 1] = (0.5 - cy * 0.5) * this.height;
    this.screen[3 * to + 2] = (m[2] * x + m[6] * y + m[10] * z + m[14]) / w;
    return true;
  }

  /** Returns whether there was room. @param x of the first letter @param y of the middle of the line */
  private write(name: Name, x: number, y: number, color: string, owner = -1, opacity = 1): boolean {
    const { layout } = this;
    const left = Math.round(x);
    const middle = Math.round(y);
    if (name.text === '' || !layout.hasRoom(left, middle, name.width)) return false;
    layout.take(left, middle, name.width, owner);
    this.sprites.draw(name, color, left, middle, opacity);
    return true;
  }

  private measure(name: string, most = MAX_LETTERS): Name {
    return this.sprites.name(cut(name, most));
  }

  /** `rokoko-dance · LeftUpLeg` if there are several characters. */
  private nameUnderPointer({ characterId, joint }: JointRef): Name | undefined {
    const drawn = this.drawn.find((d) => d.characterId === characterId);
    if (!drawn) return undefined;
    const own = jointName(drawn.skeleton, joint);
    if (this.drawn.length < 2 || !drawn.name) return this.measure(own);
    return this.measure(`${cut(drawn.name, MAX_BEFORE)} · ${cut(own, MAX_LETTERS)}`, Infinity);
  }

  private nameOf(instance: number): Name | undefined {
    const found = jointAt(this.drawn, instance);
    let first = 0;
    for (const { characterId, nodes, skeleton } of this.drawn) {
      if (found && characterId === found.characterId) return this.nameAt(first + found.joint, skeleton, found.joint);
      first += nodes.jointCount;
    }
    return undefined;
  }

  /** @param index in `names` */
  private nameAt(index: number, skeleton: Skeleton, joint: number): Name {
    const { names } = this;
    names[index] ??= this.measure(jointName(skeleton, joint));
    return names[index];
  }
}

function cut(name: string, most: number): string {
  return name.length > most ? `${name.slice(0, most - 1)}…` : name;
}
