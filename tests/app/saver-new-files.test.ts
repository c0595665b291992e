/** Saving what has no file yet: characters that were made here. */
import { describe, expect, it } from 'vitest';
import { createRig } from '../../src/edit/commands/rig.ts';
import type { Character } from '../../src/model/document.ts';
import { skeleton } from '../helpers/builders.ts';
import { pageWith } from './disk.ts';
import { HERO, limited, longer, posed, SKEL, said } from './hero.ts';

/** Characters of one joint, created one after the other. */
async function withMadeHere(count: number) {
  const page = await pageWith({});
  page.disk.picks = 'as suggested';
  for (let i = 0; i < count; i++) page.store.apply(createRig, {});
  return page;
}
const listed = (page: Awaited<ReturnType<typeof pageWith>>) =>
  page.store.document.characters.map(({ sources }) => sources.map(({ name }) => name));

describe('saving several files that have no place yet', () => {
  it('ends with the first cancelled dialog, and lists in one message what is not saved', async () => {
    const page = await withMadeHere(3);
    page.disk.picks = 'give up';
    await page.saver.saveChanged();
    expect(page.disk.asked).toEqual(['character.skel']);
    expect(page.messages.list.get()).toEqual([]);
    expect(said(page)).toBe('Not saved: character.skel, character2.skel, character3.skel.');
    expect(page.names()).toEqual(['character.skel', 'character2.skel', 'character3.skel']);
  });

  it('continues with the next click, if the browser opens one dialog each', async () => {
    const page = await withMadeHere(3);
    page.disk.dialogs = 1;
    await page.saver.saveChanged();
    expect(page.messages.list.get()).toEqual([]);
    expect(said(page)).toBe(
      'Saved character.skel. Not saved: character2.skel, character3.skel. ' +
        'The browser saves one file at a time. Save again for the next.',
    );
    page.disk.dialogs = 1;
    await page.saver.saveChanged();
    page.disk.dialogs = 1;
    await page.saver.saveChanged();
    expect(page.disk.asked).toEqual(['character.skel', 'character2.skel', 'character3.skel']);
    expect(said(page)).toBe('Saved character3.skel.');
    expect(page.names()).toEqual([]);
  });

  it('warns if the browser opens no dialog at all', async () => {
    const page = await withMadeHere(2);
    page.disk.dialogs = 0;
    await page.saver.saveChanged();
    expect(page.messages.list.get()).toMatchObject([
      {
        severity: 'warning',
        text: 'Not saved: character.skel, character2.skel. Save again to choose where to save it.',
      },
    ]);
  });

  it('tells what the browser requires if no dialog was open before', async () => {
    const page = await pageWith(HERO);
    page.disk.picks = 'as suggested';
    page.disk.mayWrite = false;
    page.store.apply(createRig, {});
    page.change(longer);
    await page.saver.saveChanged();
    expect(page.disk.asked).toEqual([]);
    expect(page.messages.list.get()).toMatchObject([
      {
        severity: 'warning',
        text: 'Not saved: hero_walk.anim, character.skel. Save again to allow writing to it.',
      },
    ]);
    page.disk.mayWrite = true;
    await page.saver.saveChanged();
    expect(said(page)).toBe('Saved hero_walk.anim, character.skel.');
  });

  it('names each file as it is saved', async () => {
    const page = await withMadeHere(2);
    const named = (c: Character): Character => {
      const own = c.skeleton ?? skeleton();
      return { ...c, skeleton: { ...own, joints: own.joints.map((j) => ({ ...j, name: 'two words' })) } };
    };
    page.change(named, 0);
    page.change(named, 1);
    await page.saver.saveChanged();
    expect(page.disk.asked).toEqual(['character.skel', 'character2.skel']);
    const about = page.messages.list.get().map(({ text }) => text.slice(0, text.indexOf(':')));
    expect(about).toEqual(['character.skel', 'character2.skel']);
  });

  it('saving several files that have no place yet never gives two files the same name', async () => {
    const page = await pageWith(HERO);
    for (const name of ['hero', 'Hero', 'hero']) page.store.apply(createRig, { name });
    page.change(posed);
    await page.saver.saveChanged();
    expect(page.disk.downloads).toEqual(['hero2.skel', 'Hero3.skel', 'hero4.skel']);
    expect(page.text('hero.skel')).toContain('pose 0 0.25 0');
  });
});

describe('a part that was made here', () => {
  it('a part created here gets the file that it was saved as, under the picked name', async () => {
    const page = await withMadeHere(1);
    page.disk.picks = page.disk.put('crab.skel', '');
    await page.saver.saveChanged();
    const bytes = page.text('crab.skel')?.length;
    expect(page.store.document.characters[0].sources).toEqual([{ name: 'crab.skel', path: 'crab.skel', bytes }]);
    expect(page.store.undoLabel).toBe('New skeleton character');
    page.change(limited);
    expect(page.names()).toEqual(['crab.skel']);
    await page.saver.saveChanged();
    expect(page.disk.asked).toHaveLength(1);
    expect(page.store.document.characters[0].sources[0].bytes).toBe(page.text('crab.skel')?.length);
  });

  it('a part created here keeps its file when steps before the saving are undone', async () => {
    const page = await withMadeHere(1);
    page.change(limited);
    await page.saver.saveChanged();
    page.store.undo();
    await Promise.resolve();
    expect(listed(page)).toEqual([['character.skel']]);
    expect(page.names()).toEqual(['character.skel']);
    await page.saver.saveChanged();
    expect(page.disk.asked).toHaveLength(1);
    expect(page.text('character.skel')).not.toContain('rotxlimit');
    page.store.redo();
    expect(listed(page)).toEqual([['character.skel']]);
    page.store.undo();
    page.store.undo();
    await Promise.resolve();
    expect(page.store.document.characters).toEqual([]);
  });

  it('a part created here takes its file with it when undone and replaced by another', async () => {
    const page = await withMadeHere(1);
    await page.saver.saveChanged();
    const first = page.text('character.skel');
    page.store.undo();
    await Promise.resolve();
    page.store.apply(createRig, {});
    expect(page.store.document.characters.map(({ id }) => id)).toEqual(['c1']);
    await Promise.resolve();
    expect(listed(page)).toEqual([[]]);
    expect(page.names()).toEqual(['character.skel']);
    page.change(limited);
    await page.saver.saveChanged();
    expect(page.disk.asked).toEqual(['character.skel', 'character.skel']);
    expect(page.text('character.skel')).toBe(first);
  });

  it('a part created here still has its file when undone and redone', async () => {
    const page = await withMadeHere(1);
    await page.saver.saveChanged();
    page.store.undo();
    await Promise.resolve();
    page.store.redo();
    page.change(limited);
    await page.saver.saveChanged();
    expect(page.disk.asked).toHaveLength(1);
    expect(page.text('character.skel')).toContain('rotxlimit');
  });

  it('a part created here is listed with its downloaded file, too', async () => {
    const page = await withMadeHere(1);
    page.disk.picks = undefined;
    await page.saver.saveChanged();
    expect(listed(page)).toEqual([['character.skel']]);
  });

  it('a part created here is replaced when its file is opened', async () => {
    const page = await withMadeHere(1);
    await page.saver.saveChanged();
    await page.open([{ path: 'character.skel', blob: new Blob([SKEL]) }]);
    expect(listed(page)).toEqual([['character.skel']]);
    expect(page.store.document.characters[0].skeleton?.joints).toHaveLength(2);
  });

  it('a part created here is not taken for a root of another file of that name', async () => {
    const page = await pageWith(HERO);
    page.store.apply(createRig, { name: 'hero' });
    page.disk.picks = page.disk.put('hero.skel', '');
    await page.saver.saveChanged();
    expect(page.store.document.characters[1].sources[0]).toMatchObject({ name: 'hero.skel', path: 'c2/hero.skel' });
    page.change(posed);
    await page.saver.saveChanged();
    expect(page.text('hero.skel')).toMatch(/pose 0 0.25 0/);
    expect(page.text('hero.skel')).not.toContain('balljoint root ');
  });
});
