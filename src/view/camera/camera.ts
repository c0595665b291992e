/**
 * The camera: a perspective and an orthographic one that always show the same thing at the target, three.js's
 * OrbitControls for input, and short animated moves for commands.
 *
 *     left drag orbits, middle or right drag (or Shift and left) pans, the wheel dollies towards the pointer;
 *     one finger orbits, two pan and zoom
 *
 * A view is a target, a direction from it (azimuth from +z towards +x, height above the ground, radians) and a
 * distance; for an orthographic camera of half height h the distance is h / tan(fov/2).
 */
import { Box3, MOUSE, OrthographicCamera, PerspectiveCamera, Sphere, Spherical, TOUCH, Vector3 } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { distanceForHalfHeight, fitEye, lookingFrom, orthographicDepth, perspectiveDepth } from '../../math/framing.ts';
import type { Vec3 } from '../../math/vec3.ts';
import { Grid } from '../scene/grid.ts';
import { CameraTravel, FARTHEST, limitView, newView, PressWatch, type View } from './camera-travel.ts';
import { keepToOneKindOfPointer } from './one-kind-of-pointer.ts';

export type ViewDirection = 'front' | 'back' | 'left' | 'right' | 'top' | 'bottom';

/**
 * Azimuth and polar angle (from +y) of each view. A character's left is at +x when it faces +z. From above, x is to the
 * right and −z up; from below, x to the right and z up.
 */
const VIEW_DIRECTIONS: Readonly<Record<ViewDirection, readonly [azimuth: number, polar: number]>> = {
  front: [0, Math.PI / 2],
  back: [Math.PI, Math.PI / 2],
  left: [Math.PI / 2, Math.PI / 2],
  right: [-Math.PI / 2, Math.PI / 2],
  top: [0, 0],
  bottom: [0, Math.PI],
};

const FOV_DEGREES = 32;
const TAN_HALF_FOV = Math.tan((FOV_DEGREES * Math.PI) / 360);
/** Margin around what is framed, on top of the box computed from joints. */
const MARGIN = 1.08;
/** At least this part of the height is assumed to be free of overlays. */
const MIN_FREE = 0.6;

const UP = new Vector3(0, 1, 0);

/** Camera target, direction and distance as plain data; see above. */
export interface CameraView {
  readonly target: Vec3;
  /** Radians; the polar angle from +y. */
  readonly azimuth: number;
  readonly polar: number;
  readonly distance: number;
}

export class CameraRig {
  readonly target: Vector3;
  /** While a button or finger is down, or the wheel turns. */
  handling = false;
  private readonly perspective = new PerspectiveCamera(FOV_DEGREES, 1, 0.01, 100);
  private readonly orthographic = new OrthographicCamera();
  private readonly controls: OrbitControls;
  private shown: PerspectiveCamera | OrthographicCamera = this.perspective;
  private aspect = 1;
  private heightPx = 1;
  private readonly travel = new CameraTravel();
  private readonly press = new PressWatch();
  private readonly listening = new AbortController();
  private readonly spherical = new Spherical();
  private readonly size = new Vector3();
  private readonly axes = new Float64Array(12);
  private readonly sphere = new Sphere();
  private readonly seen = newView();
  /** The last view that could be drawn. */
  private readonly sane = newView();
  private readonly drawable = new Box3();

  /** @param changed called whenever a redraw is needed */
  constructor(
    element: HTMLElement,
    private readonly changed: () => void,
  ) {
    keepToOneKindOfPointer(element, this.listening.signal);
    this.controls = new OrbitControls(this.perspective, element);
    const { controls } = this;
    this.target = controls.target;
    controls.enableDamping = false;
    controls.zoomToCursor = true;
    controls.screenSpacePanning = true;
    controls.rotateSpeed = 0.9;
    controls.mouseButtons = { LEFT: MOUSE.ROTATE, MIDDLE: MOUSE.PAN, RIGHT: MOUSE.PAN };
    controls.touches = { ONE: TOUCH.ROTATE, TWO: TOUCH.DOLLY_PAN };
    controls.addEventListener('change', changed);
    controls.addEventListener('start', () => {
      this.handling = true;
    });
    controls.addEventListener('end', () => {
      this.handling = false;
      changed();
    });
    this.listen(element);
    // Three quarters from the front, a little above.
    this.place({ target: new Vector3(0, 0.8, 0), azimuth: 0.6, polar: 1.3, distance: 5 });
  }

  get camera(): PerspectiveCamera | OrthographicCamera {
    return this.shown;
  }

  get isMoving(): boolean {
    return this.travel.goal !== undefined;
  }

  /** Distance to the target; for an orthographic camera, that of the equivalent perspective one. */
  get distance(): number {
    if (this.shown === this.perspective) return this.shown.position.distanceTo(this.target);
    return distanceForHalfHeight(this.orthographic.top / this.orthographic.zoom, TAN_HALF_FOV);
  }

  /** World length of a CSS pixel at the target. */
  get unitsPerPixel(): number {
    return (2 * this.distance * TAN_HALF_FOV) / this.heightPx;
  }

  /** The plane that an orthographic camera faces exactly, if any; otherwise the ground. */
  get plane(): 'ground' | 'front' | 'side' {
    if (this.shown === this.perspective) return 'ground';
    const m = this.shown.matrixWorld.elements;
    return Math.abs(m[10]) > 0.99999 ? 'front' : Math.abs(m[8]) > 0.99999 ? 'side' : 'ground';
  }

  /** The current view, or the one being moved to. */
  get view(): CameraView {
    const { target, azimuth, polar, distance } = this.goal();
    return { target: [target.x, target.y, target.z], azimuth, polar, distance };
  }

  /** Sets the view at once. */
  set view({ target, azimuth, polar, distance }: CameraView) {
    this.go({ target: new Vector3(...target), azimuth, polar, distance }, false);
  }

  /** CSS pixels. */
  resize(width: number, height: number): void {
    // A viewport that panels leave no room for.
    if (!(width > 0 && height > 0)) return;
    const { perspective, orthographic } = this;
    this.aspect = width / height;
    this.heightPx = height;
    perspective.aspect = this.aspect;
    perspective.updateProjectionMatrix();
    orthographic.right = orthographic.top * this.aspect;
    orthographic.left = -orthographic.right;
    orthographic.updateProjectionMatrix();
    this.changed();
  }

  /** Switches the projection and keeps what is in view. */
  setOrthographic(on: boolean): void {
    const next = on ? this.orthographic : this.perspective;
    if (next === this.shown) return;
    const view = this.read(newView());
    this.shown = next;
    this.controls.object = next;
    this.place(view);
    this.changed();
  }

  /**
   * Frames boxes, from the current direction or the one being moved to.
   *
   * @param coveredTop CSS pixels at the top covered by overlays
   * @param smoothly in a short animated move
   */
  frame(boxes: readonly Box3[], coveredTop: number, smoothly: boolean): void {
    const { min, max } = this.drawable;
    const corners: number[] = [];
    for (const box of boxes) if (this.limitBox(box)) corners.push(min.x, min.y, min.z, max.x, max.y, max.z);
    if (corners.length === 0) return;
    const to = this.goal();
    const { axes } = this;
    lookingFrom(to.azimuth, to.polar, axes);
    const covered = this.partOfHeight(coveredTop);
    const { x, y, z, middle } = fitEye(corners, axes, TAN_HALF_FOV, this.aspect, MARGIN, covered);
    to.distance = z - middle;
    to.target.set(
      axes[0] * x + axes[4] * y + axes[8] * middle,
      axes[1] * x + axes[5] * y + axes[9] * middle,
      axes[2] * x + axes[6] * y + axes[10] * middle,
    );
    this.go(to, smoothly);
  }

  /** That many CSS pixels as a fraction of the height, limited so that framing keeps enough room. */
  partOfHeight(pixels: number): number {
    return Math.min(pixels / this.heightPx, 1 - MIN_FREE);
  }

  /** Frames a sphere. */
  frameSphere(centre: Vector3, radius: number, smoothly: boolean): void {
    const to = this.goal();
    to.target.copy(centre);
    to.distance = (radius * MARGIN) / (TAN_HALF_FOV * Math.min(1, this.aspect));
    this.go(to, smoothly);
  }

  lookFrom(side: ViewDirection): void {
    const to = this.goal();
    [to.azimuth, to.polar] = VIEW_DIRECTIONS[side];
    this.go(to, true);
  }

  /**
   * Orbits, at once; radians, positive moves the camera to the right and down.
   *
   * @param about the vertical axis through this point keeps its place in the picture; default the target
   */
  turn(azimuth: number, polar = 0, about?: Vector3): void {
    const to = this.goal();
    to.azimuth += azimuth;
    to.polar = Math.min(Math.PI, Math.max(0, to.polar + polar));
    if (about) to.target.sub(about).applyAxisAngle(UP, azimuth).add(about);
    this.go(to, false);
  }

  /**
   * The default view of something: three-quarter front, at once.
   *
   * @param facing the direction that its front faces, radians from +z towards +x
   */
  lookFirst(boxes: readonly Box3[], coveredTop: number, facing = 0): void {
    this.travel.stop();
    this.place({ ...this.read(newView()), azimuth: 0.62 + facing, polar: 1.37 });
    this.frame(boxes, coveredTop, false);
  }

  /** Moves camera and target by the motion of what they follow. */
  shift(by: Vector3): void {
    // A broken frame throws it out of reach.
    if (!(by.length() < FARTHEST) || !(this.size.copy(this.target).add(by).length() < FARTHEST)) return;
    this.shown.position.add(by);
    this.target.add(by);
    this.travel.shift(by);
    this.shown.lookAt(this.target);
  }

  /** Moves the target to a point, and the camera with it, in a short animated move. */
  moveTo(at: Vector3): void {
    const to = this.goal();
    to.target.copy(at);
    this.go(to, true);
  }

  /** Advances a running move. */
  tick(nowMs: number): void {
    const view = this.travel.at(nowMs);
    if (!view) return;
    this.place(view);
    if (this.isMoving) this.changed();
  }

  /** Near and far planes, and dolly limits, for content within `box`. Call before each frame. */
  fitDepth(box: Box3, gridShown: boolean): void {
    this.keepSane();
    const { distance, shown, perspective, orthographic, controls, sphere } = this;
    if (this.limitBox(box)) this.drawable.getBoundingSphere(sphere);
    else sphere.set(this.target, distance);
    // A point at the target has neither size nor distance.
    sphere.radius ||= distance;
    const content = sphere.center.distanceTo(this.target) + sphere.radius;
    const reach = Math.max(content * 1.02, gridShown ? Grid.reach(distance) : 0, distance);
    const depth =
      shown === perspective
        ? perspectiveDepth(distance, reach)
        : orthographicDepth(this.standOff, reach + this.standOff);
    if (shown.near !== depth.near || shown.far !== depth.far) {
      shown.near = depth.near;
      shown.far = depth.far;
      shown.updateProjectionMatrix();
    }
    controls.minDistance = shown === perspective ? sphere.radius * 1e-3 : 0;
    // Not nearer than it is: a long path is framed from far away, and input would jump.
    controls.maxDistance = shown === perspective ? Math.max(content * 60, distance) : Infinity;
    controls.minZoom = (orthographic.top / (content * 30)) * 1e-1;
    controls.maxZoom = (orthographic.top / sphere.radius) * 1e3;
    shown.updateMatrixWorld();
  }

  dispose(): void {
    this.listening.abort();
    this.controls.dispose();
  }

  private listen(element: HTMLElement): void {
    const { signal } = this.listening;
    // Before other listeners and the controls: a drag is computed from the view at its start.
    window.addEventListener(
      'pointerdown',
      (event) => {
        // Of a canvas in a shadow root, the target would be its host.
        if (event.composedPath()[0] !== element) return;
        // A second finger is never a click.
        if (event.isPrimary) this.press.press(event);
        else this.arrive();
      },
      { capture: true, signal },
    );
    element.addEventListener(
      'pointermove',
      (event) => {
        if (this.isMoving && this.press.isDrag(event)) this.arrive();
        // OrbitControls' change event assumes scenes of about a metre: it misses a pan on a character a millimetre
        // tall.
        if (this.handling) this.changed();
      },
      { capture: true, signal },
    );
    element.addEventListener('wheel', () => this.arrive(), { capture: true, passive: true, signal });
  }

  /** Jumps to the end of a running move. */
  private arrive(): void {
    const { goal } = this.travel;
    if (goal) this.go(goal, false);
  }

  /** Distance of the orthographic camera to its target; it doesn't affect the image. */
  private get standOff(): number {
    return this.orthographic.position.distanceTo(this.target);
  }

  /**
   * Goes back to the last view that could be drawn if input has led to none: the controls divide by the size of an
   * element that may have none.
   */
  private keepSane(): void {
    const { seen, sane } = this;
    const { target, azimuth, polar, distance } = this.read(seen);
    if (!(distance > 0 && limitView(seen))) {
      this.place(sane);
      return;
    }
    sane.target.copy(target);
    sane.azimuth = azimuth;
    sane.polar = polar;
    sane.distance = distance;
  }

  private read(out: View): View {
    const { spherical, shown } = this;
    spherical.setFromVector3(this.size.copy(shown.position).sub(this.target));
    out.target.copy(this.target);
    out.azimuth = spherical.theta;
    out.polar = spherical.phi;
    out.distance = this.distance;
    return out;
  }

  /** The view being moved to, or the current one. */
  private goal(): View {
    const { goal } = this.travel;
    return goal ? { ...goal, target: goal.target.clone() } : this.read(newView());
  }

  /** Copies a box to `drawable`, within what can be drawn. False if it is empty or has no numbers. */
  private limitBox(box: Box3): boolean {
    const { drawable } = this;
    if (box.isEmpty() || !isFiniteVector(box.min) || !isFiniteVector(box.max)) return false;
    drawable.copy(box);
    drawable.min.clampScalar(-FARTHEST, FARTHEST);
    drawable.max.clampScalar(-FARTHEST, FARTHEST);
    return true;
  }

  private go(to: View, smoothly: boolean): void {
    if (!limitView(to)) return;
    const still = typeof matchMedia === 'function' && matchMedia('(prefers-reduced-motion: reduce)').matches;
    if (smoothly && !still) {
      this.travel.begin(this.read(newView()), to);
    } else {
      this.travel.stop();
      this.place(to);
    }
    this.changed();
  }

  private place({ target, azimuth, polar, distance }: View): void {
    const { spherical, shown, orthographic } = this;
    this.target.copy(target);
    spherical.set(distance, polar, azimuth).makeSafe();
    shown.position.setFromSpherical(spherical).add(target);
    shown.lookAt(target);
    if (shown === orthographic) {
      orthographic.zoom = 1;
      orthographic.top = distance * TAN_HALF_FOV;
      orthographic.bottom = -orthographic.top;
      orthographic.right = orthographic.top * this.aspect;
      orthographic.left = -orthographic.right;
    }
    shown.updateProjectionMatrix();
    shown.updateMatrixWorld();
  }
}

function isFiniteVector({ x, y, z }: Vector3): boolean {
  return Number.isFinite(x) && Number.isFinite(y) && Number.isFinite(z);
}
