/**
 * What a wheel does over anything with times along it: rulers, the scrubber, curves, the dope sheet, charts.
 *
 *     wheel           zooms about the pointer, in the curves both axes
 *     Ctrl+wheel      zooms time only, as pinching does on a trackpad
 *     Alt+wheel       the other axis: zooms values, scrolls rows
 *     Shift+wheel     pans in time, as a wheel does that goes sideways
 */

/** The part of a WheelEvent that is needed. */
export interface Wheel
  extends Pick<WheelEvent, 'deltaX' | 'deltaY' | 'deltaMode' | 'shiftKey' | 'ctrlKey' | 'metaKey' | 'altKey'> {}

export type WheelTurn =
  | { readonly what: 'pan' /** CSS pixels to the right. */; readonly pixels: number }
  | {
      readonly what: 'zoom';
      readonly axes: 'both' | 'time' | 'other';
      /** Above 1 zooms out. */
      readonly factor: number;
      /** CSS pixels that it would scroll down. */
      readonly pixels: number;
    };

const ZOOM_STEP = 1.15;
/** A typical notch in pixels: one step. */
const STEP_PIXELS = 60;
/** Pixels per line, for wheels that count in lines. */
const LINE_PIXELS = 16;

export function wheelTurn(wheel: Wheel): WheelTurn {
  const unit = wheel.deltaMode === 1 ? LINE_PIXELS : 1;
  const [dx, dy] = [wheel.deltaX * unit, wheel.deltaY * unit];
  // With Shift, some systems already scroll sideways.
  const sideways = Math.abs(dx) > Math.abs(dy) ? dx : wheel.shiftKey ? dy : 0;
  if (sideways !== 0) return { what: 'pan', pixels: sideways };
  const axes = wheel.ctrlKey || wheel.metaKey ? 'time' : wheel.altKey ? 'other' : 'both';
  return { what: 'zoom', axes, factor: ZOOM_STEP ** (dy / STEP_PIXELS), pixels: dy };
}
