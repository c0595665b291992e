/** The steps of a joint and of a vertex, as the page shows and copies them. */
import type { Locator, Page } from 'playwright-core';
import { expect, it } from 'vitest';
import { compileTake } from '../../src/evaluate/compiled-take.ts';
import { evaluateChannel } from '../../src/evaluate/curves.ts';
import { compileSkeleton, worldMatrices } from '../../src/evaluate/kinematics.ts';
import { dofCountOf, poseAt } from '../../src/evaluate/pose.ts';
import { compileSkin, deform } from '../../src/evaluate/skin/deform.ts';
import { runToEnd } from '../../src/evaluate/steps.ts';
import { FourAttachments, type FourFacts, type KeptFour } from '../../src/teaching/program/four-attachments.ts';
import { dropFiles, withPage } from '../helpers/page.ts';
import { describeShared, sharedBytes } from '../helpers/shared.ts';
import { characterOf, SHARED } from '../teaching/lesson-files.ts';

const WASP = ['wasp.skel', 'wasp.skin', 'wasp_walk.anim'];

/** The first table of a card. */
const tableOf = (page: Page, card: string) => page.locator(`.step-card[aria-label="${card}"] .grid`).first();

/** A table as copied by keyboard: rows of numbers. */
async function copied(page: Page, table: Locator): Promise<readonly (readonly number[])[]> {
  await table.locator('[tabindex="0"]').focus();
  await page.keyboard.press('ControlOrMeta+Enter');
  await table.locator('.copied').first().waitFor();
  const text = await page.evaluate(() => navigator.clipboard.readText());
  return text.split('\n').map((line) => line.split(' ').map(Number));
}

/** The skin as `marrow pose --vertices` has it. */
function waspAt(timeSeconds: number) {
  const wasp = characterOf(...SHARED.wasp);
  if (!wasp.skeleton) throw new Error('No skeleton.');
  const dofs = new Float64Array(dofCountOf(wasp));
  const world = new Float64Array(16 * wasp.skeleton.joints.length);
  const skin = compileSkin(wasp.skins[0]);
  const positions = wasp.skins[0].positions.slice();
  const normals = skin.normals.slice();
  poseAt(wasp, timeSeconds, dofs);
  worldMatrices(compileSkeleton(wasp.skeleton), dofs, world);
  deform(skin, world, positions, normals, positions, normals);
  return { positions, normals };
}

/** As `marrow channels` has it. */
function rxOfHipAt(timeSeconds: number): number {
  const take = characterOf(...SHARED.wasp).takes[0];
  // Three of the root's translation, three of each joint before the hip, which is number 7.
  return evaluateChannel(compileTake(take), 3 + 3 * 7, timeSeconds);
}

describeShared('the steps of the wasp', () => {
  it('the steps end at the numbers that are drawn, and their symbols and slider change nothing in the document', () =>
    withPage(async ({ page }) => {
      await page.context().grantPermissions(['clipboard-read', 'clipboard-write']);
      await dropFiles(
        page,
        WASP.map((name) => ({ name, bytes: sharedBytes(`data/cse169/${name}`) })),
      );
      await page.waitForFunction(() => window.marrow.characters()[0]?.vertexCount === 694);
      await page.evaluate(() => window.marrow.seek(0.4));
      const opened = await page.evaluate(() => window.marrow.steps().undo);
      await page.evaluate(() => window.marrow.run('page.tab.steps'));
      await page.locator('.steps .empty').waitFor();
      await page.locator('[role=treeitem]', { hasText: 'hip_03_r' }).click();
      const world = await copied(page, tableOf(page, 'W₇'));
      const drawn = await page.evaluate(() => window.marrow.worldMatrices()[7]);
      expect(world.flatMap((_, r) => world.map((row) => row[r]))).toEqual(drawn);

      const slider = page.getByRole('slider', { name: 'Steps applied in the viewport' });
      await slider.fill('2');
      await page.locator('.step-card.now[aria-label="Rz(rz)"]').waitFor();
      await page.locator('.step-card[aria-label="Rz(rz)"] .symbol').focus();
      await page.locator('.inspector .dof.lit', { hasText: 'rz' }).waitFor();
      await page.locator('.step-card[aria-label="W₀"] .symbol').focus();
      await page.locator('.row-joint.lit', { hasText: 'root' }).waitFor();

      await page.evaluate(() => window.marrow.run('page.tab.curves'));
      await page.evaluate(() => window.marrow.run('timeline.showsWhy'));
      const [[value]] = await copied(page, page.locator('.why .grid[aria-label="Value"]'));
      expect(value).toBe(rxOfHipAt(0.4));
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
      const meant = waspAt(0.4);
      expect(place).toEqual([...meant.positions.subarray(3 * vertex, 3 * vertex + 3)]);
      expect(normal).toEqual([...meant.normals.subarray(3 * vertex, 3 * vertex + 3)]);
      await expect.poll(() => page.evaluate(() => window.marrow.steps().undo)).toBe(opened);
    }));
});

/** The row of the card, as copied: `vertex`, its index, its displacement, and that as a percentage of the size. */
async function largestOf(page: Page): Promise<readonly number[]> {
  // Of what was copied before.
  await page.locator('.heat-card .copied').first().waitFor({ state: 'detached' });
  const [[, ...numbers]] = await copied(page, page.locator('.heat-card .grid'));
  return numbers;
}

/** What `teaching/program/four-attachments.ts` measures of the pose that is drawn. */
async function measuredOf(page: Page, kept: KeptFour): Promise<FourFacts> {
  const nine = characterOf(...SHARED.nine);
  const world = await page.evaluate(() => window.marrow.worldMatrices().flat());
  const four = new FourAttachments(nine.skins[0], nine.morphs, kept);
  return runToEnd(four.follow(new Float64Array(nine.morphs.length), Float64Array.from(world)));
}

describeShared('the heat map of four attachments', () => {
  it('the card of four attachments has the numbers of the pose that is drawn, and selects the vertex', () =>
    withPage(
      async ({ page }) => {
        await page.context().grantPermissions(['clipboard-read', 'clipboard-write']);
        const names = ['nine.skel', 'nine.skin'];
        await dropFiles(
          page,
          names.map((name) => ({ name, bytes: sharedBytes(`data/synthetic/${name}`) })),
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
      { size: { width: 1440, height: 900 } },
    ));
});
