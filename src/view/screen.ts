/**
 * The canvas in the page with its renderer: as large as its container, at the screen's resolution, unless pictures of
 * another size are being drawn; and what becomes of it when the browser takes its WebGL context.
 */
import { type Camera, type Scene, SRGBColorSpace, WebGLRenderer } from 'three';
import { shaderError } from './scene/shader-error.ts';
import { LINE_RESOLUTION } from './scene/thick-lines.ts';

/** Of the last frame drawn. */
export interface FrameStats {
  readonly drawCalls: number;
  readonly triangles: number;
  /** On the GPU. */
  readonly geometries: number;
  readonly textures: number;
}

export interface ScreenEvents {
  /** CSS pixels, and pixels of the canvas for each. */
  resized(width: number, height: number, ratio: number): void;
  /** It has the size of its container again: a resized canvas is empty, and would flash if it isn't drawn at once. */
  fitted(): void;
  shaderFailed(error: unknown): void;
  contextLost(): void;
  contextRestored(): void;
}

/** Where a screen draws that has no context of its own. */
export interface Surface {
  readonly renderer: WebGLRenderer;
  /** Shows what was drawn. */
  readonly canvas: HTMLCanvasElement;
  /** CSS pixels, and pixels of the canvas for each. */
  resize(width: number, height: number, ratio: number): void;
  /** What the renderer draws between these is on the canvas. */
  begin(): void;
  end(): void;
  dispose(): void;
}

const MAX_PIXELS_PER_PIXEL = 2;

export class Screen {
  readonly canvas: HTMLCanvasElement;
  readonly renderer: WebGLRenderer;
  /** CSS pixels; 0 until the container has a size. */
  width = 0;
  height = 0;
  /** Pixels of the canvas for each of these. */
  ratio = 0;
  private isFixed = false;
  private readonly resizing: ResizeObserver;
  private readonly listening = new AbortController();

  /** @throws Error if the browser has no WebGL2 */
  constructor(
    private readonly container: HTMLElement,
    private readonly events: ScreenEvents,
    private readonly surface?: Surface,
  ) {
    this.renderer = surface?.renderer ?? newRenderer();
    const { renderer } = this;
    const { signal } = this.listening;
    const { domElement } = renderer;
    this.canvas = surface?.canvas ?? domElement;
    this.canvas.style.cssText =
      'display:block;position:absolute;inset:0;width:100%;height:100%;object-fit:contain;touch-action:none';
    renderer.outputColorSpace = SRGBColorSpace;
    // Counted over a whole frame, which has several passes.
    renderer.info.autoReset = false;
    renderer.debug.onShaderError = (gl, program, vertex, fragment) => {
      // Without a context nothing compiles, and all of it does once it is restored. The program is WebGL's: the types
      // name three.js's own class.
      if (!gl.isContextLost()) events.shaderFailed(shaderError(gl, program as WebGLProgram, [vertex, fragment]));
    };
    domElement.addEventListener('webglcontextlost', () => events.contextLost(), { signal });
    domElement.addEventListener('webglcontextrestored', () => events.contextRestored(), { signal });
    this.resizing = new ResizeObserver(() => this.fit());
    this.resizing.observe(container);
  }

  /** Whether there is anything to draw into: neither a size of 0 nor a lost context. */
  get canDraw(): boolean {
    return this.width > 0 && !this.isLost;
  }

  /** Whether the browser has taken the context. */
  get isLost(): boolean {
    return this.renderer.getContext().isContextLost();
  }

  get stats(): FrameStats {
    const { render, memory } = this.renderer.info;
    return { drawCalls: render.calls, triangles: render.triangles, ...memory };
  }

  /** Has the size of the container from now on: call once all that is told of its size is there. */
  fill(): void {
    this.isFixed = false;
    this.width = 0;
    this.fit();
  }

  /** Has this size until `fill`. CSS pixels, and pixels of the canvas for each. */
  fix(width: number, height: number, ratio: number): void {
    this.isFixed = true;
    this.resize(width, height, ratio);
  }

  /** @throws whatever three.js does */
  render(scene: Scene, camera: Camera): void {
    const { renderer, surface } = this;
    LINE_RESOLUTION.value.set(this.width, this.height);
    renderer.info.reset();
    surface?.begin();
    renderer.render(scene, camera);
    surface?.end();
  }

  dispose(): void {
    this.listening.abort();
    this.resizing.disconnect();
    (this.surface ?? this.renderer).dispose();
    this.canvas.remove();
  }

  /** Takes the size of its container, which may have changed since the last frame. */
  fit(): void {
    const { clientWidth: width, clientHeight: height } = this.container;
    if (width === 0 || height === 0 || this.isFixed) return;
    const ratio = Math.min(window.devicePixelRatio || 1, MAX_PIXELS_PER_PIXEL);
    if (width === this.width && height === this.height && ratio === this.ratio) return;
    this.resize(width, height, ratio);
    this.events.fitted();
  }

  private resize(width: number, height: number, ratio: number): void {
    this.width = width;
    this.height = height;
    this.ratio = ratio;
    if (this.surface) this.surface.resize(width, height, ratio);
    else this.renderer.setDrawingBufferSize(width, height, ratio);
    this.events.resized(width, height, ratio);
  }
}

/** @throws Error if the browser has no WebGL2 */
export function newRenderer(): WebGLRenderer {
  return new WebGLRenderer({ antialias: true, stencil: false, powerPreference: 'high-performance' });
}
