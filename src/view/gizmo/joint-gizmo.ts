/**
 * The gizmo of a joint: what can be taken hold of, drawn over the picture.
 *
 * three.js's own (TransformControls) lacks what a joint needs. It turns about the axes of one object, and a joint's DOFs
 * turn about axes of their own, each gimbal ring by those applied after it: there would have to be one for each DOF, on a
 * proxy whose x is that axis, of some fifty meshes. A ring of it that is seen face on turns by the pointer's way along
 * one line, so that it stands still under half of the hands that take it, and the pointer leaves the place that it took
 * hold of. Nothing can be said of limits, or of what a drag has swept. Its manners are kept: red, green and blue rings,
 * arrows and boxes of the same size at any distance, the far half of a ring out of the way, a ring around them all for
 * the line of sight.
 *
 * Drawn on a flat canvas as labels are: it is over everything anyway, its lines are smooth, and no picture that is taken
 * of the scene has it in it. The canvas is as large as the gizmo and no larger.
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
   * What there is to take hold of now; asked before each picture, and the same as before where nothing of it has changed.
   * Undefined: nothing is drawn.
   */
  handles(): JointHandles | undefined;
  state(): GizmoState;
}

export class JointGizmo implements Overlay {
  /** Nothing of it is in the scene. */
  readonly object = new Group();
  private readonly canvas = document.createElement('canvas');
  private readonly pen: GizmoPen | undefined;
  private readonly projection = new CameraProjection();
  /** What is laid out. */
  private handles: JointHandles | undefined;
  private layout: Layout | undefined;
  private ratio = 0;

  /** @param container the element that the viewport fills */
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
    // Beneath what else stands over the picture: its labels and axes come after it.
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
    // On whole pixels of the screen, or its lines would be blurred.
    const snap = (at: number) => Math.round((at - SIDE / 2) * ratio) / ratio;
    const [left, top] = [snap(layout.pivot[0]), snap(layout.pivot[1])];
    canvas.style.transform = `translate(${left}px, ${top}px)`;
    pen.draw(layout, this.source.state(), left, top, ratio);
  }

  /** What is under a point of the page, as last drawn. */
  at(clientX: number, clientY: number, slack = 0): HandleId | undefined {
    if (!this.layout) return undefined;
    const { left, top } = this.container.getBoundingClientRect();
    return handleAt(this.layout, clientX - left, clientY - top, slack);
  }

  /** Of the rings as last drawn, CSS pixels. */
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
