/**
 * Draws distances over time on two canvases: edits and navigation below; playhead and hover above, so that playback
 * redraws only a line.
 */
import type { Distances } from '../../../evaluate/compare/distance.ts';
import { roundStep, wholeNumbers } from '../../../math/round-steps.ts';
import { drawOutsideRange, drawPlayhead, drawTimeGrid, type TimeView, translucent } from '../timeline/time-ground.ts';
import { TimePicture } from '../timeline/time-picture.ts';
import {
  drawReadout,
  JOINT_COLOURS,
  type PlotColours,
  type PlotReadout,
  readPlotColours,
  styleColour,
} from '../timeline/time-plot.ts';
import { traceFrames } from '../timeline/trace-frames.ts';
import { type DistanceUnit, distanceNumber } from './distance-text.ts';

export interface ChartLine {
  /** One value per frame. */
  readonly values: Float32Array;
  readonly kind: 'joint' | 'mean' | 'most' | 'hovered';
  readonly label: string;
  /** Index among the picked joints. */
  readonly ordinal: number;
}

export interface ChartScene {
  readonly view: TimeView;
  readonly height: number;
  readonly distances: Distances | undefined;
  readonly unit: DistanceUnit;
  readonly lines: readonly ChartLine[];
  /** Distance at the top. */
  readonly top: number;
}

interface Colours extends PlotColours {
  readonly palette: readonly string[];
}

const FOOT = 8;
/** Margin at the top, for its label. */
const HEAD = 18;
const LABELS_APART = 28;
/** Safety limit. */
const MAX_LINES = 100;
/** Dashes distinguish joints when colours run out. */
const DASHES: readonly (readonly number[])[] = [[], [6, 3], [2, 3]];

export class ChartPicture {
  private readonly picture = new TimePicture(readColours);
  readonly element = this.picture.element;

  recolour(): void {
    this.picture.recolour();
  }

  draw(scene: ChartScene): void {
    const g = this.picture.below(scene.view.width, scene.height);
    if (!g) return;
    const { colours } = this.picture;
    const { view, height } = scene;
    g.fillStyle = colours.plot;
    g.fillRect(0, 0, view.width, height);
    drawOutsideRange(g, view, 0, height, colours);
    drawTimeGrid(g, view, 0, height, colours);
    this.drawValueGrid(g, scene, colours);
    for (const line of scene.lines) this.drawLine(g, scene, line, colours);
    this.drawLegend(g, scene, colours);
  }

  drawOverlay(scene: ChartScene, timeSeconds: number, readout: PlotReadout | undefined): void {
    const g = this.picture.above(scene.view.width, scene.height);
    if (!g) return;
    const { colours } = this.picture;
    const { view, height } = scene;
    drawPlayhead(g, view, timeSeconds, height, colours);
    if (readout) drawReadout(g, view, readout, colours);
  }

  private drawValueGrid(g: CanvasRenderingContext2D, scene: ChartScene, colours: Colours): void {
    const { view, height, unit, top, distances } = scene;
    if (!distances || !(top > 0)) return;
    const room = height - HEAD - FOOT;
    const step = roundStep((top * unit.factor * LABELS_APART) / Math.max(LABELS_APART, room)) / unit.factor;
    g.font = colours.font;
    g.textAlign = 'left';
    g.textBaseline = 'bottom';
    for (const i of wholeNumbers(0, top / step, MAX_LINES)) {
      const y = Math.round(yAt(scene, i * step));
      g.fillStyle = i === 0 ? colours.line : colours.fineLine;
      g.fillRect(0, y, view.width, 1);
      if (i === 0) continue;
      g.fillStyle = colours.faint;
      const isLast = (i + 1) * step > top;
      g.fillText(`${distanceNumber(i * step, unit)}${isLast && unit.symbol ? ` ${unit.symbol}` : ''}`, 4, y - 1);
    }
  }

  /** The legend, from the right edge; lines without room are in the list anyway. */
  private drawLegend(g: CanvasRenderingContext2D, { lines, view }: ChartScene, colours: Colours): void {
    g.font = colours.font;
    g.textAlign = 'left';
    g.textBaseline = 'middle';
    const y = 12;
    let right = view.width - 8;
    for (const line of lines) {
      const width = Math.ceil(g.measureText(line.label).width) + 22;
      if (right - width < view.width / 3) return;
      right -= width;
      g.fillStyle = translucent(colours.plot, 0.8);
      g.fillRect(right, y - 8, width, 16);
      g.fillStyle = colourOf(line, colours);
      g.globalAlpha = opacityOf(line);
      g.fillRect(right + 4, y - 1, 10, 2);
      g.globalAlpha = 1;
      g.fillStyle = line.kind === 'most' ? colours.faint : colours.text;
      g.fillText(line.label, right + 18, y + 0.5);
    }
  }

  private drawLine(g: CanvasRenderingContext2D, scene: ChartScene, line: ChartLine, colours: Colours): void {
    const { distances, view } = scene;
    if (!distances) return;
    g.save();
    g.beginPath();
    g.rect(0, 0, view.width, scene.height);
    g.clip();
    g.lineJoin = 'round';
    g.lineWidth = line.kind === 'joint' ? 1.75 : 1.25;
    g.strokeStyle = colourOf(line, colours);
    g.globalAlpha = opacityOf(line);
    const { palette } = colours;
    if (line.kind === 'joint') {
      g.setLineDash([...DASHES[Math.floor(line.ordinal / palette.length) % DASHES.length]]);
    }
    g.beginPath();
    traceFrames(g, view, distances, line.values, (value) => yAt(scene, value));
    g.stroke();
    g.restore();
  }
}

function readColours(target: Element): Colours {
  return { ...readPlotColours(target), palette: JOINT_COLOURS.map((name) => styleColour(target, name)) };
}

function colourOf({ kind, ordinal }: ChartLine, colours: Colours): string {
  if (kind === 'joint') return colours.palette[ordinal % colours.palette.length];
  if (kind === 'hovered') return colours.text;
  return kind === 'mean' ? colours.text : colours.faint;
}

function opacityOf({ kind }: ChartLine): number {
  return kind === 'most' ? 0.6 : kind === 'hovered' ? 0.75 : 1;
}

export function yAt({ height, top }: Pick<ChartScene, 'height' | 'top'>, distance: number): number {
  return height - FOOT - (top > 0 ? distance / top : 0) * (height - HEAD - FOOT);
}
