/** Below the curves: range, grid, limits; above them: labels of the value axes. */

import { GUTTER } from '../../../widgets/time/time-window.ts';
import { drawOutsideRange, drawTimeGrid, type TimeView } from '../../timeline/time-ground.ts';
import type { CurveLine, CurveScene } from '../scene/scene.ts';
import { type AxisName, yOf } from '../scene/space.ts';
import { isInDegrees, type ValueTick, valueTicks } from '../scene/ticks.ts';
import type { PictureColours } from './picture-colours.ts';

const LABEL_SPACING = 34;
const HATCH_PIXELS = 7;
/** Translucent, since curves are drawn over it. */
const HATCH_OPACITY = 0.6;

export function timeView(scene: CurveScene): TimeView {
  const { space, range, framesPerSecond, inFrames } = scene;
  return { window: space.window, width: space.width, range, framesPerSecond, inFrames };
}

/** The axis that has labels and grid: of the first selected curve, else of the first; and the other of length and angle. */
function shownAxes({ lines, selected }: CurveScene): readonly AxisName[] {
  const line = lines.find(({ channel }) => selected.some((keys) => keys.channel === channel)) ?? lines[0];
  const first = line?.axis ?? 'angle';
  const other = first === 'angle' ? 'length' : first === 'length' ? 'angle' : undefined;
  return other && lines.some(({ axis }) => axis === other) ? [first, other] : [first];
}

export function drawCurveGround(g: CanvasRenderingContext2D, scene: CurveScene, colours: PictureColours): void {
  const { width, height } = scene.space;
  const view = timeView(scene);
  g.fillStyle = colours.plot;
  g.fillRect(0, 0, width, height);
  drawOutsideRange(g, view, 0, height, colours.time);
  drawTimeGrid(g, view, 0, height, colours.time);
  const [axis] = shownAxes(scene);
  const ticks = axisTicks(scene, axis);
  for (const labelled of [false, true]) {
    for (const tick of ticks) {
      if ((tick.label !== undefined) !== labelled) continue;
      g.fillStyle = tick.value === 0 ? colours.zeroLine : labelled ? colours.valueLine : colours.fineValueLine;
      g.fillRect(0, Math.round(yOf(scene.space, { axis }, tick.value)), width, 1);
    }
  }
}

/**
 * Labels of the axis of the first selected curve in the left gutter; of lengths and angles, the other's in the right
 * one. Outlined in the plot's colour so that they are readable over curves.
 */
export function drawValueLabels(g: CanvasRenderingContext2D, scene: CurveScene, colours: PictureColours): void {
  const { width, height } = scene.space;
  g.font = colours.time.font;
  g.textAlign = 'right';
  g.textBaseline = 'middle';
  g.lineJoin = 'round';
  g.lineWidth = 3;
  g.strokeStyle = colours.plot;
  g.fillStyle = colours.label;
  shownAxes(scene).forEach((axis, i) => {
    const x = i === 0 ? GUTTER - 8 : width - GUTTER;
    for (const { label, value } of axisTicks(scene, axis)) {
      if (label === undefined) continue;
      const y = Math.round(yOf(scene.space, { axis }, value));
      if (y < 7 || y > height - 7) continue;
      g.strokeText(label, x, y);
      g.fillText(label, x, y);
    }
  });
}

function axisTicks(scene: CurveScene, axis: AxisName): ValueTick[] {
  return valueTicks(scene.space.axes[axis], scene.space.height, LABEL_SPACING, isInDegrees(axis, scene.degrees));
}

/** Hatches values outside the limits, if those are unambiguous: one line's, or the same for all. */
export function drawLimits(
  g: CanvasRenderingContext2D,
  scene: CurveScene,
  emphasised: readonly CurveLine[],
  ratio: number,
  colours: PictureColours,
): void {
  const [line, ...others] = emphasised.length ? emphasised : scene.lines.length === 1 ? scene.lines : [];
  if (!line?.limit) return;
  const { min, max } = line.limit;
  const bottom = yOf(scene.space, line, min);
  const top = yOf(scene.space, line, max);
  for (const other of others) {
    if (!other.limit) return;
    if (yOf(scene.space, other, other.limit.min) !== bottom || yOf(scene.space, other, other.limit.max) !== top) return;
  }
  const { width, height } = scene.space;
  g.fillStyle = hatchPattern(g, ratio, colours.hatch) ?? colours.hatch;
  g.globalAlpha = HATCH_OPACITY;
  if (top > 0) g.fillRect(0, 0, width, Math.min(height, top));
  if (bottom < height) g.fillRect(0, Math.max(0, bottom), width, height - Math.max(0, bottom));
  g.globalAlpha = 1;
  g.fillStyle = colours.hatch;
  for (const y of [top, bottom]) if (y > 0 && y < height) g.fillRect(0, Math.round(y), width, 1);
}

let pattern: { readonly made: CanvasPattern | null; readonly of: string } | undefined;

function hatchPattern(g: CanvasRenderingContext2D, ratio: number, colour: string): CanvasPattern | null {
  const of = `${colour} ${ratio}`;
  if (pattern?.of === of) return pattern.made;
  const size = Math.max(4, Math.round(HATCH_PIXELS * ratio));
  const tile = document.createElement('canvas');
  tile.width = tile.height = size;
  const t = tile.getContext('2d');
  if (!t) return null;
  t.strokeStyle = colour;
  t.lineWidth = ratio;
  t.beginPath();
  // Three strokes, so that the corners of neighbouring tiles meet.
  for (const shift of [-size, 0, size]) {
    t.moveTo(shift, size);
    t.lineTo(shift + size, 0);
  }
  t.stroke();
  const made = g.createPattern(tile, 'repeat');
  made?.setTransform(new DOMMatrix([1 / ratio, 0, 0, 1 / ratio, 0, 0]));
  pattern = { made, of };
  return made;
}
