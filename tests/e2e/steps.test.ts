/** The steps of a joint and of a vertex, as the page shows and copies them. */
import type { Locator, Page } from 'playwright-core';
import { describe, expect } from 'vitest';
import { compileTake } from '../../src/evaluate/compiled-take.ts';
import { evaluateChannel } from '../../src/evaluate/curves.ts';
import { compileSkeleton, worldMatrices } from '../../src/evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../src/evaluate/pose.ts';
import { compileSkin, deform } from '../../src/evaluate/skin/deform.ts';
import { runToEnd } from '../../src/evaluate/steps.ts';
import { FourAttachments, type FourFacts, type KeptFour } from '../../src/teaching/program/four-attachments.ts';
import { inOnePage, startOver } from '../helpers/one-page.ts';
import { dropFiles } from '../helpers/page.ts';
import { characterOf, characterOfTexts, OWN, ownBytes } from '../teaching/lesson-files.ts';

const CRAWLER = [...OWN.crawler, 'crawler.png'];

/** The first table of a card. */
const tableOf = (page: Page, card: string) => page.locator(`.step-card[aria-label="${card}"] .grid`).first();

/** A table as copied by keyboard: rows of numbers. */
async function copied(page: Page, table: Locator): Promise<readonly (readonly number[])[]> {
  const isCopied = () => table.locator('.copied').count();
  await expect
    .poll(async () => {
      // A table that is drawn anew with the joint's next pose has lost the key.
      if ((await isCopied()) === 0) {
        await table.locator('[tabindex="0"]').focus();
        await page.keyboard.press('ControlOrMeta+Enter');
      }
      return isCopied();
    })
    .toBeGreaterThan(0);
  const text = await page.evaluate(() => navigator.clipboard.readText());
  return text.split('\n').map((line) => line.split(' ').map(Number));
}

/** The skin as `marrow pose --vertices` has it. */
function crawlerAt(timeSeconds: number) {
  const crawler = characterOf(...OWN.crawler);
  if (!crawler.skeleton) throw new Error('No skeleton.');
  const dofs = new Float64Array(dofCountOf(crawler));
  const world = new Float64Array(16 * crawler.skeleton.joints.length);
  const skin = compileSkin(crawler.skins[0]);
  const positions = crawler.skins[0].positions.slice();
  const normals = skin.normals.slice();
  poseAt(crawler, timeSeconds, dofs);
  worldMatrices(compileSkeleton(crawler.skeleton), dofs, world);
  deform(skin, world, positions, normals, positions, normals);
  return { positions, normals };
}

/** As `marrow channels` has it. */
function rxOfCoxaAt(timeSeconds: number): number {
  const take = characterOf(...OWN.crawler).takes[0];
  // Three of the root's translation, three of each joint before the coxa, which is number 8.
  return evaluateChannel(compileTake(take), 3 + 3 * 8, timeSeconds);
}

const inPage = inOnePage();

describe('the steps of the crawler', () => {
  inPage(
    'the steps end at the numbers that are drawn, and their symbols and slider change nothing in the document',
    async ({ page }) => {
      await startOver(page);
      await page.context().grantPermissions(['clipboard-read', 'clipboard-write']);
      await dropFiles(
        page,
        CRAWLER.map((name) => ({ name, bytes: ownBytes(name) })),
      );
      await page.waitForFunction(() => window.marrow.characters()[0]?.vertexCount === 484);
      await page.evaluate(() => window.marrow.seek(0.4));
      const opened = await page.evaluate(() => window.marrow.steps().undo);
      await page.evaluate(() => window.marrow.run('page.tab.steps'));
      await page.locator('.steps .empty').waitFor();
      await page.locator('[role=treeitem]', { hasText: 'coxa_l1' }).click();
      const world = await copied(page, tableOf(page, 'W₈'));
      const drawn = await page.evaluate(() => window.marrow.worldMatrices()[8]);
      expect(world.flatMap((_, r) => world.map((row) => row[r]))).toEqual(drawn);

      const slider = page.getByRole('slider', { name: 'Steps applied in the viewport' });
      await slider.fill('2');
      await page.locator('.step-card.now[aria-label="Rz(rz)"]').waitFor();
      await page.locator('.step-card[aria-label="Rz(rz)"] .symbol').focus();
      await page.locator('.inspector .dof.lit', { hasText: 'rz' }).waitFor();
      await page.locator('.step-card[aria-label="W₁"] .symbol').focus();
      await page.locator('.row-joint.lit', { hasText: 'body' }).waitFor();

      await page.evaluate(() => window.marrow.run('page.tab.curves'));
      await page.evaluate(() => window.marrow.run('timeline.showsWhy'));
      const [[value]] = await copied(page, page.locator('.why .grid[aria-label="Value"]'));
      expect(value).toBe(rxOfCoxaAt(0.4));
      await page.evaluate(() => window.marrow.run('page.tab.steps'));

      await page.keyboard.press('q');
      const at = await page.evaluate(() => {
        const p = window.marrow.vertices();
        return window.marrow.pointOnPage([p[900], p[901], p[902]]);
      });
      if (!at) throw new Error('The vertex is not in view.');
      await page.mouse.click(at.x, at.y);
      const vertex = Number((await page.locator('.facts-head .label').textContent())?.replace('Vertex ', ''));
      const [place] = await copied(page, tableOf(page, 'v′'));
      const [normal] = await copied(page, tableOf(page, 'n′ = n / |n|'));
      const meant = crawlerAt(0.4);
      expect(place).toEqual([...meant.positions.subarray(3 * vertex, 3 * vertex + 3)]);
      expect(normal).toEqual([...meant.normals.subarray(3 * vertex, 3 * vertex + 3)]);
      await expect.poll(() => page.evaluate(() => window.marrow.steps().undo)).toBe(opened);
    },
  );
});

/** The row of the card, as copied: `vertex`, its index, its displacement, and that as a percentage of the size. */
async function largestOf(page: Page): Promise<readonly number[]> {
  // Of what was copied before.
  await page.locator('.heat-card .copied').first().waitFor({ state: 'detached' });
  const [[, ...numbers]] = await copied(page, page.locator('.heat-card .grid'));
  return numbers;
}

/** A bar of nine joints, one above the other, in whose skin each of 120 vertices follows all of them. */
const NINE = (() => {
  const opening = Array.from(
    { length: 9 },
    (_, j) =>
      `balljoint bone_${j} { offset 0 ${j === 0 ? 0 : 0.25} 0 boxmin -0.05 0 -0.05 boxmax 0.05 0.25 0.05 pose 0.3 0.2 0.1`,
  );
  const places = Array.from({ length: 120 }, (_, v) => {
    const [ring, turn] = [Math.floor(v / 12), (2 * Math.PI * (v % 12)) / 12];
    return [0.2 * Math.cos(turn), 0.25 * ring, 0.2 * Math.sin(turn)] as const;
  });
  const rows = (of: readonly (readonly number[])[]) => of.map((row) => row.join(' ')).join('\n');
  const weights = places.map(([, y]) => {
    const near = Array.from({ length: 9 }, (_, j) => 1 / (0.1 + Math.abs(y - 0.25 * j - 0.1)));
    const sum = near.reduce((all, one) => all + one);
    return [9, ...near.flatMap((one, j) => [j, one / sum])];
  });
  const triangles = Array.from({ length: 108 }, (_, v) => {
    const [below, next] = [v, v % 12 === 11 ? v - 11 : v + 1];
    return [
      [below, next, next + 12],
      [below, next + 12, below + 12],
    ] as const;
  }).flat();
  const bindings = Array.from({ length: 9 }, (_, j) => `matrix {\n1 0 0\n0 1 0\n0 0 1\n0 ${0.25 * j} 0\n}`);
  const normals = places.map(([x, , z]) => [5 * x, 0, 5 * z]);
  return {
    'bar.skel': `${opening.join('\n')}\n${'}'.repeat(9)}\n`,
    'bar.skin': [
      `positions 120 {\n${rows(places)}\n}`,
      `normals 120 {\n${rows(normals)}\n}`,
      `skinweights 120 {\n${rows(weights)}\n}`,
      `triangles ${triangles.length} {\n${rows(triangles)}\n}`,
      `bindings 9 {\n${bindings.join('\n')}\n}\n`,
    ].join('\n'),
  };
})();

/** What `teaching/program/four-attachments.ts` measures of the pose that is drawn. */
async function measuredOf(page: Page, kept: KeptFour): Promise<FourFacts> {
  const nine = characterOfTexts(NINE);
  const world = await page.evaluate(() => window.marrow.worldMatrices().flat());
  const four = new FourAttachments(nine.skins[0], nine.morphs, kept);
  return runToEnd(four.follow(new Float64Array(nine.morphs.length), Float64Array.from(world)));
}

describe('the heat map of four attachments', () => {
  inPage(
    'the card of four attachments has the numbers of the pose that is drawn, and selects the vertex',
    async ({ page }) => {
      await page.setViewportSize({ width: 1440, height: 900 });
      await startOver(page);
      await page.context().grantPermissions(['clipboard-read', 'clipboard-write']);
      await dropFiles(
        page,
        Object.entries(NINE).map(([name, bytes]) => ({ name, bytes })),
      );
      await page.waitForFunction(() => window.marrow.characters()[0]?.vertexCount === 120);
      await page.evaluate(() => window.marrow.run('draw.skin.four'));
      const card = page.getByRole('region', { name: 'Four attachments' });
      await card.getByText('120 of 120 vertices have more than four attachments, up to 9.').waitFor();
      const first = await measuredOf(page, 'largest four normalised');
      await expect
        .poll(() => largestOf(page))
        .toEqual([first.vertex, first.largest, (100 * first.largest) / first.size]);

      await page.evaluate(() =>
        window.marrow.run('pose.setDofs', { dofs: [8, 12, 15, 20].map((index) => ({ index, value: 0.7 })) }),
      );
      const posed = await measuredOf(page, 'largest four normalised');
      expect(posed.largest).not.toBe(first.largest);
      const button = card.getByRole('button', { name: 'vertex' });
      await page.waitForFunction(
        (v) => document.querySelector('.heat-card .link')?.textContent === v,
        `vertex ${posed.vertex}`,
      );
      await card.getByRole('combobox').selectOption('first four');
      const given = await measuredOf(page, 'first four');
      await page.waitForFunction(
        (v) => document.querySelector('.heat-card .link')?.textContent === v,
        `vertex ${given.vertex}`,
      );
      await expect
        .poll(() => largestOf(page))
        .toEqual([given.vertex, given.largest, (100 * given.largest) / given.size]);
      await button.click();
      await page.locator('.facts-head .label', { hasText: `Vertex ${given.vertex}` }).waitFor();

      await page.evaluate(() => window.marrow.run('draw.skin.solid'));
      await card.waitFor({ state: 'hidden' });
    },
  );
});
