/** Light on characters, measured in pictures of them alone: faces are lit, and nothing of boxes and skins is near black. */
import type { Page } from 'playwright-core';
import { expect } from 'vitest';
import { inOnePage, undoAll } from '../helpers/one-page.ts';
import { dropPaths } from '../helpers/page.ts';
import { describeShared, sharedPath } from '../helpers/shared.ts';

/** Of the page, whose picture is larger. */
const SMALL = { width: 480, height: 360 };
/** Part of the walker's height, from the top, that is its head. */
const HEAD = 0.42;
/** Linear luminance below which a pixel is near black. */
const NEAR_BLACK = 0.01;

interface Light {
  /** Mean linear luminance of the upper part. */
  readonly upper: number;
  /** Part of all pixels that are near black. */
  readonly nearBlack: number;
}

/** Of the character as it is drawn now, without anything behind it. */
const lightNow = (page: Page): Promise<Light> =>
  page.evaluate(
    async ([head, black]) => {
      window.fillPixels(true);
      const blob = await window.marrow.picture({
        width: 300,
        height: 300,
        hasGrid: false,
        hasBackground: false,
        hasTools: false,
      });
      window.fillPixels(false);
      if (!blob) throw new Error('There is no picture.');
      const bitmap = await createImageBitmap(blob, { premultiplyAlpha: 'none' });
      const g = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
      if (!g) throw new Error('no 2D canvas');
      g.drawImage(bitmap, 0, 0);
      const { data, width, height } = g.getImageData(0, 0, bitmap.width, bitmap.height);
      const linear = (byte: number) => (byte <= 10 ? byte / 3294.6 : ((byte / 255 + 0.055) / 1.055) ** 2.4);
      const rows = Array.from({ length: height }, (_, y) => {
        const row: number[] = [];
        for (let i = 4 * y * width; i < 4 * (y + 1) * width; i += 4) {
          // Edges are mixed with nothing, and a shadow on the floor is see-through.
          if (data[i + 3] < 250) continue;
          row.push(0.2126 * linear(data[i]) + 0.7152 * linear(data[i + 1]) + 0.0722 * linear(data[i + 2]));
        }
        return row;
      });
      const top = rows.findIndex((row) => row.length > 0);
      const bottom = rows.findLastIndex((row) => row.length > 0);
      const upper = rows.slice(top, top + Math.round(head * (bottom - top))).flat();
      const all = rows.flat();
      return {
        upper: upper.reduce((sum, value) => sum + value, 0) / upper.length,
        nearBlack: all.filter((value) => value < black).length / all.length,
      };
    },
    [HEAD, NEAR_BLACK] as const,
  );

const inPage = inOnePage({ walking: true, firstVisit: true, drawn: 'later', size: SMALL });

for (const colorScheme of ['dark', 'light'] as const)
  inPage(`the walker’s face is lit at every time of its walk, in the ${colorScheme} theme`, async ({ page }) => {
    await page.emulateMedia({ colorScheme });
    await page.waitForFunction(() => window.marrow?.characters()[0]?.dofs.length === 93);
    const found: Light[] = [];
    for (let i = 0; i < 6; i++) {
      await page.evaluate((time) => window.marrow.seek(time), 1.07 * i);
      found.push(await lightNow(page));
    }
    expect(Math.min(...found.map(({ upper }) => upper))).toBeGreaterThanOrEqual(0.25);
    expect(Math.max(...found.map(({ nearBlack }) => nearBlack))).toBeLessThanOrEqual(0.018);
  });

describeShared('characters of the course', () => {
  for (const [colorScheme, all] of [
    ['dark', ['dragon.skel', 'test.skel', 'wasp.skel,wasp.skin', 'tube.skel,tube.skin']],
    ['light', ['dragon.skel', 'wasp.skel,wasp.skin']],
  ] as const) {
    for (const names of all) {
      inPage(`nothing of ${names} is near black, in the ${colorScheme} theme`, async ({ page }) => {
        await page.emulateMedia({ colorScheme });
        await undoAll(page);
        const paths = names.split(',').map((name) => sharedPath(`data/cse169/${name}`));
        await dropPaths(page, paths, SMALL.width / 2, SMALL.height / 2);
        const name = names.split('.')[0];
        await page.waitForFunction((wanted) => window.marrow.characters()[0]?.name === wanted, name);
        const found = await lightNow(page);
        expect(found.nearBlack).toBeLessThanOrEqual(0.02);
        expect(found.upper).toBeGreaterThan(0.1);
      });
    }
  }
});
