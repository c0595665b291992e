/** The page's frame is visible before any script, in the system's theme, and doesn't shift when the script runs. */
import type { Page } from 'playwright-core';
import { describe, expect, it } from 'vitest';
import { inOnePage } from '../helpers/one-page.ts';
import { type OpenPage, withPage } from '../helpers/page.ts';

const PARTS = [
  '.menu-bar',
  '.menu-titles',
  '.outliner',
  '.stage',
  '.inspector',
  '.transport',
  '.timeline',
  '.status-bar',
];
/** Layout shift of the whole page, including late text; 0.1 is considered good (web.dev/cls). */
const MAX_SHIFT = 0.0005;

const boxes = (page: Page) =>
  page.evaluate(
    (parts) =>
      parts.map((part) => {
        const box = document.querySelector(part)?.getBoundingClientRect();
        return `${part} ${box?.x} ${box?.y} ${box?.width} ${box?.height}`;
      }),
    PARTS,
  );

/** The addresses don't change, so that a page loaded without its script can then load it. */
async function withoutScript({ page, url }: OpenPage, look: () => Promise<void>): Promise<void> {
  await page.route('**/*.js', (route) => route.abort());
  await page.goto(url);
  await look();
  await page.unroute('**/*.js');
}

describe('the frame of the page', () => {
  it.each([
    ['light', 'rgb(246, 247, 248)', { width: 1280, height: 800 }],
    ['dark', 'rgb(33, 36, 39)', { width: 1024, height: 700 }],
  ] as const)(
    'is %s without any script where the system is, and keeps its place when it comes',
    (colorScheme, surface, size) =>
      withPage(
        async (open) => {
          const { page } = open;
          const before: string[] = [];
          await withoutScript(open, async () => {
            const bar = page.locator('.menu-bar');
            await expect.poll(() => bar.evaluate((element) => getComputedStyle(element).backgroundColor)).toBe(surface);
            await expect.poll(() => page.getByText('Marrow').first().isVisible()).toBe(true);
            before.push(...(await boxes(page)));
          });
          await page.reload();
          await page.waitForFunction(() => window.marrow?.characters().length > 0);
          await page.locator('.inspector .lil-gui').first().waitFor();
          await expect.poll(() => boxes(page)).toEqual(before);
          const shift = await page.evaluate(
            () =>
              new Promise<number>((resolve) => {
                // Includes earlier entries; empty if nothing has moved.
                const found = (list: PerformanceObserverEntryList) =>
                  resolve(
                    list.getEntries().reduce((sum, entry) => sum + (entry as unknown as { value: number }).value, 0),
                  );
                new PerformanceObserver(found).observe({ type: 'layout-shift', buffered: true });
                setTimeout(() => resolve(0), 500);
              }),
          );
          expect(shift).toBeLessThan(MAX_SHIFT);
        },
        { size, colorScheme, blank: true, expected: /\.js/, walking: true, firstVisit: true },
      ),
  );

  it('shows its first picture at the size that it keeps, whatever panels were dragged or collapsed to', () =>
    withPage(
      async ({ page }) => {
        await page.locator('.inspector .lil-gui').first().waitFor();
        const sizes = await page.evaluate(() => (window as unknown as { stageSizes: string[] }).stageSizes);
        expect(sizes.length).toBeGreaterThan(0);
        expect([...new Set(sizes)]).toEqual([`${1280 - 400 - 244}x${sizes[0].split('x')[1]}`]);
      },
      {
        walking: true,
        before: () => {
          const panels = { outlinerWidth: 400, timelineOpen: false };
          localStorage.setItem('marrow.settings', JSON.stringify({ panels }));
          const sizes: string[] = [];
          Object.assign(window, { stageSizes: sizes });
          const look = () => {
            const stage = document.querySelector('.stage:has(canvas)');
            if (stage) sizes.push(`${stage.clientWidth}x${stage.clientHeight}`);
            requestAnimationFrame(look);
          };
          look();
        },
      },
    ));
});

describe('what a newcomer is told', () => {
  const inPage = inOnePage({ firstVisit: true });

  inPage('the first steps go for good when closed, and the Help menu has longer ones', async ({ page, url }) => {
    const steps = page.getByRole('region', { name: 'First steps' });
    await steps.getByText('Drag a joint').waitFor();
    await page.evaluate(() => window.marrow.run('posing.ik'));
    await steps.waitFor({ state: 'hidden' });
    await page.evaluate(() => window.marrow.run('posing.fk'));
    await steps.getByText('Click a joint').waitFor();
    await steps.getByRole('button', { name: 'Close first steps' }).click();
    await steps.waitFor({ state: 'hidden' });
    // Kept a moment after the change.
    await page.waitForFunction(() => localStorage.getItem('marrow.settings')?.includes('"firstSteps":false'));
    await page.goto(url);
    await page.locator('.inspector .lil-gui').first().waitFor();
    await expect.poll(() => steps.isVisible()).toBe(false);
    await page.evaluate(() => window.marrow.run('help.firstAnimation'));
    await page.getByRole('region', { name: 'First animation' }).waitFor();
  });

  inPage('the status bar says what the mouse does where it is', async ({ page }) => {
    const bar = page.locator('.status-bar');
    await page
      .locator('.stage canvas')
      .first()
      .hover({ position: { x: 40, y: 120 } });
    await bar.getByText('Orbit').waitFor();
    await page.mouse.down();
    await page.locator('.tree').hover();
    await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
    await expect.poll(() => bar.innerText()).toContain('orbit');
    await page.mouse.up();
    await page.locator('.tree').hover();
    await bar.getByText('Frame').waitFor();
  });
});
