/** A lab's day in one page: takes listed, played, judged by keys and saved; measured, marked, and there after a reload. */
import { expect, it } from 'vitest';
import { RULER_HEIGHT } from '../../src/ui/editors/transport/scrubber-picture.ts';
import { fitWindow } from '../../src/ui/widgets/time/time-window.ts';
import { dropFiles, withPage } from '../helpers/page.ts';
import { kept, restore } from './checks/autosave.ts';

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

it('takes by the hundred are judged by keys and saved, then measured and marked, and all is there after a reload', () =>
  withPage(async ({ page, download }) => {
    await dropFiles(page, FILES);
    const table = page.getByRole('grid', { name: 'Takes in review' });
    const row = (name: string) => table.getByRole('row').filter({ hasText: name });
    await expect.poll(() => page.locator('.review-count').textContent()).toBe('24 takes');
    await expect.poll(() => page.evaluate(() => window.marrow?.characters())).toEqual([]);
    await expect.poll(() => row('take24').or(row('take9')).first().isVisible()).toBe(true);

    // The broken one, its flag, and the moment that it leads to.
    await table.focus();
    await page.keyboard.press('Home');
    await page.keyboard.press('ArrowDown');
    await expect.poll(() => row('take2').first().textContent()).toContain('spike');
    const flag = page.getByRole('button', { name: /Spike hips/ });
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

    // The size of the worst flag sorts, from the top.
    await page.getByRole('columnheader', { name: 'Worst' }).click();
    await expect.poll(() => table.locator('[aria-rowindex="2"]').textContent()).toContain('take2');
    await expect.poll(() => table.evaluate((grid) => grid.scrollTop)).toBe(0);

    // Verdicts are unsaved work, which Ctrl+S saves.
    await page.getByLabel('Notes').fill('again, slower');
    await page.getByLabel('Notes').press('Tab');
    await expect.poll(() => page.title()).toBe('• review.csv – Marrow');
    const again = await download(() => page.keyboard.press('Control+s'));
    expect(again.text).toContain('again, slower');
    await expect.poll(() => page.title()).toBe('Marrow');

    await page.evaluate(() => window.marrow?.run('review.openGood'));
    await expect
      .poll(() => page.evaluate(() => window.marrow?.characters().map(({ name }) => name)))
      .toEqual(['take3']);

    // Measure: values at the playhead, the readout of another frame, two takes overlaid, and exact numbers.
    await dropFiles(page, [{ name: 'step.bvh', bytes: take(10, false) }]);
    await page.waitForFunction(() => window.marrow.characters().length === 2);
    await page.evaluate(() => window.marrow.run('page.tab.measure'));
    const legend = page.locator('.measure-legend li');
    await expect.poll(() => legend.count()).toBe(2);
    // Half a second fills the plot, though nobody fitted it: at the right is its end, not two seconds.
    const plot = page.getByRole('application', { name: /over time/ });
    const { width: plotWidth = 0 } = (await plot.boundingBox()) ?? {};
    await plot.click({ position: { x: 0.97 * plotWidth, y: 60 } });
    await expect.poll(() => time.inputValue()).toMatch(/^0\.5/);
    await page.getByRole('combobox', { name: 'Quantity' }).selectOption('height');
    const above = page.locator('.measure .time-picture canvas').nth(1);
    const drawn = () =>
      above.evaluate(async (canvas: HTMLCanvasElement) => {
        await new Promise((next) => requestAnimationFrame(() => requestAnimationFrame(next)));
        return canvas.toDataURL();
      });
    const plain = await drawn();
    const box = await above.boundingBox();
    if (!box) throw new Error('the plot is not shown');
    await expect
      .poll(async () => {
        // Over the whole height: somewhere it meets a line.
        for (let y = 30; y < box.height; y += 8) {
          await page.mouse.move(box.x + box.width / 6, box.y + y);
          if ((await drawn()) !== plain) return true;
        }
        return false;
      })
      .toBe(true);
    await page.getByRole('button', { name: 'Values', exact: true }).click();
    const csv = await download(() => page.getByRole('menuitem', { name: 'Save as CSV' }).click());
    const [head, ...rows] = csv.text.trim().split('\r\n');
    expect([csv.name, head]).toEqual(['height.csv', 'time (s),take3: hips height (y) (m),step: hips height (y) (m)']);
    const heights = rows.map((line) => line.split(',').slice(1).map(Number));
    expect(heights).toHaveLength(16);
    // Both rise by a quarter of a unit a frame, which is one of those that are guessed.
    const unit = (heights[12][0] - heights[0][0]) / 3;
    expect(Math.min(...[0.01, 0.0254, 1].map((known) => Math.abs(known - unit)))).toBeLessThan(1e-9);
    expect(heights[15][1] - heights[0][1]).toBeCloseTo(15 * 0.25 * unit, 9);
    for (const frame of [0, 12]) {
      await page.evaluate((f) => window.marrow.seek(f * 0.0333333), frame);
      const values = heights[frame].map((height) => Number(height.toFixed(3)));
      await expect
        .poll(async () =>
          (await legend.allTextContents()).map((text) => Number(/hips(.*) m$/.exec(text)?.[1].replace('−', '-'))),
        )
        .toEqual(values);
    }

    // Markers: set, named, dragged, a span, undone, and carried through speed and cutting out.
    const markers = async () => JSON.parse(await page.evaluate(() => window.marrow.save('step.markers.json')));
    await page.evaluate(() => window.marrow.seek(0.2));
    await page.keyboard.press('m');
    await expect.poll(markers).toEqual([{ time: 0.2, label: '1' }]);
    await page.evaluate(() => window.marrow.run('marker.list'));
    const dialog = page.getByRole('dialog', { name: 'Markers' });
    await dialog.getByLabel('Label of marker 1').fill('rises');
    await dialog.getByLabel('Label of marker 1').press('Tab');
    await expect.poll(markers).toEqual([{ time: 0.2, label: 'rises' }]);
    await dialog.getByRole('button', { name: 'Add span of playback range' }).click();
    await expect.poll(async () => (await markers()).length).toBe(2);
    await dialog.getByRole('button', { name: 'Done' }).click();
    const scrubber = await page.locator('canvas.scrubber').boundingBox();
    if (!scrubber) throw new Error('the scrubber is not shown');
    const times = fitWindow([0, 0.5], scrubber.width);
    const at = (seconds: number) =>
      [
        scrubber.x + ((seconds - times.from) / (times.to - times.from)) * scrubber.width,
        scrubber.y + RULER_HEIGHT + 4,
      ] as const;
    await page.mouse.move(...at(0.2));
    await page.mouse.down();
    await page.mouse.move(...at(0.25));
    await page.mouse.move(...at(0.3));
    await expect.poll(async () => (await markers())[1].time).toBeCloseTo(0.3, 3);
    await page.mouse.up();
    await page.evaluate(() => window.marrow.undo());
    const span = { time: 0, end: expect.closeTo(0.5, 3), label: '2' };
    await expect.poll(markers).toEqual([span, { time: 0.2, label: 'rises' }]);
    const timesAfter = async (command: string, args: object) => {
      await page.evaluate(
        ([id, more]) => {
          const { id: characterId = '' } = window.marrow.characters().find(({ name }) => name === 'step') ?? {};
          return window.marrow.run(id, { takes: [{ characterId, take: 0 }], ...more });
        },
        [command, args] as const,
      );
      const times = (await markers()).map(({ time }: { time: number }) => Number(time.toFixed(2)));
      await page.evaluate(() => window.marrow.undo());
      return times;
    };
    const slower = await timesAfter('takes.setSpeed', { factor: 0.5 });
    expect(slower).toEqual([0, 0.4]);
    const cut = await timesAfter('takes.cutOut', { from: 0, to: 0.08, overlapSeconds: 0 });
    expect(cut).toEqual([0, 0.1]);
    // Its dialog would be the system's.
    await page.evaluate(() => Object.assign(window, { showSaveFilePicker: undefined }));
    const beside = await download(() => page.keyboard.press('Control+s'));
    expect(beside.name).toBe('step.markers.json');
    expect(beside.text).toContain('rises');
    await expect.poll(() => page.title()).toBe('Marrow');

    // Check take: flags of what is played, each leads to its moment, and to the plots.
    await dropFiles(page, [{ name: 'broken.bvh', bytes: take(3, true) }]);
    await page.waitForFunction(() => window.marrow.characters().some(({ name }) => name === 'broken'));
    await page.evaluate(() => window.marrow.run('page.tab.curves'));
    await page.evaluate(() => window.marrow.run('take.checkTake'));
    const check = page.getByRole('dialog', { name: 'Check take' });
    await check.getByText(/^1 flag: spike/).waitFor();
    await check.getByRole('button', { name: /Spike hips/ }).click();
    await expect.poll(() => time.inputValue()).toBe('0.267');
    await check.getByRole('button', { name: 'Measure feet and speeds' }).click();
    await check.waitFor({ state: 'detached' });
    // The row has no room for all tabs: the menu *More* has the name of the one that is open.
    const open = page.locator('[role=tab][aria-selected=true]:visible, .timeline-more.chosen');
    await expect.poll(() => open.allTextContents()).toContain('Measure');
    await page.evaluate(() => window.marrow.undo());

    // All of it is there after a reload: markers, verdicts, tags and notes.
    await kept(page);
    await page.reload();
    await restore(page);
    await page.waitForFunction(() => window.marrow?.characters().some(({ name }) => name === 'step'));
    await expect.poll(markers).toEqual([span, { time: 0.2, label: 'rises' }]);
    await page.getByRole('tab', { name: 'Review' }).click();
    await expect.poll(() => row('take2').first().textContent()).toContain('Bad');
    await expect.poll(() => row('take3').first().textContent()).toContain('★★★★');
    await expect.poll(() => row('take3').first().textContent()).toContain('rises, calm');
    await expect.poll(() => page.title()).toBe('Marrow');
  }));
