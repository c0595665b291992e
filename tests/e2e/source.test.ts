/** The tab *Source*: lines light up, lines select, messages lead to their line; a file far higher than any element. */
import type { Locator, Page } from 'playwright-core';
import { describe, expect } from 'vitest';
import { inOnePage, startOver } from '../helpers/one-page.ts';
import { dropFiles } from '../helpers/page.ts';

const SKEL = [
  'balljoint hips {',
  ...['boxmin -0.1 0 -0.1', 'boxmax 0.1 1 0.1', 'rotylimit -1 1'],
  'balljoint leg {',
  ...['offset 0 1 0', 'boxmin -0.1 0 -0.1', 'boxmax 0.1 1 0.1', '}', '}', ''],
].join('\n');
const BROKEN = 'balljoint a {\noffset 0 0 0\nrotxlimit -1 x\n}\n';
/** Pixels of its lines: more than the 33 million that an element can be high. */
const LINES = 2_000_000;

declare global {
  interface Window {
    /** Sends what `holdWorker` has kept, and all from now on. */
    release?: () => void;
  }
}

/** Texts are checked once nobody types: after a third of a second `waitFor` would ask again half a second later. */
const seen = (locator: Locator) => expect.poll(() => locator.isVisible()).toBe(true);

/** Workers are sent nothing until `window.release()`; the document says when there is something to be sent. */
const holdWorker = (page: Page) =>
  page.evaluate(() => {
    const { prototype } = Worker;
    const { postMessage } = prototype;
    const kept: (() => void)[] = [];
    prototype.postMessage = function (this: Worker, ...args: unknown[]) {
      kept.push(() => Reflect.apply(postMessage, this, args));
      document.documentElement.dataset.held = '';
    };
    window.release = () => {
      prototype.postMessage = postMessage;
      for (const send of kept) send();
    };
  });

const inPage = inOnePage();

describe('the text of files', () => {
  /** The first: another has fetched it. */
  inPage(
    'the text editor is fetched by Edit; by keyboard it finds, replaces, undoes, matches braces, marks errors and applies',
    async ({ page, asked }) => {
      await startOver(page);
      await dropFiles(page, [{ name: 'figure.skel', bytes: SKEL }]);
      await page.getByRole('treeitem', { name: 'leg' }).waitFor();
      await page.evaluate(() => window.marrow.run('page.tab.source'));
      await seen(page.getByText('11 lines'));
      const fetched = () => asked().filter((path) => /^assets\/text-editor-/.test(path) && path.endsWith('.js')).length;
      await expect.poll(fetched).toBe(0);
      await page.getByRole('button', { name: 'Edit', exact: true }).click();
      const field = page.getByRole('textbox', { name: 'Text of figure.skel' });
      await field.and(page.locator(':focus')).waitFor();
      await expect.poll(fetched).toBe(1);
      const text = () => field.evaluate((one) => [...one.querySelectorAll('.cm-line')].map((line) => line.textContent));
      const lines = SKEL.split('\n');
      await expect.poll(text).toEqual(lines);
      await page.locator('.cm-word', { hasText: 'rotylimit' }).waitFor();

      await page.keyboard.press('Control+End');
      await page.keyboard.press('ArrowUp');
      await expect.poll(() => page.locator('.cm-matchingBracket').allTextContents()).toEqual(['{', '}']);
      await page.keyboard.press('Control+f');
      await page.getByRole('textbox', { name: 'Find', exact: true }).and(page.locator(':focus')).waitFor();
      await page.keyboard.type('boxmin');
      await page.getByText('2 matches').waitFor();
      await page.keyboard.press('Enter');
      await page.locator('.cm-searchMatch-selected').waitFor();
      for (let stop = 0; stop < 3; stop++) await page.keyboard.press('Tab');
      await page.getByRole('textbox', { name: 'Replace with' }).and(page.locator(':focus')).waitFor();
      await page.keyboard.type('boxmean');
      await page.keyboard.press('Tab');
      await page.keyboard.press('Tab');
      await page.keyboard.press('Space');
      await expect.poll(text).toEqual(lines.map((line) => line.replace('boxmin', 'boxmean')));
      await seen(page.locator('.cm-lint-marker').first());
      await page.keyboard.press('Escape');
      await page.getByRole('search').waitFor({ state: 'detached' });
      await page.keyboard.press('Control+z');
      await expect.poll(text).toEqual(lines);
      // With nothing left to undo in the text, the document stays too.
      await page.keyboard.press('Control+z');
      await expect.poll(() => page.evaluate(() => window.marrow.steps().undo)).toMatch(/figure/);

      await page.keyboard.press('Control+g');
      await page.keyboard.type('6');
      await page.keyboard.press('Enter');
      await page.keyboard.type('offset 0 x 0');
      await seen(page.locator('.cm-lint-marker-error'));
      await page.locator('.cm-lint-marker-error').hover();
      await page.locator('.cm-tooltip .cm-diagnostic-error', { hasText: /^Expected/ }).waitFor();
      await seen(page.getByRole('button', { name: /^Line 6: Expected/ }));
      // Letters and Space are typed, not the page's shortcuts; F1 is the manual, of which Escape leads back.
      for (let n = 0; n < 3; n++) await page.keyboard.press('Backspace');
      await page.keyboard.type('3 0');
      await seen(page.getByText('The text can be applied.'));
      await page.keyboard.press('Control+Enter');
      await seen(page.getByText('Applied to figure.skel. One Undo reverts it'));
      await page.keyboard.press('Escape');
      await page.locator('.source-line[data-change="changed"]', { hasText: 'offset 0 3 0' }).waitFor();
      await expect.poll(() => page.locator('.source-lines:focus').count()).toBe(1);
    },
  );

  inPage('follows the selection, selects what is clicked, and shows the line of a message', async ({ page }) => {
    await startOver(page);
    const lit = page.locator('.source-line.is-lit .source-number');
    const shownFile = () => page.locator('.source-file').evaluate((s: HTMLSelectElement) => s.value);
    await dropFiles(page, [{ name: 'figure.skel', bytes: SKEL }]);
    await page.waitForFunction(() => window.marrow.characters().some(({ name }) => name === 'figure'));
    await page.evaluate(() => window.marrow.run('page.tab.source'));
    await seen(page.getByText('11 lines'));
    await page.getByRole('treeitem', { name: 'leg' }).click();
    await lit.first().waitFor();
    await expect.poll(() => lit.allTextContents()).toEqual(['5', '6', '7', '8', '9']);

    await page.locator('.source-line[data-line="4"]').click();
    await page.getByText('hips ry').waitFor();
    await expect.poll(() => lit.allTextContents()).toEqual(['4']);
    await page.keyboard.press('Control+g');
    await page.keyboard.type('6');
    await page.keyboard.press('Enter');
    await page.keyboard.press('Enter');
    await page.getByText('Joint leg', { exact: true }).waitFor();
    await page.keyboard.press('Control+f');
    await page.keyboard.type('ROTY');
    await page.keyboard.press('Enter');
    await page.getByText('Found on line 4').waitFor();

    const note = page.locator('.source-note');
    await page.getByRole('treeitem', { name: 'leg' }).click();
    await expect.poll(() => lit.allTextContents()).toEqual(['5', '6', '7', '8', '9']);
    await dropFiles(page, [{ name: 'figure.skel', bytes: SKEL.replace('-1 1', '-1 x') }]);
    await note.filter({ hasText: 'This text has errors and was not opened' }).waitFor();
    await expect.poll(() => lit.count()).toBe(0);
    await dropFiles(page, [{ name: 'figure.skel', bytes: SKEL }]);
    await note.waitFor({ state: 'hidden' });
    await lit.first().waitFor();
    await page.evaluate(() => {
      const { id = '' } = window.marrow.characters().find(({ name }) => name === 'figure') ?? {};
      window.marrow.run('rig.rename', { characterId: id, joint: 1, name: 'knee' });
    });
    // What the page changed is marked; what it was is shown by a click, and by the switch.
    await seen(note.filter({ hasText: '1 line changed since it was opened' }));
    await expect.poll(() => lit.allTextContents()).toEqual(['5~', '6', '7', '8', '9']);
    await page.keyboard.press('F7');
    const row = (change: string) => page.locator(`.source-line[data-change="${change}"]`);
    await row('changed').filter({ hasText: 'knee' }).click();
    await row('old').filter({ hasText: 'leg' }).waitFor();
    await page.getByRole('option', { name: 'Changed: balljoint knee {' }).waitFor();
    const toggle = page.getByRole('button', { name: 'Changes', exact: true });
    await toggle.click();
    await note.filter({ hasText: 'Edited since it was opened: line numbers are those of the original file' }).waitFor();
    await expect.poll(() => lit.count()).toBe(0);
    await toggle.click();
    // Given again, it is read again, and stays at its line, whatever rows were shown above it.
    await row('changed').click();
    await row('old').waitFor();
    await page.keyboard.press('Control+g');
    await page.keyboard.type('8');
    await page.keyboard.press('Enter');
    const current = page.locator('.source-line.is-current[data-line="8"]');
    await current.waitFor();
    await dropFiles(page, [{ name: 'figure.skel', bytes: SKEL.replace('leg', 'knee') }]);
    await note.waitFor({ state: 'hidden' });
    await row('old').waitFor({ state: 'detached' });
    await current.waitFor();
    await dropFiles(page, [{ name: 'figure.skel', bytes: SKEL }]);
    await page.getByRole('treeitem', { name: 'leg' }).waitFor();
    await note.waitFor({ state: 'hidden' });
    await row('changed').waitFor({ state: 'detached' });

    // The text is edited: errors have their lines, leaving asks, what fits is one step.
    await page.getByRole('button', { name: 'Edit', exact: true }).click();
    const field = page.getByRole('textbox', { name: 'Text of figure.skel' });
    await field.press('Control+Enter');
    await page.getByText('Nothing was edited, so nothing was applied.').waitFor();
    const type = async (text: string) => {
      await page.keyboard.press('Control+a');
      await page.keyboard.insertText(text);
    };
    await type(SKEL.replace('0 1 0', '0 x 0'));
    await seen(page.getByRole('button', { name: /^Line 6: Expected/ }));
    await page.keyboard.press('Control+Enter');
    await page.getByText('Not applied. The text has 1 error.').waitFor();
    await page.keyboard.press('Escape');
    await page.getByRole('alertdialog', { name: 'Discard the edits?' }).waitFor();
    await page.keyboard.press('Escape');
    // Applied while it is checked, it is applied after that.
    await holdWorker(page);
    await type(SKEL.replace('0 1 0', '0 2 0'));
    await expect.poll(() => page.locator('html[data-held]').count()).toBe(1);
    await page.keyboard.press('Control+Enter');
    await page.evaluate(() => window.release?.());
    await seen(page.getByText('Applied to figure.skel. One Undo reverts it'));
    await page.keyboard.press('Escape');
    await seen(note.filter({ hasText: '1 line changed since it was opened' }));
    await row('changed').filter({ hasText: '0 2 0' }).waitFor();
    await page.evaluate(() => window.marrow.run('edit.undo'));
    await note.waitFor({ state: 'hidden' });

    await dropFiles(page, [{ name: 'broken.skel', bytes: BROKEN }]);
    await page.getByRole('button', { name: 'Show line 3 of broken.skel in Source' }).first().click();
    await page.locator('.source-line.is-current[data-line="3"][data-severity="error"]').waitFor();
    await expect.poll(() => shownFile()).toBe('broken.skel');
    // It is corrected where it is shown.
    await page.getByRole('button', { name: 'Edit', exact: true }).click();
    await page.getByRole('textbox', { name: 'Text of broken.skel' }).and(page.locator(':focus')).waitFor();
    await type(BROKEN.replace(' x', ' 2'));
    await page.keyboard.press('Control+Enter');
    await seen(page.getByText('Applied to broken.skel. One Undo reverts it'));
    await page.keyboard.press('Escape');
    await page.locator('.source-line[data-line="3"]:not([data-severity])', { hasText: '-1 2' }).waitFor();
    await dropFiles(page, [{ name: 'broken.skel', bytes: BROKEN.replace(' x', ' 1') }]);
    await page.locator('.source-line[data-line="3"]:not([data-severity])', { hasText: '-1 1' }).waitFor();

    await dropFiles(page, [{ name: 'many.skel', bytes: `balljoint a {${'\n'.repeat(LINES)}offset 0 x 0 }\n` }]);
    const last = LINES + 1;
    const leads = page.getByRole('button', { name: `Show line ${last} of many.skel in Source` }).first();
    await seen(leads);
    await leads.click();
    await page.locator(`.source-line.is-current[data-line="${last}"]`, { hasText: 'offset 0 x 0' }).waitFor();
    await page.getByText('2,000,002 lines').waitFor();
    await page.locator('.source-lines').press('Home');
    await page.locator('.source-line.is-current[data-line="1"]', { hasText: 'balljoint a' }).waitFor();

    // The menu of tabs that have no room is named by the one that is shown.
    await page.setViewportSize({ width: 390, height: 844 });
    await page.evaluate(() => window.marrow.run('page.tab.source'));
    await page.locator('.timeline-more', { hasText: 'Source' }).waitFor();
  });
});
