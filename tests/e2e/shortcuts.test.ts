/** The dialog of shortcuts: essentials first, search by name and by pressing a key, groups. */
import { expect, it } from 'vitest';
import { withPage } from '../helpers/page.ts';

it('shortcuts show the essentials first, and are found by name, by pressing a key, or by group', () =>
  withPage(async ({ page }) => {
    await page.keyboard.press('?');
    const dialog = page.getByRole('dialog', { name: 'Shortcuts' });
    const field = dialog.getByRole('searchbox');
    const lines = () => dialog.locator('.shortcut-line > :first-child').allTextContents();
    await expect.poll(() => dialog.getByRole('tab', { selected: true }).textContent()).toBe('Essentials 23');
    await expect.poll(async () => (await lines()).length).toBe(23);

    // The field has the focus: whoever presses ? types on.
    await page.keyboard.press('Control+z');
    await expect.poll(() => field.inputValue()).toBe('Ctrl+Z');
    await expect.poll(lines).toEqual(['Undo']);
    await page.keyboard.press('Space');
    await expect.poll(lines).toEqual(['Play or pause']);
    await page.keyboard.press('k');
    await expect.poll(lines).toEqual(['Key changes (or the selected joints)']);
    // A second character begins a name.
    await page.keyboard.type('ey whole');
    await expect.poll(() => field.inputValue()).toBe('key whole');
    await expect.poll(async () => (await lines())[0]).toBe('Key whole pose');
    await page.keyboard.type(' nonsense');
    await dialog.getByText('No shortcut has this name').waitFor();

    await dialog.getByRole('tab', { name: /^Keys/ }).click();
    await expect.poll(() => field.inputValue()).toBe('');
    await expect.poll(lines).toContain('Delete selected keys');
    await page.keyboard.press('ArrowDown');
    await expect.poll(() => dialog.getByRole('tab', { selected: true }).textContent()).toMatch(/^Curves/);
    // Nothing is beside the page that scrolls.
    const beyond = () => dialog.locator('.shortcut-shown').evaluate((one) => one.scrollWidth - one.clientWidth);
    await expect.poll(beyond).toBe(0);
    await dialog.getByRole('tab', { name: /^Mouse and touch/ }).click();
    await expect.poll(lines).toContain('Orbit');
    await page.keyboard.press('Escape');
    await expect.poll(() => dialog.count()).toBe(0);
  }));
