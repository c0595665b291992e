/**
 * Views of which many are on one page, where browsers give only a few contexts: all draw with one renderer, each into a
 * canvas of its own. The renderer's canvas is as large as the largest of them; a view draws into its lower left corner.
 * The last view that goes gives the context back.
 */
import type { WebGLRenderer } from 'three';
import { newRenderer, type Surface } from './screen.ts';
import { View, type ViewEvents } from './view.ts';

interface Shared {
  readonly renderer: WebGLRenderer;
  users: number;
  /** Pixels of its canvas. */
  width: number;
  height: number;
}

let shared: Shared | undefined;

/** A canvas that shows what the shared renderer draws for it. */
class SharedSurface implements Surface {
  readonly canvas = document.createElement('canvas');
  readonly renderer: WebGLRenderer;
  private readonly pen = this.canvas.getContext('2d');
  private readonly shared: Shared;

  /** @throws Error if the browser has no WebGL2 */
  constructor() {
    shared ??= { renderer: newRenderer(), users: 0, width: 0, height: 0 };
    this.shared = shared;
    this.renderer = shared.renderer;
    shared.users++;
  }

  resize(width: number, height: number, ratio: number): void {
    this.canvas.width = Math.floor(width * ratio);
    this.canvas.height = Math.floor(height * ratio);
  }

  begin(): void {
    const { renderer, shared, canvas } = this;
    const { width, height } = canvas;
    if (width > shared.width || height > shared.height) {
      shared.width = Math.max(width, shared.width);
      shared.height = Math.max(height, shared.height);
      renderer.setDrawingBufferSize(shared.width, shared.height, 1);
    }
    renderer.setViewport(0, 0, width, height);
    renderer.setScissor(0, 0, width, height);
    renderer.setScissorTest(true);
  }

  end(): void {
    const { pen, renderer, shared, canvas } = this;
    const { width, height } = canvas;
    if (!pen) return;
    // Where nothing was drawn, the last picture would stay.
    pen.clearRect(0, 0, width, height);
    pen.drawImage(renderer.domElement, 0, shared.height - height, width, height, 0, 0, width, height);
  }

  dispose(): void {
    const { renderer } = this;
    if (--this.shared.users > 0) return;
    shared = undefined;
    renderer.dispose();
    renderer.forceContextLoss();
  }
}

export class SharedView extends View {
  /** Arguments as of `View`. @throws Error if the browser has no WebGL2 */
  constructor(container: HTMLElement, inFrame: (draw: (nowMs: number) => void) => () => void, events: ViewEvents = {}) {
    super(container, inFrame, events, new SharedSurface());
  }

  /** Without it the page shows around the characters. */
  setBackground(isDrawn: boolean): void {
    this.shown.stage.setBackground(isDrawn);
    this.requestRender();
  }

  /** While nobody sees it, gives back the shadow map: the largest thing that a small picture needs. */
  rest(): void {
    const { stage } = this.shown;
    stage.key.shadow.dispose();
    stage.moveCasters();
  }
}
