/**
 * Tangent handles. A handle has a constant length on screen and points along the curve as drawn:
 *
 *     direction = (pixels per second, −pixels per unit · slope), scaled to HANDLE_PIXELS      out: to the right, in: left
 *
 * so dragging one sets only the slope: the distance doesn't matter.
 */

import { keySlope } from '../../../../evaluate/slopes.ts';
import { firstNotBelow } from '../../../../math/search.ts';
import { keysOf } from '../../../../model/takes/take.ts';
import { pixelsPerSecond, timeAt, timeX } from '../../../widgets/time/time-window.ts';
import { type CurveLine, type CurveScene, type HandleSide, lineOf } from './scene.ts';
import { pixelsPerUnit, yOf } from './space.ts';

export const HANDLE_PIXELS = 44;
/** With more selected keys than this in view, handles would overlap and can't be grabbed. */
const MAX_KEYS_WITH_HANDLES = 120;
/** Nor if a line's selected keys are closer than this on average, unless they are few. */
const MIN_PIXELS_BETWEEN = 24;
const FEW_KEYS = 4;
/** A pointer exactly above its key would mean an infinite slope: it counts as this far to the side. */
const MIN_PIXELS_ASIDE = 1;

export interface TangentHandle {
  readonly line: CurveLine;
  readonly index: number;
  readonly side: HandleSide;
  /** Position of the key. */
  readonly x: number;
  readonly y: number;
  readonly endX: number;
  readonly endY: number;
}

/**
 * Handles of the selected keys in view; none if they are too many. A key at a step has only the one that affects the
 * curve; first and last keys have both, since linear extrapolation may use the outer one.
 */
export function handlesOf(scene: CurveScene): TangentHandle[] {
  const { space, take, offsetSeconds } = scene;
  const left = timeAt(space, -HANDLE_PIXELS) + offsetSeconds;
  const right = timeAt(space, space.width + HANDLE_PIXELS) + offsetSeconds;
  const handles: TangentHandle[] = [];
  for (const { channel, indices } of scene.selected) {
    const line = lineOf(scene, channel);
    const { times } = keysOf(take.channels[channel]);
    if (!line) continue;
    const begin = firstNotBelow(indices, firstNotBelow(times, left));
    let end = begin;
    while (end < indices.length && end - begin <= MAX_KEYS_WITH_HANDLES && times[indices[end]] <= right) end++;
    const count = end - begin;
    if (count > FEW_KEYS) {
      const pixels = (times[indices[end - 1]] - times[indices[begin]]) * pixelsPerSecond(space);
      if (pixels < MIN_PIXELS_BETWEEN * (count - 1)) continue;
    }
    for (let i = begin; i < end; i++) {
      if (handles.length >= 2 * MAX_KEYS_WITH_HANDLES) return [];
      const index = indices[i];
      if (times[index - 1] !== times[index]) handles.push(handleOf(scene, line, index, 'in'));
      if (times[index + 1] !== times[index]) handles.push(handleOf(scene, line, index, 'out'));
    }
  }
  return handles;
}

/** The handle of a key of the line's channel. */
export function handleOf(scene: CurveScene, line: CurveLine, index: number, side: HandleSide): TangentHandle {
  const { space } = scene;
  const keys = keysOf(scene.take.channels[line.channel]);
  const slope = keySlope(keys, index, side);
  const dx = pixelsPerSecond(space);
  const dy = -pixelsPerUnit(space, line) * slope;
  const length = Math.hypot(dx, dy);
  const scale = ((side === 'in' ? -1 : 1) * HANDLE_PIXELS) / (Number.isFinite(length) && length > 0 ? length : 1);
  const x = timeX(space, keys.times[index] - scene.offsetSeconds);
  const y = yOf(space, line, keys.values[index]);
  return { line, index, side, x, y, endX: x + dx * scale, endY: y + dy * scale };
}

/** The slope (value per second) of a handle dragged to a point; it stays on its side of the key. */
export function slopeFromHandle(
  scene: CurveScene,
  line: CurveLine,
  index: number,
  side: HandleSide,
  x: number,
  y: number,
): number {
  const { space } = scene;
  const { times, values } = keysOf(scene.take.channels[line.channel]);
  const aside = x - timeX(space, times[index] - scene.offsetSeconds);
  const dx = side === 'in' ? Math.min(-MIN_PIXELS_ASIDE, aside) : Math.max(MIN_PIXELS_ASIDE, aside);
  const up = yOf(space, line, values[index]) - y;
  return ((up / pixelsPerUnit(space, line)) * pixelsPerSecond(space)) / dx;
}
