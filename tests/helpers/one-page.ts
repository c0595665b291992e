/**
 * Tests that go on in one page, one after the other: to start a page for each took a third of their time. Each resets
 * what it needs as it finds it, so that any of them can be the first. What comes after one that failed, its second try
 * too, begins in a fresh page, so that no failure is told twice.
 *
 *     const inPage = inOnePage({ walking: true });
 *     inPage('a press at the first pixel seeks 0', async ({ page }) => { … });
 */
import type { Page } from 'playwright-core';
import { afterAll, it } from 'vitest';
import { type OpenedPage, type OpenPage, openPage, type PageOptions } from './page.ts';

/**
 * Returns what registers a test.
 * @param prepare run once in each page, before the first test in it
 */
export function inOnePage(
  options: PageOptions = {},
  prepare?: (open: OpenPage) => Promise<void>,
): (name: string, body: (open: OpenPage) => Promise<void>) => void {
  let shared: OpenedPage | undefined;
  const close = async () => {
    const before = shared;
    shared = undefined;
    await before?.close();
  };
  afterAll(close);
  return (name, body) =>
    it(name, async () => {
      try {
        if (!shared) {
          shared = await openPage(options);
          await prepare?.(shared.open);
        }
        await body(shared.open);
        shared.expectNoProblems();
      } catch (error) {
        await close();
        throw error;
      }
    });
}

/** The page is at the start of its opening example again, in Pose mode and with nothing selected; its camera stays. */
export async function startOver(page: Page): Promise<void> {
  await page.waitForFunction(() => window.marrow?.characters().length);
  await page.evaluate(async () => {
    const { marrow } = window;
    marrow.pause();
    while (marrow.undo());
    marrow.seek(0);
    try {
      await marrow.run('select.nothing');
    } catch {
      // Nothing is.
    }
    await marrow.run('posing.pose');
  });
}

/** The document is that of the opening example again. Returns the number of steps. */
export const undoAll = (page: Page): Promise<number> =>
  page.evaluate(() => {
    let steps = 0;
    while (window.marrow.undo()) steps++;
    return steps;
  });
