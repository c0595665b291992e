/** CSS pixels within which a click snaps to a natural point. */
export const NATURAL_POINT_PIXELS = 10;

export interface PlaceOnScreen {
  readonly x: number;
  readonly y: number;
}

/** The nearest of some screen points within a distance; -1 if there is none. */
export function nearestOnScreen(points: readonly PlaceOnScreen[], at: PlaceOnScreen, withinPixels: number): number {
  let best = -1;
  let least = withinPixels;
  points.forEach(({ x, y }, i) => {
    const distance = Math.hypot(x - at.x, y - at.y);
    if (!(distance <= least)) return;
    // The first of coincident points.
    if (best < 0 || distance < least) best = i;
    least = distance;
  });
  return best;
}
