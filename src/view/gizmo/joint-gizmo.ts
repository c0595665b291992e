/**
 * The gizmo of a joint: its handles, drawn over the scene.
 *
 * Not three.js's TransformControls: it rotates about the axes of one object, while each of a joint's DOFs has its own
 * axis, so it would take one (of some fifty meshes) per DOF, each on a proxy. Its rings seen face on rotate by pointer
 * motion along one line, so that the pointer doesn't stay on the spot it grabbed. And it shows neither limits nor the
 * swept angle. Its conventions are kept: red, green and blue rings, arrows and boxes, the far half of rings dashed,
 * an outer ring for the view axis. Unlike its handles, these have the size of the joint on screen, within bounds.
 *
 * Drawn on a 2D canvas, as labels are: it is always on top anyway, its lines are antialiased, and it isn't in saved
 * pictures of the scene. The canvas is only as large as the gizmo.
 */
import { Group, type OrthographicCamera, type PerspectiveCamera } from 'three';
import type { JointHandles } from '../../evaluate/handles/joint-handles.ts';
import { CameraProjection } from '../camera/camera-projection.ts';
import type { Overlay, ScreenBox } from '../overlay.ts';
import type { StageTheme } from '../theme.ts';
import type { GizmoState } from './gizmo-look.ts';
import { GizmoPen } from './gizmo-pen.ts';
import { type HandleHit, handleAt } from './handle-at.ts';
import { type Layout, layOut, ringRadius } from './shapes.ts';

/** Side of the canvas as a part of the rings' radius. */
const SIDE_PART = 3;
/** The canvas grows in steps, so that a dolly doesn't allocate one a frame. CSS pixels. */
const SIDE_STEP = 48;
const MAX_PIXELS_PER_PIXEL = 2;
/** Hit tolerance around the pivot, CSS pixels. */
const PIVOT_REACH = 7;

export interface GizmoSource {
  /**
   * The handles; asked before each frame, and the same object if nothing about them has changed. Undefined: nothing is
   * drawn.
   */
  handles(): JointHandles | undefined;
  state(): GizmoState;
  /** Factor of the gizmo's size. */
  scale(): number;
  /**
   * Each frame, with the gizmo as drawn; undefined: it isn't. Returns what else of it is over the viewport.
   * @param width of the viewport, CSS pixels
   */
  drawn?(layout: Layout | undefined, width: number, height: number): ScreenBox | undefined;
}

export class JointGizmo implements Overlay {
  /** Empty: the gizmo isn't in the scene. */
  readonly object = new Group();
  private readonly canvas = document.createElement('canvas');
  private readonly pen: GizmoPen | undefined;
  private readonly projection = new CameraProjection();
  /** What the layout was computed for. */
  private handles: JointHandles | undefined;
  private scale = 0;
  private layout: Layout | undefined;
  private ratio = 0;
  /** CSS pixels. */
  private side = 0;
  /** Radius of the rings. */
  private radius = 1;
  /** Whether a handle was being dragged in the last frame. */
  private isDragged = false;
  covers: readonly ScreenBox[] = [];

  /**
   * @param container the element that contains the viewport
   * @param className of its canvas
   */
  constructor(
    private readonly container: HTMLElement,
    private readonly source: GizmoSource,
    className = 'joint-gizmo',
  ) {
    this.canvas.className = className;
    this.canvas.setAttribute('aria-hidden', 'true');
    this.canvas.style.cssText = `position:absolute;left:0;top:0;pointer-events:none`;
    this.canvas.hidden = true;
    const context = this.canvas.getContext('2d');
    this.pen = context ? new GizmoPen(context) : undefined;
    // Below the labels and the axis widget, which follow it.
    container.querySelector('canvas')?.after(this.canvas);
  }

  update(camera: PerspectiveCamera | OrthographicCamera, heightPx: number): void {
    const { canvas, pen, source } = this;
    const handles = source.handles();
    const state = source.state();
    const scale = source.scale();
    const isAnotherView = this.projection.look(camera, heightPx);
    const isDragged = state.dragged !== undefined;
    if (isAnotherView || handles !== this.handles || scale !== this.scale || isDragged !== this.isDragged) {
      this.handles = handles;
      this.scale = scale;
      // Constant during a drag, which may scale the joint or move it in depth.
      if (handles && !(isDragged && this.isDragged)) this.radius = this.radiusOf(handles);
      this.isDragged = isDragged;
      this.layout = handles && layOut(handles, this.projection, this.radius);
    }
    const { layout } = this;
    this.covers = this.coveredBy(layout);
    if (canvas.hidden !== (layout === undefined)) canvas.hidden = layout === undefined;
    if (!layout || !pen) return;
    this.resize(layout.radius);
    const { side, ratio } = this;
    // Aligned to device pixels, or its lines would be blurred.
    const snap = (at: number) => Math.round((at - side / 2) * ratio) / ratio;
    const [left, top] = [snap(layout.pivot[0]), snap(layout.pivot[1])];
    canvas.style.transform = `translate(${left}px, ${top}px)`;
    pen.draw(layout, state, left, top, side, ratio);
  }

  /** The handle under a point of the page, as last drawn. */
  at(clientX: number, clientY: number, slack = 0): HandleHit | undefined {
    if (!this.layout) return undefined;
    const { left, top } = this.container.getBoundingClientRect();
    return handleAt(this.layout, clientX - left, clientY - top, slack, this.source.state().active);
  }

  /** Whether a point of the page is on the dot at the joint's pivot. @param slack extra tolerance, CSS pixels */
  isOnPivot(clientX: number, clientY: number, slack = 0): boolean {
    if (!this.layout) return false;
    const { left, top } = this.container.getBoundingClientRect();
    const [x, y] = this.layout.pivot;
    return Math.hypot(clientX - left - x, clientY - top - y) <= PIVOT_REACH + slack;
  }

  /** Radius of a joint's rings, CSS pixels. */
  radiusOf(handles: JointHandles): number {
    return ringRadius(handles, this.projection, this.source.scale());
  }

  setTheme(theme: StageTheme): void {
    this.pen?.setTheme(theme);
  }

  dispose(): void {
    this.canvas.remove();
  }

  private coveredBy(layout: Layout | undefined): readonly ScreenBox[] {
    const { width, height } = this.projection;
    const beside = this.source.drawn?.(layout, width, height);
    if (!layout) return [];
    const { pivot, outer } = layout;
    const own: ScreenBox = [pivot[0] - outer, pivot[1] - outer, pivot[0] + outer, pivot[1] + outer];
    return beside ? [own, beside] : [own];
  }

  private resize(radius: number): void {
    const { canvas } = this;
    const ratio = Math.min(window.devicePixelRatio || 1, MAX_PIXELS_PER_PIXEL);
    const side = SIDE_STEP * Math.ceil((SIDE_PART * radius) / SIDE_STEP);
    if (ratio === this.ratio && side === this.side) return;
    this.ratio = ratio;
    this.side = side;
    canvas.width = canvas.height = Math.round(side * ratio);
    canvas.style.width = canvas.style.height = `${side}px`;
  }
}
