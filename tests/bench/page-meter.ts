/** Measures the script of a page's frames while it plays, in thread time. */
import type { Page } from 'playwright-core';
import { findChromium } from '../helpers/chromium.ts';

const WINDOW_MS = 1500;

/** Draws one instance per call, and no pixels. Runs in the page before its own script. */
export function drawNothing(): void {
  const { prototype } = WebGL2RenderingContext;
  const draw = prototype.drawElementsInstanced;
  prototype.drawElementsInstanced = function (mode, count, type, offset) {
    this.enable(this.RASTERIZER_DISCARD);
    draw.call(this, mode, count, type, offset, 1);
  };
}

/**
 * Milliseconds of script per frame, over a period of playback.
 * @returns called with a count of bare loops in each frame, which the page does itself (`window.bareLoops`); default: none
 */
export async function meter(page: Page): Promise<(loops?: number) => Promise<number>> {
  await page.evaluate(() => {
    const seen = Object.assign(window, { bareLoops: 0, frames: 0 });
    const frame = () => {
      seen.frames++;
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  });
  const session = await page.context().newCDPSession(page);
  await session.send('Performance.enable', { timeDomain: 'threadTicks' });
  const script = async () => {
    const { metrics } = await session.send('Performance.getMetrics');
    return 1000 * (metrics.find(({ name }) => name === 'ScriptDuration')?.value ?? Number.NaN);
  };
  const frames = () => page.evaluate(() => Number(Reflect.get(window, 'frames')));
  return async (loops = 0) => {
    await page.evaluate((count) => {
      Object.assign(window, { bareLoops: count });
      window.marrow.play();
    }, loops);
    await page.waitForTimeout(200);
    const before = { ms: await script(), frames: await frames() };
    await page.waitForTimeout(WINDOW_MS);
    const ms = (await script()) - before.ms;
    const count = (await frames()) - before.frames;
    await page.evaluate(() => window.marrow.pause());
    return ms / count;
  };
}

/** Whether pages can be measured on this machine. */
export function hasChromium(): boolean {
  try {
    findChromium();
    return true;
  } catch {
    return false;
  }
}
