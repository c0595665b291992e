/**
 * Below the curves of the active layer: faint, what the other layers and the base add up to, and the layer's weight,
 * from 0 at the bottom of the plot to 1 at its top.
 */
import { perObject } from '../../../../model/per-object.ts';
import { timeX } from '../../../widgets/time/time-window.ts';
import { faintly } from '../scene/colours.ts';
import { type RestCurves, type RestValues, restValues } from '../scene/rest-curves.ts';
import type { CurveLine, CurveScene } from '../scene/scene.ts';
import type { CurveSpace } from '../scene/space.ts';
import { traceMap } from '../scene/trace.ts';
import type { PictureColours } from './picture-colours.ts';

/** CSS pixels between two values. */
const STEP_PIXELS = 2;
/** Of the plot's height that the weight leaves free above and below. */
const WEIGHT_MARGIN = 14;
const KEY_RADIUS = 2.5;
const DASH = [6, 3];

/** The last values of each: panels draw the same ones again for other emphasis. */
const lastOf = perObject((_: RestCurves): { view?: CurveSpace['window']; width?: number; values?: RestValues } => ({}));

export function drawRest(g: CanvasRenderingContext2D, scene: CurveScene, colours: PictureColours): void {
  const { rest, space } = scene;
  if (!rest || !(space.width > 0)) return;
  const values = valuesIn(rest.curves, scene);
  g.save();
  g.beginPath();
  g.rect(0, 0, space.width, space.height);
  g.clip();
  g.lineWidth = 1;
  g.lineJoin = 'round';
  for (const line of rest.lines) {
    g.strokeStyle = faintly(line.colour, colours.palette, colours.plot);
    drawLine(g, scene, line, values, rest.curves.count);
  }
  drawWeight(g, scene, rest.curves, values, colours);
  g.restore();
}

function valuesIn(curves: RestCurves, { space, offsetSeconds }: CurveScene): RestValues {
  const last = lastOf(curves);
  const { window, width } = space;
  if (last.values && last.view === window && last.width === width) return last.values;
  const timeCount = Math.ceil(width / STEP_PIXELS) + 1;
  const step = ((window.to - window.from) * STEP_PIXELS) / width;
  const values = restValues(curves, window.from + offsetSeconds, step, timeCount);
  Object.assign(last, { view: window, width, values });
  return values;
}

function drawLine(
  g: CanvasRenderingContext2D,
  scene: CurveScene,
  line: CurveLine,
  { values, timeCount }: RestValues,
  count: number,
): void {
  const map = traceMap(scene, line);
  g.beginPath();
  for (let i = 0; i < timeCount; i++) {
    g.lineTo(i * STEP_PIXELS, map.bottom - (values[i * count + line.channel] - map.low) * map.perUnit);
  }
  g.stroke();
}

function drawWeight(
  g: CanvasRenderingContext2D,
  { space, offsetSeconds }: CurveScene,
  { weight }: RestCurves,
  { weights }: RestValues,
  { time, label }: PictureColours,
): void {
  if (!weight) return;
  const y = (value: number) => space.height - WEIGHT_MARGIN - value * (space.height - 2 * WEIGHT_MARGIN);
  g.strokeStyle = g.fillStyle = label;
  g.setLineDash(DASH);
  g.beginPath();
  weights.forEach((value, i) => {
    g.lineTo(i * STEP_PIXELS, y(value));
  });
  g.stroke();
  g.setLineDash([]);
  const { times, values } = weight.channel;
  times.forEach((time, k) => {
    g.beginPath();
    g.arc(timeX(space, time - offsetSeconds), y(Math.min(1, Math.max(0, values[k]))), KEY_RADIUS, 0, 2 * Math.PI);
    g.fill();
  });
  g.font = time.font;
  g.textBaseline = 'bottom';
  g.fillText(`weight of ${weight.name}`, 6, y(weights[0]) - 3);
}
