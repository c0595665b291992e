/** Draws quantities over time, and their values at the playhead. Contacts are bars, a row each. */
import { shown } from '../../widgets/numbers/number-text.ts';
import { timeX } from '../../widgets/time/time-window.ts';
import type { TimeScene } from '../timeline/time-chart.ts';
import { translucent } from '../timeline/time-ground.ts';
import {
  drawDot,
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
import { framesIn } from '../timeline/trace-frames.ts';
import { type Series, valueAt } from './series.ts';

export interface PlotScene extends TimeScene {
  readonly series: readonly Series[];
  readonly axis: ValueAxis;
  readonly unit: string;
  /** Contacts, as bars. */
  readonly isBars: boolean;
  /** Whether colours tell characters apart, rather than joints. */
  readonly byCharacter: boolean;
}

export interface SeriesColours extends PlotColours {
  readonly joints: readonly string[];
  readonly characters: readonly string[];
}

/** CSS pixels. */
export const MARGINS = { head: 10, foot: 10 };
const DASHES: readonly (readonly number[])[] = [[], [7, 3], [2, 3], [9, 3, 2, 3]];
/** The first two are the tints of compared characters. */
const OF_CHARACTERS = ['--take-first', '--take-second', '--axis-y', '--accent', '--axis-x', '--axis-z', '--selected'];
/** Height of the bars, CSS pixels. */
const BAR = 10;

export function readColours(target: Element): SeriesColours {
  const colour = (name: string) => styleColour(target, name);
  return {
    ...readPlotColours(target),
    joints: JOINT_COLOURS.map(colour),
    characters: OF_CHARACTERS.map(colour),
  };
}

export function colourOf(series: Series, byCharacter: boolean, { joints, characters }: SeriesColours): string {
  const [palette, at] = byCharacter ? [characters, series.source] : [joints, series.ordinal];
  return palette[at % palette.length];
}

/** Dashes tell apart what has one colour. */
export function dashOf({ ordinal }: Series, byCharacter: boolean): number {
  return byCharacter ? ordinal : Math.floor(ordinal / JOINT_COLOURS.length);
}

export function drawSeries(g: CanvasRenderingContext2D, scene: PlotScene, colours: SeriesColours): void {
  const { view, axis, series: all, byCharacter } = scene;
  if (scene.isBars) {
    for (const [row, series] of all.entries()) {
      drawBars(g, scene, series, row, colourOf(series, byCharacter, colours));
    }
    return;
  }
  const ticks = valueTicks(axis);
  drawValueGrid(g, axis, ticks, view.width, colours);
  for (const series of all) {
    const { frames, values } = series;
    const dash = DASHES[dashOf(series, byCharacter) % DASHES.length];
    drawValueLine(g, view, axis, { frames, values, colour: colourOf(series, byCharacter, colours), width: 1.5, dash });
  }
  drawValueLabels(g, scene, ticks, colours);
}

/** The values at the playhead, as dots. */
export function drawValuesAt(
  g: CanvasRenderingContext2D,
  scene: PlotScene,
  timeSeconds: number,
  colours: SeriesColours,
): void {
  const x = timeX(scene.view, timeSeconds);
  if (scene.isBars || x < 0 || x > scene.view.width) return;
  for (const series of scene.series) {
    const value = valueAt(series, timeSeconds);
    if (value === undefined) continue;
    g.fillStyle = colourOf(series, scene.byCharacter, colours);
    drawDot(g, x, valueY(scene.axis, value));
  }
}

/** Over the lines, each on a ground of its own. */
function drawValueLabels(
  g: CanvasRenderingContext2D,
  { axis, unit }: PlotScene,
  ticks: readonly number[],
  colours: SeriesColours,
): void {
  g.font = colours.font;
  g.textAlign = 'left';
  g.textBaseline = 'middle';
  for (const value of ticks) {
    const text = `${shown(value, 4)}${value === ticks.at(-1) && unit ? ` ${unit}` : ''}`;
    const y = Math.max(8, Math.min(axis.height - 8, Math.round(valueY(axis, value))));
    g.fillStyle = translucent(colours.plot, 0.8);
    g.fillRect(2, y - 7, g.measureText(text).width + 4, 14);
    g.fillStyle = colours.faint;
    g.fillText(text, 4, y + 0.5);
  }
}

/** Centre of a row of bars. */
export function barY({ height, series }: Pick<PlotScene, 'height' | 'series'>, row: number): number {
  const { head, foot } = MARGINS;
  return head + ((row + 0.5) / series.length) * (height - head - foot);
}

function drawBars(g: CanvasRenderingContext2D, scene: PlotScene, series: Series, row: number, colour: string): void {
  const { view } = scene;
  const { frames, values } = series;
  const [first, end] = framesIn(frames, view.window);
  const top = Math.round(barY(scene, row)) - BAR / 2;
  const x = (f: number) => timeX(view, frames.startSeconds + f * frames.frameSeconds);
  g.fillStyle = colour;
  g.globalAlpha = 0.2;
  g.fillRect(x(0), top + BAR / 2, x(frames.frameCount - 1) - x(0), 1);
  g.globalAlpha = 1;
  for (let f = first; f < end; f++) {
    if (values[f] === 0) continue;
    const from = f;
    while (f + 1 < end && values[f + 1] !== 0) f++;
    g.fillRect(x(from), top, Math.max(1, x(f) - x(from)), BAR);
  }
}
