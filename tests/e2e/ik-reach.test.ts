/** What a drag in IK mode moves on the built page, by real mouse: limbs, the whole body, and nothing else. */
import type { Page } from 'playwright-core';
import { expect, it } from 'vitest';
import { transformPoint } from '../../src/math/vec3.ts';
import { dropFiles, withPage } from '../helpers/page.ts';
import { describeShared, sharedBytes } from '../helpers/shared.ts';
import { apart, drawn, intoIk, onPage, type Point, standing, undoLabel } from './checks/ik.ts';

/** CSS pixels: how far a held point of the hand may be from the pointer; the hand may turn about the point pressed. */
const NEAR_POINTER = 8;

/** What is pressed: a point of a joint's space, and how far the mouse goes from there, in CSS pixels. */
interface Hold {
  readonly joint: number;
  readonly point: Point;
  readonly by: readonly [x: number, y: number];
}

interface Shown {
  readonly names: readonly string[];
  readonly worlds: readonly (readonly number[])[];
  readonly dofs: readonly number[];
}

const shown = (page: Page): Promise<Shown> =>
  page.evaluate(() => {
    const [{ joints, dofs }] = window.marrow.characters();
    return { names: joints.map(({ name }) => name), worlds: window.marrow.worldMatrices(), dofs };
  });

/** A point of a joint, by default its pivot. */
function place({ worlds }: Shown, joint: number, point: Point = [0, 0, 0]): Point {
  return transformPoint(Float64Array.from(worlds[joint]), point);
}

/** Presses there and goes up; `there` while the mouse is down. */
async function dragUp(page: Page, { joint, point, by: [dx, dy] }: Hold, there: () => Promise<void>): Promise<void> {
  const from = await onPage(page, place(await shown(page), joint, point));
  await page.mouse.move(from.x, from.y);
  await drawn(page);
  await page.mouse.down();
  await page.mouse.move(from.x + dx, from.y + dy, { steps: 9 });
  await drawn(page);
  const now = await onPage(page, place(await shown(page), joint, point));
  expect(Math.hypot(now.x - from.x - dx, now.y - from.y - dy)).toBeLessThan(NEAR_POINTER);
  await there();
  await page.mouse.up();
}

/** A hand goes up with the mouse, and of all others only its arm moves; undo restores every number. */
async function expectArmOnly(page: Page, hold: Hold, arm: readonly number[]): Promise<void> {
  await page.evaluate(() => window.marrow.run('view.front'));
  await standing(page);
  const before = await shown(page);
  await dragUp(page, hold, async () => {
    const now = await shown(page);
    const moved = now.worlds.flatMap((world, j) => (apart(world, before.worlds[j]) > 1e-9 ? [j] : []));
    expect(moved.filter((j) => !arm.includes(j))).toEqual([]);
    expect(moved).toContain(hold.joint);
    expect(moved.length).toBeGreaterThan(1);
  });
  await expect.poll(() => undoLabel(page)).toMatch(/^Drag /);
  await page.evaluate(() => window.marrow.undo());
  await expect.poll(() => shown(page)).toEqual(before);
}

/** The joint and all below it. */
async function limbFrom(page: Page, name: string): Promise<readonly number[]> {
  return page.evaluate((wanted) => {
    const [{ joints }] = window.marrow.characters();
    const found = new Set<number>();
    for (const joint of joints) if (joint.name === wanted || found.has(joint.parent)) found.add(joint.index);
    return [...found];
  }, name);
}

it('moves nothing but the arm when the walker’s hand is dragged up, and its feet hold under Full body', () =>
  withPage(
    async ({ page }) => {
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
    },
    { walking: true },
  ));

describeShared('captures and axis-angle skeletons', () => {
  it('moves nothing but the arm when the hand of a capture is dragged up', () =>
    withPage(async ({ page }) => {
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
    }));

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
