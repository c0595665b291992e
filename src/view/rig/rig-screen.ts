/**
 * Screen positions of rig mode's handles, as last drawn. Hit testing uses these, so that users hit what they see. CSS
 * pixels from the viewport's top left; NaN for what isn't visible.
 */
export type Axis = 0 | 1 | 2;
export const AXES: readonly Axis[] = [0, 1, 2];

/** A part of the overlay that can be hovered, picked or dragged. */
export type RigPart =
  | { readonly kind: 'joint'; readonly joint: number }
  /** A bone means the joint where it starts. */
  | { readonly kind: 'bone'; readonly joint: number }
  /** One of the three that move the selected joint. */
  | { readonly kind: 'arrow'; readonly axis: Axis }
  /** Of the selected joint's box. */
  | { readonly kind: 'face'; readonly axis: Axis; readonly side: 'min' | 'max' };

export function samePart(a: RigPart | undefined, b: RigPart | undefined): boolean {
  if (a === b || !a || !b) return a === b;
  if (a.kind === 'joint' || a.kind === 'bone') return a.kind === b.kind && a.joint === b.joint;
  if (b.kind !== 'arrow' && b.kind !== 'face') return false;
  if (a.kind !== b.kind || a.axis !== b.axis) return false;
  return a.kind !== 'face' || b.kind !== 'face' || a.side === b.side;
}

export interface RigScreen {
  readonly jointCount: number;
  /** x y of each joint, followed by the bone ends without a joint. */
  readonly nodes: Float64Array;
  /** For each node, the joint where its bone starts; -1 without one. */
  readonly starts: Int32Array;
  readonly selected: number | undefined;
  /** x y of the start and tip of each arrow, 4 numbers per axis. */
  readonly arrows: Float64Array;
  /** x y of each face's handle: −x +x −y +y −z +z. */
  readonly faces: Float64Array;
}
