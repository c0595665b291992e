/** Projects world points to pixels of the viewport, for one frame and either camera. */
import { Matrix4, type OrthographicCamera, type PerspectiveCamera, Vector3 } from 'three';
import type { Vec3 } from '../../math/vec3.ts';

/** Points with a smaller take w count as behind the camera. */
const NEAREST = 1e-9;

export class CameraProjection {
  /** CSS pixels of the viewport. */
  width = 1;
  height = 1;
  private camera: PerspectiveCamera | OrthographicCamera | undefined;
  private readonly toTake = new Matrix4();
  private readonly before = new Matrix4();
  private readonly eye = new Vector3();
  private readonly ahead = new Vector3();

  /**
   * Takes over the camera's current state. Returns whether the view has changed.
   *
   * @param heightPx CSS pixels of the viewport
   * @param widthPx from the camera's aspect if absent: reading it from the page would force a layout every frame
   */
  look(
    camera: PerspectiveCamera | OrthographicCamera,
    heightPx: number,
    widthPx = heightPx * aspectOf(camera),
  ): boolean {
    camera.updateMatrixWorld();
    const { toTake, before, height, width } = this;
    before.copy(toTake);
    this.camera = camera;
    this.height = heightPx;
    this.width = widthPx;
    toTake.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
    this.eye.setFromMatrixPosition(camera.matrixWorld);
    camera.getWorldDirection(this.ahead);
    return height !== this.height || width !== this.width || !before.equals(toTake);
  }

  /** Writes x y, from the viewport's top left, to `out[o]`; NaN, and false, behind the camera. */
  toPixels(x: number, y: number, z: number, out: Float64Array, o: number): boolean {
    const m = this.toTake.elements;
    const w = m[3] * x + m[7] * y + m[11] * z + m[15];
    if (!(w > NEAREST)) {
      out[o] = out[o + 1] = Number.NaN;
      return false;
    }
    out[o] = ((m[0] * x + m[4] * y + m[8] * z + m[12]) / w + 1) * 0.5 * this.width;
    out[o + 1] = (1 - (m[1] * x + m[5] * y + m[9] * z + m[13]) / w) * 0.5 * this.height;
    return true;
  }

  /** `toPixels` of a point. */
  project([x, y, z]: Vec3, out: Float64Array, o: number): boolean {
    return this.toPixels(x, y, z, out, o);
  }

  /** Unit vector from a point towards the camera. */
  towardsViewer([x, y, z]: Vec3): Vec3 {
    const { ahead, eye, camera } = this;
    if (camera && 'isOrthographicCamera' in camera) return [-ahead.x, -ahead.y, -ahead.z];
    const [dx, dy, dz] = [eye.x - x, eye.y - y, eye.z - z];
    const length = Math.hypot(dx, dy, dz) || 1;
    return [dx / length, dy / length, dz / length];
  }

  /**
   * World length of a CSS pixel at a point; in front of the near plane or behind the camera, that at the near plane.
   */
  unitsPerPixel([x, y, z]: Vec3): number {
    return this.unitsPerPixelAt(x, y, z);
  }

  /** `unitsPerPixel` of three numbers. */
  unitsPerPixelAt(x: number, y: number, z: number): number {
    const { camera } = this;
    if (!camera) return 1;
    if ('isOrthographicCamera' in camera) return (camera.top - camera.bottom) / camera.zoom / this.height;
    return (2 * Math.max(this.depthAt(x, y, z), camera.near) * Math.tan((camera.fov * Math.PI) / 360)) / this.height;
  }

  /** Depth along the view direction, in world units. */
  depthAt(x: number, y: number, z: number): number {
    const { ahead, eye } = this;
    return (x - eye.x) * ahead.x + (y - eye.y) * ahead.y + (z - eye.z) * ahead.z;
  }
}

function aspectOf(camera: PerspectiveCamera | OrthographicCamera): number {
  if ('isPerspectiveCamera' in camera) return camera.aspect;
  return (camera.right - camera.left) / (camera.top - camera.bottom);
}
