/** Another program's numbers on the page: dropped, pasted, at several times, and wrong ones. */
import type { Page } from 'playwright-core';
import { describe, expect } from 'vitest';
import { Evaluator } from '../../src/teaching/program/evaluator.ts';
import { type Program, RIGHT_PROGRAM } from '../../src/teaching/program/program.ts';
import { COMPARE_COLOURS } from '../../src/view/compare/compare-colours.ts';
import { inOnePage, startOver } from '../helpers/one-page.ts';
import { dropFiles } from '../helpers/page.ts';
import { characterOf, OWN, ownBytes } from '../teaching/lesson-files.ts';

const given = (...names: readonly string[]) => names.map((name) => ({ name, bytes: ownBytes(name) }));
const evaluator = new Evaluator(characterOf(...OWN.crawler));

/** World matrices of the crawler at some times, as a program prints them, the joints moved that are given. */
function printed(
  times: readonly (number | undefined)[],
  moved: readonly number[] = [],
  program: Program = RIGHT_PROGRAM,
): string {
  return times
    .map((time) => {
      const { world } = evaluator.frame(program, time, { local: false, vertices: false, normals: false });
      const rows = Array.from({ length: world.length / 16 }, (_, j) => {
        const row = [...world.subarray(16 * j, 16 * j + 16)];
        if (moved.includes(j)) row[12] += 1;
        return row.join(' ');
      });
      return `${time === undefined ? '' : `time ${time}\n`}${rows.join('\n')}`;
    })
    .join('\n');
}

/** By a program that multiplies the rotations of balls in the reverse order. */
const REVERSED: Program = { ...RIGHT_PROGRAM, joints: { ...RIGHT_PROGRAM.joints, order: { is: 'zyx', for: 'balls' } } };

/** Vertices at 0.8 s by a program that leaves out the bindings, and which of them is farthest from where it should be. */
function unbound(): { readonly text: string; readonly worst: number } {
  const only = { local: false, vertices: true, normals: false };
  const program: Program = { ...RIGHT_PROGRAM, skin: { ...RIGHT_PROGRAM.skin, binding: 'none' } };
  const right = evaluator.frame(RIGHT_PROGRAM, 0.8, only).vertices.slice();
  const wrong = evaluator.frame(program, 0.8, only).vertices;
  const away = Array.from({ length: right.length / 3 }, (_, v) =>
    Math.hypot(...[0, 1, 2].map((k) => wrong[3 * v + k] - right[3 * v + k])),
  );
  const rows = away.map((_, v) => wrong.subarray(3 * v, 3 * v + 3).join(' '));
  return { text: `# time 0.8\n${rows.join('\n')}\n`, worst: away.indexOf(Math.max(...away)) };
}

const legend = (page: Page) => page.locator('.compare-legend');
const choose = (page: Page, name: string) => legend(page).getByRole('radio', { name, exact: true }).click();
/** The theme of the tests is light. */
const OWN_ERROR = COMPARE_COLOURS.light.own;

/** The colour of the page at a place in the character's space. */
async function colourAt(page: Page, place: ArrayLike<number>): Promise<string> {
  const at = await page.evaluate((point) => window.marrow.pointOnPage(point), [place[0], place[1], place[2]] as const);
  if (!at) throw new Error('The place is not in view.');
  const clip = { x: Math.round(at.x), y: Math.round(at.y), width: 1, height: 1 };
  const png = (await page.screenshot({ clip })).toString('base64');
  return page.evaluate(async (data) => {
    const blob = new Blob([Uint8Array.from(atob(data), (c) => c.charCodeAt(0))]);
    const g = new OffscreenCanvas(1, 1).getContext('2d');
    g?.drawImage(await createImageBitmap(blob), 0, 0);
    const pixel = g?.getImageData(0, 0, 1, 1).data ?? [];
    return `#${[...pixel]
      .slice(0, 3)
      .map((byte) => byte.toString(16).padStart(2, '0'))
      .join('')}`;
  }, png);
}

/** What is drawn is where theirs and ours are, and nothing of it is left on the GPU. */
async function expectDrawn(page: Page): Promise<void> {
  const onGpu = async () => {
    await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => setTimeout(resolve))));
    const { geometries, textures } = await page.evaluate(() => window.marrow.stats());
    return { geometries, textures };
  };
  const withoutSkin = await onGpu();
  await dropFiles(page, given('crawler.skin', 'crawler.png'));
  await page.waitForFunction(() => window.marrow.characters()[0]?.vertexCount === 484);
  await page.evaluate(() => window.marrow.seek(0.8));
  await page.evaluate(() => window.marrow.run('page.tab.curves'));
  // Two of a skin hold numbers; its picture comes when it is decoded.
  await expect.poll(async () => (await onGpu()).textures).toBe(withoutSkin.textures + 3);
  const before = await onGpu();

  const moved = 3;
  await dropFiles(page, [{ name: 'moved.txt', bytes: printed([0.8], [moved]) }]);
  await legend(page).getByText('own error').waitFor();
  await page.evaluate(() => window.fillPixels(true));
  await choose(page, 'Marrow’s');
  const ours = (await page.evaluate(() => window.marrow.worldMatrices()))[moved];
  const theirs = [ours[12] + 1, ours[13], ours[14]];
  const awayFromOwnError = async () => {
    const drawn = bytesOf(await colourAt(page, ours.slice(12)));
    return Math.max(...bytesOf(OWN_ERROR).map((byte, i) => Math.abs(byte - drawn[i])));
  };
  // Slightly shaded.
  await expect.poll(awayFromOwnError).toBeLessThan(12);
  const bluenessOfTheirs = async () => {
    const [red, , blue] = bytesOf(await colourAt(page, theirs));
    return blue - red;
  };
  // In the frames before, theirs are drawn too.
  await expect.poll(bluenessOfTheirs).toBeLessThan(40);
  await choose(page, 'Yours');
  await expect.poll(bluenessOfTheirs).toBeGreaterThan(40);
  await page.evaluate(() => window.fillPixels(false));

  await page.evaluate(() => window.marrow.run('compare.stop'));
  await legend(page).waitFor({ state: 'detached' });
  await expect.poll(() => onGpu()).toEqual(before);

  const { text, worst } = unbound();
  await dropFiles(page, [{ name: 'skin.txt', bytes: text }]);
  await legend(page)
    .getByRole('button', { name: new RegExp(`^Worst: vertex ${worst}\\b`) })
    .click();
  await page.locator('.facts-head .label', { hasText: `Vertex ${worst}` }).waitFor();
}

const bytesOf = (colour: string) => [1, 3, 5].map((at) => Number.parseInt(colour.slice(at, at + 2), 16));

const banner = (page: Page) => page.locator('.compare-banner');
const says = (page: Page, text: string | RegExp) =>
  expect.poll(() => banner(page).getByText(text).isVisible()).toBe(true);
/** Waits for the mark of a joint in the outliner. */
const marked = (page: Page, joint: string, mark: string) =>
  page.locator(`.row-joint:has-text("${joint}") .compare-swatch[aria-label="${mark}"]`).waitFor();

const inPage = inOnePage({ drawn: 'later' }, ({ page }) =>
  page.context().grantPermissions(['clipboard-read', 'clipboard-write']),
);

/** Without numbers and pixels of before. */
async function startComparing(page: Page): Promise<void> {
  await startOver(page);
  await page.evaluate(async () => {
    window.fillPixels(false);
    try {
      await window.marrow.run('compare.stop');
    } catch {
      // Nothing is compared.
    }
  });
}

describe('another program’s numbers', () => {
  inPage(
    'without a take, numbers of time 0 are marked at once; Ctrl+V compares from anywhere, and Enter selects',
    async ({ page }) => {
      await startComparing(page);
      const paste = async (text: string) => {
        await page.evaluate((copied) => navigator.clipboard.writeText(copied), text);
        await page.keyboard.press('ControlOrMeta+v');
      };
      await dropFiles(page, [
        ...given('crawler.skel'),
        { name: 'mine.txt', bytes: `time 0\n${printed([undefined], [22])}` },
      ]);
      await says(page, /^First wrong: tibia_r2/);
      await legend(page).getByText('own error').waitFor();
      await expect
        .poll(() =>
          banner(page)
            .getByRole('button', { name: /^Go to/ })
            .count(),
        )
        .toBe(0);

      const panel = page.locator('.compare');
      const selected = page.locator('[role=treeitem][aria-selected=true]', { hasText: 'tibia_r2' });
      const grid = panel.getByRole('grid', { name: 'Joints' });
      for (const key of ['Enter', 'Space']) {
        await page.evaluate(() => window.marrow.run('select.nothing'));
        await selected.waitFor({ state: 'detached' });
        await grid.focus();
        await page.keyboard.press(key);
        await selected.waitFor();
      }

      await page.getByRole('application', { name: 'Viewport' }).focus();
      await paste(printed([undefined]));
      await says(page, /^pasted\.txt instead of mine\.txt\. All agree/);
      // Clicked buttons let go of the focus: no field of the tab has it.
      const asks = page.getByRole('button', { name: 'Paste numbers' });
      await asks.click();
      await asks.click();
      await paste(printed([undefined], [22]));
      await says(page, /^First wrong: tibia_r2/);
      await paste('x');
      const refusal = 'Expected numbers to compare on the clipboard, found other text.';
      await page.locator('.message-line').getByText(refusal).waitFor();

      await asks.click();
      const field = panel.getByLabel(/^Print your world matrices/);
      await expect.poll(() => field.evaluate((own) => own === document.activeElement)).toBe(true);
      await paste(printed([undefined]));
      await expect.poll(() => field.inputValue()).toBe(printed([undefined]));
      await page.keyboard.press('ControlOrMeta+Enter');
      await says(page, /^All agree/);
    },
  );

  inPage(
    'dropped numbers get a banner, marks of joints, causes, and theirs beside ours; time moves between those compared',
    async ({ page }) => {
      await startComparing(page);
      await dropFiles(page, [
        ...given('crawler.skel', 'crawler_walk.anim'),
        { name: 'mine@1.5.txt', bytes: printed([1.5], [], REVERSED) },
      ]);
      await says(
        page,
        'First wrong: body. You multiply Rx·Ry·Rz; it should be Rz·Ry·Rx. Explains all 25 wrong joints.',
      );
      const { undo } = await page.evaluate(() => window.marrow.steps());
      await marked(page, 'root', 'agrees');
      await marked(page, 'body', 'own error');
      const panel = page.locator('.compare');
      await panel.getByText('rotation-order', { exact: true }).waitFor();

      await panel.locator('.compare-row', { hasText: 'femur_l1' }).click();
      await page.locator('[role=treeitem][aria-selected=true]', { hasText: 'femur_l1' }).waitFor();
      const ours = panel.locator('section[aria-label=Marrow’s] .number');
      const drawn = await page.evaluate(() => window.marrow.worldMatrices()[9]);
      await expect
        .poll(async () => (await ours.allTextContents()).map((text) => Number(text.replace('−', '-'))).slice(0, 12))
        .toEqual(Array.from({ length: 12 }, (_, i) => expect.closeTo(drawn[4 * (i % 4) + Math.floor(i / 4)], 2)));
      await panel.getByRole('button', { name: /^See its steps/ }).click();
      await page.locator('.step-card[aria-label="W₉"]').waitFor();

      // Another time: nothing is marked, and the banner leads back.
      await page.evaluate(() => window.marrow.seek(0.4));
      await page.locator('.row-joint .compare-swatch').first().waitFor({ state: 'detached' });
      await legend(page).waitFor({ state: 'detached' });
      await banner(page).getByRole('button', { name: 'Go to 1.5 s' }).click();
      await marked(page, 'body', 'own error');

      // Of the same name: in its place.
      await dropFiles(page, [{ name: 'mine@1.5.txt', bytes: printed([1.5]) }]);
      // This message goes by itself.
      await page.getByText('mine@1.5.txt replaced the earlier numbers of that name.').waitFor();
      await says(page, /^All agree: 26 world matrices at 1.5 s/);
      await dropFiles(page, [{ name: 'more.txt', bytes: printed([0.5, 1], [8, 9, 10]) }]);
      await says(page, /^Agrees at 1.5 s\. First wrong in more\.txt at 0.5 s: coxa_l1\. No known mistake/);
      await banner(page).getByRole('button', { name: 'Details' }).click();
      await panel.getByText('What differs: Joint coxa_l1 and all below it at 2 of 3 times').waitFor();
      await panel.getByRole('button', { name: '1 s, differs' }).click();
      await marked(page, 'femur_l1', 'inherited');

      // An edit compares again.
      await page.evaluate(() => window.marrow.run('pose.resetToZero'));
      await says(page, /^First wrong in more\.txt at 1 s: root/);
      await page.keyboard.press('ControlOrMeta+z');
      await says(page, /^First wrong in more\.txt at 1 s: coxa_l1/);

      await panel.getByRole('grid', { name: 'Joints' }).focus();
      await page.keyboard.press('Escape');
      await banner(page).waitFor({ state: 'hidden' });
      await expect.poll(() => page.locator('.row-joint .compare-swatch').count()).toBe(0);
      await expect.poll(async () => (await page.evaluate(() => window.marrow.steps())).undo).toBe(undo);

      const pasted = printed([1.5], [22]);
      await panel.getByLabel(/^Print your world matrices/).fill(pasted);
      await panel.getByRole('button', { name: 'Compare', exact: true }).click();
      await says(page, /^First wrong: tibia_r2/);
      // By keys too, in the place of what was pasted before.
      await page.evaluate((text) => navigator.clipboard.writeText(text), printed([1.5]));
      await panel.getByRole('grid', { name: 'Joints' }).focus();
      await page.keyboard.press('ControlOrMeta+v');
      await says(page, /^All agree: 26 world matrices/);
      await dropFiles(page, [{ name: 'short.txt', bytes: 'time 1.5\n1 2 3\n' }]);
      const line = page.locator('.message-line');
      await line.getByText(/^short\.txt:2: not compared\. Expected 12 or 16 numbers for each of 26 joints/).waitFor();
      await line.getByRole('button', { name: 'Show line 2 of short.txt in Source' }).click();
      await page.locator('.source-lines').getByText('1 2 3').waitFor();
      await page.evaluate(() => window.marrow.run('compare.stop'));

      // Steps of the pose that was compared, not of the one shown.
      await dropFiles(page, [{ name: 'still.txt', bytes: printed([undefined]) }]);
      await says(page, /^All agree: 26 world matrices in the file pose/);
      await page.evaluate(() => window.marrow.run('page.tab.compare'));
      await panel.locator('.compare-row', { hasText: 'femur_l1' }).click();
      await panel.getByRole('button', { name: /^See its steps/ }).click();
      await page.getByRole('button', { name: 'File pose', pressed: true }).waitFor();
      const still = printed([undefined]).split('\n')[9].split(' ').map(Number);
      const steps = page.locator('.step-card[aria-label="W₉"] .grid').first().locator('.number');
      await expect
        .poll(async () => (await steps.allTextContents()).map((text) => Number(text.replace('−', '-'))).slice(0, 4))
        .toEqual([0, 4, 8, 12].map((at) => expect.closeTo(still[at], 2)));
      await page.evaluate(() => window.marrow.run('compare.stop'));

      // Of the same times under another name: which is compared is said.
      await dropFiles(page, [{ name: 'mine@1.5.txt', bytes: printed([1.5]) }]);
      await says(page, /^All agree: 26 world matrices/);
      await dropFiles(page, [{ name: 'other.txt', bytes: printed([1.5], [8]) }]);
      await says(page, /^other\.txt instead of mine@1\.5\.txt\. First wrong: /);
      await page.evaluate(() => window.marrow.run('page.tab.compare'));
      await panel.locator('.compare-files').getByText('instead of mine@1.5.txt').waitFor();
      await page.evaluate(() => window.marrow.run('compare.stop'));

      await expectDrawn(page);
    },
  );
});
