/** Inverse kinematics on the built page: pins set by clicking, points dragged by mouse, one undo step each. */
import { expect } from 'vitest';
import { testAll } from '../helpers/check.ts';
import { inOnePage, undoAll } from '../helpers/one-page.ts';
import { dropFiles } from '../helpers/page.ts';
import { describeShared, sharedBytes } from '../helpers/shared.ts';
import {
  apart,
  click,
  drawn,
  IK,
  intoIk,
  jointPlace,
  onPage,
  openLeg,
  type Point,
  pins,
  standing,
  undoLabel,
} from './checks/ik.ts';
import { ontoHandle } from './checks/limb-drag.ts';

const inPage = inOnePage();

testAll(IK, inPage);

inPage('draws what can’t be reached and names the limit, until it is reached or given up', async ({ page }) => {
  await openLeg(page);
  await drawn(page);
  await intoIk(page);
  await page.evaluate(async () => {
    await window.marrow.run('ik.setStiffness', { joints: [0], stiffness: 'locked' });
    window.marrow.run('view.right');
  });
  await standing(page);
  const foot = await jointPlace(page, 'foot_l');
  await click(page, foot);
  const from = await onPage(page, foot);
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  // In front of the straight shin: the knee doesn't bend that way, and the hip is locked.
  const ahead = await onPage(page, [0, 0.5, 0.5]);
  await page.mouse.move(ahead.x, ahead.y, { steps: 5 });
  await drawn(page);
  const gap = page.locator('.ik-label[data-kind="gap"]:visible');
  await gap.waitFor();
  await expect.poll(() => gap.textContent()).toBe('foot_l: knee_l rx at its limit, hip is locked');
  await expect.poll(() => page.evaluate(() => window.marrow.characters()[0].dofs[6])).toBeCloseTo(0, 12);
  await page.mouse.move(from.x, from.y, { steps: 5 });
  await drawn(page);
  await expect.poll(() => gap.count()).toBe(0);
  await page.keyboard.press('Escape');
  await drawn(page);
  await expect.poll(async () => apart(await jointPlace(page, 'foot_l'), foot)).toBeLessThan(1e-9);
  await page.mouse.up();
  await expect.poll(() => undoLabel(page)).toBe('Pin foot_l');
});

const WASP = ['data/cse169/wasp.skel', 'data/cse169/wasp.skin'] as const;
/** Longest extent: from wings to feet and front to back. */
const SIZE = 2.85;
/** Of its size. */
const FEET_HOLD = 1e-3;

inPage('keeps a pinned point where it is while a slider moves what is above it, in one undo step', async ({ page }) => {
  await openLeg(page);
  await intoIk(page);
  await page.evaluate(() => window.marrow.run('ik.pin', { joint: 2, point: [0, 0, 0] }));
  const foot = await jointPlace(page, 'foot_l');
  const hip = await jointPlace(page, 'hip');
  const field = page.locator('.dof[data-dof="1"] input').first();
  await field.fill('-0.2');
  await field.press('Enter');
  await drawn(page);
  await expect.poll(async () => (await jointPlace(page, 'hip'))[1]).toBeCloseTo(hip[1] - 0.2, 9);
  await expect.poll(async () => apart(await jointPlace(page, 'foot_l'), foot)).toBeLessThan(1e-3);
  await expect.poll(() => undoLabel(page)).toBe('Move hip (ty)');
  // By keyboard, many small steps; further than the leg reaches, and back.
  for (const key of ['ArrowDown', 'ArrowDown', 'ArrowUp']) await field.press(key);
  await expect.poll(async () => apart(await jointPlace(page, 'foot_l'), foot)).toBeLessThan(1e-3);
  await field.fill('3');
  await field.press('Enter');
  await expect.poll(async () => apart(await jointPlace(page, 'foot_l'), foot)).toBeGreaterThan(0.5);
  await field.fill('0');
  await field.press('Enter');
  await expect.poll(async () => apart(await jointPlace(page, 'foot_l'), foot)).toBeLessThan(1e-3);
  // In FK mode pins don't hold.
  await page.evaluate(() => window.marrow.run('posing.fk'));
  await field.fill('0.1');
  await field.press('Enter');
  await drawn(page);
  await expect.poll(async () => (await jointPlace(page, 'foot_l'))[1]).toBeCloseTo(foot[1] + 0.1, 2);
});

inPage('turns a joint by a ring while a pin below holds, as one undo step, and back at Escape', async ({ page }) => {
  await openLeg(page);
  await intoIk(page);
  await page.evaluate(() => window.marrow.run('ik.pin', { joint: 2, point: [0, 0, 0] }));
  await page.evaluate(() => window.marrow.run('view.front'));
  await standing(page);
  const hip = await jointPlace(page, 'hip');
  const foot = await jointPlace(page, 'foot_l');
  const rotation = () => page.evaluate(() => window.marrow.characters()[0].dofs.slice(3, 6));
  await page.getByRole('treeitem', { name: /^hip/ }).first().click();
  await drawn(page);
  // The ring about z faces the viewer: a drag along it turns rz only. Its lower half is clear of the bars.
  const { x, y } = await onPage(page, hip);
  const canvas = page.locator('canvas.joint-gizmo');
  const before = await rotation();
  const ring = await ontoHandle(page, { x, y }, [0.8, 0.6], /^rz/);
  const radius = Math.hypot(ring.x - x, ring.y - y);
  await expect.poll(() => canvas.isVisible()).toBe(true);
  expect(radius).toBeGreaterThan(24);
  const turn = async () => {
    await page.mouse.down();
    await page.mouse.move(x + 0.6 * radius, y + 0.8 * radius, { steps: 4 });
    await drawn(page);
    const now = await rotation();
    expect(now[2] - before[2]).toBeCloseTo(Math.atan2(0.6, 0.8) - Math.atan2(0.8, 0.6), 1);
    expect(apart(now.slice(0, 2), before.slice(0, 2))).toBeLessThan(1e-9);
    await expect.poll(async () => apart(await jointPlace(page, 'foot_l'), foot)).toBeLessThan(2e-3);
  };
  await turn();
  await page.keyboard.press('Escape');
  await page.mouse.up();
  await drawn(page);
  await expect.poll(() => rotation()).toEqual(before);
  await expect.poll(() => undoLabel(page)).toBe('Pin foot_l');
  // Nothing is dragged any more: Escape deselects, and stays in IK.
  await page.keyboard.press('Escape');
  await expect.poll(() => page.locator('.mode-switch [aria-checked=true]').textContent()).toBe('IK');
  await page.getByRole('treeitem', { name: /^hip/ }).first().click();
  await drawn(page);
  await page.mouse.move(x + 0.8 * radius, y + 0.6 * radius);
  await turn();
  await page.mouse.up();
  await expect.poll(() => undoLabel(page)).toBe('Rotate hip');
  await page.evaluate(() => window.marrow.undo());
  await expect.poll(() => rotation()).toEqual(before);
});

inPage('tells how far a drag in depth has gone, in perspective and without', async ({ page }) => {
  await openLeg(page);
  await drawn(page);
  await intoIk(page);
  const readout = page.locator('.hand-readout:visible');
  for (const projection of ['perspective', 'orthographic']) {
    if (projection === 'orthographic') await page.evaluate(() => window.marrow.run('draw.orthographic'));
    await standing(page);
    const { x, y } = await onPage(page, await jointPlace(page, 'foot_l'));
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + 20, y);
    await expect.poll(() => readout.count()).toBe(0);
    await page.keyboard.down('Alt');
    await page.mouse.move(x + 20, y - 1);
    await page.mouse.move(x + 20, y - 31, { steps: 5 });
    await drawn(page);
    await expect.poll(() => readout.textContent()).toMatch(/^depth \+0\.\d{3} units$/);
    await page.keyboard.press('Escape');
    await page.mouse.up();
    await page.keyboard.up('Alt');
    await expect.poll(() => readout.count()).toBe(0);
  }
  await page.evaluate(() => window.marrow.run('draw.orthographic'));
});

describeShared('the wasp of data/cse169', () => {
  inPage('moves the wasp’s body by hand while its six feet stay', async ({ page }) => {
    await undoAll(page);
    await dropFiles(
      page,
      WASP.map((path) => ({ name: path.slice(path.lastIndexOf('/') + 1), bytes: sharedBytes(path) })),
    );
    await page.waitForFunction(() => window.marrow.characters()[0]?.vertexCount === 694);
    await drawn(page);
    await intoIk(page);
    // The lowest vertices far from the centre are the ends of its legs, one on each side and in each third.
    const vertices = await page.evaluate(() => window.marrow.vertices());
    const points: Point[] = [];
    for (let v = 0; v < vertices.length; v += 3) points.push([vertices[v], vertices[v + 1], vertices[v + 2]]);
    const low = points.map(([, y]) => y).sort((a, b) => a - b)[0];
    const feet = [-1, 1].flatMap((side) =>
      [-0.68, 0.13, 1.18].map((z) => {
        const near = points.filter((p) => p[0] * side > 0.5 && Math.abs(p[2] - z) < 0.3 && p[1] < low + 0.12);
        return near.reduce((a, b) => (b[1] < a[1] ? b : a));
      }),
    );
    // From below every foot is visible.
    for (const view of ['view.front', 'view.left', 'view.right', 'view.back', 'view.bottom']) {
      await page.evaluate((id) => window.marrow.run(id), view);
      await standing(page);
      for (const foot of feet) {
        const held = await pins(page);
        if (held.some(({ position }) => apart(position, foot) < 0.15)) continue;
        await click(page, foot);
        const made = (await pins(page)).find(({ id }) => !held.some((before) => before.id === id));
        // Another part of the body is in front of it.
        if (made && apart(made.position, foot) > 0.15) await page.evaluate(() => window.marrow.undo());
      }
    }
    const held = await pins(page);
    expect(held).toHaveLength(6);

    await page.evaluate(() => window.marrow.run('view.left'));
    await standing(page);
    const body = await jointPlace(page, 'root');
    const { x, y } = await onPage(page, body);
    await page.mouse.move(x, y);
    await page.mouse.down();
    let moved = 0;
    for (let i = 1; i <= 12; i++) {
      const turn = (i / 12) * 2 * Math.PI;
      await page.mouse.move(x + 25 * Math.sin(turn), y - 12 * (1 - Math.cos(turn)));
      await drawn(page);
      for (const [p, { position }] of (await pins(page)).entries())
        expect(apart(position, held[p].position)).toBeLessThan(FEET_HOLD * SIZE);
      moved = Math.max(moved, apart(await jointPlace(page, 'root'), body));
    }
    expect(moved).toBeGreaterThan(0.1);
    // All the way round is where it began.
    await expect.poll(async () => apart(await jointPlace(page, 'root'), body)).toBeLessThan(1e-3);
    await page.mouse.move(x + 25, y - 12);
    await drawn(page);
    await page.mouse.up();
    await expect.poll(() => undoLabel(page)).toMatch(/^Drag /);
    await page.evaluate(() => window.marrow.undo());
    await expect.poll(async () => apart(await jointPlace(page, 'root'), body)).toBeLessThan(1e-9);
    await expect.poll(() => pins(page)).toHaveLength(6);
  });
});
