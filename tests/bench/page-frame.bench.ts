/**
 * A frame of the built page while 50 motion captures of 70 joints play: all script of the main thread including
 * three.js and WebGL calls, in thread time. Goal: at most 3 times a bare loop that samples and multiplies the same
 * joints in the same page.
 *
 * Measurements alternate with and without a few bare loops per frame; their difference is the loops' time. Drawing
 * itself is left out (one instance per call, nothing rasterised): without a GPU it would dominate.
 */
import { existsSync } from 'node:fs';
import type { Page } from 'playwright-core';
import { bench, describe } from 'vitest';
import { median } from '../../src/evaluate/retarget/ground.ts';
import { withPage } from '../helpers/page.ts';
import { bareCrowd } from './bare-crowd.ts';
import { capture } from './capture.ts';
import { drawNothing, hasChromium, meter } from './page-meter.ts';

const CHARACTERS = 50;
const JOINTS = 70;
const FRAMES = 1200;
const FRAME_SECONDS = 1 / 120;
/** Bare loops per frame of a measurement with them. */
const LOOPS = 4;
const WINDOWS = 9;
/** Another build of the page, measured alternately with the one in `dist/`. */
const COMPARED = process.env.MARROW_COMPARED;

const take = capture(7, { joints: JOINTS, frames: FRAMES, frameSeconds: FRAME_SECONDS });

/** Waits for the crowd, and installs bare loops: `window.bareLoops` of them a frame. */
async function awaitCrowd(page: Page): Promise<void> {
  await page.waitForFunction((count) => window.marrow?.characters().length === count, CHARACTERS);
  // Panels are created when the page is idle.
  await page.locator('.lil-gui').first().waitFor({ state: 'attached' });
  const crowd = { parent: take.parents, offsets: take.offsets, frameSeconds: FRAME_SECONDS };
  await page.evaluate(
    ([source, given, motion, characters, frames]) => {
      const make = new Function(`return ${source}`)();
      const rows = Float64Array.from(motion);
      const bare = make({ ...given, values: Array.from({ length: characters }, () => rows.slice()) }, 'slerp');
      const wanted = () => Number(Reflect.get(window, 'bareLoops') ?? 0);
      let tick = 0;
      const frame = () => {
        // Just over two frames of samples per screen frame: never at a frame, never twice in the same one.
        for (let i = 0; i < wanted(); i++) bare(((tick++ * 2.003 + 0.31) % (frames - 2)) * given.frameSeconds);
        requestAnimationFrame(frame);
      };
      requestAnimationFrame(frame);
    },
    [bareCrowd.toString(), crowd, take.rows.flat(), CHARACTERS, FRAMES] as const,
  );
}

class Measured {
  readonly page: number[] = [];
  readonly bare: number[] = [];

  constructor(private readonly scriptMs: (loops: number) => Promise<number>) {}

  async window(): Promise<void> {
    const alone = await this.scriptMs(0);
    const together = await this.scriptMs(LOOPS);
    this.page.push(alone);
    this.bare.push((together - alone) / LOOPS);
  }

  toString(): string {
    const page = median(this.page);
    const bare = median(this.bare);
    const ratio = median(this.page.map((ms, i) => ms / this.bare[i]));
    return `${page.toFixed(2)} ms of script a frame, a bare loop ${bare.toFixed(2)} ms: ${ratio.toFixed(2)} times`;
  }
}

const takes = Array.from({ length: CHARACTERS }, (_, i) => `take${i}.bvh`);
const options = {
  size: { width: 700, height: 500 },
  before: drawNothing,
  query: `?files=${takes}`,
  files: Object.fromEntries(takes.map((name) => [name, take.bvh])),
};

describe.skipIf(!hasChromium())(
  '50 captures of 70 joints play on the page (skipped where there is no Chromium)',
  () => {
    bench(
      'a frame of it',
      async () => {
        if (!existsSync('dist/index.html')) throw new Error('There is no built page: "npm run build" first.');
        const folders = COMPARED ? [undefined, COMPARED] : [undefined];
        const measured: Measured[] = [];
        const measure = async (remaining: readonly (string | undefined)[]): Promise<void> => {
          const [folder, ...others] = remaining;
          if (remaining.length === 0) {
            for (let w = 0; w < WINDOWS; w++) for (const one of measured) await one.window();
            return;
          }
          await withPage(
            async ({ page }) => {
              await awaitCrowd(page);
              measured.push(new Measured(await meter(page)));
              await measure(others);
            },
            { ...options, drawn: true, ...(folder && { folder }) },
          );
        };
        await measure(folders);
        measured.forEach((one, i) => {
          console.log(`${folders[i] ?? 'dist'}: ${one}`);
        });
      },
      { iterations: 1, time: 0, warmupIterations: 0, warmupTime: 0 },
    );
  },
);
