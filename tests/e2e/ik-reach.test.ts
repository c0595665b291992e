/** What a drag in IK mode moves on the built page, by real mouse: limbs, the whole body, and nothing else. */
import { expect, it } from 'vitest';
import { inOnePage, startOver } from '../helpers/one-page.ts';
import { dropFiles, withPage } from '../helpers/page.ts';
import { describeShared, sharedBytes } from '../helpers/shared.ts';
import { apart, drawn, intoIk, onPage } from './checks/ik.ts';
import { dragUp, expectArmOnly, type Hold, limbFrom, place, shown } from './checks/limb-drag.ts';

const inPage = inOnePage({ walking: true });

inPage(
  'moves nothing but the arm when the walker’s hand is dragged up, and its feet hold under Full body',
  async ({ page }) => {
    await startOver(page);
    await page.waitForFunction(() => window.marrow.characters()[0]?.name === 'walker');
    await intoIk(page);
    const { names } = await shown(page);
    const hand: Hold = { joint: names.indexOf('hand_l'), point: [0.07, 0, 0], by: [0, -30] };
    const text = () => page.evaluate(() => Promise.all(['walker.skel', 'walker_walk.anim'].map(window.marrow.save)));
    const files = await text();
    await expectArmOnly(page, hand, await limbFrom(page, 'upper_arm_l'));
    await expect.poll(text).toEqual(files);

    await page.getByRole('button', { name: 'Reach: Limb' }).click();
    await page.getByRole('menuitemradio', { name: /^Full body/ }).click();
    await page.getByRole('button', { name: 'Reach: Full body' }).waitFor();
    const before = await shown(page);
    const feet = ['foot_l', 'foot_r', 'toe_l', 'toe_r'].map((name) => names.indexOf(name));
    const low = (j: number) => place(before, j)[1];
    const [lower] = feet.slice(2).sort((a, b) => low(a) - low(b));
    await dragUp(page, hand, async () => {
      const now = await shown(page);
      expect(apart(place(now, lower), place(before, lower))).toBeLessThan(1e-3);
      expect(apart(place(now, names.indexOf('hips')), place(before, names.indexOf('hips')))).toBeGreaterThan(1e-4);
    });
    await page.evaluate(() => window.marrow.undo());
    await expect.poll(text).toEqual(files);

    // A root that is fixed keeps position and turn, wherever the hand goes.
    await page.getByRole('button', { name: 'Root moves', pressed: true }).click();
    await page.getByRole('button', { name: 'Root moves', pressed: false }).waitFor();
    const root = names.indexOf('root');
    await dragUp(page, hand, async () => {
      const now = await shown(page);
      expect(now.worlds[root]).toEqual(before.worlds[root]);
      expect(apart(now.worlds[names.indexOf('chest')], before.worlds[names.indexOf('chest')])).toBeGreaterThan(1e-4);
    });
    await page.evaluate(() => window.marrow.undo());
    const from = await onPage(page, place(before, root));
    await page.getByRole('treeitem', { name: /^root/ }).first().click();
    await page.mouse.move(from.x, from.y);
    await page.mouse.down();
    await page.mouse.move(from.x, from.y - 30, { steps: 4 });
    await drawn(page);
    await expect.poll(() => shown(page)).toEqual(before);
    await page.mouse.up();
    await page.evaluate(() => window.marrow.run('ik.setReach', { reach: 'limb' }));
  },
);

describeShared('captures and axis-angle skeletons', () => {
  inPage('moves nothing but the arm when the hand of a capture is dragged up', async ({ page }) => {
    await startOver(page);
    await dropFiles(page, [{ name: 'walk.bvh', bytes: sharedBytes('data/bvh/cmu-01_01.bvh') }]);
    await page.waitForFunction(() => window.marrow.characters()[0]?.name === 'walk');
    await drawn(page);
    await intoIk(page);
    const { names } = await shown(page);
    await expectArmOnly(
      page,
      { joint: names.indexOf('LeftHand'), point: [0, 0, 0], by: [-25, -25] },
      await limbFrom(page, 'LeftShoulder'),
    );
  });

  it('moves nothing but the arm of an axis-angle skeleton once Limb is chosen; before, all up to the root', () =>
    withPage(async ({ page }) => {
      await dropFiles(page, [{ name: 'human.axskel', bytes: sharedBytes('data/axis-skel/human.axskel') }]);
      await page.waitForFunction(() => window.marrow.characters()[0]?.name === 'human');
      await drawn(page);
      await intoIk(page);
      await page.getByRole('button', { name: 'Reach: Chain' }).waitFor();
      await page.evaluate(() => window.marrow.run('ik.setReach', { reach: 'limb' }));
      await page.getByRole('button', { name: 'Reach: Limb' }).waitFor();
      await expectArmOnly(page, { joint: 9, point: [0, 0.05, 0], by: [8, -25] }, [5, 6, 7, 8, 9]);
    }));
});
