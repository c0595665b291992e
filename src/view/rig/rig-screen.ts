/**
 * Where the handles of rig mode are on the screen, as last drawn: what the pointer is over is decided from this, so that
 * a hand gets what it sees. CSS pixels from the viewport's left top; what is not seen is NaN.
 */
export type Axis = 0 | 1 | 2;
export const AXES: readonly Axis[] = [0, 1, 2];

/** Something of the overlay that a hand can take or pick. */
export type RigPart =
  | { readonly kind: 'joint'; readonly joint: number }
  /** A bone stands for the joint that it starts from. */
  | { readonly kind: 'bone'; readonly joint: number }
  /** Of the three that move the selected joint. */
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
  /** x y of each joint, and after them of the ends of bones that no joint continues. */
  readonly nodes: Float64Array;
  /** For each node, the joint that the bone to it starts from; -1 where none leads to it. */
  readonly starts: Int32Array;
  readonly selected: number | undefined;
  /** x y of the start and the tip of each arrow, 4 an axis. */
  readonly arrows: Float64Array;
  /** x y of each face's handle: −x +x −y +y −z +z. */
  readonly faces: Float64Array;
}
