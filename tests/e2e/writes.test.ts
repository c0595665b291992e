/** What the page's own elements cost while something plays or is dragged: what is written, laid out and painted. */
import type { Page } from 'playwright-core';
import { describe, expect } from 'vitest';
import type { GivenBlob } from '../../src/worker/protocol.ts';
import { star } from '../bench/gpu/scenes/star.ts';
import { drawNothing } from '../helpers/gl-calls.ts';
import { walkerFiles } from '../helpers/hero.ts';
import { layoutsOf } from '../helpers/main-thread.ts';
import { manyMorphs } from '../helpers/many-morphs.ts';
import { inOnePage, undoAll } from '../helpers/one-page.ts';
import { openFiles } from '../helpers/page.ts';
import { framesPass, type PageWrites, writesOf } from '../helpers/page-writes.ts';
import { drawn, onPage, standing } from './checks/ik.ts';
import { place, shown } from './checks/limb-drag.ts';

/** Frames that are looked at while it plays; numbers change in one of ten. */
const FRAMES = 20;
/** Paused, any write is one too many, and what would write does so in each frame, or in one of ten. */
const FRAMES_PAUSED = 10;

const CAPTURE = `HIERARCHY
ROOT hips {
OFFSET 0 90 0
CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
JOINT spine { OFFSET 0 20 0 CHANNELS 3 Zrotation Xrotation Yrotation End Site { OFFSET 0 30 0 } }
}
MOTION
Frames: 600
Frame Time: 0.0083333
${Array.from({ length: 600 }, (_, f) => `${f / 10} 90 0 0 ${(f % 90) - 45} 0 ${f % 40} 0 0`).join('\n')}
`;

const textFile = (path: string, text: string): GivenBlob => ({ path, blob: new Blob([text]) });

const noisy = ({ frames }: PageWrites) => frames.filter((own) => own.length > 0);

/** Panels come when the page is idle. It is paused, and writes nothing any more. */
async function allShown(page: Page, count: number): Promise<void> {
  await page.waitForFunction((wanted) => window.marrow?.characters().length === wanted, count);
  await page.locator('.inspector .lil-slider').first().waitFor({ state: 'attached' });
  await page.locator('.curve-plot canvas').first().waitFor();
  await page.evaluate(() => window.marrow.pause());
  // What was opened or undone is kept in a while, which the page says in an attribute.
  await page.waitForFunction(() => document.documentElement.dataset.autosave !== 'pending');
  await expect.poll(async () => noisy(await writesOf(page, () => framesPass(page, 2)))).toEqual([]);
}

/** Writes of so many frames, and how often they were laid out and painted. */
async function costOf(page: Page, count: number): Promise<PageWrites & { layouts: number; paints: number }> {
  let writes: PageWrites = { frames: [], equal: [] };
  const counted = await layoutsOf(page, async () => {
    writes = await writesOf(page, () => framesPass(page, count));
  });
  return { ...writes, ...counted };
}

const OPTIONS = { walking: true, before: drawNothing } as const;
const inPage = inOnePage(OPTIONS);
/** Another, of what is opened for these scenes. */
const inPageOfScenes = inOnePage(OPTIONS);

describe('elements of the page while characters play', () => {
  for (const [what, count, files] of [
    ['the walker', 1, () => []],
    ['ten walkers', 10, () => walkerFiles(10)],
    ['ten captures', 10, () => Array.from({ length: 10 }, (_, i) => textFile(`take${i}.bvh`, CAPTURE))],
    ['a star of 2,000 joints', 1, () => [textFile('star.bvh', star(2000))]],
    ['a skin with ten morphs', 1, () => manyMorphs(3000, 10)],
  ] as const)
    inPageOfScenes(
      `${what}: nothing is written, laid out or painted in nine of ten frames, and never paused`,
      async ({ page }) => {
        await undoAll(page);
        await openFiles(page, files());
        await allShown(page, count);
        const paused = await costOf(page, FRAMES_PAUSED);
        expect(noisy(paused)).toEqual([]);
        expect([paused.layouts, paused.paints]).toEqual([0, 0]);

        await page.evaluate(() => window.marrow.play());
        await drawn(page);
        const playing = await costOf(page, FRAMES);
        // On a busy machine a few frames more pass until it is asked for them. At both ends there may be one more.
        const numbered = Math.ceil(playing.frames.length / 10);
        expect(noisy(playing).length).toBeLessThanOrEqual(numbered + 1);
        expect(playing.layouts).toBeLessThanOrEqual(numbered + 2);
        expect(playing.paints).toBeLessThanOrEqual(numbered + 2);
        expect(playing.equal).toEqual([]);
      },
    );

  inPage(
    'numbers change while it plays, are those of the time when it stops, and follow each move of the scrubber',
    async ({ page }) => {
      await allShown(page, 1);
      const time = page.getByRole('textbox', { name: 'Time in seconds' });
      const slider = page.locator('.dof input').first();
      const seconds = async () => Number(await time.inputValue());
      const before = [await seconds(), await slider.inputValue()];
      await page.evaluate(() => window.marrow.play());
      await expect.poll(seconds).not.toBe(before[0]);
      await expect.poll(() => slider.inputValue()).not.toBe(before[1]);
      await page.evaluate(() => window.marrow.pause());
      // Of the scrubber, exact.
      const exact = async () => Number(await page.locator('.scrubber').getAttribute('aria-valuenow'));
      await expect.poll(async () => Math.abs((await exact()) - (await seconds()))).toBeLessThan(0.001);

      const ruler = await page.locator('.scrubber').boundingBox();
      if (!ruler) throw new Error('There is no ruler.');
      await page.mouse.move(ruler.x + 100, ruler.y + 8);
      await page.mouse.down();
      const shownTimes = new Set<string>();
      for (let i = 1; i <= 5; i++) {
        await page.mouse.move(ruler.x + 100 + 40 * i, ruler.y + 8);
        await drawn(page);
        shownTimes.add(await time.inputValue());
      }
      await page.mouse.up();
      expect(shownTimes.size).toBe(5);
    },
  );
});

describe('elements of the page while a joint is dragged', () => {
  for (const mode of ['posing.pose', 'posing.fk', 'posing.ik'])
    inPage(`${mode}: only what has changed is written`, async ({ page }) => {
      await undoAll(page);
      await allShown(page, 1);
      await page.evaluate((id) => window.marrow.run(id), mode);
      await standing(page);
      const now = await shown(page);
      const from = await onPage(page, place(now, now.names.indexOf('hand_l')));
      await page.mouse.move(from.x, from.y);
      await drawn(page);
      await page.mouse.down();
      // The first move selects the joint, whose rows and curves come then.
      await page.mouse.move(from.x + 5, from.y - 5);
      await drawn(page);
      await page.mouse.move(from.x + 10, from.y - 10);
      await drawn(page);
      const writes = await writesOf(page, async () => {
        for (let i = 0; i < 10; i++) {
          await page.mouse.move(from.x + 10 + 3 * i, from.y - 10 - 3 * i);
          await drawn(page);
        }
      });
      await page.mouse.up();
      expect(writes.equal).toEqual([]);
      // Numbers of the joint, its sliders, and the chip or label beside it; more than 80 when all panels wrote anew.
      expect(writes.frames.flat().length / 10).toBeLessThan(40);
    });
});
