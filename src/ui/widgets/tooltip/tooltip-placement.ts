/** Placement of tooltips. CSS pixels from the window's upper left corner. */

export interface PageRect {
  readonly left: number;
  readonly top: number;
  readonly width: number;
  readonly height: number;
}

export interface Size {
  readonly width: number;
  readonly height: number;
}

/** Between an element and its tooltip. */
export const GAP = 6;
/** Margin at the window's edges. */
export const MARGIN = 4;

/**
 * Below the element and centred, or above if there is no room below; always inside the window. Under an element wider
 * than the tooltip, it is left-aligned with it.
 */
export function placeTooltip(
  anchor: PageRect,
  size: Size,
  room: Size,
): { readonly left: number; readonly top: number } {
  const bottom = Math.min(room.height, anchor.top + anchor.height);
  const top = Math.max(0, anchor.top);
  const below = bottom + GAP;
  const above = top - GAP - size.height;
  const fitsBelow = below + size.height <= room.height - MARGIN;
  const isBelow = fitsBelow || (above < MARGIN && room.height - bottom >= top);
  const centred = anchor.width > size.width ? anchor.left : anchor.left + (anchor.width - size.width) / 2;
  return {
    left: Math.round(within(centred, room.width - size.width)),
    top: Math.round(within(isBelow ? below : above, room.height - size.height)),
  };
}

/** Whether a point is on the tooltip, or in the gap before it. */
export function isOnTooltip(x: number, y: number, tooltip: PageRect): boolean {
  return (
    x >= tooltip.left &&
    x <= tooltip.left + tooltip.width &&
    y >= tooltip.top - GAP &&
    y <= tooltip.top + tooltip.height + GAP
  );
}

function within(at: number, most: number): number {
  return Math.max(MARGIN, Math.min(at, most - MARGIN));
}
