/**
 * The gizmo of a joint: its handles, drawn over the scene.
 *
 * Not three.js's TransformControls: it rotates about the axes of one object, while each of a joint's DOFs has its own
 * axis, so it would take one (of some fifty meshes) per DOF, each on a proxy. Its rings seen face on rotate by pointer
 * motion along one line, so that the pointer doesn't stay on the spot it grabbed. And it shows neither limits nor the
 * swept angle. Its conventions are kept: red, green and blue rings, arrows and boxes of constant size on screen, the
 * far half of rings faint, an outer ring for the view axis.
 *
 * Drawn on a 2D canvas, as labels are: it is always on top anyway, its lines are antialiased, and it isn't in saved
 * pictures of the scene. The canvas is only as large as the gizmo.
 */
import { Group, type OrthographicCamera, type PerspectiveCamera } from 'three';
import type { HandleId, JointHandles } from '../../evaluate/handles/joint-handles.ts';
import { CameraProjection } from '../camera-projection.ts';
import type { Overlay } from '../overlay.ts';
import type { StageTheme } from '../theme.ts';
import type { GizmoState } from './gizmo-look.ts';
import { GizmoPen } from './gizmo-pen.ts';
import { handleAt, type Layout, layOut, RING_PIXELS } from './shapes.ts';

/** CSS pixels: side of the canvas. */
const SIDE = Math.ceil(2 * 1.5 * RING_PIXELS);
const MAX_PIXELS_PER_PIXEL = 2;

export interface GizmoSource {
  /**
   * The handles; asked before each frame, and the same object if nothing about them has changed. Undefined: nothing is
   * drawn.
   */
  handles(): JointHandles | undefined;
  state(): GizmoState;
}

export class JointGizmo implements Overlay {
  /** Empty: the gizmo isn't in the scene. */
  readonly object = new Group();
  private readonly canvas = document.createElement('canvas');
  private readonly pen: GizmoPen | undefined;
  private readonly projection = new CameraProjection();
  /** What the layout was computed for. */
  private handles: JointHandles | undefined;
  private layout: Layout | undefined;
  private ratio = 0;

  /** @param container the element that contains the viewport */
  constructor(
    private readonly container: HTMLElement,
    private readonly source: GizmoSource,
  ) {
    this.canvas.className = 'joint-gizmo';
    this.canvas.setAttribute('aria-hidden', 'true');
    this.canvas.style.cssText = `position:absolute;left:0;top:0;width:${SIDE}px;height:${SIDE}px;pointer-events:none`;
    this.canvas.hidden = true;
    const context = this.canvas.getContext('2d');
    this.pen = context ? new GizmoPen(context, SIDE) : undefined;
    // Below the labels and the axis widget, which follow it.
    container.querySelector('canvas')?.after(this.canvas);
  }

  update(camera: PerspectiveCamera | OrthographicCamera, heightPx: number): void {
    const handles = this.source.handles();
    const isAnotherView = this.projection.look(camera, heightPx);
    if (isAnotherView || handles !== this.handles) {
      this.handles = handles;
      this.layout = handles && layOut(handles, this.projection);
    }
    const { layout, canvas, pen } = this;
    if (canvas.hidden !== (layout === undefined)) canvas.hidden = layout === undefined;
    if (!layout || !pen) return;
    const ratio = Math.min(window.devicePixelRatio || 1, MAX_PIXELS_PER_PIXEL);
    if (ratio !== this.ratio) {
      this.ratio = ratio;
      canvas.width = canvas.height = Math.round(SIDE * ratio);
    }
    // Aligned to device pixels, or its lines would be blurred.
    const snap = (at: number) => Math.round((at - SIDE / 2) * ratio) / ratio;
    const [left, top] = [snap(layout.pivot[0]), snap(layout.pivot[1])];
    canvas.style.transform = `translate(${left}px, ${top}px)`;
    pen.draw(layout, this.source.state(), left, top, ratio);
  }

  /** The handle under a point of the page, as last drawn. */
  at(clientX: number, clientY: number, slack = 0): HandleId | undefined {
    if (!this.layout) return undefined;
    const { left, top } = this.container.getBoundingClientRect();
    return handleAt(this.layout, clientX - left, clientY - top, slack);
  }

  /** Radius of the rings as last drawn, CSS pixels. */
  get radius(): number {
    return this.layout?.radius ?? RING_PIXELS;
  }

  setTheme(theme: StageTheme): void {
    this.pen?.setTheme(theme);
  }

  dispose(): void {
    this.canvas.remove();
  }
}
