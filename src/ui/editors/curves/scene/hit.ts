/** Hit testing in the plot, for points and boxes. Distances are in pixels. */
import { evaluateChannel } from '../../../../evaluate/curves.ts';
import { ChannelExtremes } from '../../../../evaluate/plot/trace-extremes.ts';
import type { TraceMap } from '../../../../evaluate/plot/trace-path.ts';
import { firstNotBelow } from '../../../../math/search.ts';
import type { ChannelKeys } from '../../../../model/session.ts';
import { keysOf } from '../../../../model/takes/take.ts';
import type { SelectionBox } from '../../timeline/box.ts';
import { handlesOf } from './handles.ts';
import { type CurveHit, type CurveLine, type CurveScene, isFaint } from './scene.ts';

import { traceMap } from './trace.ts';

const EMPTY: CurveHit = { kind: 'empty' };
/** A selected key or handle wins over another one that is closer by up to this much. */
const SELECTED_PIXELS = 3;
/** Curves are sampled in steps of so many pixels. */
const STEP_PIXELS = 0.5;

const extremes = new ChannelExtremes();

/**
 * Handles and keys before curves, closest first, and of equals what is drawn in front.
 *
 * @param reach hit tolerance in pixels
 */
export function hitTest(scene: CurveScene, x: number, y: number, reach = 6): CurveHit {
  if (y < 0 || y > scene.space.height) return EMPTY;
  const faint = scene.lines.filter((line) => isFaint(scene, line));
  const front = faint.length ? scene.lines.filter((line) => !isFaint(scene, line)) : scene.lines;
  return (
    keyOrHandleAt(scene, front, x, y, reach) ??
    curveAt(scene, front, x, y, reach) ??
    keyOrHandleAt(scene, faint, x, y, reach) ??
    curveAt(scene, faint, x, y, reach) ??
    EMPTY
  );
}

function keyOrHandleAt(
  scene: CurveScene,
  lines: readonly CurveLine[],
  x: number,
  y: number,
  reach: number,
): CurveHit | undefined {
  if (lines.length === 0) return undefined;
  let best = Number.POSITIVE_INFINITY;
  let found: CurveHit | undefined;
  const consider = (distance: number, ahead: boolean, hit: () => CurveHit) => {
    if (!(distance <= reach)) return;
    const rank = distance - (ahead ? SELECTED_PIXELS : 0);
    if (rank >= best) return;
    best = rank;
    found = hit();
  };
  const selected = new Map(scene.selected.map(({ channel, indices }) => [channel, indices]));
  // Front to back, so that lines behind have to be closer.
  for (let l = lines.length - 1; l >= 0; l--) {
    const line = lines[l];
    const { times, values } = keysOf(scene.take.channels[line.channel]);
    const map = traceMap(scene, line);
    const end = firstNotBelow(times, map.left + (x + reach) / map.perSecond);
    for (let k = firstNotBelow(times, map.left + (x - reach) / map.perSecond); k < end; k++) {
      const distance = Math.hypot((times[k] - map.left) * map.perSecond - x, heightOf(map, values[k]) - y);
      if (distance > reach) continue;
      const indices = selected.get(line.channel);
      consider(distance, indices !== undefined && holds(indices, k), () => ({
        kind: 'key',
        channel: line.channel,
        index: k,
      }));
    }
  }
  for (const { line, index, side, endX, endY } of handlesOf(scene)) {
    consider(Math.hypot(endX - x, endY - y), true, () => ({ kind: 'handle', channel: line.channel, index, side }));
  }
  return found;
}

function curveAt(
  scene: CurveScene,
  lines: readonly CurveLine[],
  x: number,
  y: number,
  reach: number,
): CurveHit | undefined {
  let best = Number.POSITIVE_INFINITY;
  let found: { readonly line: CurveLine; readonly x: number } | undefined;
  const selected = new Set(scene.selected.map((keys) => keys.channel));
  for (let l = lines.length - 1; l >= 0; l--) {
    const line = lines[l];
    const near = nearestOn(scene, line, x, y, reach);
    if (!near || near.distance > reach) continue;
    const rank = near.distance - (selected.has(line.channel) ? SELECTED_PIXELS : 0);
    if (rank >= best) continue;
    best = rank;
    found = { line, x: near.x };
  }
  if (!found) return undefined;
  const map = traceMap(scene, found.line);
  const timeSeconds = map.left + found.x / map.perSecond;
  const value = evaluateChannel(scene.curves, found.line.channel, timeSeconds);
  return { kind: 'curve', channel: found.line.channel, timeSeconds, value };
}

/** The nearest point of a line within `reach` pixels horizontally. */
function nearestOn(scene: CurveScene, line: CurveLine, x: number, y: number, reach: number) {
  const map = traceMap(scene, line);
  const height = (at: number) =>
    heightOf(map, evaluateChannel(scene.curves, line.channel, map.left + at / map.perSecond));
  let best = Number.POSITIVE_INFINITY;
  let bestX = x;
  let x0 = x - reach;
  let y0 = height(x0);
  for (let s = 1; s * STEP_PIXELS <= 2 * reach; s++) {
    const x1 = x - reach + s * STEP_PIXELS;
    const y1 = height(x1);
    const along = Math.min(1, Math.max(0, ((x - x0) * (x1 - x0) + (y - y0) * (y1 - y0)) / squared(x1 - x0, y1 - y0)));
    const distance = Math.hypot(x0 + along * (x1 - x0) - x, y0 + along * (y1 - y0) - y);
    if (distance < best) {
      best = distance;
      bestX = x0 + along * (x1 - x0);
    }
    [x0, y0] = [x1, y1];
  }
  const channel = scene.take.channels[line.channel];
  if (best <= reach || (channel.kind !== 'samples' && keysOf(channel).times.length < 2))
    return { distance: best, x: bestX };
  // If a pixel covers many spans, sampling may miss what is drawn there.
  extremes.open(scene.curves, line.channel, channel);
  extremes.over(map.left + (x - 0.5) / map.perSecond, map.left + (x + 0.5) / map.perSecond);
  const top = heightOf(map, extremes.high);
  const bottom = heightOf(map, extremes.low);
  return { distance: Math.max(0, top - y, y - bottom), x };
}

function squared(x: number, y: number): number {
  return x * x + y * y;
}

function heightOf(map: TraceMap, value: number): number {
  return map.bottom - (value - map.low) * map.perUnit;
}

/** Whether ascending `indices` contain one. */
function holds(indices: readonly number[], index: number): boolean {
  return indices[firstNotBelow(indices, index)] === index;
}

/** The keys of all lines in a box, edges included. */
export function keysInBox(scene: CurveScene, box: SelectionBox): ChannelKeys[] {
  const [left, right] = [Math.min(box.x0, box.x1), Math.max(box.x0, box.x1)];
  const [top, bottom] = [Math.min(box.y0, box.y1), Math.max(box.y0, box.y1)];
  const found: ChannelKeys[] = [];
  for (const line of scene.lines) {
    if (isFaint(scene, line)) continue;
    const { times, values } = keysOf(scene.take.channels[line.channel]);
    const map = traceMap(scene, line);
    const indices: number[] = [];
    for (let k = firstNotBelow(times, map.left + left / map.perSecond); k < times.length; k++) {
      if ((times[k] - map.left) * map.perSecond > right) break;
      const y = heightOf(map, values[k]);
      if (y >= top && y <= bottom) indices.push(k);
    }
    if (indices.length > 0) found.push({ channel: line.channel, indices });
  }
  return found.sort((a, b) => a.channel - b.channel);
}
