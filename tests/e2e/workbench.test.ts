import { describe, expect } from 'vitest';
import { readAnim } from '../../src/formats/anim/read.ts';
import { testAll } from '../helpers/check.ts';
import { inOnePage, undoAll } from '../helpers/one-page.ts';
import { dropFiles } from '../helpers/page.ts';
import { describeShared, sharedBytes } from '../helpers/shared.ts';
import { CURVES, drop, expectDrawn } from './checks/curves.ts';
import { course, names, opened, REFERENCE, WASP } from './checks/workbench.ts';

const broken = (name: string) => ({ name, bytes: sharedBytes(`data/malformed/${name}`) });

const inPage = inOnePage();

describe('the page', () => {
  inPage('undoes and redoes what a slider does', async ({ page }) => {
    await opened(page);
    await undoAll(page);
    await page.evaluate(() => {
      window.marrow.pause();
      window.marrow.run('pose.setDofs', { dofs: [{ index: 1, value: 0.25 }] });
    });
    const height = () => page.evaluate(() => window.marrow.characters()[0].dofs[1]);
    await expect.poll(() => height()).toBe(0.25);
    await page.keyboard.press('Control+z');
    await expect.poll(() => height()).not.toBe(0.25);
    await page.keyboard.press('Control+Shift+z');
    await expect.poll(() => height()).toBe(0.25);
  });
});

describeShared('the page with the course’s files', () => {
  testAll(REFERENCE, inPage);

  inPage('leaves everything as it was when a file is wrong, and shows where', async ({ page }) => {
    await opened(page);
    await undoAll(page);
    await dropFiles(page, course(['test.skel']));
    await opened(page, 'test');
    await dropFiles(page, [broken('not-a-number.skel')]);
    await page.getByText('1,5').first().waitFor();
    await expect.poll(() => names(page)).toEqual(['test']);
    await page.keyboard.press('Control+z');
    await opened(page);
    await expect.poll(() => names(page)).not.toContain('test');
  });

  inPage('takes a drop back in one step, and gives it again', async ({ page }) => {
    await opened(page);
    await undoAll(page);
    const [sample] = await names(page);
    await dropFiles(page, course(WASP));
    await opened(page, 'wasp');
    await page.keyboard.press('Control+z');
    await expect.poll(() => names(page)).toEqual([sample]);
    await page.keyboard.press('Control+y');
    await expect.poll(() => names(page)).toEqual(['wasp']);
  });

  inPage('saves what it opened as the same text that it reads again', async ({ page }) => {
    await opened(page);
    await undoAll(page);
    await dropFiles(page, course(WASP));
    await opened(page, 'wasp');
    for (const name of WASP) {
      const first = await page.evaluate((n) => window.marrow.save(n), name);
      const diagnostics = await page.evaluate(([n, content]) => window.marrow.open([{ name: n, content }]), [
        name,
        first,
      ] as const);
      expect(diagnostics.filter((d) => d.severity !== 'info')).toEqual([]);
      await expect.poll(() => page.evaluate((n) => window.marrow.save(n), name)).toBe(first);
    }
    await expect.poll(() => names(page)).toEqual(['wasp']);
  });
});

testAll(CURVES, inPage);

describeShared('the sample animation of the course', () => {
  inPage('the sample animation of the course is drawn where the evaluator says', async ({ page }) => {
    const bytes = sharedBytes('data/cse169/sample.anim');
    await drop('sample.anim', bytes)(page);
    const take = readAnim(bytes, 'sample.anim').value;
    if (!take) throw new Error('sample.anim could not be read.');
    await expectDrawn(page, take);
  });
});
