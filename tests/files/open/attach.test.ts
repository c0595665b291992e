/** Attachments as files: what is saved is read again, whatever the order of the files, and the plain file moves the same. */
import { describe, expect, it } from 'vitest';
import { keyPose } from '../../../src/edit/commands/keying.ts';
import { setDofs } from '../../../src/edit/commands/pose.ts';
import { Store } from '../../../src/edit/store.ts';
import { joinLayers } from '../../../src/files/open/layers.ts';
import { openFiles } from '../../../src/files/open/open-files.ts';
import { SavedParts } from '../../../src/files/save/saved-parts.ts';
import { type Character, type Document, EMPTY_DOCUMENT } from '../../../src/model/document.ts';
import { byFileName } from '../../../src/model/files.ts';
import { differenceOf, sceneOf } from '../../edit/attach/attached.ts';
import { parsed } from '../../helpers/parsed.ts';
import { savedOf, scene, type Texts } from './attached-files.ts';

function opened(texts: Texts, names = [...texts.keys()], into = EMPTY_DOCUMENT) {
  const files = names.map((name) => parsed(name, texts.get(name) ?? ''));
  const joined = joinLayers(files, 'edit', byFileName);
  const result = openFiles(into, joined.files);
  return {
    document: result.document,
    files: joined.files,
    diagnostics: [...joined.diagnostics, ...result.diagnostics],
  };
}

function named(document: Document, name: string): Character {
  const found = document.characters.find((one) => one.name === name);
  if (!found) throw new Error(`no ${name}`);
  return found;
}

const TIMES = [0, 0.3, 0.5, 0.9, 1.4999, 1.5, 2];
const codes = (of: { readonly diagnostics: readonly { readonly code: string }[] }) =>
  of.diagnostics.map(({ code }) => code);
/** The sword in the space of the walker: characters are opened beside each other. */
function offBy(document: Document, meant: Document, time: number, what = 0): number {
  const place = (all: Document) => named(all, 'walker').placements[0].position[0];
  const found = sceneOf(named(document, 'sword'), what, time);
  found[12] -= place(document) - place(meant);
  return differenceOf(found, sceneOf(named(meant, 'sword'), what, time));
}

describe('the files of an attached take', () => {
  const before = scene();
  const texts = savedOf(before);

  it('are its base, the plain file and, last, the JSON with names and the hash of that', () => {
    expect([...texts.keys()]).toEqual([
      ...['walker.skel', 'walker_walk.anim', 'sword.skel'],
      ...['sword_anim.base.anim', 'sword_anim.anim', 'sword_anim.attach.json'],
    ]);
    expect(JSON.parse(texts.get('sword_anim.attach.json') ?? '')).toMatchObject({
      base: 'sword_anim.base.anim',
      flattened: { file: 'sword_anim.anim' },
      attached: [{ character: 'walker', joint: 'joint1', span: [0.5, 1.5] }],
    });
  });

  it('are opened again in any order, move the same and are saved byte for byte', () => {
    for (const names of [[...texts.keys()], [...texts.keys()].reverse()]) {
      const { document, diagnostics } = opened(texts, names);
      expect(diagnostics).toEqual([]);
      for (const time of TIMES) expect(offBy(document, before, time)).toBeLessThan(1e-12);
      expect(new Map([...savedOf(document)].sort())).toEqual(new Map([...texts].sort()));
    }
  });

  it('are saved when they were just read, until the leader moves: its plain file would be another', () => {
    const { document, files } = opened(texts);
    const [store, saved] = [new Store(), new SavedParts()];
    store.replace('Open', document);
    saved.opened(store.document, files);
    const unsaved = () => saved.unsavedIn(store.document).map(({ name }) => name);
    expect(unsaved()).toEqual([]);
    const { id } = named(document, 'walker');
    store.apply(setDofs, { characterId: id, dofs: [{ index: 3, value: 0.5 }], timeSeconds: 1 });
    // Not by what is only tried.
    expect(unsaved()).toEqual([]);
    store.apply(keyPose, { characterId: id, timeSeconds: 1 });
    expect(unsaved()).toEqual(['walker_walk.anim', 'sword_anim.anim']);
    store.undo();
    expect(unsaved()).toEqual([]);
  });

  it('are found by characters that were open before, and later', () => {
    const walker = ['walker.skel', 'walker_walk.anim'];
    const sword = [...texts.keys()].filter((name) => !walker.includes(name));
    const first = opened(texts, sword, opened(texts, walker).document);
    expect(first.diagnostics).toEqual([]);
    expect(offBy(first.document, before, 1)).toBeLessThan(1e-12);
    const alone = opened(texts, sword);
    expect(codes(alone)).toEqual(['attach-leader-missing']);
    expect(alone.diagnostics[0].message).toBe('attached[0].character: no open character is called "walker".');
    expect(named(alone.document, 'sword').takes[0].attached).toBeUndefined();
    const later = opened(texts, walker, alone.document);
    expect(codes(later)).toEqual([]);
    expect(offBy(later.document, before, 1)).toBeLessThan(1e-12);
    expect(later.document.unused).toEqual([]);
  });

  it('have a plain file that moves the same at whole frames, which holds without its leader', () => {
    const alone = opened(texts, ['sword.skel', 'sword_anim.anim']).document;
    const sword = named(alone, 'sword');
    for (let f = 0; f <= 60; f++) {
      const meant = sceneOf(named(before, 'sword'), 0, f / 30);
      expect(differenceOf(sceneOf(sword, 0, f / 30), meant)).toBeLessThan(4e-3);
    }
    const waiting = named(
      opened(
        texts,
        [...texts.keys()].filter((name) => !name.startsWith('walker')),
      ).document,
      'sword',
    );
    expect(differenceOf(sceneOf(waiting, 0, 1), sceneOf(sword, 0, 1))).toBe(0);
  });

  it('keep fields that are not known, and are no longer read where they name each other', () => {
    const json = texts.get('sword_anim.attach.json') ?? '';
    const more = json.replace('"span"', '"tag": 1, "span"').replace('"base"', '"by": 2,\n  "base"');
    const { document } = opened(new Map([...texts, ['sword_anim.attach.json', more]]));
    const again = JSON.parse(savedOf(document).get('sword_anim.attach.json') ?? '');
    expect(again).toMatchObject({ by: 2, attached: [{ tag: 1 }] });
    const ring = json
      .replace('"walker"', '"sword"')
      .replace('"joint1"', '"hilt"')
      .replace(/sword_anim/g, 'walker_walk')
      .replace(/ *"flattened".*\n/, '');
    const both = opened(
      new Map([
        ...texts,
        ['walker_walk.attach.json', ring],
        ['walker_walk.base.anim', texts.get('walker_walk.anim') ?? ''],
      ]),
    );
    expect(codes(both)).toContain('attach-wrong');
    expect(both.diagnostics.find(({ code }) => code === 'attach-wrong')?.message).toMatch(
      /can’t follow .*, which follows .* itself/,
    );
  });
});
