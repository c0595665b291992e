/** Takes with layers as files: what is saved is read again, and the plain file moves the same for other programs. */
import { createHash } from 'node:crypto';
import { describe, expect, it } from 'vitest';
import { compileTake } from '../../../src/evaluate/compiled-take.ts';
import { evaluateChannel } from '../../../src/evaluate/curves.ts';
import { evaluateMotion, takeMotion } from '../../../src/evaluate/take-motion.ts';
import { joinLayers } from '../../../src/files/open/layers.ts';
import { openFiles } from '../../../src/files/open/open-files.ts';
import { changedFiles } from '../../../src/files/save/jobs.ts';
import { layersCopies } from '../../../src/files/save/layers.ts';
import { outputOf, savedFileOf } from '../../../src/files/save/output.ts';
import { SavedParts } from '../../../src/files/save/saved-parts.ts';
import { type Character, EMPTY_DOCUMENT } from '../../../src/model/document.ts';
import { byFileName, type ParsedFile } from '../../../src/model/files.ts';
import { channelOf } from '../../edit/keys/channels.ts';
import { layeredTake, layerOf } from '../../edit/layers/layered.ts';
import { character, documentOf, skeleton } from '../../helpers/builders.ts';
import { parsed } from '../../helpers/parsed.ts';

const wave = channelOf([
  [0, 0, 'auto'],
  [0.5, 1, 'auto'],
  [2, 0, 0.25, 'linear'],
]);
const nod = channelOf([
  [0.25, 0, 'flat'],
  [1, 0.5, 'flat'],
]);
const TAKE = layeredTake(
  Array.from({ length: 9 }, () => wave),
  [
    layerOf(
      Array.from({ length: 9 }, () => nod),
      { name: 'arm up', weight: 0.3, joints: ['joint2'], others: { tag: 1 } },
    ),
    layerOf(
      Array.from({ length: 9 }, () => nod),
      { name: 'more', mode: 'override', weight: nod, root: true, mute: true },
    ),
  ],
);
const HERO: Character = character({ skeleton: skeleton(2), takes: [TAKE], shownTake: 0, clampsToLimits: false });

const saved = () => layersCopies(HERO).map((copy) => savedFileOf(outputOf(copy)));

describe('the files of a take with layers', () => {
  it('are its base, its layers, the plain file and, last, the JSON with the hash of that', () => {
    const files = saved();
    expect(files.map(({ name }) => name)).toEqual([
      ...['walk.base.anim', 'walk.arm_up.anim', 'walk.more.anim', 'walk.anim', 'walk.layers.json'],
    ]);
    const hash = createHash('sha256').update(files[3].text).digest('hex');
    expect(JSON.parse(files[4].text).flattened).toEqual({ file: 'walk.anim', sha256: hash });
  });

  it('are read as one take, saved again byte for byte, and the plain file moves the same', () => {
    const files = saved();
    const { files: joined, diagnostics } = joinLayers(
      files.map(({ name, text }) => parsed(name, text)),
      'edit',
      byFileName,
    );
    expect(diagnostics).toEqual([]);
    expect(joined.map(({ kind, source }) => [kind, source.name])).toEqual([['anim', 'walk.anim']]);
    const [file] = joined;
    if (file.kind !== 'anim') throw new Error('A take was expected.');
    const again = layersCopies({ ...HERO, takes: [file.take] }).map((copy) => savedFileOf(outputOf(copy)));
    expect(again.map(({ text }) => text)).toEqual(files.map(({ text }) => text));
    const plain = parsed('walk.anim', files[3].text);
    const shown = new Float64Array(9);
    for (const time of [-3, 0, 0.4, 1.1, 2, 7]) {
      evaluateMotion(takeMotion(TAKE, HERO.skeleton), time, shown, 9);
      shown.forEach((value, c) => {
        const own = plain.kind === 'anim' ? evaluateChannel(compileTake(plain.take), c, time) : Number.NaN;
        expect(own).toBeCloseTo(value, 9);
      });
    }
  });

  it('count as the plain file alone once that was edited, unless the layers are kept', () => {
    const files = saved().map(({ name, text }) => parsed(name, text));
    const edited = files.map((file) =>
      file.source.name === 'walk.anim' ? { ...file, sha256: '00'.repeat(32) } : file,
    );
    const keeps = (keep: 'edit' | 'controls') => joinLayers(edited, keep, byFileName);
    for (const keep of ['edit', 'controls'] as const) {
      const { files: joined, diagnostics } = keeps(keep);
      expect(diagnostics).toEqual([expect.objectContaining({ code: 'flattened-edited', severity: 'warning' })]);
      expect(joined.map((file) => file.kind === 'anim' && file.take.layers !== undefined)).toEqual([
        keep === 'controls',
      ]);
    }
  });

  it('are opened as saved, and all written by one save once a layer changes', () => {
    const joined = joinLayers(
      saved().map(({ name, text }) => parsed(name, text)),
      'edit',
      byFileName,
    ).files;
    const skel = { kind: 'skel', skeletons: [skeleton(2, 'walk')] } as const;
    const all: ParsedFile[] = [{ ...skel, source: { name: 'walk.skel', path: 'walk.skel', bytes: 1 } }, ...joined];
    const { document } = openFiles(EMPTY_DOCUMENT, all);
    const [opened] = document.characters;
    expect(opened.takes.map(({ name, layers }) => [name, layers?.list.length])).toEqual([['walk', 2]]);
    expect(opened.sources.map(({ name }) => name)).toEqual(
      expect.arrayContaining(['walk.base.anim', 'walk.arm_up.anim', 'walk.anim', 'walk.layers.json']),
    );
    const parts = new SavedParts();
    const unsaved = parts.unsavedIn(documentOf({ ...HERO, id: 'c1' })).filter(({ kind }) => kind === 'anim');
    const jobs = changedFiles(documentOf(HERO), unsaved, () => []);
    expect(jobs.map(({ name }) => name)).toEqual([
      ...['walk.base.anim', 'walk.arm_up.anim', 'walk.more.anim', 'walk.anim', 'walk.layers.json'],
    ]);
    const texts = jobs.map((job) => savedFileOf({ ...job.write(job.name), name: job.name }).text);
    expect(texts).toEqual(saved().map(({ text }) => text));
  });
});
