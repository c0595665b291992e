/** What a gizmo asks of three.js's camera. */
import { Matrix4, type OrthographicCamera, type PerspectiveCamera, Vector3 } from 'three';
import type { Vec3 } from '../../math/vec3.ts';
import type { Projection } from './shapes.ts';

export class CameraProjection implements Projection {
  width = 1;
  height = 1;
  private camera: PerspectiveCamera | OrthographicCamera | undefined;
  private readonly toClip = new Matrix4();
  private readonly eye = new Vector3();
  private readonly ahead = new Vector3();

  /** Takes the camera as it is; sizes are CSS pixels of the viewport. */
  look(camera: PerspectiveCamera | OrthographicCamera, width: number, height: number): void {
    camera.updateMatrixWorld();
    this.camera = camera;
    this.width = width;
    this.height = height;
    this.toClip.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
    this.eye.setFromMatrixPosition(camera.matrixWorld);
    camera.getWorldDirection(this.ahead);
  }

  project([x, y, z]: Vec3, out: Float64Array, o: number): boolean {
    const m = this.toClip.elements;
    const w = m[3] * x + m[7] * y + m[11] * z + m[15];
    if (!(w > 1e-9)) return false;
    out[o] = ((m[0] * x + m[4] * y + m[8] * z + m[12]) / w + 1) * 0.5 * this.width;
    out[o + 1] = (1 - (m[1] * x + m[5] * y + m[9] * z + m[13]) / w) * 0.5 * this.height;
    return true;
  }

  towardsViewer([x, y, z]: Vec3): Vec3 {
    const { ahead, eye, camera } = this;
    if (camera && 'isOrthographicCamera' in camera) return [-ahead.x, -ahead.y, -ahead.z];
    const [dx, dy, dz] = [eye.x - x, eye.y - y, eye.z - z];
    const length = Math.hypot(dx, dy, dz) || 1;
    return [dx / length, dy / length, dz / length];
  }

  unitsPerPixel([x, y, z]: Vec3): number {
    const { ahead, eye, camera } = this;
    if (!camera) return 1;
    if ('isOrthographicCamera' in camera) return (camera.top - camera.bottom) / camera.zoom / this.height;
    const depth = (x - eye.x) * ahead.x + (y - eye.y) * ahead.y + (z - eye.z) * ahead.z;
    return (2 * Math.max(depth, camera.near) * Math.tan((camera.fov * Math.PI) / 360)) / this.height;
  }
}
