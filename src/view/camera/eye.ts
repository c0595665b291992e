/**
 * Converts between points of the page and of the scene, for dragging.
 *
 *     client   CSS pixels of the page, as pointer events have them
 *     world    the scene: y up, with placements applied
 */
import { Plane, Raycaster, Vector2, Vector3 } from 'three';
import type { Vec3 } from '../../math/vec3.ts';
import type { CameraRig } from './camera.ts';
import { CameraProjection } from './camera-projection.ts';

export interface Ray {
  readonly origin: Vec3;
  /** Unit length. */
  readonly direction: Vec3;
}

/** A point on the page, and its distance from the camera. NaN if behind the camera. */
export interface OnScreen {
  readonly x: number;
  readonly y: number;
  /** Along the view direction, in world units; 0 or less if not in front of a perspective camera. */
  readonly depth: number;
}

export class Eye {
  private readonly caster = new Raycaster();
  private readonly pointer = new Vector2();
  private readonly point = new Vector3();
  private readonly ahead = new Vector3();
  private readonly plane = new Plane();
  private readonly projection = new CameraProjection();
  private readonly pixels = new Float64Array(2);

  constructor(
    private readonly canvas: HTMLElement,
    private readonly rig: CameraRig,
  ) {}

  /** Projects a world point to the page. */
  toScreen(world: Vec3): OnScreen {
    const { projection, pixels } = this;
    const { left, top, width, height } = this.canvas.getBoundingClientRect();
    projection.look(this.rig.camera, height, width);
    projection.project(world, pixels, 0);
    return { x: left + pixels[0], y: top + pixels[1], depth: projection.depthAt(...world) };
  }

  /** The ray under a point of the page, from near to far. */
  rayAt(clientX: number, clientY: number): Ray {
    const { ray } = this.cast(clientX, clientY);
    return { origin: ray.origin.toArray(), direction: ray.direction.toArray() };
  }

  /** The point under the pointer in the camera-facing plane through `anchor`. */
  inPlaneOf(anchor: Vec3, clientX: number, clientY: number): Vec3 {
    const { camera } = this.rig;
    camera.updateMatrixWorld();
    const normal = camera.getWorldDirection(this.ahead);
    this.plane.setFromNormalAndCoplanarPoint(normal, this.point.set(...anchor));
    const hit = this.cast(clientX, clientY).ray.intersectPlane(this.plane, this.point);
    return hit ? hit.toArray() : anchor;
  }

  /** `anchor` moved along its line of sight; positive: away from the camera. */
  inDepth(anchor: Vec3, distance: number): Vec3 {
    const { camera } = this.rig;
    const { ahead, point } = this;
    camera.updateMatrixWorld();
    point.set(...anchor);
    if ('isPerspectiveCamera' in camera) ahead.copy(point).sub(camera.position).normalize();
    else camera.getWorldDirection(ahead);
    return point.addScaledVector(ahead, distance).toArray();
  }

  /** World length of a CSS pixel at `anchor`. */
  unitsPerPixel(anchor: Vec3): number {
    this.projection.look(this.rig.camera, this.canvas.clientHeight || 1);
    return this.projection.unitsPerPixel(anchor);
  }

  private cast(clientX: number, clientY: number): Raycaster {
    const { camera } = this.rig;
    const { left, top, width, height } = this.canvas.getBoundingClientRect();
    camera.updateMatrixWorld();
    this.pointer.set(((clientX - left) / width) * 2 - 1, 1 - ((clientY - top) / height) * 2);
    this.caster.setFromCamera(this.pointer, camera);
    return this.caster;
  }
}
