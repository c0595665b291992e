/**
 * Where the handles of rig mode are on the screen, as last drawn: what the pointer is over is decided from this, so that
 * a hand gets what it sees. CSS pixels from the viewport's left top; what is not seen is NaN.
 */
import { Matrix4, type OrthographicCamera, type PerspectiveCamera } from 'three';

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

/** From the world to pixels of the viewport, for one picture. */
export class Projection {
  private readonly matrix = new Matrix4();
  private width = 1;
  private height = 1;
  private camera: PerspectiveCamera | OrthographicCamera | undefined;

  /** @param heightPx CSS pixels of the viewport */
  set(camera: PerspectiveCamera | OrthographicCamera, heightPx: number): void {
    camera.updateMatrixWorld();
    this.camera = camera;
    this.matrix.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
    this.height = heightPx;
    const aspect =
      'isPerspectiveCamera' in camera ? camera.aspect : (camera.right - camera.left) / (camera.top - camera.bottom);
    this.width = heightPx * aspect;
  }

  /** Writes x y of a point at `out[o]`; NaN where it is behind the camera. */
  toPixels(x: number, y: number, z: number, out: Float64Array, o: number): void {
    const e = this.matrix.elements;
    const w = e[3] * x + e[7] * y + e[11] * z + e[15];
    if (!(w > 0)) {
      out[o] = out[o + 1] = Number.NaN;
      return;
    }
    out[o] = ((1 + (e[0] * x + e[4] * y + e[8] * z + e[12]) / w) / 2) * this.width;
    out[o + 1] = ((1 - (e[1] * x + e[5] * y + e[9] * z + e[13]) / w) / 2) * this.height;
  }

  /** Length in the world that a pixel shows at a point; 0 behind the camera. */
  unitsPerPixel(x: number, y: number, z: number): number {
    const { camera, height } = this;
    if (!camera) return 0;
    if ('isOrthographicCamera' in camera) return (camera.top - camera.bottom) / camera.zoom / height;
    const e = camera.matrixWorldInverse.elements;
    const depth = -(e[2] * x + e[6] * y + e[10] * z + e[14]);
    return Math.max(0, (2 * depth * Math.tan((camera.fov * Math.PI) / 360)) / height);
  }
}
