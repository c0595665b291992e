/**
 * Between points of the page and points of the scene, for what is done by dragging.
 *
 *     client   CSS pixels of the page, as pointer events have them
 *     world    the scene: y up, where characters stand by their placements
 */
import { Plane, Raycaster, Vector2, Vector3 } from 'three';
import type { Vec3 } from '../math/vec3.ts';
import type { CameraRig } from './camera.ts';

export interface Ray {
  readonly origin: Vec3;
  /** Of length 1. */
  readonly direction: Vec3;
}

/** A point of the page, and how far from the camera it is that is seen there. */
export interface OnScreen {
  readonly x: number;
  readonly y: number;
  /** Along the camera's line of sight, in units of the world; not in front of a perspective camera: 0 or less. */
  readonly depth: number;
}

export class Eye {
  private readonly caster = new Raycaster();
  private readonly pointer = new Vector2();
  private readonly point = new Vector3();
  private readonly ahead = new Vector3();
  private readonly plane = new Plane();

  constructor(
    private readonly canvas: HTMLElement,
    private readonly rig: CameraRig,
  ) {}

  /** Where on the page a point of the world is. */
  toScreen(world: Vec3): OnScreen {
    const { point, ahead } = this;
    const { camera } = this.rig;
    camera.updateMatrixWorld();
    const depth = camera.getWorldDirection(ahead).dot(point.set(...world).sub(camera.position));
    point.set(...world).project(camera);
    const { left, top, width, height } = this.canvas.getBoundingClientRect();
    return { x: left + ((point.x + 1) / 2) * width, y: top + ((1 - point.y) / 2) * height, depth };
  }

  /** What lies under a point of the page, from near to far. */
  rayAt(clientX: number, clientY: number): Ray {
    const { ray } = this.cast(clientX, clientY);
    return { origin: ray.origin.toArray(), direction: ray.direction.toArray() };
  }

  /** The point under a point of the page in the plane that faces the camera and goes through `anchor`. */
  inPlaneOf(anchor: Vec3, clientX: number, clientY: number): Vec3 {
    const { camera } = this.rig;
    camera.updateMatrixWorld();
    const normal = camera.getWorldDirection(this.ahead);
    this.plane.setFromNormalAndCoplanarPoint(normal, this.point.set(...anchor));
    const hit = this.cast(clientX, clientY).ray.intersectPlane(this.plane, this.point);
    return hit ? hit.toArray() : anchor;
  }

  /** `anchor` moved along the line of sight through it; above 0: away from the camera. */
  inDepth(anchor: Vec3, distance: number): Vec3 {
    const { camera } = this.rig;
    const { ahead, point } = this;
    camera.updateMatrixWorld();
    point.set(...anchor);
    if ('isPerspectiveCamera' in camera) ahead.copy(point).sub(camera.position).normalize();
    else camera.getWorldDirection(ahead);
    return point.addScaledVector(ahead, distance).toArray();
  }

  /** Length in the world, at `anchor`, that a CSS pixel shows. */
  unitsPerPixel(anchor: Vec3): number {
    const { camera } = this.rig;
    const height = this.canvas.clientHeight || 1;
    if ('isOrthographicCamera' in camera) return (camera.top - camera.bottom) / camera.zoom / height;
    const { depth } = this.toScreen(anchor);
    return (2 * Math.max(depth, camera.near) * Math.tan((camera.fov * Math.PI) / 360)) / height;
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
