/** Measures frames from inside a page. */

/** Milliseconds, one number a frame. */
export interface WatchedFrames {
  /** From the end of the frame before to its own, which is when its pixels are there. */
  readonly whole: readonly number[];
  /** What the page's own callbacks of `requestAnimationFrame` took. */
  readonly script: readonly number[];
}

declare global {
  interface Window {
    frameWatch: {
      /** The largest that WebGL draws on. */
      canvas(): HTMLCanvasElement | OffscreenCanvas;
      /** Watches for so long, and for so many frames at least. */
      measure(seconds: number, minFrames: number): Promise<WatchedFrames>;
    };
  }
}

/**
 * Runs in the page before any of its own scripts; refers to nothing outside itself.
 *
 * Frames are sent to the GPU and return at once. Reading a pixel waits until all that was drawn before is done; it is
 * done once in each frame, so that the time between two readings is that of a frame, wherever it is spent.
 */
export function watchFrames(): void {
  const nextFrame = window.requestAnimationFrame.bind(window);
  let script: number[] | undefined;
  let stamp = Number.NaN;
  window.requestAnimationFrame = (callback) =>
    nextFrame((now) => {
      const begun = performance.now();
      try {
        callback(now);
      } finally {
        if (script) {
          // All callbacks of a frame are called with the same time.
          if (now !== stamp) script.push(0);
          stamp = now;
          script[script.length - 1] += performance.now() - begun;
        }
      }
    });

  const contexts = new Set<WebGL2RenderingContext>();
  const { prototype } = HTMLCanvasElement;
  // One signature stands for the overloads.
  const getContext = prototype.getContext as (this: HTMLCanvasElement, ...given: unknown[]) => RenderingContext | null;
  prototype.getContext = function (this: HTMLCanvasElement, ...given: unknown[]) {
    const context = getContext.apply(this, given);
    if (context instanceof WebGL2RenderingContext) contexts.add(context);
    return context;
  } as typeof prototype.getContext;

  const areaOf = ({ canvas }: WebGL2RenderingContext) => canvas.width * canvas.height;
  const largest = () => {
    const shown = [...contexts].filter(({ canvas }) => canvas instanceof HTMLCanvasElement && canvas.isConnected);
    const [context] = shown.sort((a, b) => areaOf(b) - areaOf(a));
    if (!context) throw new Error('The page draws on no canvas with WebGL 2.');
    return context;
  };
  const pixel = new Uint8Array(4);

  window.frameWatch = {
    canvas: () => largest().canvas,
    measure(seconds, minFrames) {
      const gl = largest();
      const finish = () => {
        const bound = gl.getParameter(gl.READ_FRAMEBUFFER_BINDING);
        gl.bindFramebuffer(gl.READ_FRAMEBUFFER, null);
        gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
        gl.bindFramebuffer(gl.READ_FRAMEBUFFER, bound);
        return performance.now();
      };
      // What the page itself did wrong before is no failure to measure.
      gl.getError();
      const whole: number[] = [];
      const own: number[] = [];
      return new Promise((resolve, reject) => {
        let begun = 0;
        let last = 0;
        const frame = () => {
          const end = finish();
          whole.push(end - last);
          last = end;
          if (whole.length < minFrames || end < begun + 1000 * seconds) return void nextFrame(frame);
          script = undefined;
          const error = gl.getError();
          if (error === gl.NO_ERROR) resolve({ whole, script: own });
          else reject(new Error(`WebGL reports error ${error}: the pixel could not be read.`));
        };
        nextFrame(() => {
          begun = last = finish();
          script = own;
          nextFrame(frame);
        });
      });
    },
  };
}
