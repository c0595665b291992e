/** Saving to the files that parts came from, and to others. */
import { describe, expect, it } from 'vitest';
import { addSet, setLocked } from '../../src/edit/commands/beside/sets.ts';
import { addMarkers, removeMarkers } from '../../src/edit/commands/markers.ts';
import { renameTake } from '../../src/edit/commands/take.ts';
import type { Character } from '../../src/model/document.ts';
import { ODD_AMC, ODD_ASF } from '../helpers/acclaim.ts';
import { takeOfValues } from '../helpers/builders.ts';
import { pageWith } from './disk.ts';
import { ANIM, HERO, limited, longer, posed, SKEL, SKIN, said } from './hero.ts';

/** The take with another number in its first frame. */
const withFirstValue =
  (value: number) =>
  (character: Character): Character => ({
    ...character,
    takes: character.takes.map((take) => {
      const { samples } = take;
      if (!samples) return take;
      return { ...take, samples: { ...samples, values: samples.values.map((own, i) => (i === 0 ? value : own)) } };
    }),
  });

describe('saving what changed', () => {
  it('saves a changed part in place, and nothing else', async () => {
    const page = await pageWith(HERO);
    page.change(longer);
    await page.saver.saveChanged();
    expect(page.text('hero_walk.anim')).toContain('range 0 7');
    expect(page.text('hero.skel')).toBe(SKEL);
    expect(page.names()).toEqual([]);
    expect(said(page)).toBe('Saved hero_walk.anim.');
  });

  const ROOT = 'ROOT hips { OFFSET 0 0 0 CHANNELS 3 Xposition Yposition Zposition End Site { OFFSET 0 20 0 } }';
  const BVH = `HIERARCHY ${ROOT}\nMOTION Frames: 2 Frame Time: 0.1\n0 90 0\n1 90 0\n`;
  const MARK = { characterId: 'c1', markers: [{ timeSeconds: 0.1, label: 'ends' }] };

  it.each([
    ['a capture', { 'walk.bvh': BVH }, 'walk'],
    ['an animation', HERO, 'hero_walk'],
  ])('saves the markers of %s beside it, and leaves its own file alone', async (_, files, name) => {
    const page = await pageWith(files);
    page.disk.picks = 'as suggested';
    page.store.apply(addMarkers, MARK);
    expect(page.names()).toEqual([`${name}.markers.json`]);
    await page.saver.saveChanged();
    expect(page.disk.asked).toEqual([`${name}.markers.json`]);
    expect(page.text(`${name}.markers.json`)).toContain('ends');
    for (const [own, text] of Object.entries(files)) expect(page.text(own)).toBe(text);
    expect(page.names()).toEqual([]);
    // What else is edited is saved to the take's own file, as before.
    page.change(longer);
    if (name !== 'walk') expect(page.names()).toEqual(['hero_walk.anim']);
    page.store.undo();
    page.store.apply(removeMarkers, { characterId: 'c1', indices: [0] });
    expect(page.names()).toEqual([`${name}.markers.json`]);
    await page.saver.saveChanged();
    expect(page.names()).toEqual([]);
    page.store.undo();
    expect(page.names()).toEqual([`${name}.markers.json`]);
  });

  it('saves a skeleton of Acclaim and its motion to their own files, each if it was edited', async () => {
    const page = await pageWith({ 'odd.asf': ODD_ASF, 'odd_walk.amc': ODD_AMC });
    page.change(withFirstValue(7.5));
    expect(page.names()).toEqual(['odd_walk.amc']);
    await page.saver.saveChanged();
    expect(page.text('odd_walk.amc')).toContain('root 7.5 -0.2 0.3 0.5 0.25 -0.75');
    expect(page.text('odd.asf')).toBe(ODD_ASF);
    page.change(({ skeleton, ...rest }) => {
      const joints = skeleton?.joints.map((joint, j) =>
        j === 1 ? { ...joint, limits: joint.limits.map(() => ({ min: -2, max: 3 })) } : joint,
      );
      return { ...rest, ...(skeleton && joints && { skeleton: { ...skeleton, joints } }) };
    });
    expect(page.names()).toEqual(['odd.asf']);
    await page.saver.saveChanged();
    expect(page.text('odd.asf')).toContain('limits (-2 3)');
    expect([page.names(), page.disk.asked, page.disk.downloads]).toEqual([[], [], []]);
    // Both are read again as what is open.
    await page.open(['odd.asf', 'odd_walk.amc'].map((path) => ({ path, blob: new Blob([page.text(path) ?? '']) })));
    expect(page.store.document.characters).toHaveLength(1);
    expect(page.store.document.characters[0].takes).toHaveLength(1);
  });

  it('counts markers as saved that were just read for a take that is', async () => {
    const page = await pageWith({ 'walk.bvh': BVH });
    await page.open([{ path: 'walk.markers.json', blob: new Blob(['[{ "time": 0.1, "label": "ends" }]']) }]);
    expect(page.store.document.characters[0].takes[0].markers).toHaveLength(1);
    expect(page.names()).toEqual([]);
    page.store.apply(removeMarkers, { characterId: 'c1', indices: [0] });
    expect(page.names()).toEqual(['walk.markers.json']);
  });

  it('saves sets and locks in the file beside the skeleton, in place, and nothing else; undo goes back to its bytes', async () => {
    const text = '{"sets": [{"name": "all", "joints": ["#0"], "icon": "hand"}]}';
    const page = await pageWith({ ...HERO, 'hero.sets.json': text });
    page.store.apply(setLocked, { characterId: 'c1', dofs: [4], locked: true });
    expect(page.names()).toEqual(['hero.sets.json']);
    page.store.undo();
    expect(page.names()).toEqual([]);
    page.store.redo();
    await page.saver.saveChanged();
    expect(page.names()).toEqual([]);
    expect(page.text('hero.skel')).toBe(SKEL);
    const saved = JSON.parse(page.text('hero.sets.json') ?? '');
    expect(saved).toMatchObject({ sets: [{ name: 'all', icon: 'hand' }], locked: [{ dofs: ['ry'] }] });
    page.store.undo();
    await page.saver.saveChanged();
    expect(JSON.parse(page.text('hero.sets.json') ?? '')).toMatchObject({ sets: saved.sets, locked: [] });
  });

  it('saves the first sets of a skeleton as a file that is called after it', async () => {
    const page = await pageWith(HERO);
    page.disk.picks = 'as suggested';
    page.store.apply(addSet, { characterId: 'c1', name: 'all', joints: [0] });
    await page.saver.saveChanged();
    expect(page.disk.asked).toEqual(['hero.sets.json']);
    expect(page.names()).toEqual([]);
  });

  it('tells which files were written, with what they hold now', async () => {
    const page = await pageWith(HERO);
    page.change(longer);
    await page.saver.saveChanged();
    expect(page.written.map(({ path }) => path)).toEqual(['hero_walk.anim']);
    expect(await page.written[0].content.text()).toBe(page.text('hero_walk.anim'));
  });

  it('reports that there is nothing to save', async () => {
    const page = await pageWith(HERO);
    await page.saver.saveChanged();
    expect(said(page)).toBe('Everything is saved. Use Save as to write copies.');
  });

  it('saves a renamed take to a file of that name, and under its own name to its own', async () => {
    const page = await pageWith(HERO);
    page.disk.picks = 'as suggested';
    page.store.apply(renameTake, { characterId: 'c1', take: 0, name: 'hero_run' });
    expect(page.names()).toEqual(['hero_run.anim']);
    page.store.apply(renameTake, { characterId: 'c1', take: 0, name: 'hero_walk' });
    page.change(longer);
    await page.saver.saveChanged();
    expect(page.disk.asked).toEqual([]);
    expect(page.text('hero_walk.anim')).toContain('range 0 7');
    page.store.apply(renameTake, { characterId: 'c1', take: 0, name: 'hero_run' });
    await page.saver.saveChanged();
    expect(page.disk.asked).toEqual(['hero_run.anim']);
    expect(page.names()).toEqual([]);
  });

  it('saves each part to its own file, and new parts next to them', async () => {
    const page = await pageWith({ ...HERO, 'hero_run.anim': ANIM, 'other/hero.skin': SKIN });
    page.disk.picks = 'as suggested';
    page.change((c) => ({
      ...c,
      takes: [takeOfValues('hero_new', [1]), ...c.takes].map((own) => ({ ...own, range: [0, 4] })),
    }));
    await page.saver.saveChanged();
    expect(page.disk.asked).toEqual(['hero_new.anim']);
    for (const name of ['hero_walk.anim', 'hero_run.anim', 'hero_new.anim']) {
      expect(page.text(name)).toContain('range 0 4');
    }
    expect(page.text('hero.skin')).toBe(SKIN);
    expect(page.text('hero.skel')).toBe(SKEL);
    expect(said(page)).toBe('Saved hero_walk.anim, hero_run.anim, hero_new.anim.');
  });

  it('saves pose and limits to the skeleton’s file', async () => {
    const page = await pageWith(HERO);
    page.change((c) => limited(posed(c)));
    await page.saver.saveChanged();
    expect(page.text('hero.skel')).toContain('pose 0 0.25 0');
    expect(page.text('hero.skel')).toContain('rotxlimit -2 3');
    expect(page.names()).toEqual([]);
  });

  it('leaves out a pose that a take overrides', async () => {
    const page = await pageWith(HERO);
    page.change((c) => limited({ ...posed(c), shownTake: 0 }));
    await page.saver.saveChanged();
    expect(page.text('hero.skel')).toContain('rotxlimit -2 3');
    expect(page.text('hero.skel')).not.toContain('pose');
  });

  it('saving what changed keeps all roots of a skeleton’s file', async () => {
    const page = await pageWith({ 'two.skel': `${SKEL}${SKEL}` });
    expect(page.store.document.characters).toHaveLength(2);
    page.change(posed, 1);
    await page.saver.saveChanged();
    expect(page.text('two.skel')?.match(/balljoint joint0/g)).toHaveLength(2);
    expect(page.text('two.skel')?.match(/pose/g)).toHaveLength(1);
    expect(page.names()).toEqual([]);
  });

  it('asks for a location once, and then saves there', async () => {
    const page = await pageWith(HERO);
    page.disk.picks = page.disk.put('mine.anim', '');
    page.change((c) => ({ ...c, takes: [...c.takes, takeOfValues('new', new Array(9).fill(1), [0, 3])] }));
    await page.saver.saveChanged();
    expect(page.disk.asked).toEqual(['new.anim']);
    expect(page.text('mine.anim')).toContain('range 0 3');
    expect(said(page)).toBe('Saved mine.anim.');
    page.change(longer);
    await page.saver.saveChanged();
    expect(page.disk.asked).toHaveLength(1);
    expect(page.text('mine.anim')).toContain('range 0 7');
  });

  it('saves the pose library, to its own file if it has one', async () => {
    const page = await pageWith(HERO);
    page.disk.picks = page.disk.put('hero.pose', '');
    page.change((c) => ({ ...c, poses: [{ name: 'sit', values: c.pose.map(() => 0.5) }] }));
    expect(page.names()).toEqual(['hero.pose']);
    await page.saver.saveChanged();
    expect(page.disk.asked).toEqual(['hero.pose']);
    const written = page.text('hero.pose') ?? '';
    expect(written).toContain('sit');
    expect(page.names()).toEqual([]);

    const next = await pageWith({ ...HERO, 'kept.pose': written });
    expect(next.names()).toEqual([]);
    next.change((c) => ({ ...c, poses: [{ name: 'squat', values: c.pose.map(() => 0.25) }] }));
    await next.saver.saveChanged();
    expect(next.text('kept.pose')).toContain('squat');
    expect(said(next)).toBe('Saved kept.pose.');
    expect(next.names()).toEqual([]);
  });

  it('saving what changed keeps the unsaved mark if the user cancels', async () => {
    const page = await pageWith(HERO, false);
    page.disk.picks = 'give up';
    page.change(longer);
    await page.saver.saveChanged();
    expect(page.names()).toEqual(['hero_walk.anim']);
    expect(page.disk.downloads).toEqual([]);
    expect(said(page)).toBeUndefined();
  });

  it('downloads if the browser has no save dialog', async () => {
    const page = await pageWith(HERO, false);
    page.change(longer);
    await page.saver.saveChanged();
    expect(page.disk.downloads).toEqual(['hero_walk.anim']);
    expect(page.names()).toEqual([]);
  });

  it('warns of changes on disk first, and overwrites when saved again', async () => {
    const page = await pageWith(HERO);
    const handle = page.handle('hero_walk.anim');
    if (handle) page.disk.files.set(handle, 'theirs');
    page.change(longer);
    await page.saver.saveChanged();
    expect(page.text('hero_walk.anim')).toBe('theirs');
    expect(page.names()).toEqual(['hero_walk.anim']);
    expect(page.messages.list.get()[0]?.text).toContain('changed on disk');
    await page.saver.saveChanged();
    expect(page.text('hero_walk.anim')).toContain('range 0 7');
    expect(page.messages.list.get()).toEqual([]);
  });

  it('saving what changed keeps the mark if writing fails, tells why, and asks for another location next', async () => {
    const page = await pageWith(HERO);
    const handle = page.handle('hero_walk.anim');
    if (handle) page.disk.files.delete(handle);
    page.change(longer);
    await page.saver.saveChanged();
    expect(page.names()).toEqual(['hero_walk.anim']);
    expect(page.messages.list.get()[0]?.text).toBe(
      'hero_walk.anim: Not saved. It is gone. Save again to choose another location.',
    );
    page.disk.picks = page.disk.put('hero_walk.anim', '');
    await page.saver.saveChanged();
    expect(page.names()).toEqual([]);
    expect(page.messages.list.get()).toEqual([]);
  });

  it('saves the other files if one fails', async () => {
    const page = await pageWith(HERO);
    const handle = page.handle('hero.skel');
    if (handle) page.disk.files.delete(handle);
    page.change((c) => limited(longer(c)));
    await page.saver.saveChanged();
    expect(page.names()).toEqual(['hero.skel']);
    expect(page.text('hero_walk.anim')).toContain('range 0 7');
  });
});

describe('saving as', () => {
  it('asks for a location, and saves there from then on', async () => {
    const page = await pageWith(HERO);
    page.disk.picks = page.disk.put('copy.anim', '');
    page.change(longer);
    await page.saver.saveAs('c1', 'anim');
    expect(page.text('copy.anim')).toContain('range 0 7');
    expect(page.text('hero_walk.anim')).toBe(ANIM);
    expect(page.names()).toEqual([]);
    page.change((c) => ({ ...c, takes: c.takes.map((own) => ({ ...own, range: [0, 9] })) }));
    await page.saver.saveChanged();
    expect(page.text('copy.anim')).toContain('range 0 9');
    expect(page.text('hero_walk.anim')).toBe(ANIM);
  });

  it('saving as counts poses as saved', async () => {
    const page = await pageWith(HERO, false);
    page.change((c) => ({ ...c, poses: [{ name: 'sit', values: [1] }] }));
    await page.saver.saveAs('c1', 'pose');
    expect(page.disk.downloads).toEqual(['hero.pose']);
    expect(page.names()).toEqual([]);
  });

  it('saving as tells what is missing', async () => {
    const page = await pageWith(HERO);
    await page.saver.saveAs('c1', 'skin');
    expect(page.messages.list.get()[0]?.text).toBe('hero has nothing to save as .skin.');
  });

  it('a conversion that is refused is a message, and saving goes on after it', async () => {
    const page = await pageWith(HERO);
    page.change((c) => ({ ...c, takes: c.takes.map((own) => ({ ...own, range: [0, 1e6] })) }));
    await page.saver.saveAs('c1', 'bvh');
    expect(page.messages.list.get()).toMatchObject([
      {
        severity: 'error',
        text: 'Not saved. hero_walk would have 30,000,001 frames, but the maximum is 1,000,000.',
      },
    ]);
    await page.saver.saveChanged();
    expect(page.text('hero_walk.anim')).toContain('range 0 1000000');
  });

  it('saves a whole character as one zip', async () => {
    const page = await pageWith(HERO);
    page.change(longer);
    await page.saver.saveAll('c1');
    expect(page.disk.downloads).toEqual(['hero.zip']);
    expect(page.names()).toEqual([]);
  });

  it('downloads all characters as one zip without asking, and all of them count as saved', async () => {
    const page = await pageWith(HERO);
    page.disk.picks = 'as suggested';
    page.change(longer);
    await page.saver.saveEverything();
    expect([page.disk.downloads, page.disk.asked]).toEqual([['marrow.zip'], []]);
    expect(page.names()).toEqual([]);
  });
});
