import { describe, expect, it } from 'vitest';
import { zipCharacter } from '../../../src/app/zip-character.ts';
import { saveCharacter } from '../../../src/files/save/saving.ts';
import type { Character } from '../../../src/model/document.ts';
import type { Skeleton } from '../../../src/model/skeleton/skeleton.ts';
import type { Samples } from '../../../src/model/takes/samples.ts';
import { parse } from '../../../src/worker/parse.ts';
import { pageWith } from '../../app/disk.ts';
import { character, takeOfValues } from '../../helpers/builders.ts';
import { bvhJoint, captureOf } from '../../helpers/bvh.ts';
import { writeBvh } from '../../helpers/bvh-text.ts';

const FIGURE: Skeleton = {
  name: 'walk',
  joints: [
    bvhJoint(-1, ['tx', 'ty', 'tz', 'rz', 'rx', 'ry'], { name: 'Hips' }),
    bvhJoint(0, ['rx'], { name: 'Chest', endSites: [[0, 2, 0]] }),
  ],
};
const ROWS = [0, 1, 2, 3].map((f) => [f, 90, 0.1, 1, 2, 3, f / 7]);
const BVH = writeBvh([captureOf(FIGURE, ROWS)]).text;
const TWO = writeBvh([
  captureOf({ name: 'a', joints: [bvhJoint(-1, ['tx', 'ty', 'tz'], { name: 'A' })] }, [[1, 2, 3]]),
  captureOf({ name: 'b', joints: [bvhJoint(-1, ['tx', 'ty', 'tz'], { name: 'B' })] }, [[4, 5, 6]]),
]).text;

/** Other samples in the shown take, as trimming makes them. */
function withSamples(c: Character, change: (samples: Samples) => Samples): Character {
  return { ...c, takes: c.takes.map((own) => (own.samples ? { ...own, samples: change(own.samples) } : own)) };
}
const trimmed = (c: Character): Character =>
  withSamples(c, (s) => ({ ...s, frameCount: 2, values: s.values.slice(0, 2 * s.scales.length) }));

describe('saving motion capture', () => {
  it('finds a file that was just opened saved, however it is played', async () => {
    const page = await pageWith({ 'walk.bvh': BVH });
    expect(page.names()).toEqual([]);
    page.change((c) => withSamples(c, (s) => ({ ...s, interpolation: 'nearest' })));
    page.change((c) => ({ ...c, takes: c.takes.map((own) => ({ ...own, range: [0, 0.04] })) }));
    expect(page.names()).toEqual([]);
  });

  it('writes a changed take back into its .bvh', async () => {
    const page = await pageWith({ 'walk.bvh': BVH });
    page.change(trimmed);
    expect(page.unsaved.current()).toEqual([{ characterId: 'c1', kind: 'bvh', index: 0, name: 'walk.bvh' }]);
    await page.saver.saveChanged();
    expect(page.text('walk.bvh')).toBe(writeBvh([captureOf(FIGURE, ROWS.slice(0, 2))]).text);
    expect(page.names()).toEqual([]);
    expect(page.messages.list.get()).toEqual([]);
  });

  it('samples keyed channels, and keeps the others unchanged', async () => {
    const page = await pageWith({ 'walk.bvh': BVH });
    const [keyed] = takeOfValues('', [Math.PI]).channels;
    page.change((c) => ({ ...c, takes: c.takes.map((own) => ({ ...own, channels: own.channels.with(6, keyed) })) }));
    await page.saver.saveChanged();
    expect(page.text('walk.bvh')).toBe(
      writeBvh([
        captureOf(
          FIGURE,
          ROWS.map((row) => row.with(6, 180)),
        ),
      ]).text,
    );
  });

  it('saving motion capture keeps all roots of one file', async () => {
    const page = await pageWith({ 'two.bvh': TWO });
    expect(page.store.document.characters).toHaveLength(2);
    page.change((c) => withSamples(c, (s) => ({ ...s, values: Float64Array.of(7, 8, 9) })), 1);
    await page.saver.saveChanged();
    expect(page.text('two.bvh')).toBe(TWO.replace('1 2 3 4 5 6', '1 2 3 7 8 9'));
    expect(page.names()).toEqual([]);
  });

  it('says so, and writes nothing, where the roots of one file now have different frames', async () => {
    const page = await pageWith({ 'two.bvh': TWO });
    const longer = (s: Samples) => ({ ...s, frameCount: 2, values: Float64Array.of(7, 8, 9, 7, 8, 9) });
    page.change((c) => withSamples(c, longer), 1);
    await page.saver.saveChanged();
    expect(page.text('two.bvh')).toBe(TWO);
    expect(page.names()).toEqual(['two.bvh']);
    expect(page.messages.list.get()[0]?.text).toContain('now have different frames');
  });

  it('exports .skel and .anim as copies, by which nothing counts as saved', async () => {
    const page = await pageWith({ 'walk.bvh': BVH }, false);
    page.change(trimmed);
    await page.saver.saveAs('c1', 'skel');
    await page.saver.saveAs('c1', 'anim');
    expect(page.disk.downloads).toEqual(['walk.skel', 'walk.anim']);
    expect(page.names()).toEqual(['walk.bvh']);
  });

  it('exports any other character as .bvh, keys at the rate asked for', () => {
    const walking = character({ takes: [takeOfValues('hero_walk', new Array(9).fill(0.5), [0, 2])], shownTake: 0 });
    const [file] = saveCharacter(walking, 'bvh', { framesPerSecond: 4 });
    expect(file.name).toBe('hero_walk.bvh');
    expect(file.text).toContain('Frames: 9\nFrame Time: 0.25\n');
  });

  it('zips as the .bvh that it is, which opens again as it was', async () => {
    const page = await pageWith({ 'walk.bvh': BVH });
    const [before] = page.store.document.characters;
    const { name, bytes } = zipCharacter(before);
    const { files } = await parse({ files: [{ path: name, blob: new Blob([bytes]) }] }, () => undefined);
    expect(files.map(({ source }) => source.name)).toEqual(['walk.bvh']);
    const captures = files[0].kind === 'bvh' ? files[0].captures : [];
    expect(captures).toEqual([{ skeleton: before.skeleton, take: before.takes[0] }]);
  });
});
