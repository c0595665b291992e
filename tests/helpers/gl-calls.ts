/** What a page asks of WebGL in its frames. */
import type { Page } from 'playwright-core';

/** Of one frame. */
export interface FrameCalls {
  readonly calls: number;
  readonly draws: number;
  /** Of buffers and textures. */
  readonly uploads: number;
  readonly uploadedBytes: number;
}

type Writable = { -readonly [K in keyof FrameCalls]: FrameCalls[K] };

declare global {
  interface Window {
    glFrames?: Writable[];
  }
}

/** Runs in the page, before its scripts: counts what each frame does that calls WebGL at all. */
export function countGlCalls(): void {
  const frames: Writable[] = [];
  window.glFrames = frames;
  let frame: Writable | undefined;
  const inFrame = window.requestAnimationFrame.bind(window);
  window.requestAnimationFrame = (callback) =>
    inFrame((now) => {
      const own = { calls: 0, draws: 0, uploads: 0, uploadedBytes: 0 };
      frame = own;
      callback(now);
      frame = undefined;
      if (own.calls > 0) frames.push(own);
    });
  const { prototype } = WebGL2RenderingContext;
  for (const [name, { value }] of Object.entries(Object.getOwnPropertyDescriptors(prototype))) {
    // Asked before each frame, whether or not it draws.
    if (typeof value !== 'function' || name === 'isContextLost') continue;
    const isUpload = /^(buffer(Sub)?Data|tex(Sub)?Image[23]D)$/.test(name);
    Object.defineProperty(prototype, name, {
      configurable: true,
      value(this: unknown, ...args: unknown[]) {
        if (frame) {
          frame.calls++;
          if (/^draw(Arrays|Elements)/.test(name)) frame.draws++;
          if (isUpload) frame.uploads++;
          if (isUpload) for (const arg of args) if (ArrayBuffer.isView(arg)) frame.uploadedBytes += arg.byteLength;
        }
        return value.apply(this, args);
      },
    });
  }
}

/** Runs in the page, before the calls are counted: the browser draws no pixels. In software a frame may take seconds. */
export function drawNothing(): void {
  const { prototype } = WebGL2RenderingContext;
  for (const draw of ['drawElements', 'drawElementsInstanced', 'drawArrays', 'drawArraysInstanced'] as const) {
    prototype[draw] = () => {};
  }
}

/** The next so many frames that draw. */
export function nextFrames(page: Page, count: number): Promise<readonly FrameCalls[]> {
  return framesWhile(page, count, () => Promise.resolve());
}

/** So many frames that draw, while something is done again and again that draws at least one. */
export async function framesWhile(
  page: Page,
  count: number,
  act: () => Promise<unknown>,
): Promise<readonly FrameCalls[]> {
  const length = () => page.evaluate(() => window.glFrames?.length ?? 0);
  const first = await length();
  for (let drawn = first; drawn < first + count; drawn = await length()) {
    await act();
    await page.waitForFunction((enough) => (window.glFrames?.length ?? 0) > enough, drawn);
  }
  return page.evaluate(([from, to]) => window.glFrames?.slice(from, to) ?? [], [first, first + count] as const);
}

/** The usual frame of many: each character's median. */
export function usual(frames: readonly FrameCalls[]): FrameCalls {
  const median = (of: keyof FrameCalls) => frames.map((f) => f[of]).sort((a, b) => a - b)[frames.length >> 1];
  return {
    calls: median('calls'),
    draws: median('draws'),
    uploads: median('uploads'),
    uploadedBytes: median('uploadedBytes'),
  };
}
