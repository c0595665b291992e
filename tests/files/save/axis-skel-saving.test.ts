/** Saving skeletons that were read from the axis-angle form. */
import { describe, expect, it } from 'vitest';
import { isCopy, saveCharacter } from '../../../src/files/save/saving.ts';
import type { Character } from '../../../src/model/document.ts';
import type { Skeleton } from '../../../src/model/skeleton/skeleton.ts';
import { pageWith } from '../../app/disk.ts';
import { character } from '../../helpers/builders.ts';

const ARM = '0.5 0 1 0 0 1\n1.5 1 0 0 30 1\n1 2 0 0 60 0\n';
const posed = (c: Character): Character => ({ ...c, pose: c.pose.map((v, i) => (i === 5 ? Math.PI / 2 : v)) });
const limited = (c: Character): Character => {
  const own = c.skeleton as Skeleton;
  const joints = own.joints.map((joint, j) => (j === 1 ? { ...joint, limits: [{ min: -1, max: 2 }] } : joint));
  return { ...c, skeleton: { ...own, joints } };
};
const first = (page: Awaited<ReturnType<typeof pageWith>>) => page.store.document.characters[0];

describe('a skeleton from the axis-angle form', () => {
  it('a skeleton from the axis-angle form is saved in that form, pose and all, whatever its file is called', async () => {
    for (const name of ['arm.axskel', 'arm.skel']) {
      const page = await pageWith({ [name]: ARM });
      expect(page.names()).toEqual([]);
      page.change(posed);
      expect(page.names()).toEqual([name]);
      await page.saver.saveChanged();
      expect(page.text(name)).toBe(ARM.replace('60', '90'));
      expect(page.names()).toEqual([]);
    }
  });

  it('a skeleton from the axis-angle form is saved in the hierarchy form once it has something the other can not hold', async () => {
    const page = await pageWith({ 'arm.axskel': ARM });
    page.change(limited);
    await page.saver.saveChanged();
    expect(page.text('arm.axskel')).toContain('limit r -1 2');
    expect(page.messages.list.get().flatMap(({ diagnostics }) => diagnostics.map((d) => d.message))).toEqual([
      "arm can't be written in axis-angle form: joint 1 has limits.",
    ]);
    expect(page.names()).toEqual([]);
  });

  it('a skeleton from the axis-angle form has files in either form, its own first', async () => {
    const own = first(await pageWith({ 'arm.axskel': ARM }));
    expect(saveCharacter(own, 'axskel')).toEqual([{ name: 'arm.axskel', text: ARM, diagnostics: [] }]);
    const [tree] = saveCharacter(own, 'skel');
    expect(tree.name).toBe('arm.skel');
    expect(tree.text).toMatch(/^hingejoint \{/);
    expect([isCopy(own, 'axskel'), isCopy(own, 'skel')]).toEqual([false, true]);
    const other = first(await pageWith({ 'tree.skel': tree.text }));
    expect(saveCharacter(other, 'axskel')).toEqual([{ name: 'tree.axskel', text: ARM, diagnostics: [] }]);
    expect([isCopy(other, 'axskel'), isCopy(other, 'skel')]).toEqual([true, false]);
    expect(saveCharacter(limited(own), 'axskel')).toEqual([]);
    expect(saveCharacter(character(), 'axskel')).toEqual([]);
  });

  it('a skeleton from the axis-angle form is no more saved by a copy in the other form than before', async () => {
    const page = await pageWith({ 'arm.axskel': ARM });
    page.change(posed);
    await page.saver.saveAs(first(page).id, 'skel');
    expect(page.disk.downloads).toEqual(['arm.skel']);
    expect(page.names()).toEqual(['arm.axskel']);
    await page.saver.saveAs(first(page).id, 'axskel');
    expect(page.disk.downloads).toEqual(['arm.skel', 'arm.axskel']);
    expect(page.names()).toEqual([]);
  });

  it('a skeleton from the axis-angle form is zipped with a rig that finds it', async () => {
    const { zipCharacter } = await import('../../../src/app/zip-character.ts');
    const { parse } = await import('../../../src/worker/parse.ts');
    const page = await pageWith({ 'arm.axskel': ARM });
    const { name, bytes } = zipCharacter(first(page));
    const { files, diagnostics } = await parse({ files: [{ path: name, blob: new Blob([bytes]) }] }, () => undefined);
    expect(diagnostics).toEqual([]);
    expect(files.map(({ source }) => source.name).sort()).toEqual(['arm.axskel', 'arm.rig']);
    expect(files.find((file) => file.kind === 'rig')).toMatchObject({ rig: { skeleton: 'arm.axskel' } });
  });
});
