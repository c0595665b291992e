/** Tooltips by pointer, keyboard and finger, in the built page. */
import type { Page } from 'playwright-core';
import { describe, expect } from 'vitest';
import { inOnePage } from '../helpers/one-page.ts';

const tooltip = (page: Page) => page.getByRole('tooltip');
const play = (page: Page) => page.getByRole('button', { name: 'Play', exact: true });
/** It comes after a moment, when `waitFor` would ask again half a second later. */
const shown = (page: Page) => expect.poll(() => tooltip(page).isVisible()).toBe(true);
const hidden = (page: Page) => tooltip(page).waitFor({ state: 'hidden' });

describe('a tooltip', () => {
  const inPage = inOnePage();

  inPage('shows text and key to a resting pointer, at once to a neighbour, and hides at Escape', async ({ page }) => {
    await play(page).hover();
    await shown(page);
    await expect.poll(() => tooltip(page).locator('.tooltip-text').textContent()).toBe('Play');
    await expect.poll(() => tooltip(page).locator('kbd').textContent()).toBe('Space');
    await page.getByRole('button', { name: 'Go to next key' }).hover();
    await page.waitForFunction(() => document.querySelector('.tooltip-text')?.textContent === 'Go to next key');
    await page.keyboard.press('Escape');
    await hidden(page);
  });

  inPage(
    'a tooltip stays under a pointer that moves onto it, and lets presses through to what is below',
    async ({ page }) => {
      const boxes = page.getByRole('button', { name: /^Boxes/ });
      await boxes.hover();
      await shown(page);
      const box = await tooltip(page).boundingBox();
      if (!box) throw new Error('The tooltip has no box.');
      await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2, { steps: 40 });
      await expect.poll(() => tooltip(page).isVisible()).toBe(true);
      const below = await page.evaluate(([x, y]) => document.elementFromPoint(x, y)?.closest('.tooltip') === null, [
        box.x + box.width / 2,
        box.y + box.height / 2,
      ] as const);
      expect(below).toBe(true);
      await page.mouse.move(640, 500);
      await hidden(page);
    },
  );

  inPage('describes the control that the keyboard focuses', async ({ page }) => {
    const auto = page.getByRole('button', { name: 'Auto-key' });
    await auto.focus();
    await page.keyboard.press('Shift+Tab');
    await page.keyboard.press('Tab');
    await shown(page);
    const described = await auto.evaluate(
      (target) => document.getElementById(target.getAttribute('aria-describedby') ?? '')?.textContent,
    );
    expect(described).toContain('key changes automatically');
    await page.keyboard.press('Escape');
    await hidden(page);
    await expect.poll(() => auto.getAttribute('aria-describedby')).toBe(null);
  });

  inPage('shows to a finger that holds, without the press; a tap presses', async ({ page }) => {
    const target = page.getByRole('button', { name: 'Auto-key' });
    const at = await target.boundingBox();
    if (!at) throw new Error('The button has no box.');
    const touchPoints = [{ x: at.x + at.width / 2, y: at.y + at.height / 2 }];
    const cdp = await page.context().newCDPSession(page);
    await cdp.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints });
    await shown(page);
    await cdp.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
    await expect.poll(() => tooltip(page).isVisible()).toBe(true);
    await expect.poll(() => target.getAttribute('aria-pressed')).toBe('false');
    await cdp.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints });
    await cdp.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
    await page.waitForFunction(() => document.querySelector('.auto-key')?.getAttribute('aria-pressed') === 'true');
    await hidden(page);
  });
});
