/**
 * Draws quantities over time on two canvases: lines and axes below; playhead, values there and the readout above, so
 * that playback redraws little. Contacts are bars, a row each.
 */
import { roundStep, wholeNumbers } from '../../../math/round-steps.ts';
import { shown } from '../../widgets/numbers/number-text.ts';
import { timeX } from '../../widgets/time/time-window.ts';
import { drawOutsideRange, drawPlayhead, drawTimeGrid, type TimeView, translucent } from '../timeline/time-ground.ts';
import { TimePicture } from '../timeline/time-picture.ts';
import {
  drawDot,
  drawReadout,
  JOINT_COLOURS,
  type PlotColours,
  type PlotReadout,
  readPlotColours,
  styleColour,
} from '../timeline/time-plot.ts';
import { framesIn, traceFrames } from '../timeline/trace-frames.ts';
import { type Series, valueAt } from './series.ts';

export interface PlotScene {
  readonly view: TimeView;
  readonly height: number;
  readonly series: readonly Series[];
  /** Values at the bottom and at the top. */
  readonly least: number;
  readonly most: number;
  readonly unit: string;
  /** Contacts, as bars. */
  readonly isBars: boolean;
  /** Whether colours tell characters apart, rather than joints. */
  readonly byCharacter: boolean;
}

interface Colours extends PlotColours {
  readonly joints: readonly string[];
  readonly characters: readonly string[];
}

const FOOT = 10;
const HEAD = 10;
const LABELS_APART = 28;
const DASHES: readonly (readonly number[])[] = [[], [7, 3], [2, 3], [9, 3, 2, 3]];
/** The first two are the tints of compared characters. */
const OF_CHARACTERS = ['--take-first', '--take-second', '--axis-y', '--accent', '--axis-x', '--axis-z', '--selected'];
/** Height of the bars, CSS pixels. */
const BAR = 10;

export class PlotPicture {
  private readonly picture = new TimePicture(readColours);
  readonly element = this.picture.element;

  recolour(): void {
    this.picture.recolour();
  }

  colourOf(series: Series, byCharacter: boolean): string {
    const { joints, characters } = this.picture.colours;
    const [palette, at] = byCharacter ? [characters, series.source] : [joints, series.ordinal];
    return palette[at % palette.length];
  }

  draw(scene: PlotScene): void {
    const g = this.picture.below(scene.view.width, scene.height);
    if (!g) return;
    const { colours } = this.picture;
    const { view, height } = scene;
    g.fillStyle = colours.plot;
    g.fillRect(0, 0, view.width, height);
    drawOutsideRange(g, view, 0, height, colours);
    drawTimeGrid(g, view, 0, height, colours);
    g.save();
    g.beginPath();
    g.rect(0, 0, view.width, height);
    g.clip();
    if (!scene.isBars) this.drawValueLines(g, scene, colours);
    for (const [row, series] of scene.series.entries()) {
      const colour = this.colourOf(series, scene.byCharacter);
      if (scene.isBars) drawBars(g, scene, series, row, colour);
      else drawLine(g, scene, series, colour);
    }
    if (!scene.isBars) this.drawValueLabels(g, scene, colours);
    g.restore();
  }

  drawOverlay(scene: PlotScene, timeSeconds: number, readout: PlotReadout | undefined): void {
    const g = this.picture.above(scene.view.width, scene.height);
    if (!g) return;
    const { colours } = this.picture;
    const { view, height } = scene;
    drawPlayhead(g, view, timeSeconds, height, colours);
    const x = timeX(view, timeSeconds);
    if (!scene.isBars && x >= 0 && x <= view.width) {
      for (const series of scene.series) {
        const value = valueAt(series, timeSeconds);
        if (value === undefined) continue;
        g.fillStyle = this.colourOf(series, scene.byCharacter);
        drawDot(g, x, valueY(scene, value));
      }
    }
    if (readout) drawReadout(g, view, readout, colours);
  }

  private drawValueLines(g: CanvasRenderingContext2D, scene: PlotScene, colours: Colours): void {
    for (const value of valueTicks(scene)) {
      g.fillStyle = value === 0 ? colours.line : colours.fineLine;
      g.fillRect(0, Math.round(valueY(scene, value)), scene.view.width, 1);
    }
  }

  /** Over the lines, each on a ground of its own. */
  private drawValueLabels(g: CanvasRenderingContext2D, scene: PlotScene, colours: Colours): void {
    const ticks = valueTicks(scene);
    g.font = colours.font;
    g.textAlign = 'left';
    g.textBaseline = 'middle';
    ticks.forEach((value, i) => {
      const isLast = i === ticks.length - 1;
      const text = `${shown(value, 4)}${isLast && scene.unit ? ` ${scene.unit}` : ''}`;
      const y = Math.max(8, Math.min(scene.height - 8, Math.round(valueY(scene, value))));
      g.fillStyle = translucent(colours.plot, 0.8);
      g.fillRect(2, y - 7, g.measureText(text).width + 4, 14);
      g.fillStyle = colours.faint;
      g.fillText(text, 4, y + 0.5);
    });
  }
}

function readColours(target: Element): Colours {
  const colour = (name: string) => styleColour(target, name);
  return {
    ...readPlotColours(target),
    joints: JOINT_COLOURS.map(colour),
    characters: OF_CHARACTERS.map(colour),
  };
}

/** Dashes tell apart what has one colour. */
export function dashOf({ ordinal }: Series, byCharacter: boolean): number {
  return byCharacter ? ordinal : Math.floor(ordinal / JOINT_COLOURS.length);
}

/** Pixels from the top. */
export function valueY({ height, least, most }: Pick<PlotScene, 'height' | 'least' | 'most'>, value: number): number {
  return height - FOOT - ((value - least) / (most - least)) * (height - HEAD - FOOT);
}

/** Centre of a row of bars. */
export function barY({ height, series }: Pick<PlotScene, 'height' | 'series'>, row: number): number {
  return HEAD + ((row + 0.5) / series.length) * (height - HEAD - FOOT);
}

/** Safety limit. */
const MAX_TICKS = 1000;

function valueTicks({ height, least, most }: PlotScene): number[] {
  const step = roundStep(((most - least) * LABELS_APART) / Math.max(LABELS_APART, height - HEAD - FOOT));
  return wholeNumbers(least / step - 1e-9, most / step + 1e-9, MAX_TICKS).map((i) => i * step);
}

function drawLine(g: CanvasRenderingContext2D, scene: PlotScene, series: Series, colour: string): void {
  g.lineJoin = 'round';
  g.lineWidth = 1.5;
  g.strokeStyle = colour;
  g.setLineDash([...DASHES[dashOf(series, scene.byCharacter) % DASHES.length]]);
  g.beginPath();
  traceFrames(g, scene.view, series.frames, series.values, (value) => valueY(scene, value));
  g.stroke();
  g.setLineDash([]);
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
