/** Fits the view to something, with margins. */

import { ChannelExtremes } from '../../../../evaluate/plot/trace-extremes.ts';
import { keysOf, spanOfChannel } from '../../../../model/takes/take.ts';
import { FARTHEST, fitWindow, shortestAt } from '../../../widgets/time/time-window.ts';
import { restValues } from './rest-curves.ts';
import type { CurveLine, CurveScene } from './scene.ts';
import { type AxisName, type CurveSpace, VALUE_AXES, type ValueAxis } from './space.ts';

export type Fitted = Pick<
  CurveScene,
  'take' | 'curves' | 'lines' | 'rest' | 'theirs' | 'offsetSeconds' | 'selected' | 'space' | 'range'
>;

/** Margin for half a diamond. */
const ABOVE_PIXELS = 22;

/** Minimum extent of a fitted axis: noise in the last digits must not look like motion. */
const MIN_EXTENT: Readonly<Record<AxisName, number>> = {
  angle: Math.PI / 90,
  length: 1e-3,
  factor: 0.02,
  weight: 0.02,
  normalised: 2,
};
/** Extent around a constant value. */
const STILL_EXTENT: Readonly<Record<AxisName, number>> = {
  angle: Math.PI / 3,
  length: 1,
  factor: 2.4,
  weight: 1.2,
  normalised: 2,
};
const SHORTEST_SECONDS = 0.05;

interface Bounds {
  from: number;
  to: number;
  readonly low: Record<AxisName, number>;
  readonly high: Record<AxisName, number>;
}

const extremes = new ChannelExtremes();

/**
 * Values in the time window, extrapolated ones included, or the selected keys in time too (values in the window if none
 * is selected). Axes with nothing to show keep their range.
 */
export function fit(scene: Fitted, what: 'values' | 'selected'): CurveSpace {
  const { space, offsetSeconds } = scene;
  const selected = what === 'selected' && scene.selected.some((s) => scene.lines.some((l) => l.channel === s.channel));
  const bounds = noBounds();
  if (selected) includeSelected(scene, bounds);
  else includeInView(scene, bounds);
  const axes = { ...space.axes };
  for (const axis of VALUE_AXES) axes[axis] = fittedAxis(axis, bounds, space);
  if (!(bounds.to >= bounds.from)) return { ...space, axes };
  return { ...space, axes, window: fittedWindow(bounds.from - offsetSeconds, bounds.to - offsetSeconds, space.width) };
}

/** First and last time of the playback range and of all lines' keys or samples; seconds of the transport. */
export function timesOf({ take, lines, theirs, range, offsetSeconds }: Fitted): readonly [number, number] {
  let [from, to] = range;
  for (const { channel } of lines) {
    const times = theirs?.get(channel)?.times ?? NO_TIMES;
    for (const span of [spanOfChannel(take, channel), times.length ? [times[0], times[times.length - 1]] : undefined]) {
      if (!span || !(span[1] >= span[0])) continue;
      from = Math.min(from, span[0] - offsetSeconds);
      to = Math.max(to, span[1] - offsetSeconds);
    }
  }
  return [from, to];
}

const NO_TIMES = new Float64Array(0);

function noBounds(): Bounds {
  const every = (value: number) => ({ angle: value, length: value, factor: value, weight: value, normalised: value });
  return {
    from: Number.POSITIVE_INFINITY,
    to: Number.NEGATIVE_INFINITY,
    low: every(Number.POSITIVE_INFINITY),
    high: every(Number.NEGATIVE_INFINITY),
  };
}

function fittedWindow(from: number, to: number, width: number) {
  const first = Math.max(-FARTHEST, from);
  const last = Math.min(FARTHEST, to);
  const least = shortestAt(Math.max(Math.abs(first), Math.abs(last)));
  const missing = Math.max(0, Math.max(SHORTEST_SECONDS, least) - (last - first)) / 2;
  // A lone key is centred in one second.
  const around = last > first ? missing : Math.max(0.5, least);
  return fitWindow([first - around, last + around], width);
}

function fittedAxis(axis: AxisName, bounds: Bounds, space: CurveSpace): ValueAxis {
  const low = bounds.low[axis];
  const high = bounds.high[axis];
  if (!(low <= high) || !Number.isFinite(high - low)) return space.axes[axis];
  const least = Math.max(
    high > low ? MIN_EXTENT[axis] : STILL_EXTENT[axis],
    shortestAt(Math.max(Math.abs(low), Math.abs(high))),
  );
  const around = Math.max(0, least - (high - low)) / 2;
  const part = Math.min(0.25, ABOVE_PIXELS / Math.max(1, space.height));
  const extent = (high - low + 2 * around) / (1 - 2 * part);
  return { low: low - around - part * extent, high: high + around + part * extent };
}

function include(bounds: Bounds, line: CurveLine, low: number, high: number): void {
  const { axis, normalise: n } = line;
  bounds.low[axis] = Math.min(bounds.low[axis], n ? low * n.scale + n.shift : low);
  bounds.high[axis] = Math.max(bounds.high[axis], n ? high * n.scale + n.shift : high);
}

function includeTheirs({ theirs }: Fitted, line: CurveLine, from: number, to: number, bounds: Bounds): void {
  const channel = theirs?.get(line.channel);
  channel?.values.forEach((value, i) => {
    const isInside = channel.times[i] >= from && channel.times[i] <= to;
    if (isInside && Number.isFinite(value)) include(bounds, line, value, value);
  });
}

function includeInView(scene: Fitted, bounds: Bounds): void {
  const { window } = scene.space;
  for (const line of scene.lines) {
    const [from, to] = [window.from + scene.offsetSeconds, window.to + scene.offsetSeconds];
    includeCurve(scene, line, from, to, bounds);
    includeTheirs(scene, line, from, to, bounds);
  }
  includeRest(scene, bounds);
}

/** Times at which what is below the curves is looked at. */
const REST_TIMES = 100;

function includeRest({ rest, space, offsetSeconds }: Fitted, bounds: Bounds): void {
  if (!rest) return;
  const { from, to } = space.window;
  const { curves, lines } = rest;
  const { values } = restValues(curves, from + offsetSeconds, (to - from) / (REST_TIMES - 1), REST_TIMES);
  for (const line of lines) {
    for (let i = line.channel; i < values.length; i += curves.count) include(bounds, line, values[i], values[i]);
  }
}

function includeCurve({ curves, take }: Fitted, line: CurveLine, from: number, to: number, bounds: Bounds): void {
  const channel = take.channels[line.channel];
  if (channel.kind === 'rest') {
    include(bounds, line, channel.value, channel.value);
    return;
  }
  extremes.open(curves, line.channel, channel);
  extremes.over(from, to);
  include(bounds, line, extremes.low, extremes.high);
}

function includeSelected(scene: Fitted, bounds: Bounds): void {
  for (const { channel, indices } of scene.selected) {
    const line = scene.lines.find((l) => l.channel === channel);
    if (!line) continue;
    const { times, values } = keysOf(scene.take.channels[channel]);
    for (const k of indices) {
      bounds.from = Math.min(bounds.from, times[k]);
      bounds.to = Math.max(bounds.to, times[k]);
      include(bounds, line, values[k], values[k]);
    }
  }
}
