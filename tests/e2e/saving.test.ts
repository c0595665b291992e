/**
 * Saving, marks and reloading with real files, in the browser's origin private file system, whose handles are of the
 * same kind as a real disk's. Only the dialogs are replaced, since tests can't press system buttons.
 */
import type { Page } from 'playwright-core';
import { describe, expect, it } from 'vitest';
import { testAll } from '../helpers/check.ts';
import { inOnePage, undoAll } from '../helpers/one-page.ts';
import { dropFiles, type OpenPage, type PageOptions, withPage } from '../helpers/page.ts';
import { anim, BY_DOWNLOAD, firstName, HERO, SKEL, setRange, shown, titled } from './checks/saving.ts';

/** Dialogs that pick from the private file system: everything to open, the suggested name to save. */
function privateDisk(): void {
  window.showOpenFilePicker = async () => {
    const found: FileSystemFileHandle[] = [];
    for await (const entry of (await navigator.storage.getDirectory()).values()) {
      if (entry.kind === 'file') found.push(entry);
    }
    return found;
  };
  window.showSaveFilePicker = async ({ suggestedName }) =>
    (await navigator.storage.getDirectory()).getFileHandle(suggestedName, { create: true });
}

const write = (page: Page, name: string, text: string) =>
  page.evaluate(
    async ([file, content]) => {
      const handle = await (await navigator.storage.getDirectory()).getFileHandle(file, { create: true });
      const stream = await handle.createWritable();
      await stream.write(content);
      await stream.close();
    },
    [name, text] as const,
  );
const read = (page: Page, name: string) =>
  page.evaluate(async (file) => {
    const handle = await (await navigator.storage.getDirectory()).getFileHandle(file);
    return (await handle.getFile()).text();
  }, name);

const height = (page: Page) => page.evaluate(() => window.marrow.worldMatrices()[0][13]);
const menu = async (page: Page, title: string, entry: string) => {
  await page.getByRole('menuitem', { name: title, exact: true }).click();
  await page.getByRole('menuitem', { name: entry }).click();
};

/** Opens the hero from the private file system, which holds nothing else, in place of all that was done. */
async function openHero({ page }: OpenPage): Promise<void> {
  await shown(page, await firstName(page));
  await undoAll(page);
  await page.evaluate(async () => {
    const disk = await navigator.storage.getDirectory();
    for await (const name of disk.keys()) await disk.removeEntry(name);
  });
  for (const { name, bytes } of HERO) await write(page, name, bytes);
  await menu(page, 'Open', 'Open files');
  await shown(page);
  await page.evaluate(() => {
    window.marrow.pause();
    window.marrow.seek(0.5);
  });
}

const ON_DISK: PageOptions = { before: privateDisk };
const inPage = inOnePage(ON_DISK);
const withHero = (name: string, body: (page: Page) => Promise<void>) =>
  inPage(name, async (open) => {
    await openHero(open);
    await body(open.page);
  });

/** Dialogs that end one after the other as in `answers`, for saving several new characters. */
function dialogsOneByOne(): void {
  const answers: ('AbortError' | 'NotAllowedError' | 'saved')[] = ['AbortError', 'saved', 'NotAllowedError', 'saved'];
  const asked: string[] = [];
  Object.assign(window, { asked });
  window.showSaveFilePicker = async ({ suggestedName }) => {
    asked.push(suggestedName);
    const answer = answers.shift();
    if (answer !== 'saved') throw new DOMException('', answer);
    return (await navigator.storage.getDirectory()).getFileHandle(suggestedName, { create: true });
  };
}

inPage(
  'asks for one place after the other, ends when a dialog is given up, and lists what was saved',
  async ({ page }) => {
    await firstName(page);
    await undoAll(page);
    await page.evaluate(dialogsOneByOne);
    await page.evaluate(() => {
      window.marrow.run('rig.create', {});
      window.marrow.run('rig.create', {});
    });
    await page.getByText('Unsaved: character.skel and 1 more').waitFor();
    const said = page.locator('.message-line');
    const asked = () => page.evaluate(() => Reflect.get(window, 'asked'));
    await page.keyboard.press('Control+s');
    await said.getByText('Not saved: character.skel, character2.skel.').waitFor();
    await expect.poll(() => asked()).toEqual(['character.skel']);
    await page.getByRole('button', { name: 'Save changes' }).click();
    await said.getByText('Saved character.skel. Not saved: character2.skel.').waitFor();
    await expect.poll(() => page.locator('.severity-error, .severity-warning').count()).toBe(0);
    await titled(page, '• character2.skel – Marrow');
    await page.getByRole('button', { name: 'Save changes' }).click();
    await titled(page, 'Marrow');
    const bytes = (await read(page, 'character2.skel')).length;
    await expect
      .poll(() => page.locator('.file-row').allInnerTexts())
      .toEqual([`character.skel\n${bytes} bytes`, `character2.skel\n${bytes} bytes`]);
    await page.evaluate(privateDisk);
  },
);

describe('saving in place', () => {
  withHero('marks what changed in title and menu bar, takes the mark back with undo, and writes it', async (page) => {
    await expect.poll(() => page.title()).toBe('Marrow');
    await setRange(page, 3);
    await titled(page, '• hero_walk.anim – Marrow');
    await page.getByText('Unsaved: hero_walk.anim').waitFor();
    await page.keyboard.press('Control+z');
    await titled(page, 'Marrow');
    await expect.poll(() => page.getByText('Unsaved:').isVisible()).toBe(false);
    await page.keyboard.press('Control+Shift+z');
    await titled(page, '• hero_walk.anim – Marrow');
    await page.keyboard.press('Control+s');
    await page.getByText('Saved hero_walk.anim.').waitFor();
    await titled(page, 'Marrow');
    await expect.poll(() => read(page, 'hero_walk.anim')).toContain('range 0 3');
    await expect.poll(() => read(page, 'hero.skel')).toBe(SKEL);
  });

  withHero('says so where nothing is to be saved', async (page) => {
    await page.keyboard.press('Control+s');
    await page.getByText('Everything is saved.').waitFor();
  });

  withHero('saving in place writes limits into the skeleton', async (page) => {
    await page.evaluate(() => window.marrow.run('skeleton.setLimit', { dof: 3, min: -1, max: 1 }));
    await titled(page, '• hero.skel – Marrow');
    await page.getByRole('button', { name: 'Save changes' }).click();
    await titled(page, 'Marrow');
    await expect.poll(() => read(page, 'hero.skel')).toContain('rotxlimit -1 1');
  });

  withHero('asks where a take made here goes, and then goes on writing there', async (page) => {
    await page.evaluate(() => window.marrow.run('take.create', { range: [0, 1], name: 'hero_new' }));
    await titled(page, '• hero_new.anim – Marrow');
    await page.keyboard.press('Control+s');
    await titled(page, 'Marrow');
    await expect.poll(() => read(page, 'hero_new.anim')).toContain('range 0 1');
    await setRange(page, 4);
    await page.keyboard.press('Control+s');
    await titled(page, 'Marrow');
    await expect.poll(() => read(page, 'hero_new.anim')).toContain('range 0 4');
  });

  withHero(
    'saving in place does not overwrite what has changed on disk meanwhile, unless it is saved again',
    async (page) => {
      await setRange(page, 3);
      await write(page, 'hero_walk.anim', anim(0.75));
      await page.keyboard.press('Control+s');
      await page.getByText('has changed on disk').first().waitFor();
      await expect.poll(() => read(page, 'hero_walk.anim')).toBe(anim(0.75));
      await expect.poll(() => page.title()).toBe('• hero_walk.anim – Marrow');
      await page.keyboard.press('Control+s');
      await titled(page, 'Marrow');
      await expect.poll(() => read(page, 'hero_walk.anim')).toContain('range 0 3');
    },
  );

  withHero('offers every part, elsewhere, with Save as', async (page) => {
    await page.keyboard.press('Control+Shift+s');
    await page.getByRole('dialog', { name: 'Save as' }).getByRole('button', { name: 'Rig' }).click();
    await page.getByText('Saved hero.rig.').waitFor();
    await expect.poll(() => read(page, 'hero.rig')).toContain('skeleton hero.skel');
  });
});

describe('reloading', () => {
  withHero('replaces what changed on disk as one step, and keeps time, camera and selection', async (page) => {
    await page.getByRole('treeitem', { name: 'tip' }).click();
    const before = {
      height: await height(page),
      take: await page.evaluate(() => window.marrow.save('hero_walk.anim')),
    };
    // The take's edit is replaced too, since its file has changed. Undo restores it.
    await setRange(page, 5);
    await write(page, 'hero_walk.anim', anim(4));
    await write(page, 'hero.skel', SKEL.replace('offset 0 1 0', 'offset 0 7 0'));
    await page.keyboard.press('Alt+r');
    await page.getByText('Reloaded hero.skel, hero_walk.anim.').waitFor();
    await expect.poll(() => height(page)).toBeGreaterThan(before.height + 5);
    await expect.poll(() => page.title()).toBe('Marrow');
    await expect.poll(() => page.evaluate(() => window.marrow.characters().length)).toBe(1);
    await expect.poll(() => page.evaluate(() => window.marrow.characters()[0].takes)).toEqual(['hero_walk']);
    await expect.poll(() => page.getByRole('treeitem', { name: 'tip' }).getAttribute('aria-selected')).toBe('true');
    // Time hasn't changed: the curve is 4 at 0.5 s, added to the new offset.
    const at = await page.evaluate(() => {
      const now = window.marrow.worldMatrices()[0][13];
      window.marrow.seek(0.5);
      return [now, window.marrow.worldMatrices()[0][13]];
    });
    expect(at[0]).toBe(at[1]);
    // Both differ from the disk again; then the edit is reverted too.
    await page.keyboard.press('Control+z');
    await titled(page, '• 2 files – Marrow');
    await expect.poll(() => page.evaluate(() => window.marrow.save('hero_walk.anim'))).toContain('range 0 5');
    await page.keyboard.press('Control+z');
    await expect.poll(() => height(page)).toBe(before.height);
    await expect.poll(() => page.evaluate(() => window.marrow.save('hero_walk.anim'))).toBe(before.take);
  });

  withHero('changes nothing where the file is wrong, and shows where', async (page) => {
    const before = await height(page);
    await write(page, 'hero_walk.anim', anim(0.5).replace('numchannels 9', 'numchannels nine'));
    await page.keyboard.press('Alt+r');
    await page.getByText('nine').first().waitFor();
    await expect.poll(() => height(page)).toBe(before);
    // Corrected, it is loaded with the next reload.
    await write(page, 'hero_walk.anim', anim(2));
    await page.keyboard.press('Alt+r');
    await page.getByText('Reloaded hero_walk.anim.').waitFor();
    await expect.poll(() => height(page)).toBeGreaterThan(before);
  });

  withHero('reloading says that nothing has changed', async (page) => {
    await menu(page, 'Open', 'Reload from disk');
    await page.getByText('Nothing has changed on disk.').waitFor();
  });

  inPage('reloading is what dropping a file of the same name again does, too', async ({ page }) => {
    await firstName(page);
    await undoAll(page);
    await dropFiles(page, HERO);
    await shown(page);
    await page.evaluate(() => {
      window.marrow.pause();
      window.marrow.seek(0.5);
    });
    await page.getByRole('treeitem', { name: 'tip' }).click();
    const before = await height(page);
    await setRange(page, 5);
    await titled(page, '• hero_walk.anim – Marrow');
    await dropFiles(page, [{ name: 'hero_walk.anim', bytes: anim(4) }]);
    await titled(page, 'Marrow');
    await expect.poll(() => height(page)).toBeGreaterThan(before);
    await expect.poll(() => page.evaluate(() => window.marrow.characters()[0].takes)).toEqual(['hero_walk']);
    await expect.poll(() => page.getByRole('treeitem', { name: 'tip' }).getAttribute('aria-selected')).toBe('true');
    await page.keyboard.press('Control+z');
    await titled(page, '• hero_walk.anim – Marrow');
    await expect.poll(() => height(page)).toBe(before);
  });

  it('fetches again what the address named', () => {
    const files: Record<string, Uint8Array> = {};
    for (const { name, bytes } of HERO) files[`given/${name}`] = new TextEncoder().encode(bytes);
    return withPage(
      async ({ page }) => {
        await shown(page);
        await page.evaluate(() => {
          window.marrow.pause();
          window.marrow.seek(0.5);
        });
        const before = await height(page);
        files['given/hero_walk.anim'] = new TextEncoder().encode(anim(4));
        await page.keyboard.press('Alt+r');
        await page.getByText(/Reloaded .*hero_walk\.anim/).waitFor();
        await expect.poll(() => height(page)).toBeGreaterThan(before);
      },
      { query: `?files=${HERO.map(({ name }) => `given/${name}`).join(',')}`, files },
    );
  });
});

describe('without files in place', () => testAll(BY_DOWNLOAD));

describe('leaving', () => {
  it('asks while something is unsaved, and only then', () =>
    withPage(async (open) => {
      const { page } = open;
      await openHero(open);
      const asked: string[] = [];
      page.on('dialog', async (dialog) => {
        asked.push(dialog.type());
        await dialog.dismiss();
      });
      await setRange(page, 3);
      await titled(page, '• hero_walk.anim – Marrow');
      await page.close({ runBeforeUnload: true });
      await expect.poll(() => asked).toEqual(['beforeunload']);
      await page.keyboard.press('Control+s');
      await titled(page, 'Marrow');
      const closed = page.waitForEvent('close');
      await page.close({ runBeforeUnload: true });
      await closed;
      expect(asked).toEqual(['beforeunload']);
    }, ON_DISK));
});
