/** Pictures of what is shown, at another size than on screen. */

import type { Redraw } from '../redraw.ts';
import type { Screen } from '../screen.ts';
import type { ShownDocument, Surroundings } from '../shown-document.ts';
import type { CameraRig, CameraView } from './camera.ts';

/** What is drawn into a picture besides the characters, and its size in pixels. */
export interface ShotOptions extends Surroundings {
  readonly width: number;
  readonly height: number;
}

/** Pictures being drawn. */
export interface Shots {
  /** What a picture consists of, the lowest first. */
  readonly canvases: readonly HTMLCanvasElement[];
  /**
   * Draws characters at a time of the transport. What is on the canvases must be read before the task ends.
   *
   * @throws Error if the browser has lost the canvas
   */
  draw(timeSeconds: number): void;
  /** Shows everything as before. */
  end(): void;
}

/** What pictures are drawn by: `Viewport.shotParts`. */
export interface ShotParts {
  readonly screen: Screen;
  readonly shown: ShownDocument;
  readonly rig: CameraRig;
  readonly redraw: Redraw;
  /** Updates the matrices of everything drawn, and the camera that follows it. */
  update(): void;
}

/**
 * Begins to draw pictures in the current view, which keeps its height. Until `end`, characters and display must not
 * change.
 *
 * @throws Error if the graphics card can't draw at that size
 */
export function beginShots({ screen, shown, rig, redraw, update }: ShotParts, options: ShotOptions): Shots {
  const { canvas, renderer, height } = screen;
  const { timeSeconds } = shown;
  // The camera may not have followed yet to where characters are now: what it is put back to would leave them.
  update();
  const { view } = rig;
  const ratio = options.height / height;
  const end = () => {
    shown.surround();
    shown.seek(timeSeconds);
    update();
    // It may have followed a joint.
    if (!isSameView(rig.view, view)) rig.view = view;
    screen.fill();
  };
  shown.highlight(undefined);
  shown.surround(options);
  // Else rounding may lose a pixel.
  screen.fix((options.width + 0.01) / ratio, (options.height + 0.01) / ratio, ratio);
  const { drawingBufferWidth, drawingBufferHeight } = renderer.getContext();
  if (drawingBufferWidth !== options.width || drawingBufferHeight !== options.height) {
    end();
    throw new Error(
      `This graphics card can't draw ${options.width} × ${options.height} pixels. Choose a smaller size.`,
    );
  }
  return {
    canvases: options.hasTools ? [canvas, ...(shown.annotations ? [shown.annotations.labels.canvas] : [])] : [canvas],
    draw: (seconds) => {
      shown.seek(seconds);
      redraw.now(performance.now());
      if (screen.isLost) throw new Error('The browser has lost the canvas. Try again.');
    },
    end,
  };
}

function isSameView(a: CameraView, b: CameraView): boolean {
  const isSame = a.azimuth === b.azimuth && a.polar === b.polar && a.distance === b.distance;
  return isSame && a.target.every((x, i) => x === b.target[i]);
}
