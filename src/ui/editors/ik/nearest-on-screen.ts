/** CSS pixels within which a click means a natural point. */
export const NATURAL_POINT_PIXELS = 10;

export interface PlaceOnScreen {
  readonly x: number;
  readonly y: number;
}

/** The nearest of some points on the screen that is within reach of a place; -1 where none is. */
export function nearestOnScreen(points: readonly PlaceOnScreen[], at: PlaceOnScreen, withinPixels: number): number {
  let best = -1;
  let least = withinPixels;
  points.forEach(({ x, y }, i) => {
    const distance = Math.hypot(x - at.x, y - at.y);
    if (!(distance <= least)) return;
    // Of two in one place the first.
    if (best < 0 || distance < least) best = i;
    least = distance;
  });
  return best;
}
