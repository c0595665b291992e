/** From the world to pixels of the viewport, for one picture, whatever the camera. */
import { Matrix4, type OrthographicCamera, type PerspectiveCamera, Vector3 } from 'three';
import type { Vec3 } from '../math/vec3.ts';

/** Of w: what is no further before the eye than that is behind it. */
const NEAREST = 1e-9;

export class CameraProjection {
  /** CSS pixels of the viewport. */
  width = 1;
  height = 1;
  private camera: PerspectiveCamera | OrthographicCamera | undefined;
  private readonly toClip = new Matrix4();
  private readonly before = new Matrix4();
  private readonly eye = new Vector3();
  private readonly ahead = new Vector3();

  /**
   * Takes the camera as it is. Whether that is another view than before.
   * @param heightPx CSS pixels of the viewport
   * @param widthPx by the camera where absent: asking the page for it in every frame would have it laid out anew in
   *   every frame
   */
  look(
    camera: PerspectiveCamera | OrthographicCamera,
    heightPx: number,
    widthPx = heightPx * aspectOf(camera),
  ): boolean {
    camera.updateMatrixWorld();
    const { toClip, before, height, width } = this;
    before.copy(toClip);
    this.camera = camera;
    this.height = heightPx;
    this.width = widthPx;
    toClip.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
    this.eye.setFromMatrixPosition(camera.matrixWorld);
    camera.getWorldDirection(this.ahead);
    return height !== this.height || width !== this.width || !before.equals(toClip);
  }

  /** Writes x y from the viewport's left top to `out[o]`; NaN, and false, behind the viewer. */
  toPixels(x: number, y: number, z: number, out: Float64Array, o: number): boolean {
    const m = this.toClip.elements;
    const w = m[3] * x + m[7] * y + m[11] * z + m[15];
    if (!(w > NEAREST)) {
      out[o] = out[o + 1] = Number.NaN;
      return false;
    }
    out[o] = ((m[0] * x + m[4] * y + m[8] * z + m[12]) / w + 1) * 0.5 * this.width;
    out[o + 1] = (1 - (m[1] * x + m[5] * y + m[9] * z + m[13]) / w) * 0.5 * this.height;
    return true;
  }

  /** The same of a point. */
  project([x, y, z]: Vec3, out: Float64Array, o: number): boolean {
    return this.toPixels(x, y, z, out, o);
  }

  /** From a point, of length 1. */
  towardsViewer([x, y, z]: Vec3): Vec3 {
    const { ahead, eye, camera } = this;
    if (camera && 'isOrthographicCamera' in camera) return [-ahead.x, -ahead.y, -ahead.z];
    const [dx, dy, dz] = [eye.x - x, eye.y - y, eye.z - z];
    const length = Math.hypot(dx, dy, dz) || 1;
    return [dx / length, dy / length, dz / length];
  }

  /** Length in the world of a CSS pixel, at a point; before the near plane and behind the viewer, that of the plane. */
  unitsPerPixel([x, y, z]: Vec3): number {
    return this.unitsPerPixelAt(x, y, z);
  }

  /** The same of three numbers. */
  unitsPerPixelAt(x: number, y: number, z: number): number {
    const { camera } = this;
    if (!camera) return 1;
    if ('isOrthographicCamera' in camera) return (camera.top - camera.bottom) / camera.zoom / this.height;
    return (2 * Math.max(this.depthAt(x, y, z), camera.near) * Math.tan((camera.fov * Math.PI) / 360)) / this.height;
  }

  /** Along the line of sight, in units of the world. */
  depthAt(x: number, y: number, z: number): number {
    const { ahead, eye } = this;
    return (x - eye.x) * ahead.x + (y - eye.y) * ahead.y + (z - eye.z) * ahead.z;
  }
}

function aspectOf(camera: PerspectiveCamera | OrthographicCamera): number {
  if ('isPerspectiveCamera' in camera) return camera.aspect;
  return (camera.right - camera.left) / (camera.top - camera.bottom);
}
