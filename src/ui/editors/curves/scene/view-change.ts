/**
 * The transform of an image of the curves from one view to another:
 *
 *     x′ = scaleX · x + dx        y′ = scaleY · y + dy        CSS pixels of the plot
 *
 * It exists if all axes were zoomed and panned together, as by mouse; fitting sets each separately.
 */
import { pixelsPerSecond, timeX } from '../../../widgets/time/time-window.ts';
import { type CurveSpace, type OnAxis, valueAt, yOf } from './space.ts';

export interface ViewChange {
  readonly scaleX: number;
  readonly scaleY: number;
  readonly x: number;
  readonly y: number;
}

/** Axes that differ by more than this were changed separately. */
const SAME_PIXELS = 0.25;
/** An image scaled by more than this is useless. */
const MAX_SCALE = 4;

/** Undefined if no transform exists. */
export function movedBetween(from: CurveSpace, to: CurveSpace, lines: readonly OnAxis[]): ViewChange | undefined {
  const scaleX = pixelsPerSecond(to) / pixelsPerSecond(from);
  const x = timeX(to, from.window.from);
  let first: { readonly top: number; readonly bottom: number } | undefined;
  const seen = new Set<string>();
  for (const line of lines) {
    if (seen.has(line.axis)) continue;
    seen.add(line.axis);
    const top = yOf(to, line, valueAt(from, line, 0));
    const bottom = yOf(to, line, valueAt(from, line, from.height));
    first ??= { top, bottom };
    if (Math.abs(top - first.top) > SAME_PIXELS || Math.abs(bottom - first.bottom) > SAME_PIXELS) return undefined;
  }
  const { top, bottom } = first ?? { top: 0, bottom: to.height };
  const scaleY = (bottom - top) / from.height;
  const isNear = [scaleX, scaleY].every((scale) => scale > 1 / MAX_SCALE && scale < MAX_SCALE);
  return isNear ? { scaleX, scaleY, x, y: top } : undefined;
}
