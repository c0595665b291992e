/** Fits the view to something, with margins. */

import { ChannelExtremes } from '../../../../evaluate/plot/trace-extremes.ts';
import { keysOf, spanOfChannel } from '../../../../model/takes/clip.ts';
import { FARTHEST, shortestAt } from '../../../widgets/time/time-window.ts';
import type { CurveLine, CurveScene } from './scene.ts';
import { type AxisName, type CurveSpace, PLOT_TOP, VALUE_AXES, type ValueAxis } from './space.ts';

export type Fitted = Pick<
  CurveScene,
  'clip' | 'curves' | 'lines' | 'theirs' | 'offsetSeconds' | 'selected' | 'space' | 'range'
>;

/** Margins: for labels on both sides, and for half a diamond. */
const SIDE_PIXELS = 48;
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
 * Axes with nothing to show keep their range.
 *
 * @param what the lines' keys or samples and the playback range, or the selected keys (all if none is selected)
 * @param keepTime keeps the time window, and fits the values in it
 */
export function fit(scene: Fitted, what: 'all' | 'selected', keepTime = false): CurveSpace {
  const { space, offsetSeconds } = scene;
  const selected = what === 'selected' && scene.selected.some((s) => scene.lines.some((l) => l.channel === s.channel));
  const bounds = noBounds();
  if (keepTime && !selected) includeInView(scene, bounds);
  else if (selected) includeSelected(scene, bounds);
  else includeAll(scene, bounds);
  const axes = { ...space.axes };
  for (const axis of VALUE_AXES) axes[axis] = fittedAxis(axis, bounds, space);
  if (keepTime || !(bounds.to >= bounds.from)) return { ...space, axes };
  return { ...space, axes, window: fittedWindow(bounds.from - offsetSeconds, bounds.to - offsetSeconds, space.width) };
}

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
  const part = Math.min(0.2, SIDE_PIXELS / Math.max(1, width));
  const seconds = (last - first + 2 * around) / (1 - 2 * part);
  return { from: first - around - part * seconds, to: last + around + part * seconds };
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
  const part = Math.min(0.25, ABOVE_PIXELS / Math.max(1, space.height - PLOT_TOP));
  const extent = (high - low + 2 * around) / (1 - 2 * part);
  return { low: low - around - part * extent, high: high + around + part * extent };
}

function include(bounds: Bounds, line: CurveLine, low: number, high: number): void {
  const { axis, normalise: n } = line;
  bounds.low[axis] = Math.min(bounds.low[axis], n ? low * n.scale + n.shift : low);
  bounds.high[axis] = Math.max(bounds.high[axis], n ? high * n.scale + n.shift : high);
}

function includeAll(scene: Fitted, bounds: Bounds): void {
  bounds.from = scene.range[0] + scene.offsetSeconds;
  bounds.to = scene.range[1] + scene.offsetSeconds;
  for (const line of scene.lines) {
    const [start, stop] = spanOfChannel(scene.clip, line.channel) ?? [bounds.from, bounds.from];
    bounds.from = Math.min(bounds.from, start);
    bounds.to = Math.max(bounds.to, stop);
    includeCurve(scene, line, start, stop, bounds);
    const times = scene.theirs?.get(line.channel)?.times ?? NO_TIMES;
    if (times.length === 0) continue;
    bounds.from = Math.min(bounds.from, times[0]);
    bounds.to = Math.max(bounds.to, times[times.length - 1]);
    includeTheirs(scene, line, times[0], times[times.length - 1], bounds);
  }
}

const NO_TIMES = new Float64Array(0);

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
}

function includeCurve({ curves, clip }: Fitted, line: CurveLine, from: number, to: number, bounds: Bounds): void {
  const channel = clip.channels[line.channel];
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
    const { times, values } = keysOf(scene.clip.channels[channel]);
    for (const k of indices) {
      bounds.from = Math.min(bounds.from, times[k]);
      bounds.to = Math.max(bounds.to, times[k]);
      include(bounds, line, values[k], values[k]);
    }
  }
}
