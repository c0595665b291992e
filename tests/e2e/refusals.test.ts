/** Many files that are refused, and addresses that give none. */
import { describe, expect, it } from 'vitest';
import { dropFiles, withPage } from '../helpers/page.ts';

describe('what is refused', () => {
  it('hundreds of refused files are one message that unfolds, and an address that redirects is refused in words', () =>
    withPage(
      async ({ page, url }) => {
        await page.route('**/given/moved.skel', (route) =>
          route.fulfill({ status: 302, headers: { location: 'https://elsewhere.example/a.skel' } }),
        );
        await page.goto(`${url}?files=given/moved.skel`);
        const line = page.locator('.message-line');
        await line.getByText('the server redirects it').waitFor();
        await line.getByRole('button', { name: 'Dismiss' }).click();

        const files = Array.from({ length: 300 }, (_, i) => ({
          name: `${i}.skel`,
          bytes: 'balljoint a { offset x }',
        }));
        await dropFiles(page, files);
        await line.getByText(/^300 files: not opened\. The first: 0\.skel:1: /).waitFor();
        await line.getByRole('button', { name: 'Details' }).click();
        const list = page.locator('.messages-list');
        // The other is of the address.
        await expect.poll(() => list.locator('.message').count()).toBe(2);
        await expect.poll(() => list.locator('.message-title').first().textContent()).toBe('300 files');
        await list.getByText('Files', { exact: true }).click();
        await list.getByText('0.skel', { exact: true }).waitFor();
        // What is unfolded is bounded, too.
        await expect.poll(() => list.locator('.diagnostic').count()).toBeLessThanOrEqual(200);
      },
      { size: { width: 1024, height: 640 }, blank: true },
    ));
});
