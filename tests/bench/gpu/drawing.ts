/** A browser whose frames are drawn by a GPU, if there is one, as fast as they can be. */
import { platform } from 'node:process';
import type { Browser } from 'playwright-core';
import { launchChromium } from '../../helpers/chromium.ts';
import type { GpuOptions } from './options.ts';

export interface Drawing {
  readonly browser: Browser;
  /** As WebGL names it. */
  readonly renderer: string;
  readonly userAgent: string;
  readonly flags: readonly string[];
  readonly isSoftware: boolean;
}

const UNTHROTTLED = ['--disable-gpu-vsync', '--disable-frame-rate-limit'];
const ON_GPU = ['--enable-gpu', '--ignore-gpu-blocklist'];

/**
 * Ways to a GPU, the first that leads there is taken. Without a display, Linux has none by default, and the browser's
 * own elements can't be put together by the GPU.
 */
const WAYS: readonly (readonly string[])[] = [
  [],
  ...(platform === 'linux'
    ? ['vulkan', 'gl-egl'].map((angle) => [`--use-angle=${angle}`, '--disable-gpu-compositing'])
    : []),
];

/** Renderers that are programs: Chromium's, Mesa's, and that of Windows. */
const SOFTWARE = /swiftshader|llvmpipe|softpipe|software|basic render/i;

/** Whether a renderer, by its name, is no GPU. */
export const isSoftware = (renderer: string) => SOFTWARE.test(renderer);

/** On a GPU, or in software if none is found. */
export async function openDrawing({ flags, headed }: Pick<GpuOptions, 'flags' | 'headed'>): Promise<Drawing> {
  for (const way of flags.length > 0 ? [flags] : WAYS) {
    const found = await tried([...ON_GPU, ...way, ...UNTHROTTLED], headed, false);
    if (found && !found.isSoftware) return found;
    await found?.browser.close();
  }
  const software = await tried(UNTHROTTLED, headed, true);
  if (!software) throw new Error('The browser has no WebGL 2, in software either.');
  return software;
}

/** Undefined if the browser doesn't start so, or has no WebGL 2. */
async function tried(flags: readonly string[], headed: boolean, inSoftware: boolean): Promise<Drawing | undefined> {
  const browser = await launchChromium(flags, { headed, inSoftware }).catch((error) => {
    if (inSoftware) throw error;
  });
  if (!browser) return undefined;
  const page = await browser.newPage();
  const found = await page.evaluate(() => {
    const gl = document.createElement('canvas').getContext('webgl2');
    if (!gl) return undefined;
    const names = gl.getExtension('WEBGL_debug_renderer_info');
    const renderer: unknown = gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER);
    return { renderer: String(renderer), userAgent: navigator.userAgent };
  });
  await page.close();
  if (found) return { browser, ...found, flags, isSoftware: isSoftware(found.renderer) };
  await browser.close();
  return undefined;
}
