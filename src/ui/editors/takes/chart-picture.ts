/** Draws distances over time, and whose they are. */
import type { Distances } from '../../../evaluate/compare/distance.ts';
import type { TimeScene } from '../timeline/time-chart.ts';
import { translucent } from '../timeline/time-ground.ts';
import {
  drawValueGrid,
  drawValueLine,
  JOINT_COLOURS,
  type PlotColours,
  readPlotColours,
  styleColour,
  type ValueAxis,
  valueTicks,
  valueY,
} from '../timeline/time-plot.ts';
import { type DistanceUnit, distanceNumber } from './distance-text.ts';

export interface ChartLine {
  /** One value per frame. */
  readonly values: Float32Array;
  readonly kind: 'joint' | 'mean' | 'most' | 'hovered';
  readonly label: string;
  /** Index among the picked joints. */
  readonly ordinal: number;
}

export interface ChartScene extends TimeScene {
  readonly distances: Distances | undefined;
  readonly unit: DistanceUnit;
  readonly lines: readonly ChartLine[];
  readonly axis: ValueAxis;
}

export interface ChartColours extends PlotColours {
  readonly palette: readonly string[];
}

/** Dashes distinguish joints when colours run out. */
const DASHES: readonly (readonly number[])[] = [[], [6, 3], [2, 3]];

export function readColours(target: Element): ChartColours {
  return { ...readPlotColours(target), palette: JOINT_COLOURS.map((name) => styleColour(target, name)) };
}

export function drawDistances(g: CanvasRenderingContext2D, scene: ChartScene, colours: ChartColours): void {
  const { distances: frames, view, axis } = scene;
  if (frames) {
    drawAxis(g, scene, colours);
    const { palette } = colours;
    for (const line of scene.lines) {
      const isJoint = line.kind === 'joint';
      drawValueLine(g, view, axis, {
        ...{ frames, values: line.values, colour: colourOf(line, colours), opacity: opacityOf(line) },
        width: isJoint ? 1.75 : 1.25,
        ...(isJoint && { dash: DASHES[Math.floor(line.ordinal / palette.length) % DASHES.length] }),
      });
    }
  }
  drawLegend(g, scene, colours);
}

function drawAxis(g: CanvasRenderingContext2D, { view, unit, axis }: ChartScene, colours: ChartColours): void {
  const ticks = valueTicks(axis, unit.factor);
  drawValueGrid(g, axis, ticks, view.width, colours);
  g.font = colours.font;
  g.textAlign = 'left';
  g.textBaseline = 'bottom';
  g.fillStyle = colours.faint;
  for (const value of ticks) {
    if (value === 0) continue;
    const symbol = value === ticks.at(-1) && unit.symbol ? ` ${unit.symbol}` : '';
    g.fillText(`${distanceNumber(value, unit)}${symbol}`, 4, Math.round(valueY(axis, value)) - 1);
  }
}

/** The legend, from the right edge; lines without room are in the list anyway. */
function drawLegend(g: CanvasRenderingContext2D, { lines, view }: ChartScene, colours: ChartColours): void {
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

function colourOf({ kind, ordinal }: ChartLine, colours: ChartColours): string {
  if (kind === 'joint') return colours.palette[ordinal % colours.palette.length];
  if (kind === 'hovered') return colours.text;
  return kind === 'mean' ? colours.text : colours.faint;
}

function opacityOf({ kind }: ChartLine): number {
  return kind === 'most' ? 0.6 : kind === 'hovered' ? 0.75 : 1;
}
