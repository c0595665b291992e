/**
 * Draws the curves. A line is traced again only if its channel or the view has changed: dragging keys of one channel
 * traces only that one.
 *
 * A few lines are drawn at once. Many are drawn to an offscreen canvas, a few milliseconds per frame; until that is
 * done the last complete image is shown, transformed to the current view: correct but for its sharpness:
 *
 *     frame      1         2         3         4
 *     view       ──────── moves ──────▶  rests
 *     aside      traces …  traces …  paints ─┐
 *     shown      old, moved          old     └▶ new
 */
import { type ColumnLine, ColumnRaster } from '../../../../evaluate/plot/raster.ts';
import { sampleExtremes } from '../../../../evaluate/plot/sample-extremes.ts';
import { CURVE, MOVE, type TracedPath, type TraceMap } from '../../../../evaluate/plot/trace-path.ts';
import type { Samples } from '../../../../model/takes/samples.ts';
import type { Channel } from '../../../../model/takes/take.ts';
import { type BaseColour, faintly, mixed } from '../scene/colours.ts';
import { type CurveLine, type CurveScene, isFaint } from '../scene/scene.ts';
import type { CurveSpace } from '../scene/space.ts';
import { DOT_PERIOD, LineTrace, sameMap, traceLine, traceMap } from '../scene/trace.ts';
import { movedBetween } from '../scene/view-change.ts';

const LINE_WIDTH = 1.5;
const EMPHASISED_WIDTH = 2;
/**
 * More lines than this are drawn offscreen, at the resolution of CSS pixels even on finer screens, where the difference
 * isn't visible.
 */
const MAX_LINES_AT_ONCE = 12;
/** Milliseconds per frame for drawing offscreen. */
const SLICE_MS = 2.5;
const DOT = 2;
const DOTS: readonly number[] = [DOT, DOT_PERIOD - DOT];
const UNBROKEN: readonly number[] = [];

interface Traced {
  readonly channel: Channel;
  /** If it follows samples instead of keys. */
  readonly samples: Samples | undefined;
  readonly map: TraceMap;
  readonly columnsPerPixel: number;
  readonly trace: LineTrace;
  readonly solid: Path2D | undefined;
  readonly dotted: Path2D | undefined;
}

/** Everything that an image of the lines depends on. */
export interface LinesView {
  readonly scene: CurveScene;
  /** Channels drawn on top of the others. */
  readonly standOut: ReadonlySet<number>;
  /** Device pixels per CSS pixel. */
  readonly ratio: number;
  readonly palette: Readonly<Record<BaseColour, string>>;
  /** `#rrggbb` behind the lines. */
  readonly ground: string;
}

/** A complete image of the lines, and its view. */
interface Sheet {
  readonly canvas: HTMLCanvasElement;
  readonly view: LinesView;
}

export class CurveLayer {
  private traced = new Map<number, Traced>();
  private readonly raster = new ColumnRaster();
  private readonly columns = document.createElement('canvas');
  /** View of the raster's bytes. */
  private image: ImageData | undefined;
  /** The last complete image of many lines. */
  private shown: Sheet | undefined;
  /** The next image, in progress. */
  private next: { readonly sheet: Sheet; readonly steps: Generator<void, void> } | undefined;

  /**
   * @param g scaled to CSS pixels
   * @returns whether the image is that of the view; if not, call again in the next frame
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

  /** Draws a line again on top of the others: the hovered one. */
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
    // An edit is shown at once, and so is a view that the last image can't be transformed to.
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

  /** Draws the last complete image, transformed to this view. */
  private show(g: CanvasRenderingContext2D, { scene, ratio }: LinesView): void {
    if (!this.shown) return;
    const { canvas, view } = this.shown;
    const change = movedBetween(view.scene.space, scene.space, scene.lines);
    g.save();
    g.beginPath();
    g.rect(0, 0, scene.space.width, scene.space.height);
    g.clip();
    const { scaleX, scaleY, x, y } = change ?? { scaleX: 1, scaleY: 1, x: 0, y: 0 };
    // Pixel for pixel if nothing moved, ignoring the context's scale.
    g.setTransform(scaleX, 0, 0, scaleY, x * ratio, y * ratio);
    g.drawImage(canvas, 0, 0);
    g.restore();
  }

  /** Draws everything, yielding after each line and strip. */
  private *drawing(g: CanvasRenderingContext2D, view: LinesView): Generator<void, void> {
    const { scene, standOut, ratio, palette, ground } = view;
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
    const rank = (line: CurveLine) => (standOut.has(line.channel) ? 2 : isFaint(scene, line) ? 0 : 1);
    // Faint lines at the back, those with selected keys on top.
    const order = [0, 1, 2].flatMap((r) => lines.filter((line) => rank(line) === r));
    const look = new Map(
      order.map((line) => [
        line,
        {
          colour: isFaint(scene, line) ? faintly(line.colour, palette, ground) : mixed(line.colour, palette),
          width: standOut.has(line.channel) ? EMPHASISED_WIDTH : LINE_WIDTH,
        },
      ]),
    );
    yield* this.drawingColumns(g, scene.space, look, ratio, columnsPerPixel);
    g.lineJoin = 'round';
    for (const [line, { colour, width }] of look) {
      const traced = this.traced.get(line.channel);
      if (!traced?.dotted && !traced?.solid) continue;
      g.strokeStyle = colour;
      g.lineWidth = width;
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
    look: ReadonlyMap<CurveLine, { readonly colour: string; readonly width: number }>,
    ratio: number,
    columnsPerPixel: number,
  ): Generator<void, void> {
    const dense: ColumnLine[] = [];
    for (const [line, { colour, width }] of look) {
      const columns = this.traced.get(line.channel)?.trace.columns;
      if (!columns || columns.from === columns.to) continue;
      dense.push({ columns, colour, width });
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
    // Pixel for pixel, ignoring the context's scale.
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

/** Whether both views have the same image. */
function sameView(a: LinesView, b: LinesView): boolean {
  return (
    a.scene.space === b.scene.space &&
    sameSet(a.standOut, b.standOut) &&
    a.scene.emphasised === b.scene.emphasised &&
    isStandIn(a, b)
  );
}

/** Whether an image of one view can be transformed to the other: the same curves, seen from elsewhere. */
function isStandIn(a: LinesView, b: LinesView): boolean {
  return (
    a.scene.take === b.scene.take &&
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
  const channel = scene.take.channels[line.channel];
  const map = traceMap(scene, line);
  const { curves } = scene;
  const samples = curves.columns[line.channel] >= 0 ? curves.samples : undefined;
  const sameCurve = before?.channel === channel && before.samples === samples;
  if (sameCurve && before.columnsPerPixel === columnsPerPixel && sameMap(before.map, map)) return before;
  const trace = before?.trace ?? new LineTrace();
  traceLine(curves, line.channel, channel, map, columnsPerPixel, trace);
  return { channel, samples, map, columnsPerPixel, trace, solid: pathOf(trace.solid), dotted: pathOf(trace.dotted) };
}

/** Undefined if empty: a hundred paths are created per frame. */
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
