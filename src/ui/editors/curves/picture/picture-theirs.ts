/**
 * Another program's channels over ours: a dot at each value that it printed, and a thin line from one to the next.
 * Wrong ones are red, with a line to ours: between values nothing is known of theirs. Values closer than pixels are
 * drawn as the range of each column of pixels.
 */
import type { TraceMap } from '../../../../evaluate/plot/trace-path.ts';
import { firstNotBelow } from '../../../../math/search.ts';
import { type CurveLine, type CurveScene, isFaint } from '../scene/scene.ts';

import type { TheirChannel } from '../scene/their-channels.ts';
import { traceMap } from '../scene/trace.ts';
import type { PictureColours } from './picture-colours.ts';

/** Values closer than this on average have no dots. */
const DOTS_APART = 7;
/** And no line from one to the next. */
const LINES_APART = 1;
const DOT = 2.25;
const WRONG_DOT = 3;
const LINE_OPACITY = 0.55;
const GAP_OPACITY = 0.5;

export function drawTheirs(g: CanvasRenderingContext2D, scene: CurveScene, colours: PictureColours): void {
  const { theirs, space } = scene;
  if (!theirs) return;
  g.save();
  g.beginPath();
  g.rect(0, 0, space.width, space.height);
  g.clip();
  g.lineJoin = 'round';
  for (const line of scene.lines) {
    const channel = theirs.get(line.channel);
    if (channel && !isFaint(scene, line)) drawChannel(g, scene, line, channel, colours);
  }
  g.restore();
}

function drawChannel(
  g: CanvasRenderingContext2D,
  scene: CurveScene,
  line: CurveLine,
  channel: TheirChannel,
  colours: PictureColours,
): void {
  const map = traceMap(scene, line);
  const { times } = channel;
  const right = map.left + map.width / map.perSecond;
  // One more on both sides, for the lines that leave the plot.
  const from = Math.max(0, firstNotBelow(times, map.left) - 1);
  const to = Math.min(times.length, firstNotBelow(times, right) + 2);
  if (to <= from) return;
  const apart = to - from > 1 ? ((times[to - 1] - times[from]) * map.perSecond) / (to - from - 1) : DOTS_APART;
  if (apart >= LINES_APART) drawLines(g, map, channel, from, to, colours);
  else drawColumns(g, map, channel, from, to, colours);
  if (apart < DOTS_APART) return;
  for (const isWrong of [false, true]) {
    const radius = isWrong ? WRONG_DOT : DOT;
    g.fillStyle = isWrong ? colours.wrong : colours.theirs;
    g.beginPath();
    for (let i = from; i < to; i++) {
      const y = yAt(map, channel.values[i]);
      if ((channel.wrong[i] === 1) !== isWrong || !Number.isFinite(y)) continue;
      const x = xAt(map, times[i]);
      g.moveTo(x + radius, y);
      g.arc(x, y, radius, 0, 2 * Math.PI);
    }
    g.fill();
  }
}

function drawLines(
  g: CanvasRenderingContext2D,
  map: TraceMap,
  { times, values, ours, wrong }: TheirChannel,
  from: number,
  to: number,
  colours: PictureColours,
): void {
  const isDrawn = (i: number) => Number.isFinite(values[i]) && Number.isFinite(values[i + 1]);
  const isWrong = (i: number) => wrong[i] === 1 || wrong[i + 1] === 1;
  g.strokeStyle = colours.wrong;
  g.lineWidth = 1.5;
  g.globalAlpha = GAP_OPACITY;
  g.beginPath();
  for (let i = from; i < to; i++) {
    if (wrong[i] === 0 || !Number.isFinite(values[i])) continue;
    const x = xAt(map, times[i]);
    g.moveTo(x, yAt(map, ours[i]));
    g.lineTo(x, yAt(map, values[i]));
  }
  g.stroke();
  g.globalAlpha = LINE_OPACITY;
  for (const wanted of [false, true]) {
    g.strokeStyle = wanted ? colours.wrong : colours.theirs;
    g.lineWidth = 1;
    g.beginPath();
    let last = -1;
    for (let i = from; i + 1 < to; i++) {
      if (!isDrawn(i) || isWrong(i) !== wanted) continue;
      if (last !== i) g.moveTo(xAt(map, times[i]), yAt(map, values[i]));
      g.lineTo(xAt(map, times[i + 1]), yAt(map, values[i + 1]));
      last = i + 1;
    }
    g.stroke();
  }
  g.globalAlpha = 1;
}

function drawColumns(
  g: CanvasRenderingContext2D,
  map: TraceMap,
  { times, values, wrong }: TheirChannel,
  from: number,
  to: number,
  colours: PictureColours,
): void {
  let column = Number.NaN;
  let top = Number.POSITIVE_INFINITY;
  let bottom = Number.NEGATIVE_INFINITY;
  let isWrong = false;
  const end = () => {
    g.fillStyle = isWrong ? colours.wrong : colours.theirs;
    if (top <= bottom) g.fillRect(column, top - 0.5, 1, bottom - top + 1);
    top = Number.POSITIVE_INFINITY;
    bottom = Number.NEGATIVE_INFINITY;
    isWrong = false;
  };
  for (let i = from; i < to; i++) {
    const x = Math.floor(xAt(map, times[i]));
    if (x !== column) end();
    column = x;
    const y = yAt(map, values[i]);
    if (wrong[i] === 1) isWrong = true;
    if (!Number.isFinite(y)) continue;
    top = Math.min(top, y);
    bottom = Math.max(bottom, y);
  }
  end();
}

function xAt(map: TraceMap, time: number): number {
  return (time - map.left) * map.perSecond;
}

function yAt(map: TraceMap, value: number): number {
  return map.bottom - (value - map.low) * map.perUnit;
}
