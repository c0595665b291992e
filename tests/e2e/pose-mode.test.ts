/**
 * Pose mode on the built page, by real mouse: limbs by their ends, rings, the dot in their middle, the camera, and feet
 * that stand, which hold while the body is moved and turned by its handles. And the motion path: its diamonds are dragged, at other
 * times than the current one.
 */
import type { Page } from 'playwright-core';
import { expect } from 'vitest';
import { inOnePage, startOver } from '../helpers/one-page.ts';
import { OWN_CAPTURES } from '../helpers/own-files.ts';
import { dropFiles } from '../helpers/page.ts';
import { describeShared, sharedBytes } from '../helpers/shared.ts';
import { apart, drawn, jointPlace, onPage, type Point, standing, undoLabel } from './checks/ik.ts';
import { dragUp, expectArmOnly, limbFrom, ontoHandle, place, shown } from './checks/limb-drag.ts';

const mode = (page: Page) => page.locator('.mode-switch [aria-checked=true]').textContent();
const turnOfView = (page: Page) => page.evaluate(() => window.marrow.pointOnPage([1, 0, 0])?.x ?? Number.NaN);
const texts = (page: Page) =>
  page.evaluate(() => Promise.all(['walker.skel', 'walker_walk.anim'].map(window.marrow.save)));

async function opened(page: Page, name: string): Promise<void> {
  await page.waitForFunction((wanted) => window.marrow.characters()[0]?.name === wanted, name);
  await drawn(page);
}

const inPage = inOnePage({ walking: true });

/** The first of them. */
inPage(
  'the walker’s hand is dragged in the mode that the page opens with: its arm bends, and nothing else',
  async ({ page }) => {
    await opened(page, 'walker');
    await expect.poll(() => mode(page)).toBe('Pose');
    await page.getByRole('button', { name: 'Reach: Limb' }).waitFor();
    const files = await texts(page);
    const { names } = await shown(page);
    const hand = { joint: names.indexOf('hand_l'), point: [0.07, 0, 0], by: [0, -30] } as const;
    await expectArmOnly(page, hand, await limbFrom(page, 'upper_arm_l'));
    await expect.poll(() => texts(page)).toEqual(files);

    // A drag on the chest is the camera's, and so is one beside the character; a click selects.
    const before = await shown(page);
    const view = await turnOfView(page);
    const chest = await onPage(page, await jointPlace(page, 'spine'));
    await page.mouse.move(chest.x, chest.y);
    await page.mouse.down();
    await page.mouse.move(chest.x + 60, chest.y, { steps: 5 });
    await page.mouse.up();
    await expect.poll(() => turnOfView(page)).not.toBeCloseTo(view, 0);
    await expect.poll(() => shown(page)).toEqual(before);
    await page.evaluate(() => window.marrow.run('view.front'));
    await standing(page);

    // The hips by the dot of their rings: the body moves, and the foot that stands holds. One step.
    const hips = names.indexOf('hips');
    await page.getByRole('treeitem', { name: /^hips/ }).click();
    await page.waitForFunction(() => document.querySelector<HTMLElement>('.joint-gizmo')?.hidden === false);
    await drawn(page);
    const low = (j: number) => place(before, j)[1];
    const [lower] = ['toe_l', 'toe_r'].map((name) => names.indexOf(name)).sort((a, b) => low(a) - low(b));
    await dragUp(page, { joint: hips, point: [0, 0, 0], by: [0, 14] }, async () => {
      const now = await shown(page);
      expect(apart(place(now, hips), place(before, hips))).toBeGreaterThan(1e-3);
      expect(apart(place(now, lower), place(before, lower))).toBeLessThan(1e-3);
    });
    await expect.poll(() => undoLabel(page)).toBe('Drag hips');
    await page.evaluate(() => window.marrow.undo());
    await expect.poll(() => shown(page)).toEqual(before);

    // E leads to IK and on to FK, W back.
    await page.locator('.viewport canvas[role=application]').focus();
    for (const [key, next] of [
      ['e', 'IK'],
      ['e', 'FK'],
      ['w', 'Pose'],
    ] as const) {
      await page.keyboard.press(key);
      await expect.poll(() => mode(page)).toBe(next);
    }
  },
);

describeShared('Pose mode with captures and axis-angle skeletons', () => {
  inPage('the hand of a capture is dragged: its arm bends, and nothing else', async ({ page }) => {
    await startOver(page);
    await dropFiles(page, [{ name: 'walk.bvh', bytes: sharedBytes('data/bvh/cmu-01_01.bvh') }]);
    await opened(page, 'walk');
    await expect.poll(() => mode(page)).toBe('Pose');
    const { names } = await shown(page);
    const hand = { joint: names.indexOf('LeftHand'), point: [0, 0, 0], by: [-25, -25] } as const;
    await expectArmOnly(page, hand, await limbFrom(page, 'LeftShoulder'));
  });

  inPage(
    'axis-angle skeletons open in FK; in Pose mode a hand bends its arm, and the next other character is in Pose',
    async ({ page }) => {
      await startOver(page);
      await dropFiles(page, [{ name: 'human.axskel', bytes: sharedBytes('data/axis-skel/human.axskel') }]);
      await opened(page, 'human');
      await expect.poll(() => mode(page)).toBe('FK');
      await page.evaluate(() => window.marrow.run('posing.pose'));
      await page.getByRole('button', { name: 'Reach: Limb' }).waitFor();
      await expectArmOnly(page, { joint: 9, point: [0, 0.05, 0], by: [8, -25] }, [5, 6, 7, 8, 9]);
    },
  );
});

/** Of lengths in metres; a capture's unit is another. */
const HOLDS = 1e-3;

interface Handle {
  readonly body: string;
  /** Where it is from the middle on, and the chip's text there. */
  readonly toward: readonly [x: number, y: number];
  readonly text: RegExp;
  readonly by: readonly [x: number, y: number];
}

/** Drags a handle of the body, and has `there` look while the mouse is down. Undo restores every number. */
async function dragBody(
  page: Page,
  { body, toward, text, by: [dx, dy] }: Handle,
  there: () => Promise<void>,
): Promise<void> {
  await page
    .getByRole('treeitem', { name: new RegExp(`^${body}`) })
    .first()
    .click();
  await page.waitForFunction(() => document.querySelector<HTMLElement>('.joint-gizmo')?.hidden === false);
  await standing(page);
  const before = await shown(page);
  const at = await ontoHandle(page, await onPage(page, place(before, before.names.indexOf(body))), toward, text);
  await page.mouse.down();
  await page.mouse.move(at.x + dx, at.y + dy, { steps: 5 });
  await drawn(page);
  await there();
  await page.mouse.up();
  await expect.poll(() => undoLabel(page)).toMatch(/^(Move|Rotate) /);
  await page.evaluate(() => window.marrow.undo());
  await expect.poll(() => shown(page)).toEqual(before);
}

/** The lower foot, and how far it has moved from there. */
async function lowerFoot(page: Page, feet: readonly [string, string]) {
  const before = await shown(page);
  const joints = feet.map((name) => before.names.indexOf(name));
  const [joint] = joints.sort((a, b) => place(before, a)[1] - place(before, b)[1]);
  const from: Point = place(before, joint);
  return { moved: async () => apart(place(await shown(page), joint), from) };
}

const turnOf = (worlds: readonly (readonly number[])[], joint: number) => worlds[joint].slice(0, 11);

inPage(
  'the walker’s foot that stands holds while its root is moved by an arrow and its hips are turned by a ring, but not in the air',
  async ({ page }) => {
    await startOver(page);
    await page.waitForFunction(() => window.marrow.characters()[0]?.name === 'walker');
    await page.evaluate(() => window.marrow.run('view.front'));
    await standing(page);
    const { names, dofs } = await shown(page);
    const hips = names.indexOf('hips');
    const foot = await lowerFoot(page, ['toe_l', 'toe_r']);
    const down: Handle = { body: 'root', toward: [0, -1], text: /^ty/, by: [0, 14] };
    await dragBody(page, down, async () => {
      const now = await shown(page);
      expect(now.dofs[1]).toBeLessThan(dofs[1] - 0.01);
      // The body goes along the arrow and nowhere else.
      expect([now.dofs[0], ...now.dofs.slice(2, 6)]).toEqual([dofs[0], ...dofs.slice(2, 6)]);
      await expect.poll(foot.moved).toBeLessThan(HOLDS);
    });
    // Further up than the leg is long the foot leaves the floor, and the back isn't bent to keep it there.
    await dragBody(page, { ...down, by: [0, -60] }, async () => {
      const now = await shown(page);
      const own = [dofs, now.dofs].map((all) => all.slice(6, 15));
      expect(own[1]).toEqual(own[0]);
      await expect.poll(foot.moved).toBeGreaterThan(0.05);
    });
    const before = await shown(page);
    await dragBody(page, { body: 'hips', toward: [0.8, 0.6], text: /^rz/, by: [14, 14] }, async () => {
      const now = await shown(page);
      expect(apart(turnOf(now.worlds, hips), turnOf(before.worlds, hips))).toBeGreaterThan(0.02);
      expect(place(now, hips)).toEqual(place(before, hips));
      await expect.poll(foot.moved).toBeLessThan(HOLDS);
    });

    // High above the floor nothing stands.
    await page.evaluate((ty) => window.marrow.run('pose.setDofs', { dofs: [{ index: 1, value: ty + 0.5 }] }), dofs[1]);
    await page.evaluate(() => window.marrow.run('view.frameAll'));
    await standing(page);
    const high = await lowerFoot(page, ['toe_l', 'toe_r']);
    const from = (await shown(page)).dofs[1];
    await dragBody(page, down, async () => {
      const fell = from - (await shown(page)).dofs[1];
      expect(fell).toBeGreaterThan(0.01);
      await expect.poll(high.moved).toBeCloseTo(fell, 9);
    });
  },
);

describeShared('a capture’s hips', () => {
  inPage('are moved by an arrow while the feet that stand hold', async ({ page }) => {
    await startOver(page);
    await dropFiles(page, [{ name: 'walk.bvh', bytes: sharedBytes('data/bvh/cmu-01_01.bvh') }]);
    await page.waitForFunction(() => window.marrow.characters()[0]?.name === 'walk');
    await page.evaluate(() => window.marrow.run('view.front'));
    await standing(page);
    const size = await page.evaluate(() => {
      const heights = window.marrow.worldMatrices().map((world) => world[13]);
      return Math.max(...heights) - Math.min(...heights);
    });
    const foot = await lowerFoot(page, ['LeftFoot', 'RightFoot']);
    await dragBody(page, { body: 'Hips', toward: [0, -1], text: /^(ty|py|Yposition)/, by: [0, 10] }, async () => {
      await expect.poll(foot.moved).toBeLessThan(HOLDS * size);
    });
  });
});

const saved = (page: Page, name: string) => page.evaluate((of) => window.marrow.save(of), name);
const position = (page: Page, joint: string) =>
  page.evaluate((name) => {
    const index = window.marrow.characters()[0].joints.findIndex((one) => one.name === name);
    const world = window.marrow.worldMatrices()[index];
    return [world[12], world[13], world[14]] as const;
  }, joint);

/** Selects a joint in the outliner, shows its path, and goes to a time. */
async function showPath(page: Page, joint: string, seconds: number): Promise<void> {
  await page.evaluate(() => window.marrow.run('posing.selectTool'));
  await page
    .getByRole('treeitem', { name: new RegExp(`^${joint}`) })
    .first()
    .click();
  await page.evaluate(() => window.marrow.run('draw.trail'));
  await page.evaluate((to) => window.marrow.seek(to), seconds);
}

/** Where the path is on the page at another time than the current one, which is kept. */
async function onPath(page: Page, joint: string, at: number, now: number): Promise<{ x: number; y: number }> {
  await page.evaluate((to) => window.marrow.seek(to), at);
  const place = await position(page, joint);
  // The camera may follow the root, with the next frame.
  await page.evaluate((to) => window.marrow.seek(to), now);
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  const found = await page.evaluate((point) => window.marrow.pointOnPage(point), place);
  if (!found) throw new Error('The path is in view.');
  // The script of the path comes with the first move over it.
  const cursorThere = async () => {
    await page.mouse.move(found.x - 30, found.y);
    await page.mouse.move(found.x, found.y);
    return page.evaluate(() => document.querySelector('canvas')?.style.cursor);
  };
  await expect.poll(cursorThere).toBe('grab');
  return found;
}

async function drag(page: Page, { x, y }: { x: number; y: number }, by: readonly [number, number]): Promise<void> {
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + by[0], y + by[1], { steps: 4 });
}

inPage('a diamond is dragged in one step, Escape cancels, and a click goes to its time', async ({ page }) => {
  await startOver(page);
  const [file, joint, now] = ['walker_walk.anim', 'hand_l', 0.2] as const;
  await page.waitForFunction(() => window.marrow.characters()[0]?.dofs.length === 93);
  await showPath(page, joint, now);
  const channel = await page.evaluate(
    (name) => 3 + 3 * window.marrow.characters()[0].joints.findIndex((one) => one.name === name),
    'upper_arm_l',
  );
  const times = await page.evaluate((of) => window.marrow.keys(of).map(({ time }) => time), channel);
  const time = times.find((one) => one > 0.3) ?? 0;
  const before = await saved(page, file);
  const handle = await onPath(page, joint, time, now);
  await drag(page, handle, [20, -30]);
  await expect.poll(() => saved(page, file)).not.toBe(before);
  await page.keyboard.press('Escape');
  await page.mouse.up();
  await expect.poll(() => saved(page, file)).toBe(before);

  await drag(page, handle, [20, -30]);
  await page.mouse.up();
  await expect.poll(() => undoLabel(page)).toBe(`Move ${joint} on its path`);
  const after = await page.evaluate((of) => window.marrow.keys(of).map((key) => key.time), channel);
  expect(after).toEqual(times);
  // It is where it was dragged to.
  const moved = await onPath(page, joint, time, now);
  expect(Math.hypot(moved.x - handle.x - 20, moved.y - handle.y + 30)).toBeLessThan(2);
  await page.evaluate(() => window.marrow.undo());
  await expect.poll(() => saved(page, file)).toBe(before);

  const old = await position(page, joint);
  await page.mouse.click(handle.x, handle.y);
  await expect.poll(() => position(page, joint)).not.toEqual(old);
  // Off again.
  await page.evaluate(() => window.marrow.run('draw.trail'));
});

inPage('a frame of a capture is dragged, and one line of the file changes', async ({ page }) => {
  await startOver(page);
  const name = 'own-walk.bvh';
  await dropFiles(page, [{ name, bytes: OWN_CAPTURES.get(name) ?? new Uint8Array() }]);
  await page.waitForFunction(() => window.marrow.characters()[0]?.joints.length > 5);
  await showPath(page, 'LeftFoot', 0.5);
  const before = (await saved(page, name)).split('\n');
  await drag(page, await onPath(page, 'LeftFoot', 1.2, 0.5), [15, -15]);
  await page.mouse.up();
  await expect.poll(() => undoLabel(page)).toBe('Move LeftFoot on its path');
  const after = (await saved(page, name)).split('\n');
  expect(after.filter((line, i) => line !== before[i])).toHaveLength(1);
});
