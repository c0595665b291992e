/** Takes by the hundred: listed, played, judged by keys, saved, and read back. */
import { expect, it } from 'vitest';
import { dropFiles, withPage } from '../helpers/page.ts';

const OFFSETS = 'OFFSET 0 90 0 CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation';
const HEAD = 'JOINT head { OFFSET 0 60 0 CHANNELS 3 Zrotation Xrotation Yrotation End Site { OFFSET 0 20 0 } }';

/** Half a second at 30 frames a second, in which the hips rise; they jump sideways at frame 8 if it is broken. */
function take(index: number, isBroken: boolean): string {
  const rows = Array.from(
    { length: 16 },
    (_, f) => `${isBroken && f === 8 ? 30 : 0} ${90 + index + f / 4} 0 0 0 0 0 0 0`,
  );
  return `HIERARCHY ROOT hips { ${OFFSETS} ${HEAD} } MOTION Frames: 16 Frame Time: 0.0333333\n${rows.join('\n')}\n`;
}
const FILES = Array.from({ length: 24 }, (_, i) => ({ name: `take${i + 1}.bvh`, bytes: take(i, i === 1) }));

it('takes by the hundred are listed, played, judged by keys and saved, and the list gives its verdicts back', () =>
  withPage(async ({ page, download }) => {
    await dropFiles(page, FILES);
    const table = page.getByRole('grid', { name: 'Takes in review' });
    const row = (name: string) => table.getByRole('row').filter({ hasText: name });
    await expect.poll(() => page.locator('.review-count').textContent()).toBe('24 takes');
    expect(await page.evaluate(() => window.marrow?.characters())).toEqual([]);
    await expect.poll(() => row('take24').or(row('take9')).first().isVisible()).toBe(true);

    // The broken one, its flag, and the moment that it leads to.
    await table.focus();
    await page.keyboard.press('Home');
    await page.keyboard.press('ArrowDown');
    await expect.poll(() => row('take2').first().textContent()).toContain('spike');
    const flag = page.getByRole('button', { name: /Spike of hips/ });
    await flag.click();
    const time = page
      .getByLabel('Time in seconds')
      .or(page.getByLabel('Time', { exact: true }))
      .first();
    await expect.poll(() => time.inputValue()).toBe('0.267');

    // A thumbnail moves under the pointer.
    const thumbnail = row('take2').first().locator('canvas');
    const picture = () => thumbnail.evaluate((canvas: HTMLCanvasElement) => canvas.toDataURL());
    await thumbnail.hover({ position: { x: 1, y: 16 } });
    await expect.poll(picture).not.toBe('data:,');
    const first = await picture();
    await thumbnail.hover({ position: { x: 38, y: 16 } });
    await expect.poll(picture).not.toBe(first);

    await table.focus();
    await page.keyboard.press('b');
    await expect.poll(() => row('take2').first().textContent()).toContain('Bad');
    await page.keyboard.press('j');
    await page.keyboard.press('g');
    await page.keyboard.press('4');
    await expect.poll(() => row('take3').first().textContent()).toContain('★★★★');
    await page.getByLabel('Tags').fill('rises, calm');
    await page.getByLabel('Tags').press('Enter');
    await expect.poll(() => row('take3').first().textContent()).toContain('rises, calm');

    const saved = await download(() => page.evaluate(() => window.marrow?.run('review.saveCsv')));
    expect(saved.name).toBe('review.csv');
    const lines = saved.text.split('\r\n');
    expect(lines[2]).toMatch(/^take2\.bvh,bad,,,,16,30,0\.5,2,0\.\d+,m,spike,spike 0\.267 hips$/);
    expect(lines[3]).toMatch(/^take3\.bvh,good,4,"rises; calm",,16,30,0\.5,2,,,,$/);

    // Undone one by one, and given back by the list.
    for (let i = 0; i < 4; i++) await page.evaluate(() => window.marrow?.undo());
    await expect.poll(() => row('take3').first().textContent()).not.toContain('Good');
    await dropFiles(page, [{ name: 'review.csv', bytes: saved.text }]);
    await expect.poll(() => row('take3').first().textContent()).toContain('rises, calm');
    await expect.poll(() => row('take2').first().textContent()).toContain('Bad');

    await page.evaluate(() => window.marrow?.run('review.openGood'));
    await expect
      .poll(() => page.evaluate(() => window.marrow?.characters().map(({ name }) => name)))
      .toEqual(['take3']);
  }));
