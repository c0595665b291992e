/** A short animated move of the camera. A click doesn't interrupt it; a drag starts from its end. */
import { Vector3 } from 'three';
import { easeOut, shortTurn } from '../../math/framing.ts';

/** Camera target, direction and distance; see `camera.ts`. */
export interface View {
  readonly target: Vector3;
  azimuth: number;
  polar: number;
  distance: number;
}

export const newView = (): View => ({ target: new Vector3(), azimuth: 0, polar: 0, distance: 1 });

/** Of coordinates and distances: what is farther away, squared, is no 32-bit float of graphics any more. */
export const FARTHEST = 1e15;
/** The least distance to a target, as a part of how far that is from the origin: nearer, numbers can't tell the two. */
const FINEST = 1e-9;

/** Limits a view to what can be drawn. False, and nothing is changed, if any of its numbers isn't one. */
export function limitView(view: View): boolean {
  const { target, azimuth, polar, distance } = view;
  if (Number.isNaN(target.x) || Number.isNaN(target.y) || Number.isNaN(target.z)) return false;
  if (!Number.isFinite(azimuth) || !Number.isFinite(polar) || Number.isNaN(distance)) return false;
  target.clampScalar(-FARTHEST, FARTHEST);
  const off = Math.max(Math.abs(target.x), Math.abs(target.y), Math.abs(target.z));
  view.distance = Math.min(FARTHEST, Math.max(distance, 1 / FARTHEST, FINEST * off));
  return true;
}

/** CSS pixels: a press that moved no further is a click. */
export const CLICK_PIXELS = 4;
const MOVE_MS = 260;

export class CameraTravel {
  private leg: { readonly from: View; readonly to: View; startMs: number } | undefined;
  private readonly between = newView();

  /** The view it moves to; undefined if it isn't moving. */
  get goal(): View | undefined {
    return this.leg?.to;
  }

  /** Takes over both views. */
  begin(from: View, to: View): void {
    this.leg = { from, to, startMs: 0 };
  }

  stop(): void {
    this.leg = undefined;
  }

  /** Moves both ends along. */
  shift(by: Vector3): void {
    this.leg?.from.target.add(by);
    this.leg?.to.target.add(by);
  }

  /** The view at a time, valid until the next call; undefined if it isn't moving. Ends the move when it is over. */
  at(nowMs: number): View | undefined {
    const { leg, between } = this;
    if (!leg) return undefined;
    // Starts with the first frame, so that a slow one doesn't swallow it.
    if (leg.startMs === 0) leg.startMs = nowMs;
    const { from, to, startMs } = leg;
    const t = easeOut((nowMs - startMs) / MOVE_MS);
    between.target.lerpVectors(from.target, to.target, t);
    between.azimuth = from.azimuth + shortTurn(from.azimuth, to.azimuth) * t;
    between.polar = from.polar + (to.polar - from.polar) * t;
    // Interpolated geometrically, so that zooming looks even.
    between.distance = from.distance * (to.distance / from.distance) ** t;
    if (t >= 1) this.leg = undefined;
    return between;
  }
}

/** Tells a drag from a click while a button or finger is down. */
export class PressWatch {
  private down: { readonly x: number; readonly y: number } | undefined;

  press({ clientX, clientY }: Pick<PointerEvent, 'clientX' | 'clientY'>): void {
    this.down = { x: clientX, y: clientY };
  }

  /** Whether the pointer has moved further than a click. */
  isDrag({ clientX, clientY, buttons }: Pick<PointerEvent, 'clientX' | 'clientY' | 'buttons'>): boolean {
    const { down } = this;
    return buttons !== 0 && down !== undefined && Math.hypot(clientX - down.x, clientY - down.y) > CLICK_PIXELS;
  }
}
