/**
 * What inverse kinematics draws over the scene: pins, gaps to their targets, points that could be pinned, locked
 * joints. Three draws in all. Its owner repaints it before each frame, since pins move with their joints.
 */
import { type Color, Group } from 'three';
import type { Vec3 } from '../../math/vec3.ts';
import type { Overlay } from '../overlay.ts';
import { rawColor } from '../scene/thick-lines.ts';
import type { StageTheme } from '../theme.ts';
import { PinLines } from './pin-lines.ts';
import { type MarkShape, PinMarks } from './pin-marks.ts';

const COLORS = ['pin', 'pinGap', 'selected', 'hovered', 'label', 'axisX', 'axisY', 'axisZ'] as const;
/** A colour of the stage's theme. */
export type PinColor = (typeof COLORS)[number];

export interface MarkLook {
  readonly shape: MarkShape;
  readonly color: PinColor;
  /** Diameter in CSS pixels. */
  readonly size: number;
  /** 0 to 1: how much of its inside is coloured; absent: all. */
  readonly fill?: number;
  readonly opacity?: number;
  /** Faint if a surface is further in front of it than this, in world units; absent: never. */
  readonly cover?: number;
}

export interface PinPainter {
  /** @param at in the world */
  mark(at: Vec3, look: MarkLook): void;
  line(start: Vec3, end: Vec3, color: PinColor, widthPx: number, isDashed: boolean): void;
}

export class PinOverlay implements Overlay {
  readonly object = new Group();
  private readonly marks = new PinMarks();
  private readonly lines = new PinLines();
  private colors: Readonly<Record<PinColor, Color>> | undefined;
  private readonly painter: PinPainter = {
    mark: (at, { shape, color, size, fill = 1, opacity = 1, cover = Infinity }) => {
      if (this.colors) this.marks.add(at, shape, this.colors[color], opacity, size, fill, cover);
    },
    line: (start, end, color, widthPx, isDashed) => {
      if (this.colors) this.lines.add(start, end, this.colors[color], widthPx, isDashed);
    },
  };

  /** @param paint draws the current marks; called before each frame */
  constructor(private readonly paint: (painter: PinPainter) => void) {
    this.object.add(this.lines.mesh, this.marks.object);
  }

  update(): void {
    this.marks.clear();
    this.lines.clear();
    this.paint(this.painter);
    this.marks.filled();
    this.lines.filled();
  }

  setTheme(theme: StageTheme): void {
    const color = (name: PinColor) => rawColor(theme[name]);
    this.colors = {
      pin: color('pin'),
      pinGap: color('pinGap'),
      selected: color('selected'),
      hovered: color('hovered'),
      label: color('label'),
      axisX: color('axisX'),
      axisY: color('axisY'),
      axisZ: color('axisZ'),
    };
    this.marks.setHalo(theme.labelHalo);
  }

  dispose(): void {
    this.marks.dispose();
    this.lines.dispose();
  }
}
