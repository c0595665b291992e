/**
 * The geometry of one drawn channel: paths where spans can be told apart, columns of pixels where they can't.
 *
 *     dotted      before the first key and after the last: extrapolated
 *     solid       between them
 *     columns     the smallest and largest value within each column of pixels, where spans are narrower than a few
 *
 * A path of a hundred thousand spans costs little script and very much drawing (150 ms of it in software for 100
 * channels of 1,000 keys); the cost of columns depends only on the plot's width.
 */

import type { CompiledTake } from '../../../../evaluate/compiled-take.ts';
import { TracedColumns } from '../../../../evaluate/plot/trace-columns.ts';
import { FAR_PIXELS, heightOf, SpanTracer, TracedPath, type TraceMap } from '../../../../evaluate/plot/trace-path.ts';
import { traceSampleColumns, traceSamplePath } from '../../../../evaluate/plot/trace-samples.ts';
import { lastNotAbove } from '../../../../math/search.ts';
import { rangeOfSamples, type Samples } from '../../../../model/takes/samples.ts';
import { type Channel, EXTRAPOLATIONS } from '../../../../model/takes/take.ts';
import { pixelsPerSecond } from '../../../widgets/time/time-window.ts';
import type { CurveScene } from './scene.ts';
import { type OnAxis, pixelsPerUnit, valueAt } from './space.ts';

/** Period of the dots of extrapolated parts in pixels. They are fixed to the curve as the view moves. */
export const DOT_PERIOD = 5;
/** Spans narrower than this are drawn as columns … */
const DENSE_PIXELS = 3;
/** … if there are so many of them. */
const DENSE_SPANS = 24;
/** Curves are traced this far beyond the edges. */
const BESIDE_PIXELS = 8;
/** A period of up to this many plot widths is drawn as a whole, so that its dots don't move. */
const WHOLE_PERIOD_PLOTS = 4;
/** Safety limit: more in view are drawn as columns. */
const MAX_PERIODS = 10_000;

const LINEAR = EXTRAPOLATIONS.indexOf('linear');
const CYCLE = EXTRAPOLATIONS.indexOf('cycle');
const CYCLE_OFFSET = EXTRAPOLATIONS.indexOf('cycle_offset');
const BOUNCE = EXTRAPOLATIONS.indexOf('bounce');

/** The trace of one line; allocated once and refilled. */
export class LineTrace {
  readonly solid: TracedPath = new TracedPath();
  readonly dotted: TracedPath = new TracedPath();
  /** What is drawn as columns instead. */
  readonly columns: TracedColumns = new TracedColumns();
}

/** Maps a line's channel to the plot. */
export function traceMap(
  { space, offsetSeconds }: Pick<CurveScene, 'space' | 'offsetSeconds'>,
  line: OnAxis,
): TraceMap {
  return {
    left: space.window.from + offsetSeconds,
    low: valueAt(space, line, space.height),
    perSecond: pixelsPerSecond(space),
    perUnit: pixelsPerUnit(space, line),
    width: space.width,
    top: 0,
    bottom: space.height,
  };
}

export function sameMap(a: TraceMap, b: TraceMap): boolean {
  return (
    a.left === b.left &&
    a.low === b.low &&
    a.perSecond === b.perSecond &&
    a.perUnit === b.perUnit &&
    a.width === b.width &&
    a.bottom === b.bottom
  );
}

const tracer = new SpanTracer();

/**
 * @param index of `channel` in the compiled take
 * @param columnsPerPixel resolution of columns: device pixels per CSS pixel
 */
export function traceLine(
  curves: CompiledTake,
  index: number,
  channel: Channel,
  map: TraceMap,
  columnsPerPixel: number,
  out: LineTrace,
): void {
  out.solid.clear();
  out.dotted.clear();
  out.columns.clear();
  const right = map.left + map.width / map.perSecond;
  const first = curves.firstKey[index];
  const last = curves.firstKey[index + 1] - 1;
  if (curves.samples && curves.columns[index] >= 0) {
    sampled(curves.samples, curves.columns[index], map, columnsPerPixel, out);
    return;
  }
  if (channel.kind !== 'keys') {
    const beside = BESIDE_PIXELS / map.perSecond;
    const value = channel.kind === 'rest' ? channel.value : 0;
    straight(map, map.left - beside, right + beside, 0, value, 0, out.dotted);
    return;
  }
  const start = curves.times[first];
  const stop = curves.times[last];
  if (map.left < start) outside(curves, index, channel, map, 0, columnsPerPixel, out);
  if (stop > start && map.left < stop && right > start) inside(curves, index, channel, map, columnsPerPixel, out);
  if (right > stop) outside(curves, index, channel, map, 1, columnsPerPixel, out);
}

/** The column of a sampled channel. */
function sampled(samples: Samples, column: number, map: TraceMap, columnsPerPixel: number, out: LineTrace): void {
  const { values, scales, frameCount, frameSeconds } = samples;
  const [start, stop] = rangeOfSamples(samples);
  const beside = BESIDE_PIXELS / map.perSecond;
  const left = map.left - beside;
  const right = map.left + map.width / map.perSecond + beside;
  const held = (frame: number) => values[frame * scales.length + column] * scales[column];
  if (left < start) straight(map, left, Math.min(start, right), start, held(0), 0, out.dotted);
  if (right > stop) straight(map, Math.max(stop, left), right, stop, held(frameCount - 1), 0, out.dotted);
  const from = Math.max(start, left);
  const to = Math.min(stop, right);
  if (!(to > from)) return;
  if (isDense((to - from) / frameSeconds, (to - from) * map.perSecond)) {
    traceSampleColumns(samples, column, map, from, to, columnsPerPixel, out.columns);
  } else traceSamplePath(samples, column, map, from, to, out.solid);
}

function inside(
  curves: CompiledTake,
  index: number,
  channel: Channel,
  map: TraceMap,
  columnsPerPixel: number,
  out: LineTrace,
): void {
  const { times, cubics } = curves;
  const first = curves.firstKey[index];
  const last = curves.firstKey[index + 1] - 1;
  const beside = BESIDE_PIXELS / map.perSecond;
  const from = Math.max(times[first], map.left - beside);
  const to = Math.min(times[last], map.left + map.width / map.perSecond + beside);
  if (!(to > from)) return;
  const spans = lastNotAbove(times, first, last + 1, to) - lastNotAbove(times, first, last + 1, from);
  if (isDense(spans, (to - from) * map.perSecond)) {
    out.columns.keyed(curves, index, channel, map, from, to, columnsPerPixel);
    return;
  }
  tracer.open(curves, map, out.solid);
  const x = (from - map.left) * map.perSecond;
  const beginsWithStep = from === times[first] && times[first + 1] === from;
  if (beginsWithStep) out.solid.moveTo(x, heightOf(map, cubics[4 * first]));
  tracer.keys(first, last, from, to, x, 0, beginsWithStep);
}

/** Before the keys (`side` 0) or after them (1). */
function outside(
  curves: CompiledTake,
  index: number,
  channel: Channel,
  map: TraceMap,
  side: 0 | 1,
  columnsPerPixel: number,
  out: LineTrace,
): void {
  const { times } = curves;
  const first = curves.firstKey[index];
  const last = curves.firstKey[index + 1] - 1;
  const start = times[first];
  const stop = times[last];
  const beside = BESIDE_PIXELS / map.perSecond;
  const right = map.left + map.width / map.perSecond;
  const from = side === 0 ? map.left - beside : Math.max(stop, map.left - beside);
  const to = side === 0 ? Math.min(start, right + beside) : right + beside;
  const code = curves.extrapolations[2 * index + side];
  if (code !== CYCLE && code !== CYCLE_OFFSET && code !== BOUNCE) {
    const slope = code === LINEAR ? curves.beyond[4 * index + 2 + side] : 0;
    straight(
      map,
      from,
      to,
      side === 0 ? start : stop,
      curves.cubics[4 * (side === 0 ? first : last)],
      slope,
      out.dotted,
    );
    return;
  }
  const length = curves.beyond[4 * index];
  const visible = (to - from) * map.perSecond;
  const pixels = length * map.perSecond;
  if (isDense(((last - first) * visible) / pixels, visible)) {
    out.columns.repeated(curves, index, channel, map, from, to, columnsPerPixel);
    return;
  }
  const begin = side === 0 ? Math.floor((from - start) / length) : Math.max(1, Math.floor((from - start) / length));
  const end = side === 0 ? Math.min(-1, Math.floor((to - start) / length)) : Math.floor((to - start) / length);
  const drift = code === CYCLE_OFFSET ? curves.beyond[4 * index + 1] : 0;
  const whole = pixels < WHOLE_PERIOD_PLOTS * map.width;
  tracer.open(curves, map, out.dotted);
  // Beyond whole numbers that can be counted, nothing of a period is seen.
  const count = Number.isSafeInteger(begin) ? Math.min(MAX_PERIODS, end - begin + 1) : 0;
  for (let i = 0; i < count; i++) {
    const period = begin + i;
    const origin = start + period * length;
    const since = whole ? 0 : Math.min(length, Math.max(0, from - origin));
    const until = whole ? length : Math.max(since, Math.min(length, to - origin));
    if (!(until > since)) continue;
    const mirrored = code === BOUNCE && period % 2 !== 0;
    // Each repetition starts its dots again. A jump to the next is a vertical line in the first of them.
    const x = (origin + since - map.left) * map.perSecond;
    if (mirrored) tracer.keys(first, last, stop - since, Math.max(start, stop - until), x, 0, false);
    else tracer.keys(first, last, start + since, Math.min(stop, start + until), x, drift * period, false);
    if (code === CYCLE && until === length) {
      out.dotted.lineTo(x + (until - since) * map.perSecond, heightOf(map, curves.cubics[4 * first]));
    }
  }
}

/** The dotted line through a key at `anchor` and `value`, between two times on the same side of it. */
function straight(
  map: TraceMap,
  from: number,
  to: number,
  anchor: number,
  value: number,
  slope: number,
  path: TracedPath,
): void {
  if (!(to > from)) return;
  const backwards = anchor >= to;
  const near = backwards ? to : from;
  // Dots are counted from the key, even if it is out of view.
  const begin = near - (((near - anchor) * map.perSecond) % DOT_PERIOD) / map.perSecond;
  const end = backwards ? from : to;
  const x0 = (begin - map.left) * map.perSecond;
  const x1 = (end - map.left) * map.perSecond;
  const at = (time: number) => {
    const there = value + slope * (time - anchor);
    return map.bottom - ((Number.isFinite(there) ? there : value) - map.low) * map.perUnit;
  };
  const y0 = at(begin);
  const y1 = at(end);
  const ceiling = map.top - FAR_PIXELS;
  const floor = map.bottom + FAR_PIXELS;
  if ((y0 < ceiling && y1 < ceiling) || (y0 > floor && y1 > floor)) return;
  const along = (y: number) => {
    const near = Math.min(floor, Math.max(ceiling, y));
    return near === y ? undefined : { x: x0 + ((near - y0) / (y1 - y0)) * (x1 - x0), y: near };
  };
  const p0 = along(y0) ?? { x: x0, y: y0 };
  const p1 = along(y1) ?? { x: x1, y: y1 };
  path.moveTo(p0.x, p0.y);
  path.lineTo(p1.x, p1.y);
}

function isDense(spans: number, pixels: number): boolean {
  return spans > DENSE_SPANS && spans * DENSE_PIXELS > pixels;
}
