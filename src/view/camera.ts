/**
 * The camera: a perspective and an orthographic one that always show the same thing at the target, three.js's
 * OrbitControls for the hand, and short moves to where a command wants it.
 *
 *     left drag orbits, middle or right drag (or Shift and left) pans, the wheel dollies towards the pointer;
 *     one finger orbits, two pan and zoom
 *
 * A view is a target, a direction from it (azimuth from +z towards +x, height above the ground, radians) and a
 * distance; an orthographic camera of half height h counts as standing h / tan(fov/2) away.
 */
import { type Box3, MOUSE, OrthographicCamera, PerspectiveCamera, Sphere, Spherical, TOUCH, Vector3 } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import {
  distanceForHalfHeight,
  fitDistance,
  lookingFrom,
  orthographicDepth,
  perspectiveDepth,
} from '../math/framing.ts';
import type { Vec3 } from '../math/vec3.ts';
import { CameraTravel, newView, PressWatch, type View } from './camera-travel.ts';
import { Grid } from './grid.ts';

export type ViewDirection = 'front' | 'back' | 'left' | 'right' | 'top' | 'bottom';

/**
 * Azimuth and polar angle (from +y) that look from each side. A character's left is at +x when it faces +z. From above,
 * x is to the right and −z up; from below, x to the right and z up.
 */
export const VIEW_DIRECTIONS: Readonly<Record<ViewDirection, readonly [azimuth: number, polar: number]>> = {
  front: [0, Math.PI / 2],
  back: [Math.PI, Math.PI / 2],
  left: [Math.PI / 2, Math.PI / 2],
  right: [-Math.PI / 2, Math.PI / 2],
  top: [0, 0],
  bottom: [0, Math.PI],
};

const FOV_DEGREES = 32;
const TAN_HALF_FOV = Math.tan((FOV_DEGREES * Math.PI) / 360);
/** Room around what is framed, beside what a box from the joints has already. */
const MARGIN = 1.12;
/** What lies over the picture leaves this much of its height at least. */
const MIN_FREE = 0.6;

/** Where the camera looks and from where, as plain data; see above. */
export interface CameraView {
  readonly target: Vec3;
  /** Radians; the polar angle from +y. */
  readonly azimuth: number;
  readonly polar: number;
  readonly distance: number;
}

export class CameraRig {
  readonly target: Vector3;
  /** While a button or a finger is down, or the wheel turns. */
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

  /** @param changed called whenever there is something new to draw */
  constructor(
    element: HTMLElement,
    private readonly changed: () => void,
  ) {
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

  /** From the target; for an orthographic camera, of the perspective one that would show the same. */
  get distance(): number {
    if (this.shown === this.perspective) return this.shown.position.distanceTo(this.target);
    return distanceForHalfHeight(this.orthographic.top / this.orthographic.zoom, TAN_HALF_FOV);
  }

  /** Length at the target that a CSS pixel shows. */
  get unitsPerPixel(): number {
    return (2 * this.distance * TAN_HALF_FOV) / this.heightPx;
  }

  /** Which plane an orthographic camera looks straight at, if it does; the ground otherwise. */
  get plane(): 'ground' | 'front' | 'side' {
    if (this.shown === this.perspective) return 'ground';
    const m = this.shown.matrixWorld.elements;
    return Math.abs(m[10]) > 0.99999 ? 'front' : Math.abs(m[8]) > 0.99999 ? 'side' : 'ground';
  }

  /** Where the camera stands, or is going. */
  get view(): CameraView {
    const { target, azimuth, polar, distance } = this.goal();
    return { target: [target.x, target.y, target.z], azimuth, polar, distance };
  }

  /** Puts the camera there at once. */
  set view({ target, azimuth, polar, distance }: CameraView) {
    this.go({ target: new Vector3(...target), azimuth, polar, distance }, false);
  }

  /** CSS pixels. */
  resize(width: number, height: number): void {
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

  /** Changes the kind of picture, not what is in it. */
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
   * All of `box` in the picture, from where the camera looks now, or is about to.
   * @param coveredTop CSS pixels at the top that something else lies over
   * @param smoothly in a short move
   */
  frame(box: Box3, coveredTop: number, smoothly: boolean): void {
    if (box.isEmpty()) return;
    const to = this.goal();
    box.getCenter(to.target);
    box.getSize(this.size).multiplyScalar(0.5);
    const { axes } = this;
    lookingFrom(to.azimuth, to.polar, axes);
    const { x, y, z } = this.size;
    const covered = this.partOfHeight(coveredTop);
    to.distance = fitDistance(x, y, z, axes, TAN_HALF_FOV, this.aspect, MARGIN, covered);
    to.target.addScaledVector(this.size.set(axes[4], axes[5], axes[6]), covered * TAN_HALF_FOV * to.distance);
    this.go(to, smoothly);
  }

  /** What so many CSS pixels are of the picture's height; at most what framing can do without. */
  partOfHeight(pixels: number): number {
    return Math.min(pixels / this.heightPx, 1 - MIN_FREE);
  }

  /** A sphere of this radius around a point, in the picture. */
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

  /** About the target, at once; radians, above 0: as if the camera went to the right. */
  turn(azimuth: number): void {
    const to = this.goal();
    to.azimuth += azimuth;
    this.go(to, false);
  }

  /** The first look at something: three quarters from the front, at once. */
  lookFirst(box: Box3, coveredTop: number): void {
    this.travel.stop();
    this.place({ ...this.read(newView()), azimuth: 0.6, polar: 1.32 });
    this.frame(box, coveredTop, false);
  }

  /** Takes camera and target along, where what they follow went. */
  shift(by: Vector3): void {
    this.shown.position.add(by);
    this.target.add(by);
    this.travel.shift(by);
    this.shown.lookAt(this.target);
  }

  /** Takes the target to a point in a short move, and the camera along. */
  moveTo(at: Vector3): void {
    const to = this.goal();
    to.target.copy(at);
    this.go(to, true);
  }

  /** One step of a move that is under way. */
  tick(nowMs: number): void {
    const view = this.travel.at(nowMs);
    if (!view) return;
    this.place(view);
    if (this.isMoving) this.changed();
  }

  /** Near and far planes, and the limits of the hand, for content within `box`. Before each frame. */
  fitDepth(box: Box3, gridShown: boolean): void {
    const { distance, shown, perspective, orthographic, controls, sphere } = this;
    if (box.isEmpty()) sphere.set(this.target, distance);
    else box.getBoundingSphere(sphere);
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
    controls.maxDistance = shown === perspective ? content * 60 : Infinity;
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
    // Before whoever else takes the press, and before the controls: a drag is worked out from the view at its beginning.
    window.addEventListener(
      'pointerdown',
      (event) => {
        if (event.target !== element) return;
        // A second finger never clicks.
        if (event.isPrimary) this.press.press(event);
        else this.arrive();
      },
      { capture: true, signal },
    );
    element.addEventListener(
      'pointermove',
      (event) => {
        if (this.isMoving && this.press.isDrag(event)) this.arrive();
        // The controls' own notice of a change is for scenes of about a metre: a pan over a millimetre's character goes
        // unnoticed.
        if (this.handling) this.changed();
      },
      { capture: true, signal },
    );
    element.addEventListener('wheel', () => this.arrive(), { capture: true, passive: true, signal });
  }

  /** Ends a move that is under way where it was to end. */
  private arrive(): void {
    const { goal } = this.travel;
    if (goal) this.go(goal, false);
  }

  /** How far an orthographic camera stands from its target; any distance shows the same. */
  private get standOff(): number {
    return this.orthographic.position.distanceTo(this.target);
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

  /** Where the camera is going, or is. */
  private goal(): View {
    const { goal } = this.travel;
    return goal ? { ...goal, target: goal.target.clone() } : this.read(newView());
  }

  private go(to: View, smoothly: boolean): void {
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
