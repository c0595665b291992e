/** Restoring work after a page was killed, closed or reloaded, with other tabs, and without storage. */
import { readFileSync } from 'node:fs';
import type { Page } from 'playwright-core';
import { describe, expect, it } from 'vitest';
import { c3dOf, type PointFrame } from '../helpers/c3d.ts';
import { inOnePage, undoAll } from '../helpers/one-page.ts';
import { dropFiles, type OpenPage, type PageOptions, withPage } from '../helpers/page.ts';
import { ARM, dofs, kept, offer, openArm, RESTORING, ready, restore, SMALL, setDof, shown } from './checks/autosave.ts';

const sample = (name: string) => readFileSync(new URL(`../../public/samples/${name}`, import.meta.url));
const WALKER = ['walker.skel', 'walker.skin', 'walker_walk.anim'].map((name) => ({ name, bytes: sample(name) }));
/** Points of which some frames are cropped away. */
const POINTS = c3dOf({
  labels: ['LASI', 'RASI'],
  frames: Array.from(
    { length: 20 },
    (_, f): PointFrame => [[100 + f, 1000, 3], f >= 5 && f < 10 ? null : [4, 500 + f, -6.5]],
  ),
});
const TWIN = [{ name: 'twin.skel', bytes: sample('walker.skel') }];

/**
 * Large enough for the tree to show joints. The first test needs a browser in which nothing was done yet, and the last
 * one crashes it.
 */
const inPage = inOnePage({ expected: /crashed/ });
/** Of what was done before, nothing is left but that it can't be redone. */
const inFreshPage = (name: string, body: (open: OpenPage) => Promise<void>) =>
  inPage(name, async (open) => {
    await ready(open.page);
    await undoAll(open.page);
    await body(open);
  });
/** With work that is kept. */
const withArm = (name: string, body: (open: OpenPage) => Promise<void>) =>
  inFreshPage(name, async (open) => {
    await openArm(open.page);
    await setDof(open.page, 6, 0.5);
    await kept(open.page);
    await body(open);
  });
const dofOf = (page: Page, index = 6) => expect.poll(async () => (await dofs(page))[index]);
const older = (page: Page) => offer(page).getByRole('button', { name: /older/ });

/** Crashes the page in the middle of work. */
async function crash(page: Page): Promise<void> {
  const session = await page.context().newCDPSession(page);
  const crashed = page.waitForEvent('crash');
  // Never answered, as the page is gone.
  session.send('Page.crash').catch(() => undefined);
  await crashed;
}

/** Runs in the page: as if files were changed or removed on disk after opening. */
function refuseFiles(): void {
  const { put } = IDBObjectStore.prototype;
  IDBObjectStore.prototype.put = function (value, key) {
    if (typeof value === 'object' && value !== null && 'given' in value) {
      throw new DOMException('It was changed on disk.', 'NotReadableError');
    }
    return put.call(this, value, key);
  };
}

describe('work', () => {
  inPage(
    'work is kept to the last moment when its page is closed, and not offered where nothing was done',
    async ({ page: idle, openAnother }) => {
      const page = await openAnother();
      await openArm(page);
      await kept(page);
      // A page with nothing but the example, with another view and time.
      await idle.evaluate(() => window.marrow.seek(0.5));
      await idle.keyboard.press('1');
      await setDof(page, 6, 0.75);
      await page.close();
      await idle.reload();
      await offer(idle)
        .getByText(/Unsaved work from .*: arm, 2 joints\./)
        .waitFor();
      await expect.poll(() => older(idle).count()).toBe(0);
      await restore(idle);
      await shown(idle, 'arm');
      await dofOf(idle).toBe(0.75);
    },
  );

  for (const { name, run } of RESTORING) inFreshPage(name, run);

  withArm(
    'work that was put off is in the Open menu until it is restored, and goes on being kept under the same session then, ' +
      'to the last moment; discarded, it can be had back',
    async ({ page }) => {
      await page.reload();
      await ready(page);
      const inMenu = page.getByRole('menuitem', { name: /^Restore last session/ });
      const openMenu = () => page.getByRole('menuitem', { name: 'Open', exact: true }).click();
      await offer(page).getByRole('button', { name: 'Not now' }).click();
      await expect.poll(() => offer(page).count()).toBe(0);
      await openMenu();
      await inMenu.click();
      // The offer has the focus, so that Enter restores.
      await page.keyboard.press('Enter');
      await shown(page, 'arm');
      await openMenu();
      await expect.poll(() => inMenu.count()).toBe(0);
      await page.keyboard.press('Escape');

      await page.reload();
      await offer(page).waitFor();
      await expect.poll(() => older(page).count()).toBe(0);
      await restore(page);
      await shown(page, 'arm');
      await dofOf(page).toBe(0.5);
      await setDof(page, 6, 0.7);
      await kept(page);
      await setDof(page, 6, 0.75);
      await page.reload();
      await offer(page).getByRole('button', { name: 'Discard' }).click();
      await offer(page).getByRole('button', { name: 'Keep it' }).click();
      await expect.poll(() => older(page).count()).toBe(0);
      await restore(page);
      await shown(page, 'arm');
      await dofOf(page).toBe(0.75);
    },
  );

  inFreshPage(
    'autosave keeps what was read of a file that can’t be copied, every vertex where it was',
    async ({ page }) => {
      const skin =
        'positions 3 { 0 0 0 1 0 0 0 2 0 } normals 3 { 0 0 1 0 0 1 0 0 1 } ' +
        'skinweights 3 { 1 0 1 1 0 1 2 0 0.5 1 0.5 } triangles 1 { 0 1 2 } bindings 2 { ' +
        'matrix { 1 0 0 0 1 0 0 0 1 0 0 0 } matrix { 1 0 0 0 1 0 0 0 1 0 1 0 } }';
      await page.evaluate(refuseFiles);
      await dropFiles(page, [
        { name: 'arm.skel', bytes: ARM },
        { name: 'arm.skin', bytes: skin },
      ]);
      await page.waitForFunction(() => window.marrow.vertices().length === 9);
      await setDof(page, 6, 0.5);
      await kept(page);
      const before = await page.evaluate(() => window.marrow.vertices());
      await page.reload();
      await ready(page);
      await page.evaluate(refuseFiles);
      await restore(page);
      await shown(page, 'arm');
      await expect.poll(() => page.evaluate(() => window.marrow.vertices())).toEqual(before);
    },
  );

  withArm('the sessions of two tabs stay apart', async ({ page, openAnother }) => {
    const other = await openAnother();
    await openArm(other);
    await setDof(other, 6, -0.5);
    await kept(other);
    await setDof(page, 7, 0.1);
    await kept(page);
    // Neither is offered the other's session, which is still open.
    await expect.poll(() => offer(other).count()).toBe(0);
    await other.close();
    await page.reload();
    await ready(page);
    await offer(page).getByRole('button', { name: '1 older' }).waitFor();
    await restore(page);
    await shown(page, 'arm');
    await expect.poll(async () => (await dofs(page)).slice(6, 8)).toEqual([0.5, 0.1]);
  });

  inFreshPage(
    'skin, keys with tangents and steps, layers, goals of limbs, sets, locks, cropped points, an attachment and ' +
      'retargeting come back after a crash, and move as they did; ' +
      'selection and time too, and what was open is gone',
    async ({ page, openAnother }) => {
      await dropFiles(page, [
        ...WALKER,
        { name: 'sword.skel', bytes: ARM },
        ...TWIN,
        { name: 'points.c3d', bytes: POINTS },
      ]);
      for (const name of ['sword', 'twin', 'points']) await shown(page, name);
      await page.evaluate(async () => {
        const { marrow } = window;
        marrow.pause();
        marrow.seek(0.5);
        const [walker, sword, twin] = ['walker', 'sword', 'twin'].map((name) => {
          const found = marrow.characters().find((one) => one.name === name);
          if (!found) throw new Error(`no ${name}`);
          return { ...found, jointIn: (joint: string) => found.joints.findIndex((one) => one.name === joint) };
        });
        const characterId = walker.id;
        const turn = 3 + 3 * walker.jointIn('upper_arm_l') + 2;
        const tangents = { characterId, keys: [{ channel: turn, indices: [0, 1] }], side: 'both' };
        await marrow.run('keys.setTangents', { ...tangents, kind: 'auto' });
        await marrow.run('keys.setTangents', { ...tangents, keys: [{ channel: turn, indices: [1] }], kind: 'step' });
        await marrow.run('sets.add', { characterId, name: 'feet', joints: [walker.jointIn('foot_l')] });
        await marrow.run('dofs.setLocked', { characterId, dofs: [turn], locked: true });
        await marrow.run('samples.crop', { character: 'points', from: 0.04, to: 0.16 });
        const joints = ['thigh_l', 'shin_l', 'foot_l'].map(walker.jointIn);
        await marrow.run('keys.move', {
          characterId,
          keys: [{ channel: 3, indices: [0] }],
          seconds: 0.01,
          values: [0.2],
        });
        await marrow.run('limbs.add', { characterId, joints, orient: true, mirrored: true });
        await marrow.run('limbs.switch', { characterId, limb: 0, timeSeconds: 0.5, to: 'ik' });
        await marrow.run('layers.add', { characterId, name: 'wave' });
        const index = walker.dofs.length - 5;
        await marrow.run('pose.setDofs', { characterId, dofs: [{ index, value: 0.4 }], timeSeconds: 0.5, key: {} });
        await marrow.run('retarget.set', { characterId: twin.id, sourceId: walker.id });
        const grip = { leaderId: twin.id, joint: twin.jointIn('hand_r'), span: [0.25, 2] };
        await marrow.run('attach.add', { characterId: sword.id, ...grip });
        // Keys of the base are those that are listed.
        await marrow.run('layers.activate', { characterId, layer: -1 });
      });
      const seen = (of: Page) =>
        of.evaluate(async () => {
          const { marrow } = window;
          const sets = JSON.parse(await marrow.save('walker.sets.json'));
          const { joints } = marrow.characters().find(({ name }) => name === 'walker') ?? { joints: [] };
          const keys = marrow.keys(3 + 3 * joints.findIndex(({ name }) => name === 'upper_arm_l') + 2, 'walker');
          return [0, 0.4, 0.9].map((seconds) => {
            marrow.seek(seconds);
            const moved = marrow.characters().map(({ name }) => marrow.worldMatrices(name));
            return {
              names: marrow.characters().map(({ name }) => name),
              moved,
              vertices: marrow.vertices('walker'),
              limbs: marrow.limbs('walker'),
              layers: marrow.layers('walker'),
              sets,
              keys,
            };
          });
        });
      const before = await seen(page);
      const last = before[2];
      expect(last.limbs.map(({ blend }) => blend)).toEqual([1, undefined]);
      expect(last.names).not.toContain('post');
      expect(last.vertices.length).toBeGreaterThan(1000);
      expect(last.layers.map(({ name }) => name)).toEqual(['wave']);
      // A step is a flat key, and another with its value.
      expect(last.keys.map(({ tangentOut }) => tangentOut).slice(0, 2)).toEqual(['auto', 'flat']);
      expect(last.keys[2].value).toBe(last.keys[1].value);
      expect(last.sets).toMatchObject({
        sets: [{ joints: ['foot_l'] }],
        locked: [{ joint: 'upper_arm_l', dofs: ['rz'] }],
      });
      // The points are cropped.
      expect(before[0].moved[last.names.indexOf('points')][0].slice(12, 15)).toEqual([104, 1000, 3]);
      await page.getByRole('treeitem', { name: 'elbow' }).first().click();
      await page.evaluate(() => window.marrow.seek(0.75));
      await kept(page);
      await crash(page);

      const again = await openAnother();
      await ready(again);
      await restore(again);
      await shown(again, 'sword');
      const names = () => again.evaluate(() => window.marrow.characters().map(({ name }) => name));
      await expect.poll(names).toEqual(last.names);
      await again.locator('[role=treeitem][aria-selected=true]', { hasText: 'elbow' }).waitFor();
      await expect.poll(() => again.getByRole('textbox', { name: 'Time in seconds' }).inputValue()).toContain('0.75');
      await expect.poll(() => offer(again).count()).toBe(0);
      await expect.poll(() => seen(again)).toEqual(before);
      // What is retargeted is written by the worker, which has restored nothing.
      const made = await again.evaluate(async () => (await window.marrow.glb({}, 'sword')).bytes.length);
      expect(made).toBeGreaterThan(1000);
      await again.evaluate(() => window.marrow.run('attach.putDown', { character: 'sword', timeSeconds: 0.9 }));
      const undone = await again.evaluate(() => window.marrow.undo());
      expect(undone).toBe(true);
      await expect.poll(() => seen(again)).toEqual(before);
    },
  );
});

describe('where nothing can be kept', () => {
  const forbidden: Record<string, PageOptions['before']> = {
    'IndexedDB is forbidden': () => {
      IDBFactory.prototype.open = () => {
        throw new DOMException('Not here.', 'SecurityError');
      };
    },
    'the store is full': () => {
      IDBObjectStore.prototype.put = () => {
        throw new DOMException('No room.', 'QuotaExceededError');
      };
    },
    'there are no locks': () => {
      Object.defineProperty(Navigator.prototype, 'locks', { value: undefined });
    },
  };
  it.each(Object.entries(forbidden))(
    'where nothing can be kept because %s, that is said once, and all else goes on',
    (_why, before) =>
      withPage(
        async ({ page }) => {
          await openArm(page);
          await page
            .locator('.message-line')
            .getByText(/your work is not protected|keep a backup of your work/)
            .waitFor();
          await page.getByRole('button', { name: 'Dismiss' }).click();
          for (const value of [0.5, 0.6]) {
            await page.evaluate(() => {
              document.documentElement.dataset.autosave = 'waiting';
            });
            await setDof(page, 6, value);
            await expect.poll(async () => (await dofs(page))[6]).toBe(value);
          }
          await page.waitForFunction(() => document.documentElement.dataset.autosave !== 'waiting');
          await expect.poll(() => page.locator('.message-line[role=status]').isVisible()).toBe(false);
        },
        before ? { ...SMALL, before } : SMALL,
      ),
  );
});
