/** Menus by the right button and by keyboard, tables by keyboard, and the empty stage; one page. */
import type { Page } from 'playwright-core';
import { expect, it } from 'vitest';
import { dropFiles, withPage } from '../helpers/page.ts';

const ARM = `balljoint shoulder {
  boxmin -0.1 0 -0.1 boxmax 0.1 1 0.1
  balljoint elbow {
    offset 0 1 0 boxmin -0.1 0 -0.1 boxmax 0.1 1 0.1
    pose 0.125 0 0
  }
}
`;

const undo = (page: Page) => page.evaluate(() => window.marrow.steps().undo);
const menuName = (page: Page) => page.getByRole('menu').first().getAttribute('aria-label');
const focused = (page: Page) =>
  page.evaluate(() => document.activeElement?.ariaLabel ?? document.activeElement?.textContent ?? '');

async function placeOf(page: Page, point: readonly [number, number, number]) {
  const at = await page.evaluate((p) => window.marrow.pointOnPage([...p]), point);
  if (!at) throw new Error('The point is not in the picture.');
  return at;
}

it('menus open by the right button and by keyboard, tables copy by keyboard, and an empty stage says what to open', () =>
  withPage(async ({ page }) => {
    await dropFiles(page, [{ name: 'arm.skel', bytes: ARM }]);
    await page.waitForFunction(() => window.marrow.characters()[0]?.name === 'arm');
    const stage = page.getByRole('application', { name: 'Viewport' });

    // A drag with the right button pans; a click selects what is there, and opens its menu.
    const { x, y } = await placeOf(page, [0, 1.5, 0]);
    await page.mouse.move(x, y);
    await page.mouse.down({ button: 'right' });
    await page.mouse.move(x + 40, y);
    await page.mouse.move(x, y);
    await page.mouse.up({ button: 'right' });
    await expect.poll(() => page.getByRole('menu').count()).toBe(0);
    const now = await placeOf(page, [0, 1.5, 0]);
    await page.mouse.click(now.x, now.y, { button: 'right' });
    await page.getByRole('menu', { name: 'elbow' }).waitFor();
    await page.keyboard.press('Escape');
    await page.getByRole('menu').waitFor({ state: 'detached' });

    // By keyboard the same menu; what it does is undone by name, and the focus returns.
    await page.evaluate(() => window.marrow.run('pose.setDofs', { dofs: [{ index: 6, value: 1 }] }));
    await stage.focus();
    await page.keyboard.press('Shift+F10');
    await page.getByRole('menu', { name: 'elbow' }).waitFor();
    await expect.poll(() => focused(page)).toMatch(/^Key all DOFs of elbow/);
    await page.keyboard.press('r');
    await page.keyboard.press('Enter');
    await expect.poll(() => undo(page)).toBe('Reset elbow to file pose');
    await expect.poll(() => page.evaluate(() => window.marrow.characters()[0]?.dofs[6])).toBe(0.125);
    await expect.poll(() => focused(page)).toBe('Viewport');

    // Beside the character the menu of the stage.
    const box = await stage.boundingBox();
    if (!box) throw new Error('The viewport is not visible.');
    await page.mouse.click(box.x + 20, box.y + box.height - 20, { button: 'right' });
    await page.getByRole('menu').waitFor();
    await expect.poll(() => menuName(page)).toBe('Viewport');
    await page.keyboard.press('Escape');

    // A title of the menu bar opens its menu and closes it again.
    const title = page.getByRole('menuitem', { name: 'Edit', exact: true });
    for (const isOpen of ['true', 'false', 'true', 'false']) {
      await title.click();
      await expect.poll(() => title.getAttribute('aria-expanded')).toBe(isOpen);
      await expect.poll(() => page.getByRole('menu').count()).toBe(isOpen === 'true' ? 1 : 0);
    }

    // In the timeline each part has its menu: the ruler, the plot.
    await page.getByRole('slider', { name: 'Time', exact: true }).focus();
    await page.keyboard.press('Shift+F10');
    await page.getByRole('menuitem', { name: 'Set range start here' }).waitFor();
    await page.keyboard.press('Escape');
    const ruler = await page.getByRole('slider', { name: 'Time', exact: true }).boundingBox();
    if (!ruler) throw new Error('The ruler is not visible.');
    await page.mouse.click(ruler.x + ruler.width / 2, ruler.y + 8, { button: 'right' });
    await page.getByRole('menuitem', { name: 'Go here' }).waitFor();
    await page.keyboard.press('Escape');
    await page.locator('.curve-plot').focus();
    await page.keyboard.press('Shift+F10');
    await page.getByRole('menu', { name: 'Curves' }).waitFor();
    await page.keyboard.press('Escape');

    // The details' tables: one tab stop, arrows, and exact copies.
    await page.evaluate(() => void window.marrow.run('page.details'));
    await page.waitForFunction(() => document.activeElement?.role === 'gridcell');
    await page.keyboard.press('End');
    await page.keyboard.press('ArrowLeft');
    await page.keyboard.press('Control+c');
    await page.getByText(/^Copied 1\u00a0?$/).waitFor({ state: 'attached' });
    await page.keyboard.press('Shift+Enter');
    await page.getByText('Copied 3 numbers').waitFor({ state: 'attached' });
    await page.keyboard.press('Shift+F10');
    await expect
      .poll(() => page.getByRole('menu').getByRole('menuitem').allTextContents())
      .toEqual([
        expect.stringMatching(/^Copy number/),
        expect.stringMatching(/^Copy row/),
        expect.stringMatching(/^Copy table/),
      ]);
    await page.keyboard.press('Escape');

    // Nothing is open: a card with what to do, by keyboard too.
    await page.evaluate(() =>
      window.marrow.run('character.remove', { characterId: window.marrow.characters()[0]?.id }),
    );
    const card = page.getByRole('region', { name: 'Nothing is open' });
    await card.waitFor();
    await card.getByRole('button', { name: 'Open files…' }).focus();
    await page.keyboard.press('Tab');
    await page.keyboard.press('Enter');
    await page.getByRole('menuitem', { name: 'Post' }).waitFor();
    await page.keyboard.press('Enter');
    await card.waitFor({ state: 'hidden' });
    await page.waitForFunction(() => window.marrow.characters()[0]?.name === 'post');
  }));
