/** Draws markers and labelled spans in a strip of a timeline. */

/** In seconds of the transport. */
export interface ShownMarker {
  readonly timeSeconds: number;
  readonly endSeconds?: number;
  readonly label: string;
}

export const NO_MARKERS: readonly ShownMarker[] = [];

export interface MarkerColours {
  readonly marker: string;
  readonly markerText: string;
  readonly font: string;
}

/** Height of the strip in CSS pixels. */
export const MARKER_HEIGHT = 13;
const PADDING = 4;

/**
 * A label ends where the next marker begins.
 * @param x pixels of a time
 * @param top of the strip
 */
export function drawMarkers(
  g: CanvasRenderingContext2D,
  markers: readonly ShownMarker[],
  x: (seconds: number) => number,
  width: number,
  top: number,
  colours: MarkerColours,
): void {
  g.font = colours.font;
  g.textAlign = 'left';
  g.textBaseline = 'middle';
  markers.forEach(({ timeSeconds, endSeconds, label }, i) => {
    const left = Math.round(x(timeSeconds));
    const next = markers[i + 1];
    const room = (next ? Math.round(x(next.timeSeconds)) : width) - left;
    const wanted = label ? g.measureText(label).width + 2 * PADDING : PADDING;
    const span = endSeconds === undefined ? 0 : Math.round(x(endSeconds)) - left;
    if (left > width || left + Math.max(span, wanted) < 0) return;
    g.fillStyle = colours.marker;
    g.globalAlpha = 0.28;
    g.fillRect(left, top, endSeconds === undefined ? Math.min(room, wanted) : Math.max(2, span), MARKER_HEIGHT);
    g.globalAlpha = 1;
    g.fillRect(left - 1, top, 2, MARKER_HEIGHT);
    if (endSeconds !== undefined) g.fillRect(left + span - 1, top, 2, MARKER_HEIGHT);
    if (!label || room < 2 * PADDING) return;
    g.save();
    g.beginPath();
    g.rect(left, top, room - 1, MARKER_HEIGHT);
    g.clip();
    g.fillStyle = colours.markerText;
    g.fillText(label, left + PADDING, top + MARKER_HEIGHT / 2 + 0.5);
    g.restore();
  });
}
