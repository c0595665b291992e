/** Work on small characters: edits in quick succession, a drag without end, two tabs. */
import type { Page } from 'playwright-core';
import { ARM, dofs, kept, offer, restore, setDof, shown } from '../../../e2e/checks/autosave.ts';
import { dropFiles } from '../../../helpers/page.ts';
import type { Attempt } from '../../attack.ts';
import type { Profile } from './profile.ts';
import { Edits, type Found, forAWhile, type Work } from './work.ts';

/** The DOFs that edits set, both to one value: half of an edit would show. */
const [FIRST, SECOND] = [6, 7];

export const EDIT: Work = {
  name: 'edit',
  begin: async (profile) => [await openArm(profile, 'arm')],
  async run([page], _profile, attempt) {
    const edits = await editArm(page, attempt);
    return async (again, killedMs) => foundIn(await restored(await again.open(), 'arm'), edits, killedMs);
  },
};

export const DRAG: Work = {
  name: 'drag',
  async begin(profile) {
    return [await openArm(profile, 'arm')];
  },
  async run([page], _profile, attempt) {
    await page.getByRole('treeitem', { name: 'elbow' }).click();
    await setDof(page, FIRST, 0);
    await kept(page);
    const slider = await page.locator('.dof .lil-slider').first().boundingBox();
    if (!slider) throw new Error('A slider was expected.');
    const [x, y] = [slider.x + slider.width / 2, slider.y + slider.height / 2];
    await page.mouse.move(x, y);
    await page.mouse.down();
    const edits = new Edits();
    await forAWhile(page, attempt, async (i) => {
      await page.mouse.move(x + Math.min(i, slider.width / 2 - 2), y);
      edits.note((await dofs(page))[FIRST]);
    });
    return async (again, killedMs) => {
      const back = await restored(await again.open(), 'arm');
      return { pages: [back], lostMs: edits.lostMs((await dofs(back))[FIRST], killedMs) };
    };
  },
};

export const TABS: Work = {
  name: 'two tabs',
  begin: async (profile) => [await openArm(profile, 'arm'), await openArm(profile, 'leg')],
  async run(tabs, _profile, attempt) {
    const edits = new Map<string, Edits>();
    for (const page of tabs) {
      await page.bringToFront();
      edits.set(await nameOf(page), await editArm(page, attempt));
    }
    return async (again, killedMs) => {
      const pages: Page[] = [];
      let found: Found = { pages, lostMs: 0 };
      for (let i = 0; i < tabs.length; i++) {
        const page = await again.open();
        if (i === 0) await offer(page).getByRole('button', { name: '1 older' }).waitFor();
        await restore(page);
        await page.waitForFunction(() => window.marrow.characters()[0]?.name !== 'post');
        pages.push(page);
        const its = edits.get(await nameOf(page));
        if (!its) return { ...found, broken: `the work of one tab is offered twice: ${await nameOf(page)}` };
        edits.delete(await nameOf(page));
        const one = await foundIn(page, its, killedMs);
        found = { ...found, ...one, pages, lostMs: Math.max(found.lostMs, one.lostMs) };
      }
      return found;
    };
  },
};

async function nameOf(page: Page): Promise<string> {
  return page.evaluate(() => window.marrow.characters()[0].name);
}

async function openArm(profile: Profile, name: string): Promise<Page> {
  const page = await profile.open();
  await dropFiles(page, [{ name: `${name}.skel`, bytes: ARM }]);
  await shown(page, name);
  await kept(page);
  return page;
}

export async function restored(page: Page, name: string): Promise<Page> {
  await restore(page);
  await shown(page, name);
  return page;
}

async function editArm(page: Page, attempt: Attempt): Promise<Edits> {
  const edits = new Edits();
  const base = (await dofs(page))[FIRST];
  await forAWhile(page, attempt, async (i) => {
    const value = base + i / 10_000;
    await page.evaluate(
      ([v, ...indices]) => window.marrow.run('pose.setDofs', { dofs: indices.map((index) => ({ index, value: v })) }),
      [value, FIRST, SECOND],
    );
    edits.note(value);
  });
  return edits;
}

async function foundIn(page: Page, edits: Edits, killedMs: number): Promise<Found> {
  const values = await dofs(page);
  if (values.length !== 9 || values[FIRST] !== values[SECOND]) {
    return { pages: [page], lostMs: 0, broken: `half a pose: ${values.join(' ')}` };
  }
  return { pages: [page], lostMs: edits.lostMs(values[FIRST], killedMs) };
}
