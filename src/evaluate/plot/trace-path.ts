/**
 * Curves as canvas paths, computed without a canvas so that each point can be compared with the evaluator.
 *
 * A cubic in time is exactly a Bézier curve with control points at thirds of the time:
 *
 *     p(τ) over [τa, τb], h = τb − τa      P1 = (τa + h/3, p(τa) + p′(τa)·h/3)      P2 = (τb − h/3, p(τb) − p′(τb)·h/3)
 *
 * and so is each part of it. Curves are therefore clipped to the visible range: canvases use single floats, and a span
 * of a minute, zoomed to a millisecond, would have control points millions of pixels away.
 */
import type { CompiledTake } from '../compiled-take.ts';

/** The cubics and key times of a compiled take. */
export type Spans = Pick<CompiledTake, 'times' | 'cubics'>;

/** Path verbs: two coordinates each, six for a curve. */
export const MOVE = 0;
/** A line to the point. */
export const LINE = 1;
/** A cubic Bézier curve: two control points, then its end. */
export const CURVE = 2;

/** Values farther than this from the plot are clipped. */
export const FAR_PIXELS = 4096;
/** A span is drawn straight if its curve is nowhere farther than this from the line. */
const STRAIGHT_PIXELS = 0.03;

/** A path as verbs and CSS pixels; grows, and is reused. */
export class TracedPath {
  verbs = new Uint8Array(64);
  /** CSS pixels. */
  points = new Float32Array(256);
  verbCount = 0;
  pointCount = 0;

  /** Removes all verbs and points; the arrays are kept. */
  clear(): void {
    this.verbCount = 0;
    this.pointCount = 0;
  }

  /** Starts another part of the path, in CSS pixels. */
  moveTo(x: number, y: number): void {
    this.point(MOVE, x, y);
  }

  /** Adds a line from the last point, in CSS pixels. */
  lineTo(x: number, y: number): void {
    this.point(LINE, x, y);
  }

  /** Adds a cubic Bézier curve from the last point: two control points, then its end; CSS pixels. */
  curveTo(x1: number, y1: number, x2: number, y2: number, x: number, y: number): void {
    this.reserve();
    const { points } = this;
    let p = this.pointCount;
    points[p++] = x1;
    points[p++] = y1;
    points[p++] = x2;
    points[p++] = y2;
    points[p++] = x;
    points[p++] = y;
    this.pointCount = p;
    this.verbs[this.verbCount++] = CURVE;
  }

  private point(verb: number, x: number, y: number): void {
    this.reserve();
    this.points[this.pointCount++] = x;
    this.points[this.pointCount++] = y;
    this.verbs[this.verbCount++] = verb;
  }

  private reserve(): void {
    if (this.verbCount === this.verbs.length) {
      const verbs = new Uint8Array(2 * this.verbs.length);
      verbs.set(this.verbs);
      this.verbs = verbs;
    }
    if (this.pointCount + 6 > this.points.length) {
      const points = new Float32Array(2 * this.points.length);
      points.set(this.points);
      this.points = points;
    }
  }
}

/** From channel to plot: x = (time − left) · perSecond, y = bottom − (value − low) · perUnit. CSS pixels. */
export interface TraceMap {
  /** Take time at x = 0, and value at the bottom. */
  readonly left: number;
  readonly low: number;
  readonly perSecond: number;
  readonly perUnit: number;
  readonly width: number;
  readonly top: number;
  readonly bottom: number;
}

/** Height of a value, clipped as when drawing. */
export function heightOf(map: TraceMap, value: number): number {
  const y = map.bottom - (value - map.low) * map.perUnit;
  return Math.min(map.bottom + FAR_PIXELS, Math.max(map.top - FAR_PIXELS, y));
}

/** Draws cubics of a compiled take into paths; reuse it by opening the next. */
export class SpanTracer {
  private curves: Spans | undefined;
  private map: TraceMap | undefined;
  private path = new TracedPath();
  /** Where values are clipped. */
  private ceiling = 0;
  private floor = 0;
  /** Added to values: drift from period to period, minus the value at the bottom. */
  private add = 0;

  /** Starts tracing spans of `curves` into `path`, with the scale of `map`. */
  open(curves: Spans, map: TraceMap, path: TracedPath): void {
    this.curves = curves;
    this.map = map;
    this.path = path;
    this.ceiling = map.top - FAR_PIXELS;
    this.floor = map.bottom + FAR_PIXELS;
  }

  /**
   * A stretch of one channel's keys, from one key time to another; backwards if `to` is before `from`, as in every
   * other period of a bounce. Both ends are within the keys.
   *
   * @param first the channel's first key, `last` its last
   * @param x position of `from`; drawing continues to the right from there, even backwards
   * @param add offset of the values
   * @param joins continues the path with a vertical line instead of starting a new one
   */
  keys(first: number, last: number, from: number, to: number, x: number, add: number, joins: boolean): void {
    const { curves, map } = this;
    if (!curves || !map) return;
    const { times } = curves;
    this.add = add - map.low;
    const onward = to >= from;
    const perSecond = onward ? map.perSecond : -map.perSecond;
    let key = keyBefore(times, first, last, from, onward);
    let at = from;
    this.point(key, from - times[key], x, joins);
    while (onward ? at < to : at > to) {
      const begin = times[key];
      const next = onward ? Math.min(to, times[key + 1]) : Math.max(to, begin);
      this.span(4 * key, at - begin, next - begin, x + (at - from) * perSecond, perSecond);
      at = next;
      if (at === to) break;
      // Keys at the same time are a step: on to the last of them, or before the first.
      const step = onward ? key + 1 : key;
      key = onward ? key + 1 : key - 1;
      while (onward ? key < last && times[key + 1] === at : key > first && times[key] === at) key += onward ? 1 : -1;
      if (key !== (onward ? step : step - 1)) this.point(key, at - times[key], x + (at - from) * perSecond, true);
    }
    // The evaluator returns the later of two keys at the end; a step there is drawn too.
    if (onward && to === times[last] && times[last - 1] === to) this.point(last, 0, x + (to - from) * perSecond, true);
  }

  private point(key: number, since: number, x: number, joins: boolean): void {
    const y = this.clamped(this.y(4 * key, since));
    if (joins) this.path.lineTo(x, y);
    else this.path.moveTo(x, y);
  }

  private y(o: number, t: number): number {
    const { curves, map, add } = this;
    if (!curves || !map) return 0;
    const { cubics } = curves;
    const value = ((cubics[o + 3] * t + cubics[o + 2]) * t + cubics[o + 1]) * t + (cubics[o] + add);
    return map.bottom - value * map.perUnit;
  }

  private clamped(y: number): number {
    return Math.min(this.floor, Math.max(this.ceiling, y));
  }

  /** One span's cubic from τ = a to b, in either direction, from the end of the path: (x, its value at a). */
  private span(o: number, a: number, b: number, x: number, perSecond: number): void {
    const { curves, map, path } = this;
    if (!curves || !map) return;
    const { cubics } = curves;
    const c1 = cubics[o + 1];
    const c2 = cubics[o + 2];
    const c3 = cubics[o + 3];
    const third = (b - a) / 3;
    const y0 = this.y(o, a);
    const y3 = this.y(o, b);
    const y1 = y0 - ((3 * c3 * a + 2 * c2) * a + c1) * third * map.perUnit;
    const y2 = y3 + ((3 * c3 * b + 2 * c2) * b + c1) * third * map.perUnit;
    const end = x + (b - a) * perSecond;
    const rise = (y3 - y0) / 3;
    const straight = Math.abs(y1 - y0 - rise) < STRAIGHT_PIXELS && Math.abs(y3 - y2 - rise) < STRAIGHT_PIXELS;
    if (!this.isNear(y0) || !this.isNear(y3)) this.farSpan(o, a, b, x, perSecond);
    else if (straight) path.lineTo(end, y3);
    else if (!this.isNear(y1) || !this.isNear(y2)) this.farSpan(o, a, b, x, perSecond);
    else path.curveTo(x + third * perSecond, y1, end - third * perSecond, y2, end, y3);
  }

  private isNear(y: number): boolean {
    return y >= this.ceiling && y <= this.floor;
  }

  /** A span that leaves the take range: split at its extrema and crossings, and drawn along the edge outside. */
  private farSpan(o: number, a: number, b: number, x: number, perSecond: number): void {
    const { path } = this;
    const at = (t: number) => x + (t - a) * perSecond;
    let from = a;
    for (const to of this.turns(o, a, b)) {
      const y0 = this.y(o, from);
      const y1 = this.y(o, to);
      if ((y0 <= this.ceiling && y1 <= this.ceiling) || (y0 >= this.floor && y1 >= this.floor)) {
        path.lineTo(at(to), this.clamped(y1));
      } else {
        const enters = this.isNear(y0) ? from : this.crossing(o, from, to, this.clamped(y0));
        const leaves = this.isNear(y1) ? to : this.crossing(o, from, to, this.clamped(y1));
        path.lineTo(at(enters), this.clamped(this.y(o, enters)));
        this.nearSpan(o, enters, leaves, at(enters), at(leaves));
        path.lineTo(at(to), this.clamped(y1));
      }
      from = to;
    }
  }

  private nearSpan(o: number, a: number, b: number, x: number, end: number): void {
    const { curves, map, path } = this;
    if (!curves || !map) return;
    const { cubics } = curves;
    const third = (b - a) / 3;
    const slope = (t: number) => (3 * cubics[o + 3] * t + 2 * cubics[o + 2]) * t + cubics[o + 1];
    const y0 = this.y(o, a);
    const y3 = this.y(o, b);
    const y1 = y0 - slope(a) * third * map.perUnit;
    const y2 = y3 + slope(b) * third * map.perUnit;
    path.curveTo(x + (end - x) / 3, y1, end - (end - x) / 3, y2, end, this.clamped(y3));
  }

  /** Extrema between a and b in the order of drawing, then b. */
  private turns(o: number, a: number, b: number): number[] {
    const cubics = this.curves?.cubics;
    if (!cubics) return [b];
    const c = cubics[o + 2];
    const root = Math.sqrt(c * c - 3 * cubics[o + 1] * cubics[o + 3]);
    const q = c > 0 ? -c - root : root - c;
    const inside = [q / (3 * cubics[o + 3]), cubics[o + 1] / q].filter((t) => (t - a) * (t - b) < 0);
    inside.sort((s, t) => (a < b ? s - t : t - s));
    return [...inside, b];
  }

  /** Where a monotonic stretch crosses a height, by bisection. */
  private crossing(o: number, a: number, b: number, y: number): number {
    const rises = this.y(o, b) > this.y(o, a);
    for (let i = 0; i < 60; i++) {
      const middle = (a + b) / 2;
      if (this.y(o, middle) < y === rises) a = middle;
      else b = middle;
    }
    return (a + b) / 2;
  }
}

/** The key whose span a stretch starts in: forwards the last not after `time`, backwards the last before it. */
function keyBefore(times: Float64Array, first: number, last: number, time: number, onward: boolean): number {
  let low = first;
  let high = last;
  while (low < high) {
    const middle = (low + high + 1) >>> 1;
    if (onward ? times[middle] <= time : times[middle] < time) low = middle;
    else high = middle - 1;
  }
  // Forwards from the very last key there is no span; its own value is drawn.
  return low;
}
