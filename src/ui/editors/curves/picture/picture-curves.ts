/**
 * The curves on a canvas. A line is traced again only where its channel or the view of it is another one: while keys
 * of one channel are dragged, only that one is.
 *
 * A few lines are drawn at once. Many are drawn aside, a few milliseconds in each frame; until they are done the last
 * whole picture stands in their place, moved and stretched as the view was meanwhile, which is where each curve is but
 * for its sharpness:
 *
 *     frame      1         2         3         4
 *     view       ──────── moves ──────▶  rests
 *     aside      traces …  traces …  paints ─┐
 *     shown      old, moved          old     └▶ new
 */
import { type ColumnLine, ColumnRaster } from '../../../../evaluate/plot/raster.ts';
import { sampleExtremes } from '../../../../evaluate/plot/sample-extremes.ts';
import { CURVE, MOVE, type TracedPath, type TraceMap } from '../../../../evaluate/plot/trace-path.ts';
import type { Channel } from '../../../../model/clip.ts';
import type { Samples } from '../../../../model/samples.ts';
import { type BaseColour, mixed } from '../scene/colours.ts';
import type { CurveLine, CurveScene } from '../scene/scene.ts';
import { type CurveSpace, PLOT_TOP } from '../scene/space.ts';
import { DOT_PERIOD, LineTrace, sameMap, traceLine, traceMap } from '../scene/trace.ts';
import { movedBetween } from '../scene/view-change.ts';

export const LINE_WIDTH = 1.5;
const EMPHASISED_WIDTH = 2;
/**
 * More lines than this are drawn aside, in columns as wide as a CSS pixel, however fine the screen: nobody sees the
 * difference.
 */
const MAX_LINES_AT_ONCE = 12;
/** What drawing aside may take of a frame. */
const SLICE_MS = 2.5;
const DOT = 2;
const DOTS: readonly number[] = [DOT, DOT_PERIOD - DOT];
const UNBROKEN: readonly number[] = [];

interface Traced {
  readonly channel: Channel;
  /** What it follows instead of keys. */
  readonly samples: Samples | undefined;
  readonly map: TraceMap;
  readonly columnsPerPixel: number;
  readonly trace: LineTrace;
  readonly solid: Path2D | undefined;
  readonly dotted: Path2D | undefined;
}

/** What a picture of the lines is made of. */
export interface LinesView {
  readonly scene: CurveScene;
  /** Channels that are drawn over the others. */
  readonly standOut: ReadonlySet<number>;
  /** The screen's pixels in a CSS pixel. */
  readonly ratio: number;
  readonly palette: Readonly<Record<BaseColour, string>>;
}

/** A whole picture of the lines, and what it shows. */
interface Sheet {
  readonly canvas: HTMLCanvasElement;
  readonly view: LinesView;
}

export class CurveLayer {
  private traced = new Map<number, Traced>();
  private readonly raster = new ColumnRaster();
  private readonly columns = document.createElement('canvas');
  /** Of the raster's own bytes. */
  private image: ImageData | undefined;
  /** The last whole picture of many lines. */
  private shown: Sheet | undefined;
  /** The next one, as far as it has got. */
  private next: { readonly sheet: Sheet; readonly steps: Generator<void, void> } | undefined;

  /**
   * @param g scaled so that it counts in CSS pixels
   * @returns whether it is the picture of that view; if not, it has to be asked again in the next frame
   */
  draw(g: CanvasRenderingContext2D, view: LinesView): boolean {
    if (view.scene.lines.length <= MAX_LINES_AT_ONCE) {
      this.shown = this.next = undefined;
      finish(this.drawing(g, view));
      return true;
    }
    if (!this.shown || !sameView(this.shown.view, view)) this.goOn(view);
    this.show(g, view);
    return this.shown !== undefined && sameView(this.shown.view, view);
  }

  /** A line once more, over what is drawn: the one under the pointer. */
  outline(g: CanvasRenderingContext2D, channel: number): void {
    const traced = this.traced.get(channel);
    if (!traced) return;
    if (traced.solid) g.stroke(traced.solid);
    g.setLineDash(DOTS);
    if (traced.dotted) g.stroke(traced.dotted);
    g.setLineDash(UNBROKEN);
  }

  private goOn(view: LinesView): void {
    const { shown } = this;
    // An edit is seen at once, and so is what the last picture can't stand for.
    const mayWait = shown !== undefined && isStandIn(shown.view, view);
    if (!mayWait || (this.next && !isStandIn(this.next.sheet.view, view))) this.next = undefined;
    this.next ??= this.begin(view);
    if (!this.next) return;
    const { sheet, steps } = this.next;
    const until = performance.now() + (mayWait ? SLICE_MS : Number.POSITIVE_INFINITY);
    while (performance.now() < until) {
      if (!steps.next().done) continue;
      this.shown = sheet;
      this.next = undefined;
      return;
    }
  }

  private begin(view: LinesView) {
    const canvas = document.createElement('canvas');
    canvas.width = Math.ceil(view.scene.space.width * view.ratio);
    canvas.height = Math.ceil(view.scene.space.height * view.ratio);
    const g = canvas.getContext('2d');
    if (!g) return undefined;
    g.setTransform(view.ratio, 0, 0, view.ratio, 0, 0);
    return { sheet: { canvas, view }, steps: this.drawing(g, view) };
  }

  /** The last whole picture, where its curves are in this view. */
  private show(g: CanvasRenderingContext2D, { scene, ratio }: LinesView): void {
    if (!this.shown) return;
    const { canvas, view } = this.shown;
    const change = movedBetween(view.scene.space, scene.space, scene.lines);
    g.save();
    g.beginPath();
    g.rect(0, PLOT_TOP, scene.space.width, scene.space.height - PLOT_TOP);
    g.clip();
    const { scaleX, scaleY, x, y } = change ?? { scaleX: 1, scaleY: 1, x: 0, y: 0 };
    // Pixel for pixel where nothing moved, whatever the context counts in.
    g.setTransform(scaleX, 0, 0, scaleY, x * ratio, y * ratio);
    g.drawImage(canvas, 0, 0);
    g.restore();
  }

  /** Draws everything, and pauses after each line and each strip. */
  private *drawing(g: CanvasRenderingContext2D, view: LinesView): Generator<void, void> {
    const { scene, standOut, ratio, palette } = view;
    const { lines } = scene;
    const before = this.traced;
    this.traced = new Map(before);
    const isMany = lines.length > MAX_LINES_AT_ONCE;
    const columnsPerPixel = isMany ? 1 : ratio;
    const { samples } = scene.curves;
    if (isMany && samples) yield* sampleExtremes(samples).building();
    for (const line of lines) {
      this.traced.set(line.channel, traceAgain(scene, line, columnsPerPixel, before.get(line.channel)));
      yield;
    }
    this.forgetAllBut(lines);
    const isEmphasised = (line: CurveLine) => standOut.has(line.channel);
    // Those that stand out are drawn over the others.
    const order = [...lines.filter((line) => !isEmphasised(line)), ...lines.filter(isEmphasised)];
    const widthOf = (line: CurveLine) => (isEmphasised(line) ? EMPHASISED_WIDTH : LINE_WIDTH);
    yield* this.drawingColumns(g, scene.space, order, widthOf, ratio, columnsPerPixel, palette);
    g.lineJoin = 'round';
    for (const line of order) {
      const traced = this.traced.get(line.channel);
      if (!traced?.dotted && !traced?.solid) continue;
      g.strokeStyle = mixed(line.colour, palette);
      g.lineWidth = widthOf(line);
      if (traced.dotted) {
        g.setLineDash(DOTS);
        g.stroke(traced.dotted);
      }
      if (traced.solid) {
        g.setLineDash(line.colour.dash);
        g.stroke(traced.solid);
      }
      yield;
    }
    g.setLineDash(UNBROKEN);
  }

  private forgetAllBut(lines: readonly CurveLine[]): void {
    if (this.traced.size === lines.length) return;
    const kept = new Set(lines.map((line) => line.channel));
    for (const channel of this.traced.keys()) if (!kept.has(channel)) this.traced.delete(channel);
  }

  private *drawingColumns(
    g: CanvasRenderingContext2D,
    space: CurveSpace,
    order: readonly CurveLine[],
    widthOf: (line: CurveLine) => number,
    ratio: number,
    columnsPerPixel: number,
    palette: Readonly<Record<BaseColour, string>>,
  ): Generator<void, void> {
    const dense: ColumnLine[] = [];
    for (const line of order) {
      const columns = this.traced.get(line.channel)?.trace.columns;
      if (!columns || columns.from === columns.to) continue;
      dense.push({ columns, colour: mixed(line.colour, palette), width: widthOf(line) });
    }
    if (dense.length === 0) return;
    const width = Math.ceil(space.width * ratio);
    const height = Math.ceil(space.height * ratio);
    yield* this.raster.painting(dense, width, height, ratio, columnsPerPixel);
    if (this.columns.width !== width || this.columns.height !== height) {
      this.columns.width = width;
      this.columns.height = height;
    }
    if (this.image?.data !== this.raster.pixels || this.image.width !== width) {
      this.image = new ImageData(this.raster.pixels, width, height);
    }
    this.columns.getContext('2d')?.putImageData(this.image, 0, 0);
    // Pixel for pixel, whatever the context counts in.
    g.save();
    g.setTransform(1, 0, 0, 1, 0, 0);
    g.drawImage(this.columns, 0, 0);
    g.restore();
  }
}

function finish(steps: Generator<void, void>): void {
  while (!steps.next().done);
}

function sameSet(a: ReadonlySet<number>, b: ReadonlySet<number>): boolean {
  return a.size === b.size && [...a].every((channel) => b.has(channel));
}

/** Whether a picture of one view is one of the other. */
function sameView(a: LinesView, b: LinesView): boolean {
  return a.scene.space === b.scene.space && sameSet(a.standOut, b.standOut) && isStandIn(a, b);
}

/** Whether a picture of one view may stand for the other until that is drawn: the same curves, seen from elsewhere. */
function isStandIn(a: LinesView, b: LinesView): boolean {
  return (
    a.scene.clip === b.scene.clip &&
    a.scene.lines === b.scene.lines &&
    a.scene.offsetSeconds === b.scene.offsetSeconds &&
    a.palette === b.palette &&
    a.ratio === b.ratio &&
    a.scene.space.width === b.scene.space.width &&
    a.scene.space.height === b.scene.space.height &&
    movedBetween(a.scene.space, b.scene.space, b.scene.lines) !== undefined
  );
}

function traceAgain(scene: CurveScene, line: CurveLine, columnsPerPixel: number, before: Traced | undefined): Traced {
  const channel = scene.clip.channels[line.channel];
  const map = traceMap(scene, line);
  const { curves } = scene;
  const samples = curves.columns[line.channel] >= 0 ? curves.samples : undefined;
  const sameCurve = before?.channel === channel && before.samples === samples;
  if (sameCurve && before.columnsPerPixel === columnsPerPixel && sameMap(before.map, map)) return before;
  const trace = before?.trace ?? new LineTrace();
  traceLine(curves, line.channel, channel, map, columnsPerPixel, trace);
  return { channel, samples, map, columnsPerPixel, trace, solid: pathOf(trace.solid), dotted: pathOf(trace.dotted) };
}

/** None for nothing: a hundred paths are made in a frame. */
function pathOf({ verbs, points, verbCount }: TracedPath): Path2D | undefined {
  if (verbCount === 0) return undefined;
  const path = new Path2D();
  let p = 0;
  for (let v = 0; v < verbCount; v++) {
    if (verbs[v] === CURVE) {
      path.bezierCurveTo(points[p], points[p + 1], points[p + 2], points[p + 3], points[p + 4], points[p + 5]);
      p += 6;
    } else {
      if (verbs[v] === MOVE) path.moveTo(points[p], points[p + 1]);
      else path.lineTo(points[p], points[p + 1]);
      p += 2;
    }
  }
  return path;
}
