/**
 * Names of joints and characters, on a 2D canvas over the scene: crisp at any scale, in any script, without an element
 * per name. A name that would overlap one already drawn is left out. The hovered joint's name comes first, then
 * the selected one's; then those of characters, the selected one first and the others in a fixed order, so that dancers who
 * pass each other don't make names flicker; then joints, nearest first.
 */
import { type Camera, Matrix4 } from 'three';
import { jointName } from '../model/joint-name.ts';
import type { Display, Selection } from '../model/session.ts';
import { placeName } from './character-names.ts';
import { type DrawnSkeleton, instanceOf, type JointRef, jointAt } from './drawn-skeletons.ts';
import { type Name, NameSprites } from './name-sprites.ts';
import type { StageTheme } from './theme.ts';

/** CSS pixels. */
const LINE_HEIGHT = 15;
/** Positions tried for a character's name in a crowd before it is left out. */
const NAME_LINES = 3;
/** Gap between a joint and its name. */
const BESIDE = 8;
/** Maximum number of names at once. */
const LIMIT = 120;
/** Maximum number of joints considered. */
const CANDIDATES = 4096;
/** Longer names are truncated. */
const MAX_LETTERS = 40;
/** Maximum length of the character's name before a joint's. */
const MAX_BEFORE = 28;

export class Labels {
  readonly canvas = document.createElement('canvas');
  private readonly pen: CanvasRenderingContext2D;
  private readonly sprites = new NameSprites();
  private names: Name[] = [];
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
  /** In the order of `drawn`; empty for a single character, or if names are off. */
  private characterNames: Name[] = [];
  private selectedCharacter = -1;
  private readonly place = new Float64Array(2);
  private wrote = false;
  private readonly toClip = new Matrix4();
  /** Screen x, y and depth of each candidate. */
  private readonly screen = new Float32Array(3 * CANDIDATES);
  private readonly order = new Uint32Array(CANDIDATES);
  private readonly boxes = new Float32Array(4 * LIMIT);
  private written = 0;

  constructor() {
    const pen = this.canvas.getContext('2d');
    if (!pen) throw new Error('This browser gives no 2D canvas.');
    this.pen = pen;
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
    this.showsAll = display.names;
    this.drawn = drawn;
    this.names = [];
    if (display.names) {
      for (const { skeleton } of drawn) {
        skeleton.joints.forEach((_, j) => {
          this.names.push(this.measure(jointName(skeleton, j)));
        });
      }
    }
    this.selected = display.names ? instanceOf(drawn, selection.characterId, 0, selection.joint) : -1;
    this.hovered = hovered ? instanceOf(drawn, hovered.characterId, hovered.placement, hovered.joint) : -1;
    this.hoveredName = hovered && this.nameUnderPointer(hovered);
    this.always = [...new Set([this.hovered, this.selected])].filter((i) => i >= 0);
    const isNamed = display.characterNames && drawn.length > 1;
    this.characterNames = isNamed ? drawn.map(({ name }) => this.measure(name ?? '')) : [];
    this.selectedCharacter = drawn.findIndex((d) => d.characterId === selection.characterId);
  }

  /** Call every frame. @param positions x y z of each instance of the skeleton drawing */
  draw(camera: Camera, positions: Float64Array): void {
    const { pen, theme } = this;
    const nothing = !this.showsAll && this.always.length === 0 && this.characterNames.length === 0;
    if (!theme || (nothing && !this.wrote)) return;
    pen.clearRect(0, 0, this.canvas.width, this.canvas.height);
    // Chromium may keep showing the old content of a canvas that is only cleared.
    this.canvas.style.visibility = nothing ? 'hidden' : '';
    this.wrote = !nothing;
    if (nothing) return;
    this.toClip.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);

    this.written = 0;
    for (const instance of this.always) this.writeAlways(instance, positions, theme);
    this.writeCharacters(positions, theme);
    if (!this.showsAll) return;
    // Only the first instance of each character: a crowd would repeat the same names.
    let firstName = 0;
    let count = 0;
    for (const { firstInstance, skeleton } of this.drawn) {
      for (let j = 0; j < skeleton.joints.length && count < CANDIDATES; j++) {
        if (this.project(positions, firstInstance + j, count)) {
          this.order[count] = firstName + j;
          count++;
        }
      }
      firstName += skeleton.joints.length;
    }
    // Nearest first; a selection sort will do for so few.
    for (let n = 0; n < count && this.written < LIMIT; n++) {
      let best = -1;
      for (let i = 0; i < count; i++) {
        if (this.screen[3 * i + 2] < Infinity && (best < 0 || this.screen[3 * i + 2] < this.screen[3 * best + 2]))
          best = i;
      }
      if (best < 0) break;
      this.screen[3 * best + 2] = Infinity;
      this.write(this.names[this.order[best]], this.screen[3 * best] + BESIDE, this.screen[3 * best + 1], theme.label);
    }
  }

  private writeCharacters(positions: Float64Array, theme: StageTheme): void {
    const { characterNames: names, selectedCharacter: first } = this;
    if (names.length === 0) return;
    if (first >= 0) this.writeCharacter(first, positions, theme.selectedLabel);
    for (let c = 0; c < names.length; c++) {
      if (c === first) continue;
      const { tint } = this.drawn[c];
      this.writeCharacter(c, positions, tint ? theme[tint] : theme.label);
    }
  }

  private writeCharacter(c: number, positions: Float64Array, color: string): void {
    const { place } = this;
    if (!placeName(this.drawn[c], positions, this.toClip, this.width, this.height, place)) return;
    const name = this.characterNames[c];
    // Above a name that is already there.
    for (let line = 0; line < NAME_LINES; line++) {
      if (this.write(name, place[0] - name.width / 2, place[1] - line * LINE_HEIGHT, color)) return;
    }
  }

  private writeAlways(instance: number, positions: Float64Array, theme: StageTheme): void {
    const name = instance === this.hovered ? this.hoveredName : this.nameOf(instance);
    if (!name || !this.project(positions, instance, CANDIDATES - 1)) return;
    const color = instance === this.selected ? theme.selectedLabel : theme.label;
    const o = 3 * (CANDIDATES - 1);
    this.write(name, this.screen[o] + BESIDE, this.screen[o + 1], color);
  }

  /** Writes an instance's screen position to slot `to`; false if it is out of view. */
  private project(positions: Float64Array, instance: number, to: number): boolean {
    const m = this.toClip.elements;
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
  private write(name: Name, x: number, y: number, color: string): boolean {
    const { text, width } = name;
    if (text === '' || this.written >= LIMIT) return false;
    const left = Math.round(x);
    const top = Math.round(y) - LINE_HEIGHT / 2;
    const { boxes } = this;
    for (let b = 0; b < this.written; b++) {
      const o = 4 * b;
      const apart =
        left > boxes[o + 2] || left + width < boxes[o] || top > boxes[o + 3] || top + LINE_HEIGHT < boxes[o + 1];
      if (!apart) return false;
    }
    const o = 4 * this.written++;
    boxes[o] = left - 4;
    boxes[o + 1] = top;
    boxes[o + 2] = left + width + 4;
    boxes[o + 3] = top + LINE_HEIGHT;
    this.sprites.draw(this.pen, name, color, left, Math.round(y));
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
    for (const { characterId, nodes } of this.drawn) {
      if (found && characterId === found.characterId) return this.names[first + found.joint];
      first += nodes.jointCount;
    }
    return undefined;
  }
}

function cut(name: string, most: number): string {
  return name.length > most ? `${name.slice(0, most - 1)}…` : name;
}
