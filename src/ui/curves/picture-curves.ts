/**
 * The curves on a canvas. A line is traced again only where its channel or the view of it is another one: while keys
 * of one channel are dragged, only that one is.
 */
import type { Channel } from '../../model/clip.ts';
import { type BaseColour, mixed } from './colours.ts';
import { type ColumnLine, ColumnRaster } from './picture-raster.ts';
import type { CurveLine, CurveScene } from './scene.ts';
import { DOT_PERIOD, LineTrace, sameMap, traceLine, traceMap } from './trace.ts';
import { CURVE, MOVE, type TracedPath, type TraceMap } from './trace-path.ts';

export const LINE_WIDTH = 1.5;
const EMPHASISED_WIDTH = 2;
/** With more lines than this, columns are as wide as a CSS pixel, however fine the screen: nobody sees the difference. */
const MOST_FINE_LINES = 12;
/** While the view moves, columns of many lines are three times as wide: what passes by is not read to the pixel. */
const MOVING_COLUMNS_PER_PIXEL = 1 / 3;
const DOT = 2;
const DOTS: readonly number[] = [DOT, DOT_PERIOD - DOT];
const UNBROKEN: readonly number[] = [];

interface Traced {
  readonly channel: Channel;
  readonly map: TraceMap;
  readonly columnsPerPixel: number;
  readonly trace: LineTrace;
  readonly solid: Path2D | undefined;
  readonly dotted: Path2D | undefined;
}

export class CurveLayer {
  private traced = new Map<number, Traced>();
  private readonly raster = new ColumnRaster();
  private readonly columns = document.createElement('canvas');
  /** Of the raster's own bytes. */
  private image: ImageData | undefined;

  /**
   * @param g scaled so that it counts in CSS pixels, `ratio` of the screen's to each
   * @param moving the view is on its way: may be drawn more coarsely
   * @returns whether it was, and should be drawn once more at rest
   */
  draw(
    g: CanvasRenderingContext2D,
    scene: CurveScene,
    isEmphasised: (line: CurveLine) => boolean,
    ratio: number,
    palette: Readonly<Record<BaseColour, string>>,
    moving: boolean,
  ): boolean {
    const { lines } = scene;
    const before = this.traced;
    this.traced = new Map();
    const many = lines.length > MOST_FINE_LINES;
    const columnsPerPixel = many ? (moving ? MOVING_COLUMNS_PER_PIXEL : 1) : ratio;
    for (const line of lines) {
      this.traced.set(line.channel, traceAgain(scene, line, columnsPerPixel, before.get(line.channel)));
    }
    // Those that stand out are drawn over the others.
    const order = [...lines.filter((line) => !isEmphasised(line)), ...lines.filter(isEmphasised)];
    const widthOf = (line: CurveLine) => (isEmphasised(line) ? EMPHASISED_WIDTH : LINE_WIDTH);
    const hasColumns = this.drawColumns(g, scene, order, widthOf, ratio, columnsPerPixel, palette);
    g.lineJoin = 'round';
    for (const line of order) {
      const traced = this.traced.get(line.channel);
      if (!traced) continue;
      g.strokeStyle = mixed(line.colour, palette);
      g.lineWidth = widthOf(line);
      if (traced.dotted) {
        g.setLineDash(DOTS);
        g.stroke(traced.dotted);
      }
      if (!traced.solid) continue;
      g.setLineDash(line.colour.dash);
      g.stroke(traced.solid);
    }
    g.setLineDash(UNBROKEN);
    return moving && many && hasColumns;
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

  private drawColumns(
    g: CanvasRenderingContext2D,
    { space }: CurveScene,
    order: readonly CurveLine[],
    widthOf: (line: CurveLine) => number,
    ratio: number,
    columnsPerPixel: number,
    palette: Readonly<Record<BaseColour, string>>,
  ): boolean {
    const dense: ColumnLine[] = [];
    for (const line of order) {
      const columns = this.traced.get(line.channel)?.trace.columns;
      if (!columns || columns.from === columns.to) continue;
      dense.push({ columns, colour: mixed(line.colour, palette), width: widthOf(line) });
    }
    if (dense.length === 0) return false;
    const width = Math.ceil(space.width * ratio);
    const height = Math.ceil(space.height * ratio);
    this.raster.paint(dense, width, height, ratio, columnsPerPixel);
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
    return true;
  }
}

function traceAgain(scene: CurveScene, line: CurveLine, columnsPerPixel: number, before: Traced | undefined): Traced {
  const channel = scene.clip.channels[line.channel];
  const map = traceMap(scene, line);
  if (before?.channel === channel && before.columnsPerPixel === columnsPerPixel && sameMap(before.map, map)) {
    return before;
  }
  const trace = before?.trace ?? new LineTrace();
  traceLine(scene.curves, line.channel, channel, map, columnsPerPixel, trace);
  return { channel, map, columnsPerPixel, trace, solid: pathOf(trace.solid), dotted: pathOf(trace.dotted) };
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
